// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_SWINGING_ARM_H
#define EP_TEST_SWINGING_ARM_H

#include <math.h>

#include "BulletDynamics/ConstraintSolver/btHingeConstraint.h"
#include "scenes/Member.h"

/// An arm of steel of parts of half a metre that swings as a pendulum from 1.3 rad: on a ball joint of ours or on Bullet's hinge, with a load in its last part.
struct SwingingArm
{
	ep::World m_world{ep::Solver::Direct, btVector3(0, -10, 0)};
	double m_fall;  ///< what its weight gives down to the lowest point [J]

	explicit SwingingArm(int parts, double load = 0, bool isOnHinge = false)
	{
		ep::Member::Settings settings;
		settings.parts = parts;
		const double angle = 1.3, length = 0.5 * parts;
		const btTransform start(btQuaternion(btVector3(0, 0, 1), btScalar(angle - SIMD_HALF_PI)), btVector3(1, 2, 3));
		ep::Member arm(m_world, settings, start, btScalar(length));
		const double partMass = 1 / double(arm.last().getInvMass());
		arm.last().setMassProps(btScalar(partMass + load), arm.last().getLocalInertia());
		btRigidBody& ground = *m_world.body(0, m_world.box(btVector3(1, 1, 1)), start, false);
		m_fall = 10 * (1 - cos(angle)) * (partMass * parts * length / 2 + load * (length - 0.25));
		if (isOnHinge)
		{
			const btTransform end = arm.first().getCenterOfMassTransform().inverse() * start;
			const btVector3 axis(0, 0, 1);
			m_world.add(new btHingeConstraint(arm.first(), ground, end.getOrigin(), btVector3(0, 0, 0), axis, axis));
			return;
		}
		btElasticPlasticCapacity ball;
		for (int dof = 0; dof < 3; ++dof)
			ball.set(dof, btScalar(4e9), btScalar(2e6), btScalar(0.01));
		m_world.joint(ground, arm.first(), start, ball);
	}
};

#endif  // EP_TEST_SWINGING_ARM_H
