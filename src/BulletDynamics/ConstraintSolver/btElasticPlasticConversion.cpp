// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticConversion.h"

#include "BulletDynamics/ConstraintSolver/btConeTwistConstraint.h"
#include "BulletDynamics/ConstraintSolver/btFixedConstraint.h"
#include "BulletDynamics/ConstraintSolver/btGeneric6DofConstraint.h"
#include "BulletDynamics/ConstraintSolver/btHingeConstraint.h"
#include "BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h"
#include "BulletDynamics/ConstraintSolver/btSliderConstraint.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "ElasticPlastic/joint/JointRegistry.h"
#include "btElasticPlasticAction.h"

namespace
{
typedef btElasticPlasticConversion::Joint Joint;

const btMatrix3x3& asItIs() { return btMatrix3x3::getIdentity(); }

/// A joint at two frames, both turned by the same rotation, with what belongs to a constraint whatever its type. All translations and
/// turns are locked.
Joint* make(btTypedConstraint& constraint, const btTransform& frameInA, const btTransform& frameInB,
			const btMatrix3x3& turn)
{
	const btTransform turned(turn, btVector3(0, 0, 0));
	Joint* const joint =
		new Joint(constraint.getRigidBodyA(), constraint.getRigidBodyB(), frameInA * turned, frameInB * turned);
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		joint->setLimit(dof, 0, 0);
	// The pointer lies where the identification is.
	joint->setUserConstraintType(constraint.getUserConstraintType());
	joint->setUserConstraintPtr(constraint.getUserConstraintPtr());
	joint->setDbgDrawSize(constraint.getDbgDrawSize());
	return joint;
}

bool isLocked(Joint& joint, int dof)
{
	if (dof < 3)
	{
		const btTranslationalLimitMotor2& motor = *joint.getTranslationalLimitMotor();
		return motor.m_lowerLimit[dof] == 0 && motor.m_upperLimit[dof] == 0;
	}
	const btRotationalLimitMotor2& motor = *joint.getRotationalLimitMotor(dof - 3);
	return motor.m_loLimit == 0 && motor.m_hiLimit == 0;
}

/// Gives the capacity to what is locked.
Joint* strengthen(Joint* joint, const btElasticPlasticCapacity& capacity)
{
	btElasticPlasticCapacity ofLocked = capacity;
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		if (!isLocked(*joint, dof))
			ofLocked.clear(dof);
	joint->setCapacity(ofLocked);
	return joint;
}

/// Limits an angle to either side; a span of pi and more leaves it free.
void setSpan(Joint& joint, int dof, btScalar span)
{
	if (span < SIMD_PI)
		joint.setLimit(dof, -span, span);
	else
		joint.setLimit(dof, 1, -1);
}

/// A rotation that turns x into a direction.
btMatrix3x3 turnTowards(const btVector3& direction)
{
	const btVector3 x = direction.normalized();
	btVector3 y, z;
	btPlaneSpace1(x, y, z);
	return btMatrix3x3(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z());
}

/// A direction of the world in a frame on a body.
btVector3 inFrame(const btRigidBody& body, const btTransform& frame, const btVector3& direction)
{
	return (body.getCenterOfMassTransform().getBasis() * frame.getBasis()).transpose() * direction;
}
}  // namespace

Joint* btElasticPlasticConversion::fromFixed(btFixedConstraint& constraint, const btElasticPlasticCapacity& capacity,
											 const btVector3& along)
{
	const btTransform &a = constraint.getFrameOffsetA(), &b = constraint.getFrameOffsetB();
	const btMatrix3x3 turn = along.fuzzyZero() ? asItIs() : turnTowards(inFrame(constraint.getRigidBodyA(), a, along));
	return strengthen(make(constraint, a, b, turn), capacity);
}

Joint* btElasticPlasticConversion::fromHinge(btHingeConstraint& constraint, const btElasticPlasticCapacity& capacity,
											 const btVector3& along)
{
	const btTransform &a = constraint.getAFrame(), &b = constraint.getBFrame();
	const btVector3 x = inFrame(constraint.getRigidBodyA(), a, along);
	const btMatrix3x3 turn = btVector3(x.x(), x.y(), 0).fuzzyZero()
								 ? asItIs()
								 : btMatrix3x3(btQuaternion(btVector3(0, 0, 1), btAtan2(x.y(), x.x())));
	Joint* const joint = make(constraint, a, b, turn);
	if (!constraint.hasLimit())
		joint->setLimit(BT_EP_BENDING_Z, 1, -1);
	// A hinge that refers to A counts its angle the other way round.
	else if (constraint.getUseReferenceFrameA())
		joint->setLimit(BT_EP_BENDING_Z, -constraint.getUpperLimit(), -constraint.getLowerLimit());
	else
		joint->setLimit(BT_EP_BENDING_Z, constraint.getLowerLimit(), constraint.getUpperLimit());
	return strengthen(joint, capacity);
}

Joint* btElasticPlasticConversion::fromPoint2Point(btPoint2PointConstraint& constraint,
												   const btElasticPlasticCapacity& capacity, const btVector3& along)
{
	// The frames coincide in the present pose.
	const btMatrix3x3 world = along.fuzzyZero() ? asItIs() : turnTowards(along);
	const btTransform a(constraint.getRigidBodyA().getCenterOfMassTransform().getBasis().transpose() * world,
						constraint.getPivotInA()),
		b(constraint.getRigidBodyB().getCenterOfMassTransform().getBasis().transpose() * world,
		  constraint.getPivotInB());
	Joint* const joint = make(constraint, a, b, asItIs());
	for (int dof = 3; dof < BT_EP_DOF_COUNT; ++dof)
		joint->setLimit(dof, 1, -1);
	return strengthen(joint, capacity);
}

Joint* btElasticPlasticConversion::fromConeTwist(btConeTwistConstraint& constraint,
												 const btElasticPlasticCapacity& capacity)
{
	Joint* const joint = make(constraint, constraint.getAFrame(), constraint.getBFrame(), asItIs());
	setSpan(*joint, BT_EP_TORSION, constraint.getTwistSpan());
	setSpan(*joint, BT_EP_BENDING_Y, constraint.getSwingSpan2());
	setSpan(*joint, BT_EP_BENDING_Z, constraint.getSwingSpan1());
	return strengthen(joint, capacity);
}

Joint* btElasticPlasticConversion::fromSlider(btSliderConstraint& constraint, const btElasticPlasticCapacity& capacity)
{
	Joint* const joint = make(constraint, constraint.getFrameOffsetA(), constraint.getFrameOffsetB(), asItIs());
	joint->setLimit(BT_EP_AXIAL, constraint.getLowerLinLimit(), constraint.getUpperLinLimit());
	// A slider counts its angle the other way round.
	joint->setLimit(BT_EP_TORSION, -constraint.getUpperAngLimit(), -constraint.getLowerAngLimit());
	return strengthen(joint, capacity);
}

Joint* btElasticPlasticConversion::from6Dof(btGeneric6DofConstraint& constraint,
											const btElasticPlasticCapacity& capacity)
{
	Joint* const joint = make(constraint, constraint.getFrameOffsetA(), constraint.getFrameOffsetB(), asItIs());
	const btTranslationalLimitMotor& linear = *constraint.getTranslationalLimitMotor();
	for (int i = 0; i < 3; ++i)
	{
		const btRotationalLimitMotor& angular = *constraint.getRotationalLimitMotor(i);
		joint->setLimit(i, linear.m_lowerLimit[i], linear.m_upperLimit[i]);
		joint->setLimit(3 + i, angular.m_loLimit, angular.m_hiLimit);
	}
	return strengthen(joint, capacity);
}

Joint* btElasticPlasticConversion::from6DofSpring2(btGeneric6DofSpring2Constraint& constraint,
												   const btElasticPlasticCapacity& capacity)
{
	Joint* const joint = make(constraint, constraint.getFrameOffsetA(), constraint.getFrameOffsetB(), asItIs());
	*joint->getTranslationalLimitMotor() = *constraint.getTranslationalLimitMotor();
	for (int i = 0; i < 3; ++i)
		*joint->getRotationalLimitMotor(i) = *constraint.getRotationalLimitMotor(i);
	joint->setRotationOrder(constraint.getRotationOrder());
	return strengthen(joint, capacity);
}

Joint* btElasticPlasticConversion::from(btTypedConstraint& constraint, const btElasticPlasticCapacity& capacity)
{
	if (btElasticPlasticJoint::from(&constraint))
		return nullptr;
	switch (constraint.getConstraintType())
	{
		case POINT2POINT_CONSTRAINT_TYPE:
			return fromPoint2Point(static_cast<btPoint2PointConstraint&>(constraint), capacity);
		case HINGE_CONSTRAINT_TYPE:
			return fromHinge(static_cast<btHingeConstraint&>(constraint), capacity);
		case CONETWIST_CONSTRAINT_TYPE:
			return fromConeTwist(static_cast<btConeTwistConstraint&>(constraint), capacity);
		case SLIDER_CONSTRAINT_TYPE:
			return fromSlider(static_cast<btSliderConstraint&>(constraint), capacity);
		case D6_CONSTRAINT_TYPE:
			return from6Dof(static_cast<btGeneric6DofConstraint&>(constraint), capacity);
		case D6_SPRING_2_CONSTRAINT_TYPE:
			return from6DofSpring2(static_cast<btGeneric6DofSpring2Constraint&>(constraint), capacity);
		default:
			return nullptr;
	}
}

Joint* btElasticPlasticConversion::replace(btDynamicsWorld& world, btElasticPlasticAction& action,
										   btTypedConstraint& constraint, const btElasticPlasticCapacity& capacity)
{
	Joint* const joint = from(constraint, capacity);
	if (!joint)
		return nullptr;
	const bool disablesCollisions = btElasticPlastic::keepsFromColliding(constraint);
	world.removeConstraint(&constraint);
	world.addConstraint(joint, disablesCollisions);
	action.addJoint(joint);
	return joint;
}
