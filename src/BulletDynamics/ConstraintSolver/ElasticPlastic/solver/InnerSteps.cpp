// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "InnerSteps.h"

#include <math.h>

#include "../joint/JointRegistry.h"
#include "../joint/JointWorks.h"
#include "BulletDynamics/ConstraintSolver/btContactSolverInfo.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// 1 << this many inner steps for an island on which something is about to bounce: it bounces when it touches, to an inner step.
const int BOUNCE_LEVEL = 3;
/// The number of successive steps that have to leave little open before inner steps become half as many.
const int CALM_INNER_STEPS = 6;
/// After so many they do whatever the moment.
const int MOST_CALM_INNER_STEPS = 24;
/// Levels that may become less at once.
const int MOST_SPARE = 15;
/// Below this share of the error allowed a step has left little open: it falls as the square of the step.
const double CALM_INNER_SHARE = 1. / 8;
/// Below this share of the error a step leaves next to nothing open, and the next one may have fewer inner steps at once.
const double NO_INNER_SHARE = 1. / 1000;
/// The least work of a solution by joint, in the unit of btElasticPlasticStatistics::m_work: what no island of so many joints can do
/// twice is not tried.
const long long LEAST_WORK_A_JOINT = 500;

int levelOf(int steps)
{
	int level = 0;
	while (2 << level <= steps)
		++level;
	return level;
}

/// What the joints remember: islands may have joined since.
InnerRhythm rhythmOf(const SolverGroup& island)
{
	InnerRhythm rhythm = {0, 255, 255};
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
		{
			const InnerRhythm& joint = island.m_joints[i]->m_rhythm;
			btSetMax(rhythm.m_level, joint.m_level);
			btSetMin(rhythm.m_calm, joint.m_calm);
			btSetMin(rhythm.m_spare, joint.m_spare);
		}
	return rhythm;
}

/// Begins a step that may have inner ones. \return the joints' action, null if they do not have one in common that ends their steps
JointRegistry* beginJoints(const SolverGroup& island)
{
	JointRegistry* registry = nullptr;
	bool isOne = true;
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		if (i + PREFETCH_AHEAD < island.m_numConstraints && island.m_joints[i + PREFETCH_AHEAD])
			island.m_joints[i + PREFETCH_AHEAD]->prefetch();
		JointWorks* const joint = island.m_joints[i];
		if (!joint)
			continue;
		const bool isEnded = joint->beginInside();
		if (joint->m_model.m_fault)
			continue;
		registry = registry ? registry : joint->m_entry.m_registry;
		isOne &= isEnded && joint->m_entry.m_registry == registry && !joint->m_model.m_isPaper;
	}
	return isOne && registry && !registry->isStepControlled() ? registry : nullptr;
}

/// What the last solution has left open, before joints are committed.
OpenShare measure(const SolverGroup& island, double length, double ahead)
{
	OpenShare open(true);
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		const JointWorks* const works = island.m_joints[i];
		if (!works || works->m_step.getNumRows() == 0)
			continue;
		const JointStep& step = works->m_step;
		const btElasticPlasticState& state = works->m_model.m_state;
		btScalar after[BT_EP_DOF_COUNT];
		step.projectVelocities(after);
		const double place = double(works->m_model.bodyA().getCenterOfMassPosition().length()) + 1;
		for (int r = 0; r < step.getNumRows(); ++r)
		{
			const int dof = step.getDof(r);
			open.addRow(works->m_model.m_capacity,
						{dof, step.getRateBefore(r), -after[dof], step.getImpulse(r) / step.getTimeStep(),
						 state.m_plastic[dof], state.m_plasticPath[dof]},
						length, ahead, place);
		}
	}
	if (!open.hasOpenWork())
		return open;
	for (int i = 0; i < island.m_numBodies; ++i)
	{
		const btRigidBody* const body = btRigidBody::upcast(island.m_bodies[i]);
		if (body && body->getInvMass() > 0 && body->isActive())
			open.addBody(*body);
	}
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
			for (const btRigidBody* body :
				 {&island.m_constraints[i]->getRigidBodyA(), &island.m_constraints[i]->getRigidBodyB()})
				if (body->isStaticOrKinematicObject())
					open.addSupport(*body, island.m_joints[i]->m_step.getKinematics().m_rA +
											   island.m_constraints[i]->getRigidBodyA().getCenterOfMassPosition());
	return open;
}
}  // namespace

bool InnerSteps::mayBeTaken(const SolverGroup& island, const btElasticPlasticSolverSettings& settings)
{
	return settings.m_innerError > 0 && settings.m_maxInnerSteps > 1 &&
		   2 * LEAST_WORK_A_JOINT * island.m_numConstraints <= settings.m_maxInnerWork;
}

bool InnerSteps::mayBounce(const btElasticPlasticSolverSettings& settings)
{
	return settings.m_maxInnerSteps >= 1 << BOUNCE_LEVEL;
}

void InnerSteps::solve(const SolverGroup& island, const btContactSolverInfo& info,
					   const btElasticPlasticSolverSettings& settings, btElasticPlasticStatistics& statistics,
					   Solution& solution)
{
	Task task = {island, info, settings, statistics, solution, statistics.m_work, 0, levelOf(settings.m_maxInnerSteps)};
	JointRegistry* const registry = info.m_timeStep > 0 && mayBeTaken(island, settings) ? beginJoints(island) : nullptr;
	if (!registry)
	{
		solution.solveStep(info, 1, settings.m_maxWork);
		return;
	}
	m_motions.clear();
	take(task, *registry);
	if (m_motions.size() > 0)
		registry->take(m_motions);
}

void InnerSteps::take(Task& task, const JointRegistry& registry)
{
	const SolverGroup& island = task.m_island;
	m_state.begin(island, task.m_info.m_timeStep, registry);
	int level = beginLevel(task);
	if (m_state.hasBounceAhead(task.m_info.m_restitutionVelocityThreshold))
		btSetMax(level, BOUNCE_LEVEL);
	btSetMin(level, task.m_maxLevel);
	for (;;)
	{
		// The first whole step after inner ones is the only one of its kind: velocities come to belong to another time.
		const bool isWhole = level == 0 && !JoinedShift::isWanted(island, task.m_info.m_timeStep);
		const Attempt attempt = isWhole ? solveWhole(task) : solveInner(task, level);
		if (attempt.m_next == level)
		{
			remember(island, level, attempt, task.m_settings.m_innerError);
			return;
		}
		if (isWhole)
			for (int i = 0; i < island.m_numConstraints; ++i)
				if (island.m_joints[i])
					island.m_joints[i]->m_step.revert();
		m_state.restore();
		level = attempt.m_next;
	}
}

/// That of the last step, or less if that was calm.
int InnerSteps::beginLevel(const Task& task)
{
	const SolverGroup& island = task.m_island;
	const InnerRhythm rhythm = rhythmOf(island);
	if (rhythm.m_level == 0 || rhythm.m_calm < CALM_INNER_STEPS)
		return rhythm.m_level;
	const int level = btMax(rhythm.m_level - btMax(int(rhythm.m_spare), 1), 0);
	const btScalar longer = task.m_info.m_timeStep / btScalar(1 << level);
	if (rhythm.m_calm < MOST_CALM_INNER_STEPS && !m_state.isJoinedShiftSmall(island, longer))
		return rhythm.m_level;
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
			island.m_joints[i]->m_rhythm.m_calm = 0;
	return level;
}

InnerSteps::Attempt InnerSteps::solveWhole(Task& task)
{
	++task.m_numSolutions;
	task.m_solution.solveStep(task.m_info, 1, task.m_settings.m_maxWork);
	const double dt = task.m_info.m_timeStep;
	const OpenShare left = measure(task.m_island, dt, dt);
	const double open = left.getMendableShare();
	return {open, left.getShare(), refine(task, 0, open)};
}

/// Leaves the step in the middle where it goes on at another level.
InnerSteps::Attempt InnerSteps::solveInner(Task& task, int level)
{
	const SolverGroup& island = task.m_island;
	const int steps = 1 << level;
	const btScalar dt = task.m_info.m_timeStep, share = 1 / btScalar(steps), h = dt * share,
				   leastSpeed = task.m_info.m_restitutionVelocityThreshold;
	btContactSolverInfo info = task.m_info;
	info.m_timeStep = h;
	info.m_erp *= share;
	info.m_erp2 *= share;
	m_state.saveJoints(island);
	m_state.shiftFreeVelocities((dt - h) / 2);
	m_state.shiftJoinedVelocities(island, h);
	m_impulses.scale(island, share);
	Attempt attempt = {0, 0, level};
	double open = 0, doubted = 0;
	bool isLoaded = false;
	for (int k = 0; k < steps; ++k)
	{
		m_state.carry((k + 1) * h, h, leastSpeed);
		++task.m_numSolutions;
		++task.m_statistics.m_innerSteps;
		const bool isBounded = task.m_settings.m_maxWork > 0;
		task.m_solution.solveStep(info, share, isBounded ? btMax(task.getWorkLeft() / (steps - k), 1ll) : 0);
		const OpenShare left = measure(island, h, dt);
		btSetMax(open, left.getMendableShare());
		btSetMax(doubted, left.getShare());
		isLoaded = isLoaded || left.isLoaded();
		// What stays clear of yield asks for no shorter steps. It is calm but not still: longer steps damp it.
		const double most = isLoaded ? HUGE_VAL : task.m_settings.m_innerError * CALM_INNER_SHARE;
		attempt.m_open = btMin(open, most);
		attempt.m_doubted = btMin(doubted, most);
		// What half of the steps have not shown to be too much is cheaper to end than to begin again.
		attempt.m_next =
			2 * k < steps && isTooMuch(task, level) ? mostLevel(task, level) : refine(task, level, attempt.m_open);
		if (attempt.m_next != level)
			break;
		m_state.move(h);
		for (int i = 0; i < island.m_numConstraints; ++i)
			if (island.m_joints[i])
				island.m_joints[i]->commitInside(1. / steps);
		if (k + 1 == steps)
		{
			m_state.shiftFreeVelocities((h - dt) / 2);
			m_state.finish(steps, m_motions);
		}
	}
	m_impulses.restore();
	return attempt;
}

/// The highest level up to one that the settings have the work for, by the mean of the solutions so far.
int InnerSteps::mostLevel(const Task& task, int level) const
{
	long long most = task.m_settings.m_maxInnerWork;
	if (task.m_settings.m_maxWork > 0)
		most = btMin(most, task.getWorkLeft());
	while (level > 0 && task.getMeanWork() << level > most)
		--level;
	return level;
}

/// Whether a level takes far more than there is for it: what was right for the last step is not, since more is joined or touches.
bool InnerSteps::isTooMuch(const Task& task, int level) const
{
	return task.getMeanWork() << level > 2 * task.m_settings.m_maxInnerWork;
}

/// The level of inner steps that what a step has left open asks for, as far as the settings let it have it.
int InnerSteps::refine(Task& task, int level, double share) const
{
	const double error = task.m_settings.m_innerError;
	if (!(share > error))
		return level;
	const int wanted = level + btMax(1, int(ceil(0.5 * log2(share / error))));
	return btMax(level, mostLevel(task, btMin(wanted, task.m_maxLevel)));
}

/// An oscillation has moments at which a step leaves little open. What may be rounding asks for no shorter steps, and gives no leave for
/// far longer ones at once: it grows by the square of the step if it is none.
void InnerSteps::remember(const SolverGroup& island, int level, const Attempt& attempt, double error) const
{
	InnerRhythm rhythm = rhythmOf(island);
	const double doubted = attempt.m_doubted;
	const bool isCalm = attempt.m_open <= error * CALM_INNER_SHARE, isStill = doubted < error * NO_INNER_SHARE;
	const int spare = doubted > 0 ? int(floor(0.5 * log2(btMax(error / (8 * doubted), 1.)))) : MOST_SPARE;
	const int calm = isCalm ? btMin(rhythm.m_calm + 1, MOST_CALM_INNER_STEPS) : 0;
	const bool isNew = calm <= 1 || (isStill && calm < CALM_INNER_STEPS);
	rhythm.m_level = static_cast<unsigned char>(level);
	rhythm.m_spare = static_cast<unsigned char>(btMin(spare, isNew ? MOST_SPARE : int(rhythm.m_spare)));
	rhythm.m_calm = static_cast<unsigned char>(isStill ? btMax(calm, CALM_INNER_STEPS) : calm);
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
			island.m_joints[i]->m_rhythm = rhythm;
}
}  // namespace btElasticPlastic
