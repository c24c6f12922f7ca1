// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "EnergyFlow.h"

#include "../../btElasticPlasticAction.h"
#include "../joint/BodyEnergy.h"
#include "../joint/BodyGate.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"

namespace btElasticPlastic
{
namespace
{
btRigidBody* massiveBody(btCollisionObject* object)
{
	btRigidBody* const body = btRigidBody::upcast(object);
	return body && body->getInvMass() > 0 && !body->isStaticOrKinematicObject() ? body : nullptr;
}

double kineticEnergyOf(const btRigidBody& body)
{
	return kineticEnergy(body, body.getWorldTransform().getBasis(), body.getLinearVelocity(),
						 body.getAngularVelocity());
}

/// Whether a body has an energy: one that has become NaN is left out, as it is by the joints.
bool hasEnergy(const btRigidBody& body)
{
	return isWellFormed(body) && btElasticPlasticIsFinite(kineticEnergyOf(body));
}

/// Books work, of which a body that has become NaN may make a NaN.
void book(double& account, double work)
{
	if (btElasticPlasticIsFinite(work))
		account += work;
}
}  // namespace

EnergyFlow::EnergyFlow(btDynamicsWorld& world, btElasticPlasticAction& action) : m_world(world), m_action(action)
{
	reset();
}

EnergyFlow::~EnergyFlow()
{
	stopListening();
	for (int i = 0; i < m_feedback.size(); ++i)
		delete *m_feedback.getAtIndex(i);
}

void EnergyFlow::reset()
{
	m_balance = btElasticPlasticEnergyBalance();
	takeStock();
	m_balance.m_begin = m_balance.m_turnover = m_balance.m_kinetic + m_balance.m_elastic;
}

void EnergyFlow::begin()
{
	const double before = m_balance.m_kinetic + m_balance.m_elastic;
	double asleep = 0;
	for (int i = 0; i < m_world.getNumCollisionObjects(); ++i)
	{
		const btRigidBody* const body = massiveBody(m_world.getCollisionObjectArray()[i]);
		const Body* const known = body ? m_bodies.find(btHashPtr(body)) : nullptr;
		if (known && !body->isActive() && hasEnergy(*body))
			asleep += known->m_kinetic - kineticEnergyOf(*body);
	}
	takeStock();
	listen();
	m_balance.m_sleep += asleep;
	m_balance.m_others += m_balance.m_kinetic + m_balance.m_elastic - before + asleep;
}

EnergyFlow::Joint EnergyFlow::read(const btElasticPlasticJoint& joint)
{
	const double elastic = joint.getElasticEnergy();
	return {joint.isBroken() ? 0 : elastic, joint.getPlasticEnergy(),       joint.getDampingEnergy(),
			joint.getNumericalEnergy(),     joint.isBroken() ? elastic : 0, joint.getPosition()};
}

void EnergyFlow::takeStock()
{
	m_balance.m_kinetic = m_balance.m_elastic = 0;
	m_bodies.clear();
	for (int i = 0; i < m_world.getNumCollisionObjects(); ++i)
	{
		const btRigidBody* const body = massiveBody(m_world.getCollisionObjectArray()[i]);
		if (!body || !hasEnergy(*body))
			continue;
		const double kinetic = kineticEnergyOf(*body);
		m_bodies.insert(btHashPtr(body), {body->getWorldTransform(), body->getLinearVelocity(),
										  body->getAngularVelocity(), kinetic, false, false});
		m_balance.m_kinetic += kinetic;
	}
	m_joints.clear();
	for (int i = 0; i < m_action.getNumJoints(); ++i)
	{
		const btElasticPlasticJoint* const joint = m_action.getJoint(i);
		const Joint account = read(*joint);
		m_joints.insert(btHashPtr(joint), account);
		m_balance.m_elastic += account.m_elastic;
	}
	m_action.getJointsInWorld(m_world, m_held);
	for (int i = 0; i < m_held.size(); ++i)
		m_joints.find(btHashPtr(m_held[i]))->m_point = m_held[i]->getPosition();
}

/// Bullet tells a constraint's impulses to its feedback alone. Within a substep only: afterwards a constraint may leave the world, and the audit
/// be deleted.
void EnergyFlow::listen()
{
	for (int i = 0; i < m_world.getNumConstraints(); ++i)
	{
		btTypedConstraint* const constraint = m_world.getConstraint(i);
		if (btElasticPlasticJoint::from(constraint))
			continue;
		btJointFeedback** own = m_feedback.find(btHashPtr(constraint));
		if (constraint->getJointFeedback() && (!own || *own != constraint->getJointFeedback()))
			continue;
		if (!own)
		{
			m_feedback.insert(btHashPtr(constraint), new btJointFeedback);
			own = m_feedback.find(btHashPtr(constraint));
		}
		const btVector3 zero(0, 0, 0);
		(*own)->m_appliedForceBodyA = (*own)->m_appliedTorqueBodyA = zero;
		(*own)->m_appliedForceBodyB = (*own)->m_appliedTorqueBodyB = zero;
		constraint->setJointFeedback(*own);
	}
}

void EnergyFlow::stopListening()
{
	for (int i = 0; i < m_world.getNumConstraints(); ++i)
	{
		btTypedConstraint* const constraint = m_world.getConstraint(i);
		btJointFeedback* const* const own = m_feedback.find(btHashPtr(constraint));
		if (own && *own == constraint->getJointFeedback())
			constraint->setJointFeedback(nullptr);
	}
}

// ---- after a substep

void EnergyFlow::end(btScalar dt)
{
	for (int i = 0; i < m_world.getNumCollisionObjects(); ++i)
		if (btRigidBody* const body = massiveBody(m_world.getCollisionObjectArray()[i]))
			endBody(*body, dt);
	btDispatcher& dispatcher = *m_world.getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
		endContact(*dispatcher.getManifoldByIndexInternal(i));
	for (int i = 0; i < m_world.getNumConstraints(); ++i)
		endConstraint(*m_world.getConstraint(i), dt);
	stopListening();
	for (int i = 0; i < m_action.getNumJoints(); ++i)
		endJoint(*m_action.getJoint(i));
	m_action.getJointsInWorld(m_world, m_held);
	for (int i = 0; i < m_held.size(); ++i)
		endSupports(*m_held[i], dt);
	takeStock();
	btElasticPlasticEnergyBalance& b = m_balance;
	b.m_rest = b.getGiven() - b.getTaken() - b.m_kinetic - b.m_elastic;
	const double turnover = b.m_kinetic + b.m_elastic + b.m_plastic + b.m_damping + b.m_broken;
	btSetMax(b.m_turnover, turnover);
}

/// Books what has changed a body by itself: loads, Bullet's damping, its turn. The velocities that it then has in the list are those with
/// which the solver began.
void EnergyFlow::endBody(btRigidBody& body, btScalar dt)
{
	Body* const before = m_bodies.find(btHashPtr(&body));
	if (!before)
		return;
	if (!hasEnergy(body))
	{
		m_balance.m_others -= before->m_kinetic;
		m_bodies.remove(btHashPtr(&body));
		return;
	}
	const btTransform place = body.getWorldTransform();
	const btVector3 linear = body.getLinearVelocity(), angular = body.getAngularVelocity();
	btElasticPlasticInnerMotion inner;
	before->m_isSolved = body.isActive();
	before->m_hasInnerSteps = m_action.getInnerMotion(body, inner);

	// Bullet is asked itself, with the body as it was.
	body.setLinearVelocity(before->m_linear);
	body.setAngularVelocity(before->m_angular);
	body.applyDamping(dt);
	before->m_linear = body.getLinearVelocity();
	before->m_angular = body.getAngularVelocity();
	m_balance.m_bulletDamping +=
		before->m_kinetic - kineticEnergy(body, before->m_place.getBasis(), before->m_linear, before->m_angular);
	if (before->m_isSolved && !before->m_hasInnerSteps)
	{
		body.setWorldTransform(before->m_place);
		m_balance.m_turning -= energyOfTurning(body, linear, before->m_angular, angular, place.getBasis(), dt);
		body.setWorldTransform(place);
	}
	body.setLinearVelocity(linear);
	body.setAngularVelocity(angular);
	if (!before->m_isSolved)
		return;

	const btVector3 weight = body.getGravity() * body.getLinearFactor() / body.getInvMass(),
					others = body.getTotalForce() - weight;
	btVector3 way = linear * dt;
	if (before->m_hasInnerSteps)
	{
		way = inner.m_way;
		m_balance.m_gravity += inner.m_gravity;
		m_balance.m_loads += inner.m_work + inner.m_shift - inner.m_pushes - inner.m_gravity;
		m_balance.m_others += inner.m_pushes;
		m_balance.m_contacts -= inner.m_contacts;
		m_balance.m_friction -= inner.m_friction;
		m_balance.m_turning -= inner.m_turning;
	}
	else
	{
		const btVector3 meanWay = (before->m_linear + linear) * (dt / 2),
						meanTurn = (before->m_angular + angular) * (dt / 2);
		m_balance.m_gravity += double(weight.dot(meanWay));
		m_balance.m_loads += double(others.dot(meanWay)) + double(body.getTotalTorque().dot(meanTurn));
	}
	const btVector3 lifted = place.getOrigin() - before->m_place.getOrigin() - way;
	if (lifted.length() > 4 * SIMD_EPSILON * place.getOrigin().length())
		m_balance.m_lifted -= double(weight.dot(lifted));
}

double EnergyFlow::workOn(const btCollisionObject& object, const btVector3& point, const btVector3& impulse)
{
	const Body* const before = m_bodies.find(btHashPtr(&object));
	const btRigidBody* const body = btRigidBody::upcast(&object);
	if (!before || !before->m_isSolved || before->m_hasInnerSteps || !body)
		return 0;
	const btVector3 arm = point - before->m_place.getOrigin();
	return 0.5 * (double(impulse.dot((before->m_linear + body->getLinearVelocity()) * body->getLinearFactor())) +
				  double(arm.cross(impulse).dot((before->m_angular + body->getAngularVelocity()) *
												body->getAngularFactor())));
}

void EnergyFlow::endContact(const btPersistentManifold& manifold)
{
	const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
	for (int i = 0; i < manifold.getNumContacts(); ++i)
	{
		const btManifoldPoint& p = manifold.getContactPoint(i);
		const auto give = [&](const btVector3& impulse)
		{ return workOn(a, p.getPositionWorldOnA(), impulse) + workOn(b, p.getPositionWorldOnB(), -impulse); };
		book(m_balance.m_contacts, -give(p.m_normalWorldOnB * p.m_appliedImpulse));
		book(m_balance.m_friction, -give(p.m_lateralFrictionDir1 * p.m_appliedImpulseLateral1 +
										 p.m_lateralFrictionDir2 * p.m_appliedImpulseLateral2));
	}
}

void EnergyFlow::endConstraint(const btTypedConstraint& constraint, btScalar dt)
{
	const btJointFeedback* const feedback = constraint.getJointFeedback();
	if (!feedback || btElasticPlasticJoint::from(const_cast<btTypedConstraint*>(&constraint)))
		return;
	const btRigidBody* const bodies[2] = {&constraint.getRigidBodyA(), &constraint.getRigidBodyB()};
	const btVector3 forces[2] = {feedback->m_appliedForceBodyA, feedback->m_appliedForceBodyB},
					torques[2] = {feedback->m_appliedTorqueBodyA, feedback->m_appliedTorqueBodyB};
	for (int side = 0; side < 2; ++side)
	{
		const Body* const before = m_bodies.find(btHashPtr(bodies[side]));
		if (!before || !before->m_isSolved || before->m_hasInnerSteps)
			continue;
		book(m_balance.m_constraints,
			 -0.5 * double(dt) *
				 (double(forces[side].dot(before->m_linear + bodies[side]->getLinearVelocity())) +
				  double(torques[side].dot(before->m_angular + bodies[side]->getAngularVelocity()))));
	}
}

void EnergyFlow::endJoint(const btElasticPlasticJoint& joint)
{
	const Joint* const before = m_joints.find(btHashPtr(&joint));
	if (!before)
		return;
	const Joint after = read(joint);
	m_balance.m_plastic += after.m_plastic - before->m_plastic;
	m_balance.m_damping += after.m_damping - before->m_damping;
	m_balance.m_numerical += after.m_numerical - before->m_numerical;
	m_balance.m_broken += after.m_broken - before->m_broken;
}

/// A support that moves gives what the joint takes from it.
void EnergyFlow::endSupports(const btElasticPlasticJoint& joint, btScalar dt)
{
	const Joint* const before = m_joints.find(btHashPtr(&joint));
	if (!before || joint.getNumCommittedRows() == 0)
		return;
	const btRigidBody* const bodies[2] = {&joint.getConstraint().getRigidBodyA(),
										  &joint.getConstraint().getRigidBodyB()};
	for (int side = 0; side < 2; ++side)
	{
		const btRigidBody& body = *bodies[side];
		if (!body.isKinematicObject())
			continue;
		btVector3 force(0, 0, 0), moment(0, 0, 0);
		for (int i = 0; i < 3; ++i)
		{
			force += joint.getJointAxis(i) * joint.getAppliedForce(i);
			moment += joint.getJointAxis(3 + i) * joint.getAppliedForce(3 + i);
		}
		const btVector3 point =
			before->m_point - (body.getWorldTransform().getOrigin() - body.getLinearVelocity() * dt);
		const double power =
			double(force.dot(body.getVelocityInLocalPoint(point))) + double(moment.dot(body.getAngularVelocity()));
		book(m_balance.m_constraints, (side == 0 ? 1 : -1) * power * double(dt));
	}
}
}  // namespace btElasticPlastic
