// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Fibres that harden, against the textbook's return mapping with a back stress, in steps that are so short that it is exact.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/Close.h"
#include "support/Run.h"
#include "world/Place.h"

namespace testHardening
{
using namespace ep;

const double SIDE = 0.02, AREA = SIDE * SIDE, YIELD = 250e6, YOUNGS = 200e9, LENGTH = 1;

struct Point
{
	double strain, stress;
};

btElasticPlasticMaterial hardeningSteel(const std::vector<Point>& points, double kinematicShare)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(YIELD));
	steel.m_dampingRatio = 0;  // the curve is that of slow motion
	steel.m_ultimatePlasticStrain = btScalar(10);
	steel.m_kinematicShare = btScalar(kinematicShare);
	for (const Point& point : points)
		steel.m_hardening.push_back({btScalar(point.strain), btScalar(point.stress)});
	return steel;
}

/// A bar by its closed form: sigma = E (e - p), |sigma - a| <= f_y + (1 - b) h(k), da = b h'(k) dp, dk = |dp|.
class Bar
{
public:
	Bar(const std::vector<Point>& points, double kinematicShare) : m_points(points), m_share(kinematicShare) {}

	/// \return the force at an elongation, on the way there from the last one
	double stretch(double elongation)
	{
		const int parts = 200;
		const double from = m_elongation;
		for (int i = 1; i <= parts; ++i)
			follow(from + (elongation - from) * i / parts);
		return getForce();
	}
	double getForce() const { return AREA * YOUNGS * (m_elongation / LENGTH - m_plastic); }
	double getDissipated() const { return m_dissipated; }

private:
	/// Of the curve at m_path: h and its slope.
	double hardening(double& slope) const
	{
		Point before = {0, YIELD};
		for (const Point& next : m_points)
		{
			slope = (next.stress - before.stress) / (next.strain - before.strain);
			if (m_path < next.strain)
				return before.stress + slope * (m_path - before.strain) - YIELD;
			before = next;
		}
		slope = 0;
		return before.stress - YIELD;
	}

	void follow(double elongation)
	{
		m_elongation = elongation;
		double slope;
		const double radius = YIELD + (1 - m_share) * hardening(slope),
					 trial = YOUNGS * (elongation / LENGTH - m_plastic) - m_back;
		const double beyond = std::fabs(trial) - radius;
		if (beyond <= 0)
			return;
		const double flow = beyond / (YOUNGS + slope), sign = trial > 0 ? 1 : -1;
		m_plastic += sign * flow;
		m_path += flow;
		m_back += sign * m_share * slope * flow;
		m_dissipated += AREA * LENGTH * flow * radius;
	}

	std::vector<Point> m_points;
	double m_share, m_elongation = 0, m_plastic = 0, m_back = 0, m_path = 0, m_dissipated = 0;
};

/// Four fibres have the bar's area and second moments with stiffness as their area is, so that all yield at once.
btElasticPlasticSection section()
{
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
	const btScalar arm = btScalar(SIDE / std::sqrt(12.));
	for (int i = 0; i < 4; ++i)
		section.m_fibres.push_back({i % 2 ? arm : -arm, i < 2 ? arm : -arm, btScalar(AREA / 4), 0});
	return section;
}

/// The bar as a joint, by a body that is too heavy to be stopped.
struct PulledBar
{
	World m_world;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;

	explicit PulledBar(const btElasticPlasticMaterial& material) : m_world(Solver::Direct, btVector3(0, 0, 0))
	{
		btCollisionShape* const box = m_world.box(btVector3(1, 1, 1));
		btRigidBody* const ground = m_world.body(0, box, at(btScalar(-0.5)), false);
		m_body = m_world.body(btScalar(1e6), box, at(btScalar(0.5)), false);
		m_joint =
			m_world.joint(*ground, *m_body, at(0), btElasticPlasticCapacity::fromMember(material, section(), 1, 1));
	}

	/// One step of 1/480 s. \param speed  [m/s]
	void step(double speed)
	{
		m_body->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
		m_world.step(btScalar(1) / 480);
	}
	double elongation() const { return double(m_body->getCenterOfMassPosition().x()) - 0.5; }
	double force() const { return m_joint->getForce(BT_EP_AXIAL); }
};

const std::vector<Point> LINE = {{0.1, YIELD + 0.1 * YOUNGS / 50}};
const std::vector<Point> CURVE = {{0.005, 300e6}, {0.02, 360e6}, {0.06, 400e6}};

TEST(Hardening, FollowsTheClosedFormInCycles)
{
	// 20 mm to and fro, of which 1.25 are elastic: what was stretched yields the earlier in compression, the more kinematic.
	struct Case
	{
		std::vector<Point> points;
		double share;
	};
	for (const Case& c : {Case{LINE, 1}, Case{LINE, 0}, Case{LINE, 0.5}, Case{CURVE, 0}})
	{
		PulledBar bar(hardeningSteel(c.points, c.share));
		Bar exact(c.points, c.share);
		double most = 0;
		for (int i = 0; i < 5 * 96; ++i)
		{
			bar.step(i / 96 % 2 == 0 ? 0.1 : -0.1);
			const double force = exact.stretch(bar.elongation());
			most = std::max(most, std::fabs(force));
			EXPECT_NEAR(force, bar.force(), 0.01 * AREA * YIELD) << "step " << i << ", share " << c.share;
		}
		EXPECT_GT(most, 1.1 * AREA * YIELD);
		if (c.share == 0)
		{
			EXPECT_NEAR(exact.getDissipated(), bar.m_joint->getPlasticEnergy(), 0.01 * exact.getDissipated());
		}
		// All that was given is dissipated or in springs, also in those that kinematic hardening locks in.
		EXPECT_NEAR(bar.m_joint->getWork(), bar.m_joint->getPlasticEnergy() + bar.m_joint->getElasticEnergy(),
					0.02 * bar.m_joint->getWork());
	}
}

TEST(Hardening, FollowsItsCurveInOneDirection)
{
	for (const double share : {0., 0.3, 1.})
	{
		PulledBar bar(hardeningSteel(CURVE, share));
		Bar exact(CURVE, 0);
		for (int i = 0; i < 400; ++i)
		{
			bar.step(0.1);
			EXPECT_NEAR(exact.stretch(bar.elongation()), bar.force(), 0.01 * AREA * YIELD) << i << ", share " << share;
		}
	}
}

TEST(Hardening, FollowsACurveThatIsSteeperThanTheSpring)
{
	// Ramberg and Osgood's, of which the first parts rise by up to 20 times Young's modulus.
	std::vector<Point> points;
	for (int i = 1; i <= 10; ++i)
	{
		const double share = 1 + 0.1 * i;
		points.push_back({0.002 * (std::pow(share / 2, 8) - std::pow(0.5, 8)), YIELD * share});
	}
	for (const double share : {0., 0.5, 1.})
	{
		PulledBar bar(hardeningSteel(points, share));
		Bar exact(points, 0);
		for (int i = 0; i < 800; ++i)
		{
			bar.step(0.01);
			EXPECT_NEAR(exact.stretch(bar.elongation()), bar.force(), 0.005 * AREA * YIELD) << i << ", share " << share;
		}
	}
}

TEST(Hardening, UnloadsAndReloadsByTheSpring)
{
	for (const double share : {0., 1.})
	{
		PulledBar bar(hardeningSteel(LINE, share));
		for (int i = 0; i < 96; ++i)
			bar.step(0.1);
		const double force = bar.force(), at = bar.elongation(), plastic = bar.m_joint->getState().m_plasticEnergy;
		for (int i = 0; i < 8; ++i)
			bar.step(i < 4 ? -0.1 : 0.1);
		const auto sprung = [&] { return force - AREA * YOUNGS / LENGTH * (at - bar.elongation()); };
		EXPECT_NEAR(sprung(), bar.force(), 1e-4 * force) << share;
		EXPECT_EQ(plastic, bar.m_joint->getState().m_plasticEnergy) << share;
		for (int i = 0; i < 4; ++i)
			bar.step(-0.1);
		EXPECT_NEAR(sprung(), bar.force(), 1e-4 * force) << share;
	}
}

TEST(Hardening, TearsWhereItsPlasticStrainIsSpent)
{
	for (const double share : {0., 0.5, 1.})
	{
		btElasticPlasticMaterial steel = hardeningSteel(CURVE, share);
		steel.m_ultimatePlasticStrain = btScalar(0.04);
		PulledBar bar(steel);
		// At 380 MPa, half way to the last point.
		const double exact = 0.04 * LENGTH + 380e6 / YOUNGS * LENGTH;
		while (!bar.m_joint->isBroken() && bar.elongation() < 2 * exact)
			bar.step(0.1);
		EXPECT_NEAR(exact, bar.elongation(), 2.5e-4) << share;
		Bar whole(CURVE, 0);
		whole.stretch(exact);
		// What kinematic hardening has locked in is set free.
		const double area = AREA * LENGTH * (0.005 * 275e6 + 0.015 * 330e6 + 0.02 * 370e6);
		EXPECT_LT(bar.m_joint->getPlasticEnergy(), 1.01 * area) << share;
		if (share == 0)
		{
			EXPECT_NEAR(area, bar.m_joint->getPlasticEnergy(), 0.01 * area);
		}
	}
}

TEST(Hardening, LeavesYieldAndStiffnessAsTheyAre)
{
	const btElasticPlasticCapacity plain =
		btElasticPlasticCapacity::fromMember(btElasticPlasticMaterial::steel(btScalar(YIELD)), section(), 1, 1);
	for (const double share : {0., 0.3, 1.})
	{
		const btElasticPlasticCapacity hardening =
			btElasticPlasticCapacity::fromMember(hardeningSteel(CURVE, share), section(), 1, 1);
		ASSERT_FALSE(hardening.fault());
		EXPECT_EQ(share == 0 ? 4 : 16, hardening.m_fibres.size());
		double stiffness = 0;
		for (int i = 0; i < hardening.m_fibres.size(); ++i)
			stiffness += double(hardening.m_fibres[i].m_stiffness);
		expectClose(plain.m_stiffness[BT_EP_AXIAL], stiffness, byPrecision(1e-9, 1e-5));
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			EXPECT_EQ(plain.m_yield[dof], hardening.m_yield[dof]);
			EXPECT_EQ(plain.m_stiffness[dof], hardening.m_stiffness[dof]);
		}
	}
}

TEST(Hardening, TellsWhatIsWrong)
{
	const auto quantity = [](const std::vector<Point>& points, double share)
	{ return hardeningSteel(points, share).fault().m_quantity; };
	EXPECT_FALSE(hardeningSteel(CURVE, 1).fault());
	EXPECT_STREQ("kinematic share of hardening", quantity({}, 1.1));
	EXPECT_STREQ("kinematic share of hardening", quantity({}, NAN));
	EXPECT_STREQ("stress of hardening [Pa]", quantity({{0.1, 0}}, 0));
	EXPECT_STREQ("plastic strain of hardening", quantity({{0, 300e6}}, 0));
	EXPECT_STREQ("plastic strain of hardening", quantity({{0.1, 300e6}, {0.1, 400e6}}, 0));
	// A plateau, as of structural steel, and a fall: isotropic only.
	EXPECT_STREQ("slope of kinematic hardening [Pa]", quantity({{0.02, YIELD}, {0.1, 400e6}}, 1));
	EXPECT_STREQ("slope of kinematic hardening [Pa]", quantity({{0.02, YIELD / 2}}, 1));
	EXPECT_FALSE(hardeningSteel({{0.02, YIELD}, {0.1, 400e6}, {0.2, 300e6}}, 0).fault());

	const btElasticPlasticCapacity good =
		btElasticPlasticCapacity::fromMember(hardeningSteel(CURVE, 0), section(), 1, 1);
	btElasticPlasticCapacity bad = good;
	bad.m_curvePoints.pop_back();
	EXPECT_STREQ("point of a fibre's curve", bad.fault().m_quantity);
	bad = good;
	bad.m_curvePoints[1].m_path = 0;
	EXPECT_STREQ("plastic path on a fibre's curve [m]", bad.fault().m_quantity);
	bad = good;
	bad.m_curvePoints[1].m_factor = btScalar(NAN);
	EXPECT_STREQ("factor of a fibre's strength", bad.fault().m_quantity);
	bad = good;
	EXPECT_TRUE(good.isSameAs(bad));
	bad.m_curvePoints[1].m_factor *= 2;
	EXPECT_FALSE(good.isSameAs(bad));
}
}  // namespace testHardening
