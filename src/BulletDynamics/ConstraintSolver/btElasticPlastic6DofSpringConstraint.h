// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_6DOF_SPRING_CONSTRAINT_H
#define BT_ELASTIC_PLASTIC_6DOF_SPRING_CONSTRAINT_H

#include "BulletDynamics/ConstraintSolver/btGeneric6DofSpringConstraint.h"
#include "btElasticPlasticConstraint.h"

/// btGeneric6DofSpringConstraint whose degrees of freedom can yield, flow and tear.
/// Those that setCapacity() gives a yield value are elastic-plastic; the others stay Bullet's (limits, motors, springs).
/// Existing code changes the class name, calls setCapacity(), and registers the joint with a btElasticPlasticAction.
class alignas(16) btElasticPlastic6DofSpringConstraint
	: public btElasticPlasticConstraint<btGeneric6DofSpringConstraint>
{
public:
	/// Joins two bodies, of which one may be static or kinematic.
	/// \param frameInA, frameInB  the joint's frame in the bodies' coordinates, x along the member
	btElasticPlastic6DofSpringConstraint(btRigidBody& rbA, btRigidBody& rbB, const btTransform& frameInA,
										 const btTransform& frameInB, bool useLinearReferenceFrameA = true);

	/// Joins a body to the world where it stands.
	btElasticPlastic6DofSpringConstraint(btRigidBody& rbB, const btTransform& frameInB,
										 bool useLinearReferenceFrameB = true);

protected:
	void releaseBase(int dof) override;
	bool isBaseActive() override;
	void lock(void* data) const override;
};

#endif  // BT_ELASTIC_PLASTIC_6DOF_SPRING_CONSTRAINT_H
