// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "world/BulletJoint.h"

#include <cmath>

#include "LinearMath/btMinMax.h"

namespace ep
{
namespace
{
btTransform in(const btRigidBody& body, const btTransform& frame)
{
	return body.getCenterOfMassTransform().inverse() * frame;
}

/// Bullet's class with six springs, whichever of the two.
template <class Constraint>
Constraint* withSprings(Constraint* constraint, const btElasticPlasticCapacity& c)
{
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const bool locked = c.isRigidPlastic(i);
		constraint->setLimit(i, locked ? 0 : 1, locked ? 0 : -1);
		if (locked || !c.isElasticPlastic(i))
			continue;
		constraint->enableSpring(i, true);
		constraint->setStiffness(i, c.m_stiffness[i]);
		constraint->setEquilibriumPoint(i);
	}
	return constraint;
}

class Fixed : public BulletJoint
{
public:
	using BulletJoint::BulletJoint;
	void release(int dof) override { static_cast<btFixedConstraint&>(constraint()).setLimit(dof, 1, -1); }
};

/// Bullet has one threshold for forces and moments: the least of the yield values, as a number.
class Breaking : public Fixed
{
public:
	using Fixed::Fixed;
	void beforeStep(btScalar dt) override
	{
		btScalar least = btElasticPlasticCapacity::unlimited();
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			if (capacity().isElasticPlastic(i))
				least = btMin(least, capacity().m_yield[i]);
		constraint().setBreakingImpulseThreshold(least * dt);
	}
};

template <class Constraint>
class Springs : public BulletJoint
{
public:
	using BulletJoint::BulletJoint;
	void release(int dof) override
	{
		auto& springs = static_cast<Constraint&>(constraint());
		springs.enableSpring(dof, false);
		springs.setLimit(dof, 1, -1);
		m_released |= 1u << dof;
	}
	double elasticEnergy() const override
	{
		double energy = 0;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			if (isSpring(i))
				energy += double(capacity().m_stiffness[i]) * std::pow(double(deformation(i)), 2) / 2;
		return energy;
	}
	double longestStep() const override
	{
		double most = 0;  // squared frequency of one body by itself [1/s^2]
		for (const btRigidBody* body : {&constraint().getRigidBodyA(), &constraint().getRigidBodyB()})
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			{
				const btVector3 along = axis(i);
				const btScalar inverse =
					i < 3 ? body->getInvMass() : along.dot(body->getInvInertiaTensorWorld() * along);
				if (isSpring(i))
					most = btMax(most, double(capacity().m_stiffness[i] * inverse));
			}
		return most > 0 ? 0.25 / std::sqrt(most) : HUGE_VAL;
	}

private:
	bool isSpring(int dof) const
	{
		return capacity().isElasticPlastic(dof) && !capacity().isRigidPlastic(dof) && !(m_released >> dof & 1u);
	}

	unsigned m_released = 0;  // bit i: degree of freedom i
};

/// A hinge about the joint's z axis.
class Motor : public BulletJoint
{
public:
	Motor(btTypedConstraint* hinge, const btTransform& frame, const btElasticPlasticCapacity& capacity, bool breaks)
		: BulletJoint(hinge, frame, capacity), m_breaks(breaks)
	{
	}
	void release(int dof) override { m_free |= dof == BT_EP_BENDING_Z; }
	bool isBrake() const override { return true; }
	double plasticWork() const override { return m_work; }
	void beforeStep(btScalar dt) override
	{
		auto& hinge = static_cast<btHingeConstraint&>(constraint());
		hinge.enableAngularMotor(!m_free, 0, capacity().m_yield[BT_EP_BENDING_Z] * dt);
	}
	void afterStep(btScalar dt) override
	{
		const btRigidBody &a = constraint().getRigidBodyA(), &b = constraint().getRigidBodyB();
		const btScalar turn = axis(BT_EP_BENDING_Z).dot(b.getAngularVelocity() - a.getAngularVelocity()) * dt;
		m_path += btFabs(turn);
		m_work += btMax(0., double(load(BT_EP_BENDING_Z) * turn));
		if (m_breaks && m_path > capacity().m_ductility[BT_EP_BENDING_Z])
			constraint().setEnabled(false);
	}

private:
	bool m_breaks, m_free = false;
	btScalar m_path = 0;  // [rad]
	double m_work = 0;
};
}  // namespace

btTypedConstraint* makeBulletsOwn(const JointKind& kind, btRigidBody& a, btRigidBody& b, const btTransform& frame,
								  const btElasticPlasticCapacity& capacity)
{
	const btTransform inA = in(a, frame), inB = in(b, frame);
	switch (kind.joints)
	{
		case Joints::ElasticPlastic:
		case Joints::Paper:
		case Joints::None:
			break;
		case Joints::Fixed:
		case Joints::Breaking:
			return new btFixedConstraint(a, b, inA, inB);
		case Joints::Springs:
			if (kind.jointClass == JointClass::Spring)
				return withSprings(new btGeneric6DofSpringConstraint(a, b, inA, inB, true), capacity);
			return withSprings(new btGeneric6DofSpring2Constraint(a, b, inA, inB), capacity);
		case Joints::HingeMotor:
		case Joints::PlasticHinge:
			return new btHingeConstraint(a, b, inA, inB, true);
	}
	return nullptr;
}

std::unique_ptr<BulletJoint> BulletJoint::make(const JointKind& kind, btRigidBody& a, btRigidBody& b,
											   const btTransform& frame, const btElasticPlasticCapacity& c)
{
	btTypedConstraint* const constraint = makeBulletsOwn(kind, a, b, frame, c);
	if (!constraint)
		return nullptr;
	if (kind.joints == Joints::Fixed)
		return std::make_unique<Fixed>(constraint, frame, c);
	if (kind.joints == Joints::Breaking)
		return std::make_unique<Breaking>(constraint, frame, c);
	if (kind == kinds::Spring)
		return std::make_unique<Springs<btGeneric6DofSpringConstraint>>(constraint, frame, c);
	if (kind == kinds::Spring2)
		return std::make_unique<Springs<btGeneric6DofSpring2Constraint>>(constraint, frame, c);
	return std::make_unique<Motor>(constraint, frame, c, kind.joints == Joints::PlasticHinge);
}

BulletJoint::BulletJoint(btTypedConstraint* constraint, const btTransform& frame,
						 const btElasticPlasticCapacity& capacity)
	: m_constraint(constraint),
	  m_inA(in(m_constraint->getRigidBodyA(), frame)),
	  m_inB(in(m_constraint->getRigidBodyB(), frame)),
	  m_capacity(capacity)
{
	m_feedback.m_appliedForceBodyA = m_feedback.m_appliedTorqueBodyA = btVector3(0, 0, 0);
	m_feedback.m_appliedForceBodyB = m_feedback.m_appliedTorqueBodyB = btVector3(0, 0, 0);
	m_constraint->setJointFeedback(&m_feedback);
}

double BulletJoint::longestStep() const { return HUGE_VAL; }

btVector3 BulletJoint::axis(int dof) const
{
	return quatRotate(m_constraint->getRigidBodyA().getOrientation(), m_inA.getBasis().getColumn(dof % 3));
}

btScalar BulletJoint::load(int dof) const
{
	// The user's own feedback, if there is one.
	const btJointFeedback& feedback = *m_constraint->getJointFeedback();
	const btVector3 arm = quatRotate(m_constraint->getRigidBodyA().getOrientation(), m_inA.getOrigin());
	const btVector3& force = feedback.m_appliedForceBodyA;
	return axis(dof).dot(dof < 3 ? force : feedback.m_appliedTorqueBodyA - arm.cross(force));
}

btScalar BulletJoint::deformation(int dof) const
{
	const btTransform a = m_constraint->getRigidBodyA().getCenterOfMassTransform() * m_inA,
					  b = m_constraint->getRigidBodyB().getCenterOfMassTransform() * m_inB;
	const btTransform apart = a.inverse() * b;
	if (dof < 3)
		return apart.getOrigin()[dof];
	const btQuaternion turn = apart.getRotation();
	return turn.getAngleShortestPath() * (turn.w() < 0 ? -1 : 1) * turn.getAxis()[dof - 3];
}
}  // namespace ep
