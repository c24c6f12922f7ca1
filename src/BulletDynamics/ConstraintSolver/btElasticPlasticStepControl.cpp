// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticStepControl.h"

#include <math.h>

#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "ElasticPlastic/joint/JointRegistry.h"
#include "ElasticPlastic/joint/JointWorks.h"
#include "ElasticPlastic/stepping/Approach.h"
#include "ElasticPlastic/stepping/ErrorReduction.h"
#include "ElasticPlastic/stepping/FreeFlight.h"
#include "ElasticPlastic/stepping/OpenWork.h"
#include "ElasticPlastic/stepping/StepInput.h"

using namespace btElasticPlastic;

namespace
{
/// The number of successive steps that have to leave little open before the substep is doubled.
const int CALM_STEPS = 6;
/// Below this share of the error allowed a step has left little open: with T falling as the square of the substep, twice the
/// substep stays below half of it.
const double CALM_SHARE = 1. / 8;
/// Below this share of the error a substep leaves next to nothing open, and the next one is doubled at once.
const double NOTHING_SHARE = 1. / 1000;
/// Whenever it has been doubled too early the calm that it takes the next time is twice as long, up to so many times.
const int MOST_PATIENCE = 6;
/// Below this share of the error the search doubles the substep: twice the substep has four times the T.
const double SEARCH_SHARE = 1. / 4;
/// The most that a joined body may turn in a substep [rad].
const double MOST_TURN = 1;

/// Tells joints, of whatever action, that the coming substep is as short as they need, so that the solver takes no inner steps.
/// \param share       of the step
/// \param isResolved  see JointRegistry::setStepControlled()
void tellJoints(btDynamicsWorld& world, btScalar share, bool isResolved)
{
	JointRegistry* told = nullptr;
	for (int i = 0; i < world.getNumConstraints(); ++i)
	{
		const JointWorks* const joint = JointWorks::from(world.getConstraint(i));
		JointRegistry* const registry = joint ? joint->m_entry.m_registry : nullptr;
		if (registry && registry != told)
		{
			registry->setStepControlled(share, isResolved);
			told = registry;
		}
	}
}
}  // namespace

struct btElasticPlasticStepControl::Works
{
	double m_error = 0.01;
	int m_maxLevel = MAX_LEVEL;
	int m_level = 0;            ///< the substep is the step over 1 << m_level
	bool m_isSearching = true;  ///< for the substep, from the finest up
	btScalar m_dt = 0;          ///< of the step
	btScalar m_length = 0;      ///< of the substep, the last one
	btScalar m_calm = 0;        ///< for how long little has been left open [s]
	btScalar m_sinceDoubled =
		-1;  ///< the time since the substep has been doubled, if that was not by the search; below 0: it has not, or has been halved since [s]
	int m_patience = 0;  ///< how often it has been doubled too early, less how often it has not
	int m_left = 0;      ///< of the step, in parts of it over 1 << MAX_LEVEL
	int m_parts = 0;     ///< that the substep under way takes of them
	ErrorReduction m_errorReduction;
	OpenWork m_openWork;
	BodyMarks m_joined;  ///< those that move and that elastic-plastic joints hold

	void refine(int level) { m_level = btMax(m_level, btMin(m_maxLevel, level)); }
	void lookAhead(btDynamicsWorld& world);
	double findFastestSpin(const btDynamicsWorld& world) const;
	void markJoined(const btDynamicsWorld& world, const btAlignedObjectArray<btElasticPlasticJoint*>& joints);
	void chooseLevel();
	void learnPatience(bool isHalved);
	/// That has to last before the substep is doubled [s].
	btScalar getCalm() const { return btScalar(CALM_STEPS << m_patience) * m_dt; }

	/// From here on coarser steps have to show that they leave little open: a spring that the level below resolves has
	/// T = error / 16, which takes two of them.
	int getResolvedLevel() const { return 2 + int(ceil(0.5 * log2(1 / m_error))); }
};

btElasticPlasticStepControl::btElasticPlasticStepControl(double error, btElasticPlasticOwnPrecision)
	: m_works(new Works)
{
	setError(error);
}
btElasticPlasticStepControl::~btElasticPlasticStepControl() { delete m_works; }

double btElasticPlasticStepControl::getError() const { return m_works->m_error; }
double btElasticPlasticStepControl::getOpenShare() const { return m_works->m_openWork.getShare(); }
int btElasticPlasticStepControl::getSubsteps() const { return 1 << m_works->m_level; }

void btElasticPlasticStepControl::setError(double error)
{
	m_works->m_error = btElasticPlasticIsNumber(error) ? btMax(1e-6, btMin(1., error)) : 0.01;
	expectBlow();
}

void btElasticPlasticStepControl::expectBlow()
{
	// The effect of a blow in its first moment is not known beforehand, and a substep that was too long cannot be undone.
	m_works->refine(MAX_LEVEL);
	m_works->m_isSearching = true;
	m_works->m_sinceDoubled = -1;
	m_works->m_patience = 0;
}

void btElasticPlasticStepControl::setMaxSubsteps(int most)
{
	m_works->m_maxLevel = MAX_LEVEL;
	while (m_works->m_maxLevel > 0 && 1 << m_works->m_maxLevel > most)
		--m_works->m_maxLevel;
}

void btElasticPlasticStepControl::begin(btScalar dt)
{
	m_works->m_dt = dt;
	m_works->m_left = dt > 0 && btElasticPlasticIsFinite(dt) ? 1 << MAX_LEVEL : 0;
	m_works->m_level = btMin(m_works->m_level, m_works->m_maxLevel);
}

void btElasticPlasticStepControl::Works::lookAhead(btDynamicsWorld& world)
{
	const Approach approach = btElasticPlastic::lookAhead(world, m_joined, m_dt);
	if (approach.m_isBlow)
		refine(getResolvedLevel());
	const double rate = btMax(approach.m_rate, findFastestSpin(world) / MOST_TURN);
	while (m_level < m_maxLevel && rate * double(m_dt) > double(1 << m_level))
		++m_level;
}

/// Of bodies that joints hold [rad/s]. Joints' axes stay during a substep, whatever their bodies turn by.
double btElasticPlasticStepControl::Works::findFastestSpin(const btDynamicsWorld& world) const
{
	double fastest = 0;
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	for (int i = 0; i < objects.size(); ++i)
	{
		const btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (body && m_joined.isMarked(*body) && body->isActive())
			fastest = btMax(fastest, double(body->getAngularVelocity().length()));
	}
	return fastest;
}

btScalar btElasticPlasticStepControl::next(btDynamicsWorld& world)
{
	Works& w = *m_works;
	if (w.m_left <= 0)
		return 0;
	w.lookAhead(world);
	w.m_parts = 1 << (MAX_LEVEL - w.m_level);
	const btScalar share = 1 / btScalar(1 << w.m_level);
	tellJoints(world, share, w.m_isSearching);
	w.m_errorReduction.restore(world, nullptr);
	w.m_errorReduction.scale(world, share, w.m_dt);
	const btScalar length = w.m_dt * share;
	if (w.m_length > 0 && w.m_length != length)
		keepFreeFlight(world, (w.m_length - length) / 2);
	return w.m_length = length;
}

void btElasticPlasticStepControl::Works::markJoined(const btDynamicsWorld& world,
													const btAlignedObjectArray<btElasticPlasticJoint*>& joints)
{
	m_joined.clear(world.getNumCollisionObjects());
	for (int i = 0; i < joints.size(); ++i)
	{
		const btTypedConstraint& constraint = joints[i]->getConstraint();
		for (const btRigidBody* body : {&constraint.getRigidBodyA(), &constraint.getRigidBodyB()})
			if (!body->isStaticOrKinematicObject())
				m_joined.mark(*body);
	}
}

/// An oscillation has moments at which a substep leaves little open, and every change of the substep dissipates some of its
/// energy. The substep is therefore doubled only if it has left little open for some time, or if it leaves next to nothing.
/// Where it has to be halved again soon, it waits for longer the next time. Substeps begin at multiples of their length, so that the step ends with a whole one.
void btElasticPlasticStepControl::Works::chooseLevel()
{
	const double share = m_openWork.getShare(), mendable = m_openWork.getMendableShare();
	const int level = m_level;
	if (mendable > m_error)
		refine(m_level + int(ceil(0.5 * log2(mendable / m_error))));
	learnPatience(m_level > level);
	m_calm = share > m_error * CALM_SHARE ? btScalar(0) : m_calm + m_length;
	m_isSearching &= share <= m_error * SEARCH_SHARE && m_level > getResolvedLevel();
	const bool fitsTwice = m_level > 0 && m_left % (2 << (MAX_LEVEL - m_level)) == 0;
	const bool isCalm = m_calm >= getCalm(), isStill = m_patience == 0 && share < m_error * NOTHING_SHARE;
	if (!fitsTwice || !(isCalm || isStill || m_isSearching))
		return;
	--m_level;
	m_calm = 0;
	if (!m_isSearching)
		m_sinceDoubled = 0;
	if (isCalm)
		m_patience = btMax(m_patience - 1, 0);
}

void btElasticPlasticStepControl::Works::learnPatience(bool isHalved)
{
	if (m_sinceDoubled < 0)
		return;
	m_sinceDoubled += m_length;
	if (!isHalved)
		return;
	if (m_sinceDoubled < 2 * getCalm())
		m_patience = btMin(m_patience + 1, MOST_PATIENCE);
	m_sinceDoubled = -1;
}

void btElasticPlasticStepControl::observe(btDynamicsWorld& world, btElasticPlasticAction& action)
{
	Works& w = *m_works;
	w.m_errorReduction.restore(world, action.m_registry);
	w.m_left -= w.m_parts;
	btAlignedObjectArray<btElasticPlasticJoint*> joints;
	action.getJointsInWorld(world, joints);
	w.markJoined(world, joints);
	w.m_openWork.measure(world, joints, double(w.m_dt));
	w.chooseLevel();
}

int btElasticPlasticStepControl::step(btDynamicsWorld& world, btElasticPlasticAction& action, btScalar dt)
{
	begin(dt);
	Works& w = *m_works;
	if (w.m_left == 0)
		return 0;
	StepInput input(world, dt);
	const JointRegistry::Watch watch(*action.m_registry);
	int substeps = 0;
	for (btScalar length; (length = next(world)) > 0;)
	{
		input.apply(1 - btScalar(w.m_left - w.m_parts) / btScalar(1 << MAX_LEVEL));
		world.stepSimulation(length, 0);
		++substeps;
		if (!watch.isDeleted())
		{
			observe(world, action);
			continue;
		}
		// Nobody is left who could tell what a substep leaves open: the rest is one.
		w.m_errorReduction.restore(world, nullptr);
		w.m_left -= w.m_parts;
		if (w.m_left > 0)
		{
			input.apply(1);
			world.stepSimulation(dt * btScalar(w.m_left) / btScalar(1 << MAX_LEVEL), 0);
			++substeps;
		}
		w.m_left = 0;
	}
	return substeps;
}
