// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONVERSION_H
#define BT_ELASTIC_PLASTIC_CONVERSION_H

#include "btElasticPlastic6DofSpring2Constraint.h"

class btConeTwistConstraint;
class btDynamicsWorld;
class btElasticPlasticAction;
class btFixedConstraint;
class btGeneric6DofConstraint;
class btHingeConstraint;
class btPoint2PointConstraint;
class btSliderConstraint;

/// Makes an elastic-plastic joint in place of one of Bullet's constraints: between the same bodies, at the same place, with the same
/// free degrees of freedom and their limits. What the constraint locks gets the capacity's stiffness, yield value and ductility; of
/// what it leaves free or limits the capacity is not used. docs/games.md has a table.
///
/// Each function returns a joint made by new, which the caller owns; it is neither in the world nor in an action yet, and the
/// constraint stays as it is: see replace(). The joint has the constraint's user id, type and pointer. Motors, softness and the
/// breaking impulse are left behind, but those of btGeneric6DofSpring2Constraint are kept. If the capacity has a fault the joint
/// tells it (btElasticPlasticJoint::fault()).
///
/// \param along  direction of the member in the world's axes, in the bodies' present pose, for the joint's x axis, as capacities by
///               fromMember() want it; of any length. Zero: the constraint's own frames. Where the constraint determines the x axis
///               (cone-twist, slider, 6-dof) it is not asked for; of a hinge, whose axis is z, the part across the axis counts.
struct btElasticPlasticConversion
{
	typedef btElasticPlastic6DofSpring2Constraint Joint;

	/// All six degrees of freedom are locked.
	static Joint* fromFixed(btFixedConstraint& constraint, const btElasticPlasticCapacity& capacity,
							const btVector3& along = btVector3(0, 0, 0));

	/// Free about z, within the hinge's limits: BT_EP_BENDING_Z has no capacity, unless both limits are 0.
	static Joint* fromHinge(btHingeConstraint& constraint, const btElasticPlasticCapacity& capacity,
							const btVector3& along = btVector3(0, 0, 0));

	/// Free to turn: axial force and shear have capacity.
	static Joint* fromPoint2Point(btPoint2PointConstraint& constraint, const btElasticPlasticCapacity& capacity,
								  const btVector3& along = btVector3(0, 0, 0));

	/// x is the twist axis. Turns are free within the spans, about y and z each by itself: the cone becomes a pyramid.
	static Joint* fromConeTwist(btConeTwistConstraint& constraint, const btElasticPlasticCapacity& capacity);

	/// x is the sliding axis: free along and about it within the limits.
	static Joint* fromSlider(btSliderConstraint& constraint, const btElasticPlasticCapacity& capacity);

	/// Also of btUniversalConstraint. Limits of translations are measured along A's frame.
	static Joint* from6Dof(btGeneric6DofConstraint& constraint, const btElasticPlasticCapacity& capacity);

	/// Also of btFixedConstraint and btHinge2Constraint. With all limits, motors, servos, springs and the rotation order.
	static Joint* from6DofSpring2(btGeneric6DofSpring2Constraint& constraint, const btElasticPlasticCapacity& capacity);

	/// Any of those above. \return null for other types (gears, contact constraints, multibody joints, springs of
	/// btGeneric6DofSpringConstraint), and for what is an elastic-plastic joint already
	static Joint* from(btTypedConstraint& constraint, const btElasticPlasticCapacity& capacity);

	/// Takes a constraint out of the world, puts the joint that from() makes of it there, with collisions between its bodies as they
	/// were, and gives it to the action, which tells faults. The constraint is the caller's to delete.
	/// \return null, and nothing changes, if from() does
	static Joint* replace(btDynamicsWorld& world, btElasticPlasticAction& action, btTypedConstraint& constraint,
						  const btElasticPlasticCapacity& capacity);
};

#endif  // BT_ELASTIC_PLASTIC_CONVERSION_H
