// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Limits of Bullet's class on what a joint leaves free.

#include <gtest/gtest.h>

#include "support/Close.h"
#include "world/Place.h"
#include "world/World.h"

namespace testLimits
{
using namespace ep;

TEST(Limits, ThatAreFarGiveNothing)
{
	// Three boxes glide, two of them on an axis with limits that they never reach, two joined by rigid rows. A limit asks for the speed that would reach it in a
	// step, 240 m/s here; the search began with that, and each step left what is rigid with a part of a millionth: after 10 s there was a fifth more momentum
	// and 1.4 times the energy.
	for (const btScalar limit : {btScalar(1), btScalar(100)})
		for (const bool isRigid : {true, false})
		{
			World world(Solver::Direct, btVector3(0, 0, 0));
			btCollisionShape* const box = world.box(btVector3(btScalar(0.4), btScalar(0.4), btScalar(0.4)));
			btRigidBody* bodies[3];
			for (int i = 0; i < 3; ++i)
				bodies[i] = world.body(20, box, at(btScalar(i)), false);
			btElasticPlasticCapacity slides, holds;
			for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			{
				if (dof != BT_EP_AXIAL)
					slides.set(dof, btScalar(1e5), btScalar(1e6));
				if (isRigid)
					holds.setRigidPlastic(dof, btScalar(1e6));
				else
					holds.set(dof, btScalar(1e12), btScalar(1e6));
			}
			btElasticPlasticJoint* const slider = world.joint(*bodies[0], *bodies[1], at(btScalar(0.5)), slides);
			static_cast<btElasticPlastic6DofSpring2Constraint*>(slider)->setLimit(0, -limit, limit);
			world.joint(*bodies[1], *bodies[2], at(btScalar(1.5)), holds);
			bodies[0]->setLinearVelocity(btVector3(btScalar(0.91), 0, 0));
			bodies[1]->setLinearVelocity(btVector3(1, 0, 0));
			bodies[2]->setLinearVelocity(btVector3(1, 0, 0));
			for (int i = 0; i < 2400; ++i)
				world.step(btScalar(1) / 240);
			double momentum = 0;
			for (const btRigidBody* body : bodies)
				momentum += 20 * double(body->getLinearVelocity().x());
			EXPECT_NEAR(20 * 2.91, momentum, inPrecision(1e-6, 1e-3)) << limit << ", " << isRigid;
		}
}
}  // namespace testLimits
