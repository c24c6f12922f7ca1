// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The law of one degree of freedom: coefficients, stability, return mapping.

#include <math.h>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/Law.h"
#include "support/Precision.h"

namespace
{
/// One mass on one row: what the solver would find.
double solve(const btElasticPlastic::SoftRow& row, double freeVelocity, double inverseMass)
{
	const double impulse = (double(row.m_velocity) - freeVelocity) / (inverseMass + double(row.m_compliance));
	return std::max(double(row.m_lower), std::min(double(row.m_upper), impulse));
}

/// Energy of a free oscillation after many steps over that at its start, largest over the run.
double growth(double squaredStep, bool stock)
{
	const double m = 2, dt = 0.01, k = squaredStep * m / dt / dt;
	double e = 1, v = 0, force = k, rate = 0, largest = 0;
	for (int i = 0; i < 2000; ++i)
	{
		const btElasticPlastic::DofState s = {btScalar(k), btScalar(1e30), btScalar(e), btScalar(force),
											  btScalar(rate)};
		const btElasticPlastic::SoftRow row = stock ? btElasticPlastic::stockRow(s, btScalar(1 / m), btScalar(dt))
													: btElasticPlastic::implicitRow(s, btScalar(1 / m), btScalar(dt));
		v += solve(row, v, 1 / m) / m;
		e -= dt * v;
		rate = (k * e - force) / dt;
		force = k * e;
		largest = std::max(largest, (k * e * e + m * v * v) / k);
	}
	return largest;
}

TEST(Law, IsStableAtAnyStep)
{
	for (double a = 1e-6; a < 1e12; a *= 3)
	{
		// Newmark's energy wanders within the step's own size, it never grows from swing to swing.
		EXPECT_LT(growth(a, false), 1.5) << "a = " << a;
		// Explicit below a = 1: symplectic Euler's invariant bounds the energy by 1 / (1 - sqrt(a)/2) = 2.
		EXPECT_LT(growth(a, true), 2.1) << "a = " << a;
	}
}

TEST(Law, ResolvesASlowSpringWithoutDissipation)
{
	// a = 1e-4: 628 steps a swing. After a hundred swings the amplitude is what it was, to 1 %.
	const double m = 1, dt = 0.01, k = 1;
	double e = 1, v = 0, force = k, rate = 0;
	const int steps = 62832;
	double largest = 0;
	for (int i = 0; i < steps; ++i)
	{
		const btElasticPlastic::DofState s = {btScalar(k), btScalar(1e6), btScalar(e), btScalar(force), btScalar(rate)};
		v += solve(btElasticPlastic::implicitRow(s, 1, btScalar(dt)), v, 1) / m;
		e -= dt * v;
		rate = (k * e - force) / dt;
		force = k * e;
		if (i > steps - 700)
			largest = std::max(largest, e);
	}
	EXPECT_NEAR(1, largest, 0.01);
}

TEST(Law, BecomesBackwardEulerForAStiffSpring)
{
	const btElasticPlastic::DofState s = {btScalar(1e12), btScalar(1e5), btScalar(1e-8), btScalar(3e3), btScalar(7e4)};
	const btElasticPlastic::SoftRow row = btElasticPlastic::implicitRow(s, 1, btScalar(0.01));
	EXPECT_NEAR(1, row.m_compliance * 1e12 * 1e-4, 1e-6);
	EXPECT_NEAR(1e-8 / 0.01, row.m_velocity, 1e-12);
	EXPECT_NEAR(-1e3, row.m_lower, 1);
	EXPECT_NEAR(1e3, row.m_upper, 1);
}

TEST(Law, DoesNotCareHowTheStepChanges)
{
	// The same oscillation with steps that alternate 1:3 and with even ones ends at the same place.
	const double m = 1, k = 100, T = 2;
	const auto run = [&](double a, double b)
	{
		double e = 1, v = 0, force = k, rate = 0, t = 0;
		for (int i = 0; t < T - 1e-9; ++i)
		{
			const double dt = i % 2 ? a : b;
			const btElasticPlastic::DofState s = {btScalar(k), btScalar(1e6), btScalar(e), btScalar(force),
												  btScalar(rate)};
			v += solve(btElasticPlastic::implicitRow(s, 1, btScalar(dt)), v, 1 / m);
			e -= dt * v;
			rate = (k * e - force) / dt;
			force = k * e;
			t += dt;
		}
		return e;
	};
	const double exact = cos(10 * T);
	EXPECT_NEAR(exact, run(0.0005, 0.0005), 0.01);
	EXPECT_NEAR(exact, run(0.00025, 0.00075), 0.01);
}

TEST(Law, HugeAndTinyStiffnessGiveNumbers)
{
	for (double k : {1e-30, 1e-6, 1e18, double(BT_LARGE_FLOAT)})
		for (double dt : {1e-5, 0.1})
		{
			const btElasticPlastic::DofState s = {btScalar(k), btScalar(1e5), btScalar(1e-3), 0, 0};
			for (const btElasticPlastic::SoftRow& row : {btElasticPlastic::implicitRow(s, btScalar(1e6), btScalar(dt)),
														 btElasticPlastic::stockRow(s, btScalar(1e6), btScalar(dt))})
			{
				EXPECT_FALSE(std::isnan(row.m_velocity) || std::isnan(row.m_compliance) || std::isnan(row.m_lower))
					<< k << " " << dt;
				EXPECT_LE(row.m_lower, row.m_upper);
			}
		}
}

TEST(Law, ReturnMapping)
{
	// Elastic
	btElasticPlastic::ReturnMapping r = btElasticPlastic::returnMap(1000, 50, btScalar(0.03), true);
	EXPECT_FLOAT_EQ(30, r.m_force);
	EXPECT_EQ(0, r.m_increment);
	// Beyond yield, at the bound: flows, either way
	r = btElasticPlastic::returnMap(1000, 50, btScalar(0.08), true);
	EXPECT_FLOAT_EQ(50, r.m_force);
	EXPECT_NEAR(0.03, r.m_increment, 1e-8);
	r = btElasticPlastic::returnMap(1000, 50, btScalar(-0.08), true);
	EXPECT_FLOAT_EQ(-50, r.m_force);
	EXPECT_NEAR(-0.03, r.m_increment, 1e-8);
	// Beyond yield, but the solver's impulse is not at its bound: solver error, no flow
	r = btElasticPlastic::returnMap(1000, 50, btScalar(0.08), false);
	EXPECT_FLOAT_EQ(50, r.m_force);
	EXPECT_EQ(0, r.m_increment);
	// Mapping what was mapped changes nothing.
	EXPECT_EQ(0, btElasticPlastic::returnMap(1000, 50, btScalar(0.05), true).m_increment);
}

}  // namespace
