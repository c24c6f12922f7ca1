// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Fibres that are the stronger the faster they flow, against integrals of the law of Cowper and Symonds.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/Close.h"
#include "support/Run.h"
#include "world/Place.h"

namespace testRate
{
using namespace ep;

const double SIDE = 0.02, YIELD = 250e6, NP = SIDE * SIDE * YIELD, LENGTH = 1;

btElasticPlasticMaterial mildSteel(double stiffness = 1)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(YIELD));
	steel.m_youngsModulus *= btScalar(stiffness);
	steel.m_ultimatePlasticStrain = btScalar(1e6);
	steel.m_rate = btElasticPlasticRate::mildSteel();
	return steel;
}

/// A body on a rod of 1 m.
struct BodyOnRod
{
	World m_world;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;

	BodyOnRod(const btElasticPlasticMaterial& material, double mass) : m_world(Solver::Direct, btVector3(0, 0, 0))
	{
		btCollisionShape* const box = m_world.box(btVector3(1, 1, 1));
		btRigidBody* const ground = m_world.body(0, box, at(btScalar(-0.5)), false);
		m_body = m_world.body(btScalar(mass), box, at(btScalar(0.5)), false);
		const btElasticPlasticSection section =
			btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE)).withFibres(12);
		m_joint = m_world.joint(*ground, *m_body, at(0), btElasticPlasticCapacity::fromMember(material, section, 1, 1));
	}
	double speed() const { return m_body->getLinearVelocity().x(); }
};

/// (v / D l)^(1/5)
double share(double speed) { return std::pow(speed / (40.4 * LENGTH), 0.2); }

TEST(Rate, StopsABodyAsTheLawDoes)
{
	// m v dv = -N_p (1 + (v / D l)^(1/5)) dx
	const double mass = 1000;
	for (const double speed : {2., 10.})
	{
		double exact = 0;
		const int parts = 100000;
		for (int i = 0; i < parts; ++i)
		{
			const double v = (i + 0.5) * speed / parts;
			exact += mass * v / (NP * (1 + share(v))) * speed / parts;
		}
		for (const int rate : {1920, 15360})
		{
			BodyOnRod rod(mildSteel(100), mass);
			rod.m_body->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
			for (int i = 0; i < rate && rod.speed() > 0; ++i)
				rod.m_world.step(btScalar(1) / rate);
			EXPECT_NEAR(exact, rod.m_joint->getPlasticDeformation(BT_EP_AXIAL), (rate == 1920 ? 0.03 : 0.01) * exact)
				<< speed << " m/s, 1/" << rate << " s";
			// Without a rate: m v^2 / 2 N_p.
			EXPECT_LT(exact, 0.7 * mass * speed * speed / 2 / NP);
			EXPECT_LT(rod.m_joint->getPlasticEnergy(), 1.02 * mass * speed * speed / 2);
		}
	}
}

TEST(Rate, LetsALoadCreepWithoutOscillation)
{
	// A load above the yield force moves at the speed at which the rod bears it, whatever the step; a strength by the speed before the step would
	// stop the body and let it go by turns.
	for (const double load : {1.1, 1.3, 1.6})
		for (const int rate : {30, 60, 480, 3840})
		{
			BodyOnRod rod(mildSteel(), 1000);
			const double exact = 40.4 * LENGTH * std::pow(load - 1, 5);
			const auto place = [&] { return double(rod.m_body->getCenterOfMassPosition().x()); };
			double from = 0;
			for (int i = 0; i < 6 * rate; ++i)
			{
				rod.m_body->applyCentralForce(btVector3(btScalar(load * NP), 0, 0));
				rod.m_world.step(btScalar(1) / rate);
				if (i == 5 * rate - 1)
					from = place();
			}
			// Where the law is steepest an elastic sway is left over: then by strength, of which it is a small part.
			const double speed = place() - from;
			EXPECT_NEAR(load, 1 + share(std::fabs(speed)), 0.05) << load << ", 1/" << rate << " s";
			if (load > 1.2)
			{
				EXPECT_NEAR(exact, speed, 0.02 * exact) << load << ", 1/" << rate << " s";
			}
		}
}

TEST(Rate, MakesNoDifferenceToWhatRestsBelowYield)
{
	BodyOnRod rod(mildSteel(), 1000);
	for (int i = 0; i < 480; ++i)
	{
		rod.m_body->applyCentralForce(btVector3(btScalar(0.45 * NP), 0, 0));
		rod.m_world.step(btScalar(1) / 480);
	}
	EXPECT_FALSE(rod.m_joint->hasYielded());
}

TEST(Rate, TellsWhatIsWrong)
{
	btElasticPlasticMaterial steel = mildSteel();
	EXPECT_FALSE(steel.fault());
	steel.m_rate.m_reference = -1;
	EXPECT_STREQ("rate at which strength doubles [1/s]", steel.fault().m_quantity);
	steel.m_rate = btElasticPlasticRate::of(40, btScalar(0.5));
	EXPECT_STREQ("exponent of the rate of strain", steel.fault().m_quantity);
	BodyOnRod rod(mildSteel(), 1000);
	btElasticPlasticCapacity capacity = rod.m_joint->getCapacity();
	expectClose(40.4 * LENGTH, capacity.m_fibres[3].m_rateReference);
	capacity.m_fibres[3].m_rateReference = btScalar(NAN);
	EXPECT_STREQ("rate at which a fibre's strength doubles [m/s]", capacity.fault().m_quantity);
	capacity = rod.m_joint->getCapacity();
	capacity.m_fibres[3].m_rateExponent = 0;
	EXPECT_STREQ("exponent of a fibre's rate", capacity.fault().m_quantity);
}
}  // namespace testRate
