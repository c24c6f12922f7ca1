// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The estimate of what a step leaves open, beside its formula.

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/OpenShare.h"
#include "support/Close.h"
#include "support/Pair.h"

namespace testOpenShare
{
using btElasticPlastic::OpenShare;

/// T of a row that has flowed by 10 mm and changed its rate by 0.5 m/s in a step of 10 ms, between two bodies.
double shareOf(const Pair& pair, bool isHeld)
{
	btElasticPlasticCapacity capacity;
	capacity.set(BT_EP_AXIAL, btScalar(1e5), 400, 1);
	OpenShare open;
	for (const btRigidBody* body : {pair.m_a, pair.m_b})
		if (body->getInvMass() > 0)
			open.addBody(*body);
	if (isHeld)
		open.addSupport(*pair.m_a, pair.m_a->getCenterOfMassPosition());
	open.addRow(capacity, {BT_EP_AXIAL, 1, btScalar(0.5), 400, btScalar(0.01), btScalar(0.01)}, 0.01, 0.01, 1);
	return open.getShare();
}

const double OPEN_WORK = 400 * 0.01 * 0.5, JOINT = 0.5 * 400 * 400 / 1e5 + 400 * 0.01;

TEST(OpenShare, MotionAsAWholeDoesNotCount)
{
	// 3 and 12 kg that part at 2 m/s, whatever their common motion.
	for (const double common : {0., 5., 40.})
	{
		Pair pair(ep::Solver::Direct, 3, 12);
		pair.m_a->setLinearVelocity(btVector3(btScalar(common), btScalar(-common), 0));
		pair.m_b->setLinearVelocity(btVector3(btScalar(common + 2), btScalar(-common), 0));
		const double kinetic = 0.5 * (3. * 12 / 15) * 4;
		expectClose(OPEN_WORK / (kinetic + JOINT), shareOf(pair, false), byPrecision(1e-12, 1e-5));
	}
}

TEST(OpenShare, NorDoesThatOfASupport)
{
	// 12 kg that move by 2 m/s against a support; joints can dissipate all of that.
	for (const double common : {0., 5.})
	{
		Pair pair(ep::Solver::Direct, 0, 12);
		makeKinematic(*pair.m_a);
		pair.m_a->setLinearVelocity(btVector3(btScalar(common), 0, 0));
		pair.m_b->setLinearVelocity(btVector3(btScalar(common + 2), 0, 0));
		expectClose(OPEN_WORK / (0.5 * 12 * 4 + JOINT), shareOf(pair, true), byPrecision(1e-12, 1e-5));
	}
}
}  // namespace testOpenShare
