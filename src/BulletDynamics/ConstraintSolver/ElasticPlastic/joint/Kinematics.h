// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_KINEMATICS_H
#define BT_ELASTIC_PLASTIC_KINEMATICS_H

#include "LinearMath/btTransform.h"

namespace btElasticPlastic
{
/// The rotations of a joint's frame B and mid frame relative to frame A.
struct RelativeRotation
{
	btQuaternion m_relative;  ///< R, of frame B; of its two quaternions the one nearer to the plastic rotation
	btQuaternion m_middle;    ///< of the mid frame

	/// \param basisA, basisB  of the joint's frames, world coordinates; the others as for evaluate() below
	RelativeRotation(const btMatrix3x3& basisA, const btMatrix3x3& basisB, const btQuaternion& plasticRotation,
					 const btQuaternion& plasticMiddle);
};

/// The axes, arms and elastic deformation of a joint at a pose of its bodies.
///
/// Frames A and B are the joint's frames on its two bodies, R = R_A^T R_B their relative rotation. The axes are the columns of
/// the mid frame R_A P exp(e / 2): P, the plastic middle, is half of the plastic rotation, summed increment by increment.
/// Both bodies are treated alike, a turned scene gives the same answer, and the frame turns with the mean of the bodies'
/// angular velocities at any bend (half of log(R) would not: it is singular at a full turn). The common point p is half way
/// between the frames' origins.
///  - Linear: e_i = (p_B - p_A) . a_i - plastic offset_i.
///  - Angular: e = log(R R_p^T) in mid-frame components. The plastic rotation R_p turns the reference, so that the elastic
///    rotation stays small however far the joint has bent; Euler angles would jump at 90 degrees.
/// Jacobians, for J v = -de/dt: [a, r_A x a, -a, -r_B x a] and [0, a, 0, -a], and of the axial strain that of the point in the bow, J_0 + b_z J_4 - b_y J_5.
struct Kinematics
{
	btVector3 m_axis[3];   ///< mid frame, world coordinates
	btVector3 m_rA, m_rB;  ///< from the centres of mass to the common point, world coordinates [m]
	btScalar m_bow[2];     ///< from there to where an axial force acts, along the second and third axis [m]
	btScalar m_strain[6];  ///< elastic deformation e [m], [rad], mid-frame components

	/// \param bodyA, bodyB    centre-of-mass transforms
	/// \param frameA, frameB  joint frames in the bodies' coordinates
	/// \param plasticOffset   mid-frame components [m]
	/// \param plasticRotation R_p in frame A, unit quaternion; its sign counts: it carries the turns beyond 180 degrees
	/// \param plasticMiddle   P, unit quaternion
	void evaluate(const btTransform& bodyA, const btTransform& bodyB, const btTransform& frameA,
				  const btTransform& frameB, const btVector3& plasticOffset, const btQuaternion& plasticRotation,
				  const btQuaternion& plasticMiddle);

	/// Lets the member bow between the bodies' centres. Of two straight parts that are turned by t against each other, the ends are
	/// closer together by a bow's l t^2 / 12: an axial force bends what is crooked by that much less. The axial strain loses it,
	/// and its point moves by l t / 6 towards the bow, so that J v = -de/dt holds. Shears act at the common point: at that of the bow they would twist the member, and the
	/// twist, as it bends on, would have to bend it.
	/// \param lengthY, lengthZ  l of the member where it bends about y and about z; 0: a hinge, which does not bow; negative where
	///                          the x axis points from body B to body A [m]
	void bow(btScalar lengthY, btScalar lengthZ);

	/// What that adds to the axial strain, in proportion to the lengths. \param strain  of which the turns count
	static btScalar strainOfBow(const btScalar strain[6], btScalar lengthY, btScalar lengthZ)
	{
		const btScalar y = strain[4], z = strain[5];
		return -(lengthY * y * y + lengthZ * z * z) / 12;
	}

	/// From the common point to the one in the bow, world coordinates [m].
	btVector3 armOfBow() const { return m_axis[1] * m_bow[0] + m_axis[2] * m_bow[1]; }

	/// From the centres of mass to where the force along one of the axes acts.
	btVector3 armA(int axis) const { return axis == 0 ? m_rA + armOfBow() : m_rA; }
	btVector3 armB(int axis) const { return axis == 0 ? m_rB + armOfBow() : m_rB; }

	/// J v of all six degrees of freedom. \param linear, angular  velocity of A to B at the common point, and relative angular velocity
	void projectMotion(const btVector3& linear, const btVector3& angular, btScalar onAxes[6]) const;

	/// Components of a force and of a torque about the common point, as impulses of the rows.
	void projectLoad(const btVector3& force, const btVector3& torque, btScalar onAxes[6]) const;

	/// Whether all of the strain is deformation, which it is not where a body's place is not finite.
	bool isUsable() const;
};

/// Whether a number may be a deformation [m], [rad]: it is finite, and sums of many such ones are finite, too.
bool isDeformation(btScalar strain);

/// Rotation vector of a unit quaternion, |result| <= 2 pi, the sign of the quaternion is kept.
btVector3 logarithm(const btQuaternion& q);

/// Unit quaternion of a rotation vector.
btQuaternion exponential(const btVector3& rotation);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_KINEMATICS_H
