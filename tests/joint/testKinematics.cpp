// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The measure of deformation: invariance, plastic rotations, and its rate.

#include <cmath>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/Kinematics.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticFault.h"
#include "support/Precision.h"

namespace testKinematics
{
btQuaternion rotation(double x, double y, double z, double angle)
{
	return btQuaternion(btVector3(btScalar(x), btScalar(y), btScalar(z)).normalized(), btScalar(angle));
}

const btQuaternion NONE(0, 0, 0, 1);

TEST(Kinematics, LogAndExpAreInverse)
{
	for (double angle : {0., 1e-9, 1e-5, 0.03, 0.0632, 0.0633, 0.5, 1.57, 3.1, 3.2, 6.0})
	{
		const btVector3 v = btVector3(1, -2, 2).normalized() * btScalar(angle);
		const btVector3 back = btElasticPlastic::logarithm(btElasticPlastic::exponential(v));
		EXPECT_NEAR(0, (back - v).length(), byPrecision(1e-14, 1e-6) * (1 + angle)) << angle;
	}
}

TEST(Kinematics, StrainIsFrameIndifferent)
{
	const btTransform frameA(rotation(1, 2, 0, 0.4), btVector3(1, btScalar(0.2), 0)),
		frameB(rotation(0, 1, 1, 1.2), btVector3(-1, 0, btScalar(0.1)));
	const btTransform bodyA(rotation(0, 0, 1, 0.3), btVector3(1, 2, 3));
	// B stands so that the joint is stretched by (1, 2, 3) mm and turned by a small and a large rotation.
	for (double angle : {0.001, 2.5})
	{
		const btTransform relative(rotation(3, 1, 2, angle),
								   btVector3(btScalar(0.001), btScalar(0.002), btScalar(0.003)));
		const btTransform bodyB = bodyA * frameA * relative * frameB.inverse();
		btElasticPlastic::Kinematics first;
		first.evaluate(bodyA, bodyB, frameA, frameB, btVector3(0, 0, 0), NONE, NONE);
		const btVector3 turned(first.m_strain[3], first.m_strain[4], first.m_strain[5]);
		EXPECT_NEAR(angle, turned.length(), byPrecision(1e-13, 1e-6));
		const btTransform move(rotation(1, -1, 3, 2), btVector3(-5, 4, 2));
		btElasticPlastic::Kinematics moved;
		moved.evaluate(move * bodyA, move * bodyB, frameA, frameB, btVector3(0, 0, 0), NONE, NONE);
		for (int i = 0; i < 6; ++i)
			EXPECT_NEAR(first.m_strain[i], moved.m_strain[i], byPrecision(1e-13, 3e-6));
		// Seen from the other body: the same deformation the other way round, because the axes are those in the middle.
		btElasticPlastic::Kinematics swapped;
		swapped.evaluate(bodyB, bodyA, frameB, frameA, btVector3(0, 0, 0), NONE, NONE);
		for (int i = 0; i < 6; ++i)
			EXPECT_NEAR(first.m_strain[i], -swapped.m_strain[i], byPrecision(1e-13, 3e-6));
	}
}

TEST(Kinematics, SmallPlasticRotationsCount)
{
	// In float a rotation of 0.1 mrad has a scalar part of exactly 1.
	const btTransform still = btTransform::getIdentity();
	for (double angle : {1e-5, 1e-4, 3e-4, 1e-3})
	{
		const btTransform turned(rotation(0, 1, 0, angle));
		btElasticPlastic::Kinematics k;
		k.evaluate(still, turned, still, still, btVector3(0, 0, 0), rotation(0, 1, 0, angle),
				   rotation(0, 1, 0, angle / 2));
		EXPECT_NEAR(0, k.m_strain[BT_EP_BENDING_Y], byPrecision(1e-15, 1e-7));
		k.evaluate(still, turned, still, still, btVector3(0, 0, 0), NONE, NONE);
		EXPECT_NEAR(angle, k.m_strain[BT_EP_BENDING_Y], byPrecision(1e-15, 1e-7));
	}
}

TEST(Kinematics, JacobianIsTheRateOfStrain)
{
	// -de/dt = J v by differences, for a small elastic deformation on top of a large plastic one.
	const btTransform frameA(rotation(1, 2, 0, 0.4), btVector3(1, btScalar(0.2), 0)),
		frameB(rotation(0, 1, 1, 1.2), btVector3(-1, 0, btScalar(0.1)));
	const btTransform bodyA(rotation(0, 0, 1, 0.3), btVector3(1, 2, 3));
	const double elastic = 1e-5;
	const btQuaternion plastic = rotation(1, 0.5, -1, 1.9), middle = rotation(1, 0.5, -1, 0.95);
	// And a linear offset: the axes must turn with the mean of the bodies' spins.
	const btVector3 offset(btScalar(0.2), btScalar(-0.1), btScalar(0.3));
	const btTransform bodyB = bodyA * frameA *
							  btTransform(rotation(1, 1, 0, elastic) * plastic, quatRotate(middle, offset)) *
							  frameB.inverse();
	const btVector3 vA(1, btScalar(-0.5), 2), wA(btScalar(0.3), 1, -1), vB(btScalar(0.2), 1, 1),
		wB(-1, btScalar(0.4), btScalar(0.6));
	const btScalar h = btScalar(inPrecision(1e-6, 1e-3));
	// Without a bow, and with one that is so long that it counts beside an elastic turn of 1e-5, either way round.
	for (const btScalar length : {btScalar(0), btScalar(1000), btScalar(-1000)})
	{
		const auto moved = [&](const btTransform& body, const btVector3& v, const btVector3& w, btScalar t)
		{ return btTransform(btElasticPlastic::exponential(w * t) * body.getRotation(), body.getOrigin() + v * t); };
		btElasticPlastic::Kinematics now, before, after;
		const auto bow = [length](btElasticPlastic::Kinematics& k) { k.bow(length, length / 2); };
		now.evaluate(bodyA, bodyB, frameA, frameB, offset, plastic, middle);
		before.evaluate(moved(bodyA, vA, wA, -h), moved(bodyB, vB, wB, -h), frameA, frameB, offset, plastic, middle);
		after.evaluate(moved(bodyA, vA, wA, h), moved(bodyB, vB, wB, h), frameA, frameB, offset, plastic, middle);
		for (btElasticPlastic::Kinematics* k : {&now, &before, &after})
			bow(*k);
		const btVector3 linear = vA + wA.cross(now.m_rA) - vB - wB.cross(now.m_rB), angular = wA - wB;
		btScalar along[6];
		now.projectMotion(linear, angular, along);
		for (int i = 0; i < 6; ++i)
		{
			const double rate = (double(after.m_strain[i]) - before.m_strain[i]) / (2 * double(h));
			// Angular: the elastic rotation of 1e-5 times the spin is what the small-rotation Jacobian leaves out.
			EXPECT_NEAR(-rate, along[i], byPrecision(1e-4, 2e-3)) << i;
		}
	}
}
TEST(Kinematics, AMemberBentIntoAnArcIsNotStretched)
{
	// Its bodies are the ends of an arc of length l and turn t. The chord is 2 l sin(t / 2) / t, that of two straight halves l cos(t / 2):
	// what the bow leaves of the difference, l t^2 / 12, is -l t^4 / 480 and terms of t^6.
	const double length = 2;
	for (const double turn : {0.02, 0.1, -0.3})
		for (const int axis : {1, 2})
		{
			btVector3 about(0, 0, 0);
			about[axis] = 1;
			const double half = turn / 2, chord = 2 * length * std::sin(half) / turn;
			// Seen from the chord, which is along x.
			const btTransform bodyA(btQuaternion(about, btScalar(-half)), btVector3(0, 0, 0)),
				bodyB(btQuaternion(about, btScalar(half)), btVector3(btScalar(chord), 0, 0));
			const btTransform frameA(NONE, btVector3(btScalar(length / 2), 0, 0)),
				frameB(NONE, btVector3(btScalar(-length / 2), 0, 0));
			btElasticPlastic::Kinematics k;
			k.evaluate(bodyA, bodyB, frameA, frameB, btVector3(0, 0, 0), NONE, NONE);
			EXPECT_NEAR(k.m_strain[3 + axis], turn, byPrecision(1e-14, 1e-6));
			k.bow(btScalar(axis == 1 ? length : 0), btScalar(axis == 2 ? length : 0));
			EXPECT_NEAR(k.m_strain[0], -length * std::pow(turn, 4) / 480,
						1e-4 * length * std::pow(turn, 4) + byPrecision(1e-14, 1e-6))
				<< turn << " about " << axis;
		}
}
}  // namespace testKinematics
