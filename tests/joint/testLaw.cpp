// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The law of one degree of freedom: coefficients, stability, return mapping.

#include <math.h>

#include <algorithm>
#include <vector>

#include <limits>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/Law.h"
#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/MaterialDamping.h"
#include "support/Precision.h"

namespace testLaw
{
using btElasticPlastic::DofState;
using btElasticPlastic::MaterialDamping;
using btElasticPlastic::MeanForce;
using btElasticPlastic::SoftRow;

/// One mass on one row, which the solver finds exactly.
struct Swing
{
	double m_mass, m_stiffness;
	double m_ratio = 0;  ///< of the material's damping
	enum
	{
		BY_MODE,
		BY_ROW,
		FOR_STOCK
	} m_row = BY_MODE;
	double m_carried = 0, m_rate = 0;  ///< force of the damping's branches, rate of all force
	double m_strain = 0, m_velocity = 1, m_last = 0, m_force = 0, m_applied[2] = {0, 0};
	btScalar m_branch[MaterialDamping::BRANCHES][BT_EP_DOF_COUNT] = {};

	void step(double dt)
	{
		const MaterialDamping damping{btScalar(m_ratio), btScalar(dt)};
		DofState s = {btScalar(m_stiffness), btScalar(1e30),   btScalar(m_strain),
					  btScalar(m_force),     btScalar(m_rate), {btScalar(m_applied[0]), btScalar(m_applied[1])}};
		damping.addTo(s, m_branch, 0);
		const btScalar diagonal = btScalar(1 / m_mass), length = btScalar(dt), last = btScalar(m_last),
					   a = btScalar(m_stiffness * dt * dt / m_mass);
		const MeanForce mean = m_row == BY_ROW ? MeanForce::byRow(a, length, last) : MeanForce::byMode(length, last);
		const SoftRow row = m_row == FOR_STOCK ? btElasticPlastic::stockRow(s, diagonal, length)
											   : btElasticPlastic::implicitRow(s, mean, a, length);
		const double free = (double(row.m_velocity) - m_velocity) / (1 / m_mass + double(row.m_compliance)),
					 impulse = std::max(double(row.m_lower), std::min(double(row.m_upper), free));
		m_velocity += impulse / m_mass;
		m_strain -= dt * m_velocity;
		const double before = m_force + m_carried;
		m_carried = 0;
		for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
		{
			m_branch[b][0] = damping.next(b, m_branch[b][0], btScalar(m_stiffness * m_strain - m_force));
			m_carried += double(m_branch[b][0]);
		}
		m_force = m_stiffness * m_strain;
		m_rate = (m_force + m_carried - before) / dt;
		m_applied[1] = m_applied[0];
		m_applied[0] = impulse / dt;
		m_last = dt;
	}
};

/// Damping ratio and period of a swing, from its turning points: parabolas through the largest of three.
struct Measured
{
	double m_ratio, m_period;
};

Measured measure(Swing swing, double dt, int swings)
{
	std::vector<double> times, heights;
	double before[2] = {swing.m_strain, swing.m_strain};
	for (int i = 1; int(times.size()) < swings; ++i)
	{
		swing.step(dt);
		if (i > 1 && before[0] > before[1] && before[0] >= swing.m_strain)
		{
			const double slope = (swing.m_strain - before[1]) / 2, bend = swing.m_strain - 2 * before[0] + before[1];
			times.push_back((i - 1 - slope / bend) * dt);
			heights.push_back(before[0] - slope * slope / bend / 2);
		}
		before[1] = before[0];
		before[0] = swing.m_strain;
	}
	const double decrement = log(heights[1] / heights.back()) / double(swings - 2) / (2 * M_PI);
	return {decrement / sqrt(1 + decrement * decrement), (times.back() - times[1]) / double(swings - 2)};
}

/// Energy of a swing over that at its start, the largest of many steps.
double growth(double squaredStep, decltype(Swing::m_row) kind)
{
	const double m = 2, dt = 0.01, k = squaredStep * m / dt / dt;
	Swing swing = {m, k};
	swing.m_row = kind;
	double largest = 0;
	for (int i = 0; i < 2000; ++i)
	{
		swing.step(dt);
		largest = std::max(largest, k / m * swing.m_strain * swing.m_strain + swing.m_velocity * swing.m_velocity);
	}
	return largest;
}

TEST(Law, TheLargestStiffnessWithDampingIsANumber)
{
	const btScalar largest = std::numeric_limits<btScalar>::max();
	btElasticPlastic::DofState s = {largest, 1, 0, 0, 0, {0, 0}};
	s.m_stiffening = btScalar(0.1);
	EXPECT_EQ(0, s.forceAt(0));
}

TEST(Law, IsStableAtAnyStep)
{
	for (double a = 1e-6; a < 1e12; a *= 3)
	{
		// The scheme's invariant is not the energy at one time, but within the step's own size of it.
		EXPECT_LT(growth(a, Swing::BY_MODE), 1.5) << "a = " << a;
		// Newmark's energy wanders within the step's own size, it never grows from swing to swing.
		EXPECT_LT(growth(a, Swing::BY_ROW), 1.5) << "a = " << a;
		// Explicit below a = 1: symplectic Euler's invariant bounds the energy by 1 / (1 - sqrt(a)/2) = 2.
		EXPECT_LT(growth(a, Swing::FOR_STOCK), 2.1) << "a = " << a;
	}
}

/// The filter's own damping and stretching of the period, by the roots of (1 - w)^2 D(w) + (omega dt)^2 = 0.
TEST(Law, DampsWhatTheStepDoesNotResolve)
{
	const struct
	{
		double steps, ratio, stretch;  // exact to the digits given
	} expected[] = {
		{74, 0, 0.0015}, {50, 0.00002, 0.0033}, {25, 0.0002, 0.0131}, {12, 0.0053, 0.059}, {6, 0.046, 0.209}};
	for (const auto& e : expected)
	{
		const double dt = 0.01, omega = 2 * M_PI / (e.steps * dt);
		const Measured measured = measure({2, 2 * omega * omega}, dt, 12);
		// Parabolas through turning points leave 1e-3 of a swing's height, over ten swings; 12 steps a swing and less leave more.
		EXPECT_NEAR(e.ratio, measured.m_ratio, byPrecision(1e-4, 2e-4) + 0.1 * e.ratio) << e.steps;
		EXPECT_NEAR(1 + e.stretch, measured.m_period * omega / (2 * M_PI), 1e-3 + 0.02 * e.stretch) << e.steps;
	}
	// What has 0.1 steps a swing keeps an eighth of itself from step to step.
	Swing stiff = {2, 2 * 6283. * 6283};
	for (int i = 0; i < 10; ++i)
		stiff.step(0.01);
	EXPECT_LT(fabs(stiff.m_velocity), 1e-6);
}

/// By the material's ratio within 5 % where the modes are from 0.3 to 20 Hz and have 25 steps a swing or more.
TEST(Law, DampsAsTheMaterialDoes)
{
	for (const double ratio : {0.01, 0.03, 0.04})
		for (const double rate : {30., 60., 120., 240., 480., 960.})
			for (const double steps : {25., 35., 50., 70., 100., 140., 200., 400.})
			{
				const double frequency = rate / steps, omega = 2 * M_PI * frequency;
				if (frequency < 0.29 || frequency > 20)
					continue;
				Swing swing = {2, 2 * omega * omega, ratio};
				EXPECT_NEAR(ratio, measure(swing, 1 / rate, 8).m_ratio, 0.05 * ratio) << rate << ", " << steps;
			}
}

TEST(Law, MaterialDampingLeavesTheSpringAsItIsAtRest)
{
	Swing swing = {2, 1000, 0.03};
	swing.m_branch[1][0] = 500;
	const double load = 700;
	for (int i = 0; i < 6000; ++i)
	{
		swing.step(0.01);
		swing.m_velocity -= load / swing.m_mass * 0.01;
	}
	EXPECT_NEAR(load / 1000, swing.m_strain, 1e-4);
	for (const auto& branch : swing.m_branch)
		EXPECT_NEAR(0, branch[0], 0.01);
}

TEST(Law, ByRowIsBackwardEulerForAStiffSpring)
{
	const DofState s = {btScalar(1e12), btScalar(1e5), btScalar(1e-8), btScalar(3e3), btScalar(7e4), {0, 0}};
	const SoftRow row = btElasticPlastic::implicitRow(s, MeanForce::byRow(btScalar(1e8), btScalar(0.01), 0),
													  btScalar(1e8), btScalar(0.01));
	EXPECT_NEAR(1, row.m_compliance * 1e12 * 1e-4, 1e-6);
	EXPECT_NEAR(1e-8 / 0.01, row.m_velocity, 1e-12);
	EXPECT_NEAR(-1e3, row.m_lower, 1);
	EXPECT_NEAR(1e3, row.m_upper, 1);
}

TEST(Law, DoesNotCareHowTheStepChanges)
{
	// The same oscillation with steps that alternate 1:3 and with even ones ends at the same place. Changed steps are those of backward
	// Euler, which loses omega dt / 2 of each radian: 0.5 % of 20.
	const double k = 100, T = 2;
	const auto run = [&](double a, double b, decltype(Swing::m_row) kind)
	{
		Swing swing = {1, k};
		swing.m_row = kind;
		double t = 0;
		for (int i = 0; t < T - 1e-9; ++i)
		{
			const double dt = i % 2 ? a : b;
			swing.step(dt);
			t += dt;
		}
		return swing.m_strain;
	};
	const double exact = -sin(10 * T) / 10;
	for (const auto kind : {Swing::BY_MODE, Swing::BY_ROW})
	{
		EXPECT_NEAR(exact, run(0.0005, 0.0005, kind), 0.001);
		EXPECT_NEAR(exact, run(0.000025, 0.000075, kind), 0.001);
	}
}

TEST(Law, HugeAndTinyStiffnessGiveNumbers)
{
	for (double k : {1e-30, 1e-6, 1e18, double(BT_LARGE_FLOAT)})
		for (double dt : {1e-5, 0.1})
		{
			const DofState s = {btScalar(k), btScalar(1e5), btScalar(1e-3), 0, 0, {0, 0}};
			for (const SoftRow& row :
				 {btElasticPlastic::implicitRow(s, MeanForce::byMode(btScalar(dt), 0), btScalar(k * dt * dt * 1e6),
												btScalar(dt)),
				  btElasticPlastic::implicitRow(s, MeanForce::byRow(btScalar(k * dt * dt * 1e6), btScalar(dt), 0),
												btScalar(k * dt * dt * 1e6), btScalar(dt)),
				  btElasticPlastic::stockRow(s, btScalar(1e6), btScalar(dt))})
			{
				EXPECT_FALSE(std::isnan(row.m_velocity) || std::isnan(row.m_compliance) || std::isnan(row.m_lower))
					<< k << " " << dt;
				EXPECT_LE(row.m_lower, row.m_upper);
			}
		}
}

/// Bullet's own solvers diverge where compliance comes near the diagonal A: a spring that the step nearly resolves gets A / 2, and its own
/// force on what does not move.
TEST(Law, StockRowsKeepTheirDistanceFromTheDiagonal)
{
	const double k = 1000, dt = 0.01, strain = 0.02;
	const DofState s = {btScalar(k), btScalar(1e5), btScalar(strain), 0, 0, {0, 0}};
	for (const double a : {1.25, 1.999, 2.001, 50.})
	{
		const double diagonal = a / (k * dt * dt);
		const SoftRow row = btElasticPlastic::stockRow(s, btScalar(diagonal), btScalar(dt));
		EXPECT_NEAR(row.m_compliance / diagonal, a < 2 ? 0.5 : 1 / a, 1e-6) << a;
		EXPECT_NEAR(row.m_velocity / row.m_compliance, k * strain * dt, 1e-6) << a;
		EXPECT_NEAR(row.m_upper, 1e5 * dt, 1e-3);
	}
	// One that it resolves has its force, and no compliance.
	const SoftRow row = btElasticPlastic::stockRow(s, btScalar(0.99 / (k * dt * dt)), btScalar(dt));
	EXPECT_EQ(row.m_compliance, 0);
	EXPECT_NEAR(row.m_upper, k * strain * dt, 1e-6);
}

/// A joint that has held 30 at rest is strained: it bears no more than its yield value, as the mean over the step where the step does
/// not resolve it, and in the middle of the step where it does.
TEST(Law, YieldsByTheMeanForceOrByThatOfTheMiddle)
{
	const btScalar dt = btScalar(0.01);
	const MeanForce mean = MeanForce::byMode(dt, dt);
	const DofState s = {1000, 50, btScalar(0.03), 30, 0, {30, 30}};
	for (const int side : {1, -1})
	{
		SoftRow row = implicitRow(s, mean, btScalar(1e9), dt);
		EXPECT_NEAR(50 * side, (side > 0 ? row.m_upper : row.m_lower) / dt, 1e-3);
		row = implicitRow(s, mean, 0, dt);
		const btScalar applied = (side > 0 ? row.m_upper : row.m_lower) / dt;
		// Unloading does not pull: no bound is beyond zero, and none beyond yield.
		EXPECT_NEAR(50 * side, (applied + mean.limit(side, applied * dt, s, dt)) / 2, 1e-3);
	}
}

/// Whatever was before, bounds are within yield and contain zero; so the steps of a solver that is cut give no energy.
TEST(Law, BoundsAreWithinYieldAndContainZero)
{
	for (const double a : {0., 0.1, 10., 1e6})
		for (const double last : {-50., -20., 0., 50., 80.})
			for (const double before : {-80., -50., 10., 50.})
				for (const double lastStep : {0., 0.01, 0.02, 0.1})
				{
					const DofState s = {1000, 50, 0, 0, 0, {btScalar(last), btScalar(before)}};
					const SoftRow row = implicitRow(s, MeanForce::byMode(btScalar(0.01), btScalar(lastStep)),
													btScalar(a), btScalar(0.01));
					EXPECT_LE(row.m_lower, 0);
					EXPECT_GE(row.m_upper, 0);
					EXPECT_GE(row.m_lower, btScalar(-0.5));
					EXPECT_LE(row.m_upper, btScalar(0.5));
				}
}

/// What a solver has made of a row of stiffness 1000 and yield 50 that has held its yield value for long.
btElasticPlastic::ReturnMapping mapped(double trial, int bound)
{
	const btScalar dt = btScalar(0.01), held = trial > 0 ? 50 : -50;
	const MeanForce mean = MeanForce::byMode(dt, dt);
	const DofState s = {1000, 50, 0, held, 0, {held, held}};
	const btElasticPlastic::RowOutcome outcome = {
		0, dt * -50, dt * 50, btScalar(trial), static_cast<signed char>(bound), true, false};
	return btElasticPlastic::returnMap(s, mean, outcome, dt);
}

TEST(Law, ReturnMapping)
{
	// Elastic
	btElasticPlastic::ReturnMapping r = mapped(0.03, 0);
	EXPECT_FLOAT_EQ(30, r.m_force);
	EXPECT_EQ(0, r.m_increment);
	// Beyond yield, at the bound: flows, either way
	r = mapped(0.08, 1);
	EXPECT_NEAR(50, r.m_force, 1e-4);
	EXPECT_NEAR(0.03, r.m_increment, 1e-7);
	r = mapped(-0.08, -1);
	EXPECT_NEAR(-50, r.m_force, 1e-4);
	EXPECT_NEAR(-0.03, r.m_increment, 1e-7);
	// Beyond yield, but the solver's impulse is not at its bound: solver error, no flow
	r = mapped(0.08, 0);
	EXPECT_NEAR(50, r.m_force, 1e-4);
	EXPECT_EQ(0, r.m_increment);
	// Mapping what was mapped changes nothing.
	EXPECT_NEAR(0, mapped(0.05, 1).m_increment, 1e-7);
}
}  // namespace testLaw
