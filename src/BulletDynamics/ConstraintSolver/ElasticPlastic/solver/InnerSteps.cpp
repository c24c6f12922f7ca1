// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "InnerSteps.h"

#include <math.h>

#include "../joint/BodyGate.h"
#include "../joint/JointRegistry.h"
#include "../joint/JointWorks.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/ConstraintSolver/btContactSolverInfo.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "Drive.h"

namespace btElasticPlastic
{
namespace
{
/// 1 << this many inner steps for an island on which something is about to bounce: it bounces when it touches, to an inner step.
const int BOUNCE_LEVEL = 3;
/// 1 << this many where something strikes a structure, at the least: in a longer step all of it is struck at once.
const int BLOW_LEVEL = 5;
/// The number of successive steps that have to leave little open before inner steps become half as many.
const int CALM_WORLD_STEPS = 6;
/// They need not be more than have so many inner steps.
const int ENOUGH_CALM_INNER_STEPS = 192;
/// The same of inner steps before those to come within the step become twice as long: of a swing that they resolve it is more than one.
const int CALM_RUN = 32;
/// After so many times the number they do whatever the moment.
const int CALM_PATIENCE = 4;
/// Below this share of the error allowed an inner step of a run has left little open: what each of many leaves adds up.
const double CALM_RUN_SHARE = 1. / 50;
/// Levels that may become less at once.
const int MOST_SPARE = 15;
/// Below this share of the error allowed a step has left little open: it falls as the square of the step.
const double CALM_INNER_SHARE = 1. / 8;
/// Below this share of the error a step leaves next to nothing open, and the next one may have fewer inner steps at once.
const double NO_INNER_SHARE = 1. / 1000;
/// Inner steps of this share of the world's step and less are those of a blow. With a sixteenth, plates that ring after one would take twice the steps.
const btScalar SHARE_OF_A_BLOW = btScalar(1) / 32;
/// There has to be the work for 1 << this many inner steps, or none is tried: fewer tell little more of a blow than the whole step, and take several times as long.
const int LEAST_LEVEL = 3;
/// The least work of an inner step by joint, in the unit of btElasticPlasticStatistics::m_work: what no island of so many joints can do
/// so often is not tried.
const long long LEAST_WORK_A_JOINT = 500;
/// The same by contact point: it is set up and swept in each inner step, which no statistics count.
const long long LEAST_WORK_A_POINT = 166;

/// What has not flowed for so many steps rings; they are not counted beyond the second number.
const int QUIET_STEPS = 6, MOST_QUIET_STEPS = 2 * QUIET_STEPS;
/// What rings moves no faster than this many times as fast as it has, which is forgotten by a share in each step.
const double RINGING_MARGIN = 1.25;
const float RINGING_KEPT = 0.95f;
/// How often a step is solved once more because tension comes on in it: each time it is foreseen better.
const int MOST_FORESEEN = 4;
/// The share of the work allowed that an attempt has to have done before it can be too much: its first steps may be the blow.
const double LEAST_WORK_SHARE = 1. / 8;
/// So many times the work allowed is too much: what comes with a blow is soon over.
const double FAR_TOO_MUCH = 3;
/// A contact that closes with this share of the energy by which springs yield is a blow.
const double STRONG_BLOW = 0.25;
/// So is one that takes a share of what moves, if that is a share of the energy by which springs yield.
const double LATE_BLOW = 0.1, LATE_BLOW_ENERGY = 0.5;

int levelOf(int steps)
{
	int level = 0;
	while (2 << level <= steps)
		++level;
	return level;
}

/// What the joints remember: islands may have joined since.
btElasticPlasticState::InnerRhythm rhythmOf(const SolverGroup& island)
{
	btElasticPlasticState::InnerRhythm rhythm = {0, 255, 255, 255, 0};
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
		{
			const btElasticPlasticState::InnerRhythm& joint = island.m_joints[i]->m_model.m_state.m_innerRhythm;
			btSetMax(rhythm.m_level, joint.m_level);
			btSetMin(rhythm.m_calm, joint.m_calm);
			btSetMin(rhythm.m_spare, joint.m_spare);
			btSetMin(rhythm.m_quiet, joint.m_quiet);
			btSetMax(rhythm.m_ringing, joint.m_ringing);
		}
	return rhythm;
}

/// Begins a step that may have inner ones. \return the joints' action, null if they do not have one in common that ends their steps, or if none of them holds: of
/// rubble nothing is left that a blow could bend
JointRegistry* beginJoints(const SolverGroup& island)
{
	JointRegistry* registry = nullptr;
	bool isOne = true;
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		island.prefetchJointAfter(i);
		JointWorks* const joint = island.m_joints[i];
		if (!joint)
			continue;
		const bool isEnded = joint->beginInside();
		if (!joint->holds())
			continue;
		registry = registry ? registry : joint->m_entry.m_registry;
		isOne &= isEnded && joint->m_entry.m_registry == registry && !joint->m_model.m_isPaper;
	}
	return isOne ? registry : nullptr;
}

/// Whether all joints have a material that damps: what rings comes to rest.
bool damps(const SolverGroup& island)
{
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i] && !(island.m_joints[i]->m_model.m_capacity.m_damping > 0))
			return false;
	return true;
}

/// Whether springs or motors of Bullet's act on an island.
bool isDriven(const SolverGroup& island)
{
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (isDrive(*island.m_constraints[i], island.m_joints[i]))
			return true;
	return false;
}

/// What springs hold where each joint yields in the way that takes the least [J].
double yieldEnergyOf(const SolverGroup& island)
{
	double sum = 0;
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		if (!island.m_joints[i] || !island.m_joints[i]->holds())
			continue;
		const btElasticPlasticCapacity& capacity = island.m_joints[i]->m_model.m_capacity;
		double least = SIMD_INFINITY;
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			if (capacity.m_yield[dof] > 0 && !capacity.isRigidPlastic(dof))
				btSetMin(least, 0.5 * double(capacity.m_yield[dof]) * double(capacity.m_yield[dof]) /
									double(capacity.m_stiffness[dof]));
		sum += least < SIMD_INFINITY ? least : 0;
	}
	return sum;
}

/// What the last solution has left open, before joints are committed.
/// \param flows   becomes true if anything flows
/// \param isTaut  if there is one, becomes true if joints are taut that were not, see JointStep::foreseeTension()
OpenShare measure(const SolverGroup& island, double length, double ahead, bool& flows, bool* isTaut = nullptr)
{
	OpenShare open(true);
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		island.prefetchJointAfter(i);
		JointWorks* const works = island.m_joints[i];
		if (!works || works->m_step.getNumRows() == 0)
			continue;
		const JointStep& step = works->m_step;
		const btElasticPlasticState& state = works->m_model.m_state;
		if (isTaut)
			*isTaut |= works->m_step.foreseeTension();
		OpenShare::Motion motion = {};
		motion.m_path = state.m_plasticPath;
		flows |= step.projectMotion(motion.m_before, motion.m_after);
		const btScalar rate = 1 / step.getTimeStep();
		for (int r = 0; r < step.getNumRows(); ++r)
			motion.m_force[step.getDof(r)] = step.getImpulse(r) * rate;
		if (OpenShare::isClear(works->m_model.m_capacity, motion, btScalar(length), btScalar(ahead)))
			continue;
		const double place = double(works->m_model.bodyA().getCenterOfMassPosition().length()) + 1;
		for (int r = 0; r < step.getNumRows(); ++r)
		{
			const int dof = step.getDof(r);
			open.addRow(works->m_model.m_capacity,
						{dof, -motion.m_before[dof], -motion.m_after[dof], step.getImpulse(r) / step.getTimeStep(),
						 state.m_plastic[dof], state.m_plasticPath[dof], step.isFlowing(r)},
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
				if (isHeld(*body))
					open.addSupport(*body, island.m_joints[i]->m_step.getKinematics().m_rA +
											   island.m_constraints[i]->getRigidBodyA().getCenterOfMassPosition());
	return open;
}

/// Whether an island may be solved again: others wait for it.
bool mayGoBack(const btElasticPlasticSolverSettings& settings) { return settings.m_maxInnerSteps > 0; }

bool hasRope(const SolverGroup& island)
{
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i] && island.m_joints[i]->m_model.isOfRope())
			return true;
	return false;
}

void forgetTension(const SolverGroup& island)
{
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
			island.m_joints[i]->m_step.forgetTension();
}

bool isStepControlled(const SolverGroup& island)
{
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i] && island.m_joints[i]->m_entry.m_registry)
			return island.m_joints[i]->m_entry.m_registry->isStepControlled();
	return false;
}

long long countPoints(const SolverGroup& island)
{
	long long points = 0;
	for (int i = 0; i < island.m_numManifolds; ++i)
		points += island.m_manifolds[i]->getNumContacts();
	return points;
}

/// Whether an island may keep its swings: it comes to rest by its material, and nothing else is there that could give energy to what steps do not resolve.
bool swings(const SolverGroup& island)
{
	return countPoints(island) == 0 && damps(island) && !isDriven(island) && !hasRope(island);
}

/// Whether the settings ask for inner steps, and there is the work for the fewest of them.
bool mayBeTaken(int numConstraints, long long points, const btElasticPlasticSolverSettings& settings)
{
	const long long least = LEAST_WORK_A_JOINT * numConstraints + LEAST_WORK_A_POINT * points;
	return InnerSteps::areAsked(settings) && least << LEAST_LEVEL <= settings.m_maxInnerWork;
}
}  // namespace

bool InnerSteps::areAsked(const btElasticPlasticSolverSettings& settings)
{
	return settings.m_innerError > 0 && settings.m_maxInnerSteps > 1;
}

bool InnerSteps::mayBounce(int numConstraints, const btElasticPlasticSolverSettings& settings)
{
	return settings.m_maxInnerSteps >= 1 << BOUNCE_LEVEL && mayBeTaken(numConstraints, 0, settings);
}

void InnerSteps::solve(const SolverGroup& island, const btContactSolverInfo& info,
					   const btElasticPlasticSolverSettings& settings, btElasticPlasticStatistics& statistics,
					   Solution& solution)
{
	Task task = {island, info, settings, statistics, solution, statistics.m_work, levelOf(settings.m_maxInnerSteps)};
	const bool isStep = info.m_timeStep > 0,
			   hasRoom = isStep && mayBeTaken(island.m_numConstraints, countPoints(island), settings);
	// Whether there may be inner steps or not: ropes are told when tension comes on and when the step changes, and velocities of all follow a step control.
	const bool isLookedAt = hasRoom || (isStep && mayGoBack(settings) && (hasRope(island) || isStepControlled(island)));
	JointRegistry* const registry = isLookedAt ? beginJoints(island) : nullptr;
	const bool keepsSwings = settings.m_keepsSwings && isStep && !isStepControlled(island) && swings(island);
	// A step control chooses the steps' length itself.
	const bool isControlled = registry && registry->isStepControlled(), mayTake = hasRoom && registry && !isControlled;
	task.m_isResolved = isControlled && registry->isStepResolved();
	const bool isChanged = isControlled && JoinedShift::isWanted(island, info.m_timeStep);
	if (!registry || !(mayTake || isChanged || hasRope(island)))
	{
		solution.solveStep(info, {1, keepsSwings}, settings.m_maxWork);
		return;
	}
	if (!mayTake)
		task.m_maxLevel = 0;
	task.m_keepsSwings = keepsSwings;
	m_motions.clear();
	take(task, *registry);
	registry->take(m_motions, m_state.getLoads());
}

void InnerSteps::take(Task& task, const JointRegistry& registry)
{
	const SolverGroup& island = task.m_island;
	m_state.begin(island, task.m_info.m_timeStep, registry, !registry.isStepControlled());
	task.m_rhythm = rhythmOf(island);
	task.m_blow = task.m_rhythm.m_quiet > 0 ? m_state.getEnergyOfBlow() : 0;
	if (m_state.hasSpringContact())
		task.m_maxLevel = 0;
	int level = beginLevel(task);
	if (m_state.hasBounceAhead(task.m_info.m_restitutionVelocityThreshold))
		btSetMax(level, BOUNCE_LEVEL);
	btSetMin(level, task.m_maxLevel);
	int timesForeseen = 0;
	for (;;)
	{
		task.m_numSolutions = 0;
		task.m_workAtBegin = task.m_statistics.m_work;
		task.m_factorsAtBegin = task.m_statistics.m_factorisations;
		task.m_workKept = 0;
		// The first whole step after inner ones is the only one of its kind: velocities come to belong to another time.
		const bool isWhole =
			level == 0 && !m_state.hasPushes() && !JoinedShift::isWanted(island, task.m_info.m_timeStep);
		const Attempt attempt = isWhole ? solveWhole(task) : solveInner(task, level);
		const bool isAgain =
			!attempt.m_isLeft && attempt.m_isTaut && timesForeseen < MOST_FORESEEN && hasWorkForAnother(task);
		if ((attempt.m_isTaut || timesForeseen > 0) && !isAgain)
			forgetTension(island);
		timesForeseen = isAgain ? timesForeseen + 1 : 0;
		if (!attempt.m_isLeft && !isAgain)
		{
			remember(task, attempt.m_next, attempt);
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
int InnerSteps::beginLevel(Task& task)
{
	const SolverGroup& island = task.m_island;
	const InnerRhythm& rhythm = task.m_rhythm;
	if (rhythm.m_level > 0 && rhythm.m_quiet >= QUIET_STEPS)
		return rhythm.m_level / 2;
	const int calm = btMax(1, btMin(CALM_WORLD_STEPS, ENOUGH_CALM_INNER_STEPS >> rhythm.m_level));
	if (rhythm.m_level == 0 || rhythm.m_calm < calm)
		return rhythm.m_level;
	const int level = btMax(rhythm.m_level - btMax(int(rhythm.m_spare), 1), 0);
	const btScalar longer = task.m_info.m_timeStep / btScalar(1 << level);
	if (rhythm.m_calm < CALM_PATIENCE * calm && !m_state.isJoinedShiftSmall(island, longer))
		return rhythm.m_level;
	task.m_rhythm.m_calm = 0;
	return level;
}

InnerSteps::Attempt InnerSteps::solveWhole(Task& task)
{
	++task.m_numSolutions;
	task.m_solution.solveStep(task.m_info, {1, task.m_keepsSwings}, task.m_settings.m_maxWork);
	const double dt = task.m_info.m_timeStep;
	Attempt attempt = {};
	const OpenShare left = measure(task.m_island, dt, dt, attempt.m_flows, &attempt.m_isTaut);
	attempt.m_isStruck = isStruck(task, 0);
	attempt.m_power = left.getPower();
	attempt.m_yieldEnergy = left.getYieldEnergy();
	attempt.m_open = left.getMendableShare();
	attempt.m_doubted = left.getShare();
	findNext(task, 0, attempt);
	attempt.m_isLeft = attempt.m_next != 0;
	return attempt;
}

/// What damps and has not flowed for a while will not: its ringing asks for no shorter steps, and long ones only damp it sooner. A blow makes it
/// faster than that, or makes something flow.
bool InnerSteps::isRinging(const Task& task, const Attempt& attempt) const
{
	const InnerRhythm& rhythm = task.m_rhythm;
	return rhythm.m_quiet >= QUIET_STEPS && !attempt.m_flows &&
		   attempt.m_power <= RINGING_MARGIN * double(rhythm.m_ringing) &&
		   task.m_blow <= STRONG_BLOW * attempt.m_yieldEnergy;
}

/// Of what a step has left open, as far as it counts, follows the level of the next attempt. Where Bullet's springs and motors act no inner steps are begun for elastic motion: what
/// these give and take in the half step by which velocities come to belong to another time is not known, and would add up from one beginning to the next.
void InnerSteps::findNext(const Task& task, int level, Attempt& attempt) const
{
	attempt.m_isLong = attempt.m_open > task.m_settings.m_innerError;
	const bool isElastic = level == 0 && attempt.m_isLong && !attempt.m_flows && !attempt.m_isStruck;
	if (isRinging(task, attempt) || (isElastic && isDriven(task.m_island)))
		limit(attempt, task.m_settings.m_innerError);
	attempt.m_next = refine(task, level, attempt);
}

/// How much of a blow a structure takes is left open by a long step, in which all of it is struck at once, or nothing of it if they touch at the end. No joint
/// tells it, but what contacts take does.
bool InnerSteps::isStruck(const Task& task, int level) const
{
	const double taken = level < BLOW_LEVEL ? m_state.getTaken() : 0;
	if (!(taken > 0))
		return false;
	const double energy = taken + m_state.getKineticEnergy();
	// One that comes late in the step has taken but a part of its blow.
	const bool mayBeStrong = taken > task.m_settings.m_innerError * energy, mayBeLate = taken > LATE_BLOW * energy;
	if (!mayBeStrong && !mayBeLate)
		return false;
	const double yieldEnergy = yieldEnergyOf(task.m_island);
	return taken > STRONG_BLOW * yieldEnergy ? mayBeStrong : mayBeLate && energy > LATE_BLOW_ENERGY * yieldEnergy;
}

/// It is calm but not still: longer steps damp it.
void InnerSteps::limit(Attempt& attempt, double error)
{
	btSetMin(attempt.m_open, error * CALM_INNER_SHARE);
	btSetMin(attempt.m_doubted, error * CALM_INNER_SHARE);
}

/// Few inner steps begin again where one of them leaves too much open. Of many that one is taken back, and those from there on are shorter: they have been right until something was
/// struck. And they become longer again: what a blow leaves open falls within a few of them.
InnerSteps::Attempt InnerSteps::solveInner(Task& task, int level)
{
	const SolverGroup& island = task.m_island;
	const int all = 1 << btMax(levelOf(task.m_settings.m_maxInnerSteps), level);
	const btScalar dt = task.m_info.m_timeStep;
	m_state.saveJoints(island);
	m_state.note();
	setInnerLength(task, dt, dt, level);
	btScalar lengthOfLast = dt;  // to which the velocities noted belong
	Attempt attempt = {};
	Run run(level, 0);
	double open = 0, doubted = 0;
	int steps = 0;
	for (int left = all; left > 0;)
	{
		const int parts = all >> run.m_level;
		const btScalar h = dt / btScalar(1 << run.m_level);
		task.m_left = double(left) / all;
		// In few steps what waits for its bounce until it touches would go through what it hits: Bullet's rows stop it.
		const btScalar leastBounce =
			run.m_level < BOUNCE_LEVEL ? btScalar(BT_LARGE_FLOAT) : task.m_info.m_restitutionVelocityThreshold;
		m_state.carry(dt * btScalar(all - left + parts) / btScalar(all), h, leastBounce);
		const long long workBefore = task.m_statistics.m_work;
		solveInnerStep(task, h, left / parts);
		const Attempt before = attempt;
		judge(task, h, run, attempt);
		const bool isTooDear = isTooMuch(task, run, left / parts - 1);
		attempt.m_isLeft = beginsAgain(task, run, level, isTooDear && 2 * (left - parts) >= all, attempt);
		if (attempt.m_isLeft)
			break;
		if (attempt.m_next > run.m_level && !isTooDear)
		{
			m_state.takeBack();
			beginRun(task, lengthOfLast, attempt.m_next, run);
			attempt = before;
			continue;
		}
		task.m_workKept += double(task.m_statistics.m_work - workBefore);
		btSetMax(open, attempt.m_open);
		btSetMax(doubted, attempt.m_doubted);
		m_state.move(h);
		lengthOfLast = h;
		for (int i = 0; i < island.m_numConstraints; ++i)
			if (island.m_joints[i])
				island.m_joints[i]->commitInside(1. / (1 << run.m_level));
		m_state.note();
		left -= parts;
		++steps;
		const bool fits = left > 0 && left % (2 * parts) == 0 && run.m_level > LEAST_LEVEL;
		if (fits && (isTooDear || mayBeLonger(task, run, 2 * h)))
		{
			if (isTooDear)
				task.m_maxLevel = run.m_level - 1;
			beginRun(task, lengthOfLast, run.m_level - 1, run);
		}
	}
	m_parameters.restore();
	if (attempt.m_isLeft)
		return attempt;
	attempt.m_open = open;
	attempt.m_doubted = doubted;
	attempt.m_next = run.m_level;
	m_state.endShift((dt / btScalar(1 << run.m_level) - dt) / 2);
	m_state.finish(steps, m_motions);
	return attempt;
}

/// Whether a step is to begin again at another level, which becomes the attempt's next one.
/// \param level      with which it has begun
/// \param isTooDear  it takes too much, and less than half of that has been done: to end it is not cheaper
bool InnerSteps::beginsAgain(Task& task, const Run& run, int level, bool isTooDear, Attempt& attempt) const
{
	if (isTooDear && !(level >= BLOW_LEVEL && mayGoOn(task)))
	{
		btSetMin(task.m_maxLevel, mostLevel(task, run.m_level, run.m_level, false));
		attempt.m_next = btMin(level, task.m_maxLevel);
		if (task.m_maxLevel < run.m_level)
			return true;
	}
	return attempt.m_next > run.m_level && run.m_level < BLOW_LEVEL;
}

/// Inner steps from here on are those of a level. \param lengthOfLast  to which velocities belong [s]
void InnerSteps::beginRun(Task& task, btScalar lengthOfLast, int level, Run& run)
{
	const btScalar before = task.m_info.m_timeStep / btScalar(1 << run.m_level);
	m_parameters.restore();
	run = Run(level, task.getWorkOfAttempt());
	setInnerLength(task, lengthOfLast, before, level);
}

/// Looks at what an inner step has left open.
void InnerSteps::judge(const Task& task, btScalar h, Run& run, Attempt& attempt) const
{
	const OpenShare share = measure(task.m_island, h, task.m_info.m_timeStep, attempt.m_flows);
	run.add(share, task.m_settings.m_innerError);
	btSetMax(attempt.m_power, share.getPower());
	btSetMax(attempt.m_yieldEnergy, share.getYieldEnergy());
	attempt.m_isStruck = isStruck(task, run.m_level);
	attempt.m_open = run.m_open;
	attempt.m_doubted = run.m_doubted;
	// What stays clear of yield asks for no shorter steps.
	if (!run.m_isLoaded)
		limit(attempt, task.m_settings.m_innerError);
	findNext(task, run.m_level, attempt);
}

/// Velocities that belong to steps of one length come to belong to those of a level, and contact points that are those of another.
void InnerSteps::setInnerLength(Task& task, btScalar ofVelocities, btScalar ofPoints, int level)
{
	const btScalar share = 1 / btScalar(1 << level), h = task.m_info.m_timeStep * share;
	m_state.shiftFreeVelocities((ofVelocities - h) / 2);
	m_state.shiftJoinedVelocities(task.m_island, h, task.m_isResolved);
	m_state.scalePoints(h / ofPoints);
	m_parameters.scale(task.m_island, share, task.m_info.m_timeStep);
}

/// \param ahead  how many such steps are left, with it
void InnerSteps::solveInnerStep(Task& task, btScalar h, int ahead)
{
	const btScalar share = h / task.m_info.m_timeStep;
	btContactSolverInfo info = task.m_info;
	info.m_timeStep = h;
	// As fast as that many times as many steps would reduce errors, what a limit has been passed by in a step of the world would be pushed back against all of a blow.
	info.m_erp *= share * share;
	info.m_erp2 *= share;
	++task.m_numSolutions;
	if (share < 1)
		++task.m_statistics.m_innerSteps;
	const bool isBounded = task.m_settings.m_maxWork > 0;
	const bool keepsSwings = task.m_keepsSwings || share <= SHARE_OF_A_BLOW;
	task.m_solution.solveStep(info, {share, keepsSwings}, isBounded ? btMax(task.getWorkLeft() / ahead, 1ll) : 0);
}

void InnerSteps::Run::add(const OpenShare& share, double error)
{
	btSetMax(m_open, share.getMendableShare());
	btSetMax(m_doubted, share.getShare());
	m_isLoaded = m_isLoaded || share.isLoaded();
	++m_numSteps;
	m_calm = share.getShare() <= error * CALM_RUN_SHARE ? m_calm + 1 : 0;
}

/// Down to that level at which a blow is seen, once they have been calm for longer than what they resolve takes to swing.
bool InnerSteps::mayBeLonger(const Task& task, const Run& run, btScalar longer)
{
	if (run.m_level <= BLOW_LEVEL || run.m_calm < CALM_RUN)
		return false;
	return run.m_calm >= CALM_PATIENCE * CALM_RUN || m_state.isJoinedShiftSmall(task.m_island, longer);
}

/// The work of a step in inner steps of a level, by the mean of those that the present attempt has solved so far. Shorter steps have a factor each, but fewer rows reach or leave
/// their bounds in them: the rest of a solution's work falls with the root of the step (measured: 2^-0.44 to 2^-0.6 a level). Contact points are set up and swept in each.
double InnerSteps::expectWork(const Task& task, int from, int level) const
{
	const double mean = task.getWorkOfAttempt() / task.m_numSolutions, least = task.getWorkOfFactor();
	const double ofPoints = double(LEAST_WORK_A_POINT * m_state.getNumPoints());
	return (ofPoints + least + (mean - least) * exp2(0.5 * (from - level))) * exp2(level);
}

/// The same where it goes on in inner steps of a level. These have become shorter for a blow, which is dear but soon over: what is sure is a factor for each that is ahead.
double InnerSteps::expectWorkAhead(const Task& task, int level)
{
	return task.getWorkOfFactor() * exp2(level) * task.m_left;
}

/// Whether there is the work to do once more what an attempt has done.
bool InnerSteps::hasWorkForAnother(const Task& task) const
{
	return task.m_settings.m_maxWork == 0 || task.getWorkOfAttempt() <= task.getWorkLeft();
}

/// The highest level up to one that the settings have the work for.
/// \param goesOn  the present attempt does, and does not begin again
int InnerSteps::mostLevel(const Task& task, int from, int level, bool goesOn) const
{
	double most = double(task.m_settings.m_maxInnerWork) - (goesOn ? task.m_workKept : 0);
	if (task.m_settings.m_maxWork > 0)
		most = btMin(most, double(task.getWorkLeft()));
	const auto expect = [&](int l) { return goesOn ? expectWorkAhead(task, l) : expectWork(task, from, l); };
	if (expect(LEAST_LEVEL) > most)
		return 0;
	while (level > 0 && expect(level) > most)
		--level;
	return level;
}

/// Whether an attempt takes far more than there is for it: what was right for the last step is not, since more is joined or touches.
/// \param ahead  how many inner steps are left
bool InnerSteps::isTooMuch(const Task& task, const Run& run, int ahead) const
{
	const double most = double(task.m_settings.m_maxInnerWork), work = task.getWorkOfAttempt(),
				 expected = work + (work - run.m_workBefore) * double(ahead) / run.m_numSteps;
	return work > LEAST_WORK_SHARE * most && expected > FAR_TOO_MUCH * most;
}

/// Whether there is the work for the fewest inner steps at what those of the attempt have taken so far. In a blow many that are too dear become fewer where they are then: without
/// any the blow would be missed, and one step that begins with the velocities of many would tell flow that nobody has given.
bool InnerSteps::mayGoOn(const Task& task)
{
	const double mean = task.getWorkOfAttempt() / task.m_numSolutions;
	return mean * (1 << LEAST_LEVEL) <= FAR_TOO_MUCH * double(task.m_settings.m_maxInnerWork);
}

/// The level of inner steps that what a step has left open asks for, as far as the settings let it have it.
int InnerSteps::refine(const Task& task, int level, const Attempt& attempt) const
{
	const double error = task.m_settings.m_innerError;
	int wanted = attempt.m_isStruck ? BLOW_LEVEL : level;
	// What inner steps before have left open is not mended any more.
	const int more = level >= BLOW_LEVEL ? 1 : 0;
	if (attempt.m_open > error && task.m_maxLevel > level)
		btSetMax(wanted, level + more + btMax(1, int(ceil(0.5 * log2(attempt.m_open / error)))));
	return btMax(level, mostLevel(task, level, btMin(wanted, task.m_maxLevel), level >= BLOW_LEVEL));
}

/// The level to begin the next step with: that of this one, or less where it has taken more than the settings allow. From BLOW_LEVEL on they become
/// longer within a step.
int InnerSteps::affordableLevel(const Task& task, int level) const
{
	if (level >= BLOW_LEVEL || task.getWorkOfAttempt() <= double(task.m_settings.m_maxInnerWork))
		return level;
	return level > LEAST_LEVEL ? level - 1 : 0;
}

/// An oscillation has moments at which a step leaves little open. What may be rounding asks for no shorter steps, and gives no leave for
/// far longer ones at once: it grows by the square of the step if it is none.
void InnerSteps::remember(const Task& task, int level, const Attempt& attempt) const
{
	const SolverGroup& island = task.m_island;
	InnerRhythm rhythm = task.m_rhythm;
	const double error = task.m_settings.m_innerError, doubted = attempt.m_doubted;
	const bool isCalm = attempt.m_open <= error * CALM_INNER_SHARE, isStill = doubted < error * NO_INNER_SHARE;
	const int spare = doubted > 0 ? int(floor(0.5 * log2(btMax(error / (8 * doubted), 1.)))) : MOST_SPARE;
	const int calm = isCalm ? btMin(rhythm.m_calm + 1, CALM_PATIENCE * CALM_WORLD_STEPS) : 0;
	const bool isNew = calm <= 1 || (isStill && calm < CALM_WORLD_STEPS);
	rememberRinging(task, level, attempt, rhythm);
	rhythm.m_level = static_cast<unsigned char>(affordableLevel(task, level));
	rhythm.m_spare = static_cast<unsigned char>(btMin(spare, isNew ? MOST_SPARE : int(rhythm.m_spare)));
	rhythm.m_calm = static_cast<unsigned char>(isStill ? btMax(calm, CALM_WORLD_STEPS) : calm);
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
			island.m_joints[i]->m_model.m_state.m_innerRhythm = rhythm;
}

/// In whole steps that leave little open the ringing is over.
void InnerSteps::rememberRinging(const Task& task, int level, const Attempt& attempt, InnerRhythm& rhythm) const
{
	const InnerRhythm& before = task.m_rhythm;
	int quiet = 0;
	if (level == 0 && !attempt.m_isLong)
		quiet = btMax(before.m_quiet - 1, 0);
	else if (!attempt.m_flows && (before.m_quiet > 0 || damps(task.m_island)))
		quiet = btMin(before.m_quiet + 1, MOST_QUIET_STEPS);
	rhythm.m_quiet = static_cast<unsigned char>(quiet);
	rhythm.m_ringing = quiet > 0 ? btMax(float(attempt.m_power), RINGING_KEPT * before.m_ringing) : 0;
}
}  // namespace btElasticPlastic
