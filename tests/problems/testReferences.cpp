// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What reference problems without a formula are compared with: explicit integration of the same blocks, which shares nothing with
// the library.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "problems/PlanarBlocks.h"
#include "problems/Catalogue.h"

namespace testReferences
{
using namespace ep;

double exactOf(const char* problem)
{
	Stepping stepping;
	stepping.step = 1. / 30;
	return findProblem(problem)->solve(Solver::Direct, stepping).quantities[0].exact;
}

/// Mean place of the mass between 0.1 and 0.2 s.
double parkesTip(double mass, double velocity, double dt)
{
	PlanarBlocks row({200e9, 0.3, 7800, 250e6, 0.02}, 1, 20);
	row.blocks.push_back({mass, mass * 0.05 * 0.05 / 6, {1, 0}});
	row.blocks.back().velocity[1] = -velocity;
	row.join(20, 21, 0.025, 0, 0.025);
	for (double& yield : row.joints.back().yield)
		yield *= 100;
	double sum = 0;
	const int steps = int(0.1 / dt + 0.5);
	for (int i = 0; i < 2 * steps; ++i)
	{
		row.step(dt);
		sum -= i < steps ? 0 : row.blocks.back().place[1];
	}
	return sum / steps;
}

/// Changes by 2e-4 from 1 us to 0.1 us.
TEST(References, ParkesHeavy) { EXPECT_NEAR(1, parkesTip(1.5, 25, 1e-6) / exactOf("parkes-heavy"), 3e-4); }
TEST(References, ParkesLight) { EXPECT_NEAR(1, parkesTip(0.3, 50, 1e-6) / exactOf("parkes-light"), 3e-4); }

/// A body of 20 t that flies at 0.04 m/s and turns at 0.4 rad/s, rigid-plastic: force and moment are where m + n^2 = 1 has its flow as normal.
TEST(References, BodyFliesAndTurns)
{
	const double axial = 20e3, moment = 500, mass = 20e3, inertia = 483.334, dt = 1e-6;
	double speed = 0.04, spin = 0.4, way = 0, turn = 0;
	while (speed > 0 || spin > 0)
	{
		// (2 n / Np, 1 / Mp) is as (speed, spin), up to the corner at n = 1.
		const double n = spin > 0 ? std::min(1., speed * axial / (2 * moment * spin)) : 1.;
		speed = std::max(0., speed - dt * n * axial / mass);
		spin = std::max(0., spin - dt * (1 - n * n) * moment / inertia);
		way += dt * speed;
		turn += dt * spin;
	}
	Stepping stepping;
	stepping.step = 1. / 30;
	const Outcome outcome = findProblem("body-flies-and-turns")->solve(Solver::Direct, stepping);
	EXPECT_NEAR(1, way / outcome.quantities[0].exact, 1e-4);
	EXPECT_NEAR(1, turn / outcome.quantities[1].exact, 1e-4);
}

/// Mean over whole periods within 10 s, from one sinking past the place at rest to another.
TEST(References, CantileverSwinging)
{
	PlanarBlocks row({200e9, 0.3, 7800, 400e6, 0.1}, 10, 20);
	row.gravity = 10;
	const double dt = 1e-5, half = 0.25, rest = 0.5865;
	double before = 0, pending = 0, sum = 0;
	int pendingSteps = 0, steps = 0;
	bool begun = false;
	for (int i = 0; i * dt < 10; ++i)
	{
		row.step(dt);
		const PlanarBlocks::Block& last = row.blocks.back();
		const double sag = -last.place[1] - half * std::sin(last.angle);
		if (before < rest && sag >= rest)
		{
			sum += begun ? pending : 0;
			steps += begun ? pendingSteps : 0;
			begun = true;
			pending = pendingSteps = 0;
		}
		pending += sag;
		++pendingSteps;
		before = sag;
	}
	EXPECT_NEAR(1, sum / steps / exactOf("cantilever-swinging"), 1e-4);
	for (const PlanarBlocks::Joint& joint : row.joints)
		EXPECT_EQ(0, joint.plastic[2]);
}
}  // namespace testReferences
