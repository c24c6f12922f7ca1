// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "IslandState.h"

#include "../joint/BodyEnergy.h"
#include "../joint/BodyGate.h"
#include "../joint/BodyLoad.h"
#include "../joint/JoinedVelocity.h"
#include "../joint/JointRegistry.h"
#include "../joint/JointWorks.h"
#include "ContactFactors.h"
#include "ContactPlace.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "LinearMath/btTransformUtil.h"

namespace btElasticPlastic
{
namespace
{
/// Velocities that change by less than this share have changed little.
const double SMALL_SHIFT = 0.05;

/// What turns one orientation into another, by the shorter way, over time: a mean angular velocity.
btVector3 meanSpin(const btTransform& from, const btTransform& to, btScalar dt)
{
	const btQuaternion turn = to.getRotation() * from.getRotation().inverse();
	const btScalar sign = turn.w() < 0 ? btScalar(-1) : btScalar(1);
	const btVector3 axis(turn.x(), turn.y(), turn.z());
	const btScalar sine = axis.length(), angle = 2 * btAtan2(sine, sign * turn.w());
	return axis * (sign * (sine > 0 ? angle / sine : btScalar(2)) / dt);
}

/// A callback of the game may have moved a kinematic body since Bullet has looked at it, and Bullet's velocity is that of the last frame.
void followCallback(btRigidBody& body, btScalar dt)
{
	const btTransform &before = body.getInterpolationWorldTransform(), &now = body.getWorldTransform();
	if (now == before || !isKinematicAndAwake(body))
		return;
	btVector3 velocity, spin;
	btTransformUtil::calculateVelocity(before, now, dt, velocity, spin);
	body.setLinearVelocity(velocity);
	body.setAngularVelocity(spin);
	body.setInterpolationLinearVelocity(velocity);
	body.setInterpolationAngularVelocity(spin);
	body.setInterpolationWorldTransform(now);
}

void put(btRigidBody& body, const btTransform& place, const btVector3& velocity, const btVector3& spin)
{
	body.setWorldTransform(place);
	body.setLinearVelocity(velocity);
	body.setAngularVelocity(spin);
	body.updateInertiaTensor();
}

btScalar* impulsesOf(btManifoldPoint& point, btScalar* impulses)
{
	impulses[0] = point.m_appliedImpulse;
	impulses[1] = point.m_appliedImpulseLateral1;
	impulses[2] = point.m_appliedImpulseLateral2;
	return impulses;
}

void setImpulses(btManifoldPoint& point, const btScalar* impulses, btScalar share)
{
	point.m_appliedImpulse = impulses[0] * share;
	point.m_appliedImpulseLateral1 = impulses[1] * share;
	point.m_appliedImpulseLateral2 = impulses[2] * share;
}
}  // namespace

// ---- the beginning

void IslandState::begin(const SolverGroup& island, btScalar dt, const JointRegistry& registry, bool findsPushes)
{
	m_dt = dt;
	m_kinematic.resizeNoInitialize(0);
	m_pushes.clear(dt);
	addBodies(island, registry, findsPushes);
	m_joints.resize(0);
	m_enabled.resize(0);
	m_isHeld = false;
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		island.prefetchAfter(i);
		btTypedConstraint& constraint = *island.m_constraints[i];
		if (!constraint.isEnabled())
			continue;
		m_enabled.push_back(&constraint);
		btRigidBody* const bodies[2] = {&constraint.getRigidBodyA(), &constraint.getRigidBodyB()};
		int given[2] = {-1, -1};
		for (int side = 0; side < 2; ++side)
		{
			btRigidBody* const body = bodies[side];
			addKinematic(*body);
			const int index = body->isStaticOrKinematicObject() ? -1 : body->getCompanionId();
			if (index >= 0 && index < m_bodies.size() && m_bodies[index].m_body == body)
			{
				m_bodies[index].m_isJoined = true;
				given[side] = m_bodies[index].m_given;
			}
			else
				m_isHeld = true;
		}
		if (island.m_joints[i])
			m_pushes.addJoint(island.m_joints[i]->m_model.m_state, given);
	}
	beginPushes();
	m_loads.clear();
	for (int i = 0; i < m_bodies.size() && findsPushes; ++i)
		addLoad(m_bodies[i], registry);
	addPoints(island);
	findTouched();
	// After inner steps contact points have the impulses of all of them, but the body may have left after the first.
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		m_bodies[i].m_body->setCompanionId(-1);
		const BodyMotion* const last = registry.findMotion(*m_bodies[i].m_body);
		if (last)
			m_isTouched[i] = last->m_isTouched;
		m_bodies[i].m_wasTouched = m_isTouched[i];
	}
}

void IslandState::saveJoints(const SolverGroup& island)
{
	if (m_joints.size() > 0)
		return;
	m_joints.reserve(island.m_numConstraints);
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
			m_joints.push_back({island.m_joints[i], island.m_joints[i]->m_model.m_state, 0});
}

/// The index of a body here is kept in its companion id, which Bullet does not use between two solutions.
void IslandState::addBodies(const SolverGroup& island, const JointRegistry& registry, bool findsPushes)
{
	m_bodies.resizeNoInitialize(0);
	m_bodies.reserve(island.m_numBodies);
	for (int i = 0; i < island.m_numBodies; ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(island.m_bodies[i]);
		if (!body || body->getInvMass() == 0 || body->isStaticOrKinematicObject() || !body->isActive() ||
			!isWellFormed(*body))
			continue;
		body->setCompanionId(m_bodies.size());
		m_bodies.push_back({body, body->getWorldTransform(), body->getLinearVelocity(), body->getAngularVelocity(),
							btElasticPlasticInnerMotion(), body->getWorldTransform(), body->getLinearVelocity(),
							body->getAngularVelocity(), body->getLinearVelocity(), body->getAngularVelocity(), 0, 0, 0,
							0, findsPushes ? m_pushes.addBody(*body, registry.findLoads(*body)) : -1, -1, false,
							false});
	}
}

void IslandState::beginPushes()
{
	m_hasPushes = m_pushes.isAny();
	if (!m_hasPushes)
		return;
	m_pushes.begin();
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& body = m_bodies[i];
		body.m_linear = body.m_body->getLinearVelocity();
		body.m_angular = body.m_body->getAngularVelocity();
		body.m_inner.m_shift = body.m_inner.m_pushes = m_pushes.getEnergy(body.m_given);
	}
}

/// Most bodies have none.
void IslandState::addLoad(Body& body, const JointRegistry& registry)
{
	const LoadHistory* const last = registry.findLoads(*body.m_body);
	if (!last && forceBesideWeight(*body.m_body).isZero() && body.m_body->getTotalTorque().isZero())
		return;
	LoadHistory history = last ? *last : LoadHistory();
	history.follow(*body.m_body, m_dt);
	if (history.isNothing())
		return;
	body.m_load = int(m_loads.size());
	m_loads.push_back(history);
}

void IslandState::addPoints(const SolverGroup& island)
{
	m_points.resizeNoInitialize(0);
	m_hasSpringContact = false;
	for (int m = 0; m < island.m_numManifolds; ++m)
	{
		btPersistentManifold& manifold = *island.m_manifolds[m];
		const btCollisionObject* const objects[2] = {manifold.getBody0(), manifold.getBody1()};
		int bodies[2];
		for (int side = 0; side < 2; ++side)
		{
			if (btRigidBody* const body = btRigidBody::upcast(const_cast<btCollisionObject*>(objects[side])))
				addKinematic(*body);
			const int index = objects[side]->isStaticOrKinematicObject() ? -1 : objects[side]->getCompanionId();
			const bool isHere = index >= 0 && index < m_bodies.size() && m_bodies[index].m_body == objects[side];
			bodies[side] = isHere ? index : -1;
		}
		for (int i = 0; i < manifold.getNumContacts(); ++i)
		{
			btManifoldPoint& p = manifold.getContactPoint(i);
			Point point = {&p,        {objects[0], objects[1]}, {bodies[0], bodies[1]}, p.m_distance1,  {0, 0, 0},
						   {0, 0, 0}, p.m_positionWorldOnA,     p.m_positionWorldOnB,   p.m_contactERP, {0, 0, 0}};
			impulsesOf(p, point.m_impulse);
			m_hasSpringContact |= isSpring(p);
			m_points.push_back(point);
		}
	}
}

void IslandState::addKinematic(btRigidBody& body)
{
	if (!body.isKinematicObject())
		return;
	for (int i = 0; i < m_kinematic.size(); ++i)
		if (m_kinematic[i].m_body == &body)
			return;
	followCallback(body, m_dt);
	m_kinematic.push_back({&body, body.getWorldTransform()});
}

void IslandState::restore()
{
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& body = m_bodies[i];
		put(*body.m_body, body.m_start, body.m_linear, body.m_angular);
		body.m_inner = btElasticPlasticInnerMotion();
		body.m_inner.m_shift = body.m_inner.m_pushes = m_pushes.getEnergy(body.m_given);
		body.m_ahead = 0;
	}
	for (int i = 0; i < m_points.size(); ++i)
	{
		Point& point = m_points[i];
		point.m_point->m_positionWorldOnA = point.m_onA;
		point.m_point->m_positionWorldOnB = point.m_onB;
		point.m_point->m_distance1 = point.m_distance;
		leave(point, point.m_impulse);
		for (btScalar& sum : point.m_sum)
			sum = 0;
	}
	for (int i = 0; i < m_joints.size(); ++i)
		m_joints[i].m_works->rewind(m_joints[i].m_state);
	// One that has reached Bullet's threshold was switched off.
	for (int i = 0; i < m_enabled.size(); ++i)
		m_enabled[i]->setEnabled(true);
	releaseKinematicBodies();
	for (int i = 0; i < m_bodies.size(); ++i)
		m_isTouched[i] = m_bodies[i].m_wasTouched;
}

// ---- velocities of another time

void IslandState::findTouched()
{
	m_isTouched.resize(0);
	m_isTouched.resize(m_bodies.size(), false);
	for (int i = 0; i < m_points.size(); ++i)
		for (const int body : m_points[i].m_bodies)
			if (body >= 0 && m_points[i].m_point->m_appliedImpulse > 0)
				m_isTouched[body] = true;
}

bool IslandState::isAnyTouched() const
{
	for (int i = 0; i < m_isTouched.size(); ++i)
		if (m_isTouched[i])
			return true;
	return false;
}

void IslandState::shiftFreeVelocities(btScalar later)
{
	const bool isAllFree = isFalling();
	for (int i = 0; i < m_bodies.size(); ++i)
		if (!m_isTouched[i] && (!m_bodies[i].m_isJoined || isAllFree))
			shift(m_bodies[i], later);
}

void IslandState::endShift(btScalar later)
{
	shiftFreeVelocities(later);
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& body = m_bodies[i];
		if (body.m_isJoined || !m_isTouched[i] || !(body.m_ahead > 0))
			continue;
		const btVector3 gravity = body.m_body->getGravity() * body.m_body->getLinearFactor();
		const btScalar square = gravity.length2();
		if (!(square > 0))
			continue;
		// The times for which it would have to fall freely for its speed, and for what it has gained in the step.
		const btScalar fallTime = body.m_body->getLinearVelocity().dot(gravity) / square,
					   gainTime = fallTime - body.m_linear.dot(gravity) / square - body.m_ahead,
					   freely = btMax(btMin(gainTime / m_dt, btScalar(1)), btScalar(0));
		shift(body, -btMin(freely * body.m_ahead, btMax(fallTime, btScalar(0))));
	}
}

/// \param later  the time by which its velocity is to belong to a later one [s]
void IslandState::shift(Body& body, btScalar later)
{
	btRigidBody& b = *body.m_body;
	btVector3 acceleration = b.getGravity() * b.getLinearFactor();
	if (body.m_load >= 0)
	{
		const LoadHistory& load = m_loads[size_t(body.m_load)];
		acceleration += load.m_force.m_smooth * b.getInvMass() * b.getLinearFactor();
		const btVector3 spin = b.getAngularVelocity(), twist = load.m_torque.m_smooth * later,
						turned = b.getInvInertiaTensorWorld() * twist;
		b.setAngularVelocity(spin + turned);
		body.m_inner.m_shift += double((spin + turned / 2).dot(twist));
	}
	const btVector3 change = acceleration * later, mean = b.getLinearVelocity() + change / 2;
	b.setLinearVelocity(b.getLinearVelocity() + change);
	body.m_inner.m_shift += double(mean.dot(change)) / double(b.getInvMass());
	body.m_inner.m_gravity += double(weightOf(b).dot(mean)) * double(later);
	body.m_ahead += later;
}

/// \return whether there is any
bool IslandState::findJoinedShift(const SolverGroup& island, btScalar h)
{
	if (!JoinedShift::isWanted(island, h))
		return false;
	std::vector<btRigidBody*> bodies;
	for (int i = 0; i < m_bodies.size(); ++i)
		bodies.push_back(m_bodies[i].m_body);
	m_joinedShift.collect(island, bodies, h);
	for (int i = 0; i < m_bodies.size(); ++i)
		if (m_isTouched[i])
			m_joinedShift.leaveOut(i);
	bool isHeld = m_isHeld;
	for (int i = 0; i < m_points.size(); ++i)
		isHeld |=
			(m_points[i].m_bodies[0] < 0 || m_points[i].m_bodies[1] < 0) && m_points[i].m_point->m_appliedImpulse > 0;
	// What nothing holds keeps its momentum.
	if (!isHeld && m_joinedShift.isAnyLeftOut())
		return false;
	m_joinedShift.find(isHeld);
	return true;
}

bool IslandState::isJoinedShiftSmall(const SolverGroup& island, btScalar h)
{
	if (!findJoinedShift(island, h))
		return true;
	double energy = getKineticEnergy();
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i])
			energy += island.m_joints[i]->m_model.springEnergy();
	return m_joinedShift.getEnergy() <= SMALL_SHIFT * SMALL_SHIFT * energy;
}

void IslandState::shiftJoinedVelocities(const SolverGroup& island, btScalar h, bool isResolved)
{
	if (!findJoinedShift(island, h))
		return;
	m_joinedShift.apply(isResolved);
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		m_bodies[i].m_inner.m_shift += m_joinedShift.getLoadWork(i);
		m_bodies[i].m_inner.m_gravity += m_joinedShift.getWeightWork(i);
	}
}

// ---- inner steps

/// The speed at which the two bodies close at a point [m/s].
btScalar IslandState::approachOf(const Point& point)
{
	btVector3 velocity[2];
	const btVector3 places[2] = {point.m_point->m_positionWorldOnA, point.m_point->m_positionWorldOnB};
	for (int side = 0; side < 2; ++side)
	{
		const btRigidBody* const body = btRigidBody::upcast(point.m_objects[side]);
		velocity[side] =
			body ? velocityAt(*body, places[side] - body->getWorldTransform().getOrigin()) : btVector3(0, 0, 0);
	}
	return (velocity[1] - velocity[0]).dot(point.m_point->m_normalWorldOnB);
}

bool IslandState::hasBounceAhead(btScalar leastSpeed) const
{
	for (int i = 0; i < m_points.size(); ++i)
	{
		const btManifoldPoint& point = *m_points[i].m_point;
		if (!(point.m_combinedRestitution > 0) || !(point.m_distance1 > 0))
			continue;
		const btScalar approach = approachOf(m_points[i]);
		if (approach > leastSpeed && point.m_distance1 < approach * m_dt)
			return true;
	}
	return false;
}

double IslandState::getEnergyOfBlow() const
{
	double most = 0;
	for (int i = 0; i < m_points.size(); ++i)
	{
		const Point& point = m_points[i];
		const btScalar approach = approachOf(point);
		if (!(approach > 0) || !(point.m_point->m_distance1 < approach * m_dt))
			continue;
		double inverseMass = 0;
		for (const int body : point.m_bodies)
			if (body >= 0)
				inverseMass += double(m_bodies[body].m_body->getInvMass());
		if (inverseMass > 0)
			btSetMax(most, 0.5 * double(approach) * double(approach) / inverseMass);
	}
	return most;
}

double IslandState::getKineticEnergy() const
{
	double energy = 0;
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		const btRigidBody& body = *m_bodies[i].m_body;
		energy += kineticEnergy(body, body.getWorldTransform().getBasis(), body.getLinearVelocity(),
								body.getAngularVelocity());
	}
	return energy;
}

double IslandState::getTaken() const
{
	double taken = 0;
	for (int i = 0; i < m_points.size(); ++i)
	{
		const Point& point = m_points[i];
		if (!(point.m_point->m_appliedImpulse > 0))
			continue;
		const btVector3 places[2] = {point.m_point->m_positionWorldOnA, point.m_point->m_positionWorldOnB};
		btVector3 change(0, 0, 0);
		for (int side = 0; side < 2; ++side)
			if (point.m_bodies[side] >= 0)
			{
				const Body& body = m_bodies[point.m_bodies[side]];
				const btVector3 gained =
					body.m_body->getLinearVelocity() - body.m_velocity +
					(body.m_body->getAngularVelocity() - body.m_spin).cross(places[side] - body.m_place.getOrigin());
				change += side == 1 ? gained : -gained;
			}
		const btScalar after = approachOf(point), before = after - change.dot(point.m_point->m_normalWorldOnB);
		taken += double(point.m_point->m_appliedImpulse) * double(before + after) / 2;
	}
	return btMax(taken, 0.);
}

/// Gives a point impulses of the whole step, and back the factor that it has for one.
void IslandState::leave(const Point& point, const btScalar* impulses)
{
	setImpulses(*point.m_point, impulses, 1);
	if (hasOwnFactor(*point.m_point))
		point.m_point->m_contactERP = point.m_erp;
}

void IslandState::scalePoints(btScalar share)
{
	for (int i = 0; i < m_points.size(); ++i)
	{
		btManifoldPoint& point = *m_points[i].m_point;
		btScalar impulses[3];
		impulsesOf(point, impulses);
		setImpulses(point, impulses, share);
		if (hasOwnFactor(point))
			point.m_contactERP *= share;
	}
}

void IslandState::carry(btScalar end, btScalar h, btScalar leastSpeed)
{
	for (int i = 0; i < m_kinematic.size(); ++i)
	{
		const Kinematic& kinematic = m_kinematic[i];
		btTransform place;
		btTransformUtil::integrateTransform(kinematic.m_end, kinematic.m_body->getLinearVelocity(),
											kinematic.m_body->getAngularVelocity(), end - m_dt, place);
		kinematic.m_body->setWorldTransform(place);
	}
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& body = m_bodies[i];
		body.m_place = body.m_body->getWorldTransform();
		body.m_velocity = body.m_body->getLinearVelocity();
		body.m_spin = body.m_body->getAngularVelocity();
	}
	m_isEnabled.resize(m_enabled.size());
	for (int i = 0; i < m_enabled.size(); ++i)
		m_isEnabled[i] = m_enabled[i]->isEnabled();
	const bool isFirst = end <= h;
	for (int i = 0; i < m_points.size(); ++i)
	{
		Point& point = m_points[i];
		btManifoldPoint& p = *point.m_point;
		impulsesOf(p, point.m_guess);
		if (isFirst)
			p.m_distance1 = point.m_distance;
		else
			placeContact(p, point.m_objects[0]->getWorldTransform(), point.m_objects[1]->getWorldTransform());
		const btScalar approach = p.m_combinedRestitution > 0 && p.m_distance1 > 0 ? approachOf(point) : btScalar(0);
		if (approach > leastSpeed)
			btSetMax(p.m_distance1, 4 * approach * h + btScalar(0.01));
	}
}

void IslandState::note()
{
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& body = m_bodies[i];
		body.m_notedVelocity = body.m_body->getLinearVelocity();
		body.m_notedSpin = body.m_body->getAngularVelocity();
		body.m_notedShift = body.m_inner.m_shift;
		body.m_notedGravity = body.m_inner.m_gravity;
		body.m_notedAhead = body.m_ahead;
	}
	for (int i = 0; i < m_joints.size(); ++i)
		m_joints[i].m_notedWork = m_joints[i].m_works->m_model.m_state.m_work;
}

void IslandState::takeBack()
{
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& body = m_bodies[i];
		put(*body.m_body, body.m_place, body.m_notedVelocity, body.m_notedSpin);
		body.m_inner.m_shift = body.m_notedShift;
		body.m_inner.m_gravity = body.m_notedGravity;
		body.m_ahead = body.m_notedAhead;
	}
	for (int i = 0; i < m_points.size(); ++i)
		setImpulses(*m_points[i].m_point, m_points[i].m_guess, 1);
	for (int i = 0; i < m_joints.size(); ++i)
	{
		m_joints[i].m_works->m_step.revert();
		m_joints[i].m_works->m_model.m_state.m_work = m_joints[i].m_notedWork;
	}
	// One that has reached Bullet's threshold was switched off.
	for (int i = 0; i < m_enabled.size(); ++i)
		m_enabled[i]->setEnabled(m_isEnabled[i]);
}

/// What a contact's impulses have given to its bodies, impulse times mean velocity.
void IslandState::bookWork(const Point& point)
{
	const btManifoldPoint& p = *point.m_point;
	const btVector3 normal = p.m_normalWorldOnB * p.m_appliedImpulse,
					friction = p.m_lateralFrictionDir1 * p.m_appliedImpulseLateral1 +
							   p.m_lateralFrictionDir2 * p.m_appliedImpulseLateral2;
	const btVector3 places[2] = {p.m_positionWorldOnA, p.m_positionWorldOnB};
	for (int side = 0; side < 2; ++side)
	{
		if (point.m_bodies[side] < 0)
			continue;
		Body& before = m_bodies[point.m_bodies[side]];
		const btRigidBody& body = *before.m_body;
		const btVector3 mean = (before.m_velocity + body.getLinearVelocity()) * body.getLinearFactor() / 2,
						spin = (before.m_spin + body.getAngularVelocity()) * body.getAngularFactor() / 2;
		const btVector3 arm = places[side] - before.m_place.getOrigin(), way = mean + spin.cross(arm);
		const double sign = side == 0 ? 1 : -1;
		before.m_inner.m_contacts += sign * double(normal.dot(way));
		before.m_inner.m_friction += sign * double(friction.dot(way));
	}
}

void IslandState::move(btScalar h)
{
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		const Body& before = m_bodies[i];
		btRigidBody& body = *before.m_body;
		btElasticPlasticInnerMotion& inner = m_bodies[i].m_inner;
		const btVector3 &v = body.getLinearVelocity(), &w = body.getAngularVelocity();
		inner.m_pushed += body.getWorldTransform().getOrigin() - before.m_place.getOrigin();
		inner.m_way += v * h;
		inner.m_turn += w * h;
		const btVector3 way = (before.m_velocity + v) * (h / 2), turn = (before.m_spin + w) * (h / 2);
		inner.m_work += double(body.getTotalForce().dot(way)) + double(body.getTotalTorque().dot(turn));
		inner.m_gravity += double(weightOf(body).dot(way));
		inner.m_pushes += m_pushes.getWork(before.m_given, way, turn);
		btTransform to;
		body.predictIntegratedTransform(h, to);
		const btVector3 linear = v, angular = w;
		body.setAngularVelocity(before.m_spin);
		inner.m_turning += energyOfTurning(body, linear, before.m_spin, angular, to.getBasis(), h);
		body.setAngularVelocity(angular);
	}
	for (int i = 0; i < m_points.size(); ++i)
	{
		btScalar impulses[3];
		impulsesOf(*m_points[i].m_point, impulses);
		for (int k = 0; k < 3; ++k)
			m_points[i].m_sum[k] += impulses[k];
		bookWork(m_points[i]);
	}
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		btTransform to;
		m_bodies[i].m_body->predictIntegratedTransform(h, to);
		m_bodies[i].m_body->setCenterOfMassTransform(to);
	}
	findTouched();
}

// ---- the end

void IslandState::finish(int steps, std::vector<BodyMotion>& motions)
{
	motions.clear();
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		const Body& from = m_bodies[i];
		btRigidBody& body = *from.m_body;
		BodyMotion motion;
		motion.m_body = &body;
		motion.m_index = body.getWorldArrayIndex();
		motion.m_proxy = uidOf(body);
		motion.m_end = body.getWorldTransform();
		motion.m_linear = body.getLinearVelocity();
		motion.m_angular = body.getAngularVelocity();
		motion.m_meanLinear = (motion.m_end.getOrigin() - from.m_start.getOrigin()) / m_dt;
		motion.m_meanAngular = meanSpin(from.m_start, motion.m_end, m_dt);
		motion.m_inner = from.m_inner;
		motion.m_inner.m_steps = steps;
		motion.m_isTouched = m_isTouched[i];
		put(body, from.m_start, motion.m_meanLinear, motion.m_meanAngular);
		body.predictIntegratedTransform(m_dt, motion.m_moved);
		motions.push_back(motion);
	}
	leavePoints();
	if (m_hasPushes)
		m_pushes.end();
	releaseKinematicBodies();
}

/// The next step begins with the impulses that points have. Where no joint holds any more it is Bullet's, and the sum over all inner steps of what has pressed rubble would throw it.
void IslandState::leavePoints()
{
	bool doJointsHold = false;
	for (int i = 0; i < m_joints.size(); ++i)
		doJointsHold |= m_joints[i].m_works->holds();
	const bool areForces = doPointsTellForces();
	const btScalar none[3] = {0, 0, 0};
	for (int i = 0; i < m_points.size(); ++i)
	{
		btScalar last[3];
		const btScalar* const left = doJointsHold ? m_points[i].m_sum : impulsesOf(*m_points[i].m_point, last);
		leave(m_points[i], areForces ? left : none);
	}
}

/// No contact takes more than all bodies' momentum, but where it is pressed by what cannot give way, as between the ground and a kinematic body.
bool IslandState::doPointsTellForces() const
{
	double mass = 0, fastest = 0;
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		const btRigidBody& body = *m_bodies[i].m_body;
		mass += 1 / double(body.getInvMass());
		btSetMax(fastest, double(m_bodies[i].m_linear.length()) +
							  double(m_dt) * double(body.getInvMass()) * double(body.getTotalForce().length()));
	}
	for (int i = 0; i < m_kinematic.size(); ++i)
		btSetMax(fastest, double(m_kinematic[i].m_body->getLinearVelocity().length()));
	for (int i = 0; i < m_points.size(); ++i)
		if (m_points[i].m_sum[0] > mass * fastest)
			return false;
	return true;
}

void IslandState::releaseKinematicBodies()
{
	for (int i = 0; i < m_kinematic.size(); ++i)
		m_kinematic[i].m_body->setWorldTransform(m_kinematic[i].m_end);
}
}  // namespace btElasticPlastic
