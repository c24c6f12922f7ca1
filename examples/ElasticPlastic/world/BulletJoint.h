// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BULLET_JOINT_H
#define EP_BULLET_JOINT_H

#include <memory>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"
#include "world/Method.h"
#include "btBulletDynamicsCommon.h"

namespace ep
{
/// One of Bullet's own constraints in place of an elastic-plastic joint, at a frame given in world coordinates. A rigid-plastic
/// degree of freedom is locked, one without yield value is free. \return null if the kind is elastic-plastic or none
btTypedConstraint* makeBulletsOwn(const JointKind& kind, btRigidBody& a, btRigidBody& b, const btTransform& frame,
								  const btElasticPlasticCapacity& capacity);

/// A constraint of Bullet's own that takes the place of an elastic-plastic joint: what it does step by step, and what it bears.
class BulletJoint
{
public:
	/// As makeBulletsOwn().
	static std::unique_ptr<BulletJoint> make(const JointKind& kind, btRigidBody& a, btRigidBody& b,
											 const btTransform& frame, const btElasticPlasticCapacity& capacity);

	/// Takes the constraint; for make().
	BulletJoint(btTypedConstraint* constraint, const btTransform& frame, const btElasticPlasticCapacity& capacity);
	virtual ~BulletJoint() = default;
	BulletJoint(const BulletJoint&) = delete;
	BulletJoint& operator=(const BulletJoint&) = delete;

	btTypedConstraint& constraint() const { return *m_constraint; }

	/// Around each step of dt [s].
	virtual void beforeStep(btScalar) {}
	virtual void afterStep(btScalar) {}

	/// Lets a degree of freedom go.
	virtual void release(int dof) = 0;

	/// That it can be computed with [s]: springs of Bullet's are explicit, with longer steps they explode or are weakened
	/// (the paper's equation 16).
	virtual double longestStep() const;
	bool isBroken() const { return !m_constraint->isEnabled(); }

	/// In its springs, by the bodies' present pose [J].
	virtual double elasticEnergy() const { return 0; }

	/// Are its rows those of a brake, whose work is plastic?
	virtual bool isBrake() const { return false; }

	/// What a brake has taken up, force times path [J].
	virtual double plasticWork() const { return 0; }

	/// Force or moment in the last substep, along the joint's axis [N], [N m], from Bullet's feedback.
	btScalar load(int dof) const;

	/// World coordinates; the frame is A's.
	btVector3 axis(int dof) const;

	/// How far the frames are apart, by the axes of A's [m], [rad].
	btScalar deformation(int dof) const;

protected:
	const btElasticPlasticCapacity& capacity() const { return m_capacity; }

private:
	std::unique_ptr<btTypedConstraint> m_constraint;
	btTransform m_inA, m_inB;
	btElasticPlasticCapacity m_capacity;
	btJointFeedback m_feedback;
};
}  // namespace ep

#endif  // EP_BULLET_JOINT_H
