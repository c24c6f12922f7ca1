// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// A large problem solved in places: the same solution as of the whole.

#include <gtest/gtest.h>

#include <math.h>

#include <algorithm>
#include <vector>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/solver/System.h"

namespace testCondensation
{
using btElasticPlastic::System;
using btElasticPlastic::SystemInput;

/// A grid of bodies of 1 kg, each joined to its neighbours to the right and below by six rows with bounds, the upper row held. One body
/// is pushed by an impulse given as the targets of its rows.
SystemInput grid(int columns, int rows, int pushed, double push)
{
	SystemInput input;
	for (int b = 0; b < columns * rows; ++b)
	{
		SystemInput::Body& body = input.addBody();
		for (double& mass : body.m_mass)
			mass = 1;
		for (int i = 0; i < 9; ++i)
			body.m_inertia[i] = i % 4 == 0 ? 0.2 : 0;
	}
	const auto join = [&](int a, int b, double x, double y)
	{
		SystemInput::Unit& unit = input.addUnit(6);
		for (int axis = 0; axis < 3; ++axis)
			for (int i = 0; i < 3; ++i)
				unit.m_axis[axis][i] = axis == i;
		const double arm[2][3] = {{x, y, 0}, {-x, -y, 0}};
		for (int side = 0; side < 2; ++side)
			std::copy(arm[side], arm[side] + 3, unit.m_arm[side]);
		unit.m_body[0] = a;
		unit.m_body[1] = b;
		for (int r = 0; r < 6; ++r)
		{
			unit.m_dof[r] = static_cast<signed char>(r);
			SystemInput::Bounded& row = input.m_rows[size_t(unit.m_firstRow + r)];
			row.m_compliance = 1e-3;
			row.m_upper = r < 3 ? 1 : 0.3;
			row.m_lower = -row.m_upper;
			// The impulse on the pushed body, as a velocity that its rows see.
			row.m_target = r == 2 ? ((a == pushed) - (b == pushed)) * -push : 0;
		}
	};
	for (int y = 0; y < rows; ++y)
		for (int x = 0; x < columns; ++x)
		{
			const int b = y * columns + x;
			if (y == 0)
				join(-1, b, 0, -0.5);
			if (x + 1 < columns)
				join(b, b + 1, 0.5, 0);
			if (y + 1 < rows)
				join(b, b + columns, 0, 0.5);
		}
	// What flowed in the last step: around the pushed body.
	for (const SystemInput::Unit& unit : input.m_units)
		if (unit.m_body[0] == pushed || unit.m_body[1] == pushed)
			input.m_guess[size_t(unit.m_firstRow + 2)].m_bound = 1;
	return input;
}

struct Solved
{
	btElasticPlasticStatistics m_statistics;
	std::vector<double> m_velocity, m_impulses;

	Solved(SystemInput input, bool condenses)
	{
		System system(m_statistics);
		btElasticPlasticSolverSettings settings;
		settings.m_condenses = condenses;
		settings.m_maxIterations = 0;
		system.setSettings(settings);
		int islandId = 0;
		EXPECT_TRUE(system.solve(input, islandId, System::EXACT));
		m_velocity = system.getResult().m_velocity;
		m_impulses = system.getResult().m_impulses;
	}
};

/// Both end with the exact solution for the same bounds: the rest is rounding, times the matrix's condition of 1e6.
void expectSameVelocity(const std::vector<double>& expected, const std::vector<double>& found)
{
	double largest = 0;
	for (const double v : expected)
		largest = std::max(largest, fabs(v));
	EXPECT_GT(largest, 0.1);
	for (size_t i = 0; i < expected.size(); ++i)
		ASSERT_NEAR(expected[i], found[i], 1e-9 * largest) << i;
}

TEST(Condensation, AgreesWithTheWhole)
{
	for (const double push : {2., 10., 50.})
	{
		SCOPED_TRACE(push);
		const int columns = 30, rows = 30, pushed = 15 * columns + 14;
		const SystemInput input = grid(columns, rows, pushed, push);
		const Solved whole(input, false), inPlace(input, true);
		expectSameVelocity(whole.m_velocity, inPlace.m_velocity);
		for (size_t i = 0; i < whole.m_impulses.size(); ++i)
			ASSERT_NEAR(whole.m_impulses[i], inPlace.m_impulses[i], 1e-7) << i;
		// An island of its own, the place, was solved.
		EXPECT_EQ(1, whole.m_statistics.m_islands);
		EXPECT_GT(inPlace.m_statistics.m_islands, 1);
	}
}

/// What a Condensation is told of the whole problem.
struct Begun
{
	btElasticPlasticStatistics m_statistics;
	btElasticPlastic::LinearSolver m_whole;
	btElasticPlastic::SystemMatrix m_matrix;
	btElasticPlastic::AdmissibleBox m_box;

	explicit Begun(const SystemInput& input) : m_whole(m_statistics), m_matrix(m_whole)
	{
		m_matrix.begin(input, 0, 1);
		m_box.begin(input);
	}
};

/// Where much of a structure flows, here and there, nearly all that is inside has neighbours outside. What is left of these is a dense
/// matrix, whose factor would take several times as much as that of the whole.
TEST(Condensation, IsNotForManyPlacesWithALongBorder)
{
	const int columns = 40, rows = 40, apart = 7;
	const SystemInput input = grid(columns, rows, -1, 0);
	Begun begun(input);
	std::vector<int> bodies;
	for (int b = 0; b < input.getNumBodies(); ++b)
		if (b % apart == 0 && b / columns % apart == 0)
			bodies.push_back(b);
	btElasticPlastic::Condensation inOnePlace(begun.m_statistics), inMany(begun.m_statistics);
	ASSERT_TRUE(inOnePlace.choose(input, {bodies[bodies.size() / 2]}, 6));
	EXPECT_TRUE(inOnePlace.condense(input, begun.m_box, begun.m_whole.getNumOperations()));
	ASSERT_TRUE(inMany.choose(input, bodies, 6));
	EXPECT_FALSE(inMany.condense(input, begun.m_box, begun.m_whole.getNumOperations()));
}

/// Joins the ground and a body by a shear and two fibres whose compliance is coupled with its.
void addBundle(SystemInput& input, int body)
{
	SystemInput::Unit& unit = input.addUnit(3, 2);
	for (int axis = 0; axis < 3; ++axis)
		for (int i = 0; i < 3; ++i)
		{
			unit.m_axis[axis][i] = axis == i;
			if (axis < 2)
				unit.m_arm[axis][i] = 0;
		}
	unit.m_place[0] = unit.m_place[1] = 0;
	unit.m_body[0] = -1;
	unit.m_body[1] = body;
	unit.m_dof[0] = 1;
	unit.m_bundle = int(input.m_bundles.size());
	for (int r = 0; r < 3; ++r)
	{
		SystemInput::Bounded& row = input.m_rows[size_t(unit.m_firstRow + r)];
		row = {0, 1e-3, -1, 1, r == 0 ? SystemInput::Bounded::SHEAR_OF_BUNDLE : SystemInput::Bounded::FIBRE_OF_BUNDLE,
			   0};
	}
	input.m_bundles.push_back({int(input.m_units.size()) - 1, {unit.m_firstRow, -1}, int(input.m_couplings.size())});
	for (const double y : {-0.1, 0.1})
	{
		input.m_fibres[size_t(unit.m_firstFibre + (y > 0))] = {y, 0};
		input.m_couplings.push_back({{1e-6 * y * (1 + body), 0}});
	}
}

TEST(Condensation, KnowsCouplingsThatHaveChanged)
{
	// As recovery of penetration makes joints stiff, and couplings of their fibres with them: far from what happens, and there.
	const int columns = 30, pushed = 15 * columns + 14;
	SystemInput input = grid(columns, 30, pushed, 10);
	for (const int body : {0, pushed, 1})
		addBundle(input, body);
	Begun begun(input);
	btElasticPlastic::Condensation condensation(begun.m_statistics);
	ASSERT_TRUE(condensation.choose(input, {pushed}, 6));
	ASSERT_TRUE(condensation.condense(input, begun.m_box, begun.m_whole.getNumOperations()));
	const auto expectCoupling = [&](double expected)
	{
		const SystemInput& inside = condensation.getInput();
		ASSERT_EQ(1u, inside.m_bundles.size());
		ASSERT_EQ(2u, inside.m_couplings.size());
		const int first = inside.m_bundles[0].m_firstCoupling;
		EXPECT_EQ(0, first);
		EXPECT_EQ(-expected, inside.m_couplings[0].m_shear[0]);
		EXPECT_EQ(expected, inside.m_couplings[1].m_shear[0]);
	};
	const double coupling = 1e-6 * 0.1 * (1 + pushed);
	expectCoupling(coupling);
	for (SystemInput::Coupling& own : input.m_couplings)
		own.m_shear[0] /= 1024;
	ASSERT_TRUE(condensation.condenseAgain(input, begun.m_box));
	expectCoupling(coupling / 1024);
}

TEST(Condensation, LooksFurtherWhereRowsOutsideReachABound)
{
	// A push that makes rows flow up to the held edge, far beyond the first place.
	const int columns = 30, rows = 30, pushed = 15 * columns + 14;
	SystemInput input = grid(columns, rows, pushed, 500);
	const Solved whole(input, false), inPlace(input, true);
	for (size_t i = 0; i < whole.m_velocity.size(); ++i)
		ASSERT_NEAR(whole.m_velocity[i], inPlace.m_velocity[i], 1e-6) << i;
}

TEST(Condensation, OtherCompliances)
{
	// As recovery does: the same problem once more with joints ten times as stiff but for those that are condensed, and back.
	const int columns = 30, rows = 30, pushed = 15 * columns + 14;
	SystemInput input = grid(columns, rows, pushed, 2);
	const SystemInput soft = input;
	btElasticPlasticStatistics statistics;
	System system(statistics);
	btElasticPlasticSolverSettings settings;
	settings.m_condenses = true;
	settings.m_maxIterations = 0;
	system.setSettings(settings);
	int islandId = 0;
	ASSERT_TRUE(system.solve(input, islandId, System::EXACT));
	const btElasticPlastic::SystemResult first = system.getResult();
	int numElsewhere = 0;
	for (size_t r = 0; r < input.m_rows.size(); ++r)
		if (system.isElsewhere(int(r)))
			++numElsewhere;
		else
			input.m_rows[r].m_compliance /= 10;
	EXPECT_GT(numElsewhere, 3000);
	system.beginAside();
	ASSERT_TRUE(system.solveAgain(input, System::EXACT));
	expectSameVelocity(Solved(input, false).m_velocity, system.getResult().m_velocity);
	for (size_t r = 0; r < input.m_rows.size(); ++r)
		input.m_rows[r].m_compliance = soft.m_rows[r].m_compliance;
	system.setResult(first);
	system.endAside();
	ASSERT_TRUE(system.solveAgain(input, System::EXACT));
	expectSameVelocity(Solved(input, false).m_velocity, system.getResult().m_velocity);
}
}  // namespace testCondensation
