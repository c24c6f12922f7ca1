// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ENERGY_FLOW_H
#define BT_ELASTIC_PLASTIC_ENERGY_FLOW_H

#include "../../btElasticPlasticEnergyAudit.h"
#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"
#include "LinearMath/btHashMap.h"
#include "LinearMath/btTransform.h"

class btPersistentManifold;
class btRigidBody;
class btElasticPlasticJoint;

namespace btElasticPlastic
{
/// The works of an energy audit: takes stock of bodies and joints before a substep, and books after it what has changed.
class EnergyFlow
{
public:
	EnergyFlow(btDynamicsWorld& world, btElasticPlasticAction& action);
	~EnergyFlow();

	void begin();
	void end(btScalar dt);
	void reset();
	const btElasticPlasticEnergyBalance& getBalance() const { return m_balance; }

private:
	/// A body as it was when the substep began; after it, what the solver began with.
	struct Body
	{
		btTransform m_place;
		btVector3 m_linear, m_angular;
		double m_kinetic;
		bool m_isSolved;       ///< took part in the substep
		bool m_hasInnerSteps;  ///< was taken through it in several steps, whose work is told by the solver
	};
	/// A joint's account.
	struct Joint
	{
		double m_elastic, m_plastic, m_damping, m_numerical, m_broken;
		btVector3 m_point;  ///< where it acts, if it is in the world
	};

	static Joint read(const btElasticPlasticJoint& joint);
	void takeStock();
	void listen();
	void stopListening();
	void endBody(btRigidBody& body, btScalar dt);
	void endContact(const btPersistentManifold& manifold);
	void endConstraint(const btTypedConstraint& constraint, btScalar dt);
	void endJoint(const btElasticPlasticJoint& joint);
	void endSupports(const btElasticPlasticJoint& joint, btScalar dt);
	/// What an impulse at a point has given to a body, if it is one that moves freely.
	double workOn(const btCollisionObject& object, const btVector3& point, const btVector3& impulse);

	btDynamicsWorld& m_world;
	btElasticPlasticAction& m_action;
	btElasticPlasticEnergyBalance m_balance;
	btHashMap<btHashPtr, Body> m_bodies;
	btHashMap<btHashPtr, Joint> m_joints;
	/// In the world: the bodies of others may be gone.
	btAlignedObjectArray<btElasticPlasticJoint*> m_held;
	/// Of constraints that have none of the user's; each by itself, as constraints point to it.
	btHashMap<btHashPtr, btJointFeedback*> m_feedback;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ENERGY_FLOW_H
