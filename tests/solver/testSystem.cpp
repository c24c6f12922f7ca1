// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The system of rows against a dense reference: projected Gauss-Seidel on the dual problem, iterated until it stands still.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/solver/Jacobian.h"
#include "BulletDynamics/ConstraintSolver/ElasticPlastic/solver/System.h"
#include "BulletDynamics/ConstraintSolver/ElasticPlastic/solver/SystemMatrix.h"

namespace testSystem
{
using btElasticPlastic::System;
using btElasticPlastic::SystemInput;

/// Couples two rows by this share of the most that leaves their compliance positive definite.
void couple(SystemInput& input, int i, int j, double share)
{
	SystemInput::Bounded &a = input.m_rows[size_t(i)], &b = input.m_rows[size_t(j)];
	a.m_partner = j;
	b.m_partner = i;
	a.m_coupling = b.m_coupling = share * std::sqrt(a.m_compliance * b.m_compliance);
}

/// What a chain's units have.
enum Kind
{
	PLAIN,
	PAIRS,   ///< rows along an axis that are coupled with rows about another one, and two single rows with each other
	FIBRES,  ///< two shears, a torsion and six fibres
	BUNDLES  ///< the same, fibres coupled with the shears
};

/// Couples a unit's fibres with its first two rows by these shares of the most that leaves their compliance positive definite; the
/// second one is left out in every third unit.
void coupleFibres(SystemInput& input, SystemInput::Unit& unit, const double share[2])
{
	const bool hasBoth = unit.m_body[1] % 3 != 0;
	unit.m_bundle = int(input.m_bundles.size());
	input.m_bundles.push_back(
		{unit.m_body[1], {unit.m_firstRow, hasBoth ? unit.m_firstRow + 1 : -1}, int(input.m_couplings.size())});
	for (int s = 0; s < (hasBoth ? 2 : 1); ++s)
		input.m_rows[size_t(unit.m_firstRow + s)].m_partner = SystemInput::Bounded::SHEAR_OF_BUNDLE;
	for (int i = 0; i < unit.m_numFibres; ++i)
	{
		SystemInput::Bounded& row = input.m_rows[size_t(unit.getFirstFibreRow() + i)];
		row.m_partner = SystemInput::Bounded::FIBRE_OF_BUNDLE;
		input.m_couplings.push_back({{0, 0}});
		for (int s = 0; s < 2; ++s)
			input.m_couplings.back().m_shear[s] =
				(i % 2 ? 0.7 : -0.5) * share[s] *
				std::sqrt(row.m_compliance * input.m_rows[size_t(unit.m_firstRow + s)].m_compliance / unit.m_numFibres);
	}
}

/// A chain of bodies, the first one held by the ground, with random axes, arms, compliances and bounds.
SystemInput randomChain(int numBodies, double tightness, unsigned seed, Kind kind = PLAIN)
{
	const bool isCoupled = kind == PAIRS, hasFibres = kind == FIBRES || kind == BUNDLES;
	std::mt19937 random(seed);
	std::uniform_real_distribution<double> share(0, 1);
	const auto between = [&](double low, double high) { return low + (high - low) * share(random); };
	SystemInput input;
	for (int b = 0; b < numBodies; ++b)
	{
		SystemInput::Body& body = input.addBody();
		for (double& mass : body.m_mass)
			mass = between(1, 3);
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				body.m_inertia[3 * i + j] = i == j ? between(0.5, 1) : 0.1;
	}
	for (int b = 0; b < numBodies; ++b)
	{
		const int numFibres = hasFibres ? 6 : 0, numRows = hasFibres ? 3 : 3 + b % 4;
		SystemInput::Unit& unit = input.addUnit(numRows + numFibres, numFibres);
		const double angle = between(0, 3);
		const double axes[3][3] = {
			{std::cos(angle), std::sin(angle), 0}, {-std::sin(angle), std::cos(angle), 0}, {0, 0, 1}};
		for (int a = 0; a < 3; ++a)
			for (int i = 0; i < 3; ++i)
			{
				unit.m_axis[a][i] = axes[a][i];
				if (a < 2)
					unit.m_arm[a][i] = between(-1, 1);
			}
		unit.m_body[0] = b - 1;
		unit.m_body[1] = b;
		for (int r = 0; r < numRows; ++r)
			unit.m_dof[r] = static_cast<signed char>(hasFibres ? 1 + r : (r + b) % 6);
		for (int i = 0; i < numFibres; ++i)
			input.m_fibres[size_t(unit.m_firstFibre + i)] = {between(-1, 1), between(-1, 1)};
	}
	// A single row joins the chain's ends, or two of them.
	for (int i = 0; i < (isCoupled ? 2 : 1); ++i)
	{
		SystemInput::SingleRow& loop = input.addSingleRow();
		for (double& element : loop.m_J)
			element = between(-1, 1);
		loop.m_body[0] = 0;
		loop.m_body[1] = numBodies - 1;
	}
	for (SystemInput::Bounded& row : input.m_rows)
	{
		row.m_target = between(-1, 1);
		row.m_compliance = between(0.01, 1);
		row.m_lower = -tightness * between(0.1, 1);
		row.m_upper = tightness * between(0.1, 1);
	}
	if (kind == BUNDLES)
		for (SystemInput::Unit& unit : input.m_units)
		{
			const double share[2] = {between(-0.9, 0.9), between(-0.9, 0.9)};
			coupleFibres(input, unit, share);
		}
	if (!isCoupled)
		return input;
	for (const SystemInput::Unit& unit : input.m_units)
		for (int r = 0; r < unit.m_numRows; ++r)
			for (int s = 0; s < unit.m_numRows; ++s)
				if (unit.m_dof[r] > 0 && unit.m_dof[r] < 3 && unit.m_dof[r] + unit.m_dof[s] == 6)
					couple(input, unit.m_firstRow + r, unit.m_firstRow + s, between(-0.9, 0.9));
	couple(input, input.getNumRows() - 2, input.getNumRows() - 1, between(-0.9, 0.9));
	return input;
}

typedef std::vector<double> Row;

/// All Jacobians, dense: 6 columns a body.
std::vector<Row> jacobians(const SystemInput& input)
{
	std::vector<Row> all(input.m_rows.size(), Row(6 * input.m_bodies.size(), 0.));
	const auto cross = [](const double* a, const double* b, int i)
	{ return a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]; };
	for (const SystemInput::Unit& unit : input.m_units)
		for (int r = 0; r < unit.getNumPlainRows(); ++r)
			for (int side = 0; side < 2; ++side)
			{
				if (unit.m_body[side] < 0)
					continue;
				double* to = &all[size_t(unit.m_firstRow + r)][6 * size_t(unit.m_body[side])];
				const double sign = side == 0 ? 1 : -1;
				const double* axis = unit.m_axis[unit.m_dof[r] % 3];
				for (int i = 0; i < 3; ++i)
					if (unit.m_dof[r] < 3)
					{
						to[i] = sign * axis[i];
						to[3 + i] = sign * cross(unit.m_arm[side], axis, i);
					}
					else
						to[3 + i] = sign * axis[i];
			}
	for (const SystemInput::Unit& unit : input.m_units)
		for (int f = 0; f < unit.m_numFibres; ++f)
			for (int side = 0; side < 2; ++side)
			{
				if (unit.m_body[side] < 0)
					continue;
				// A row through the fibre's own place has the arms there.
				const SystemInput::Fibre& fibre = input.m_fibres[size_t(unit.m_firstFibre + f)];
				double* to = &all[size_t(unit.getFirstFibreRow() + f)][6 * size_t(unit.m_body[side])];
				double arm[3];
				for (int i = 0; i < 3; ++i)
					arm[i] = unit.m_arm[side][i] + fibre.m_y * unit.m_axis[1][i] + fibre.m_z * unit.m_axis[2][i];
				for (int i = 0; i < 3; ++i)
				{
					to[i] = (side == 0 ? 1 : -1) * unit.m_axis[0][i];
					to[3 + i] = (side == 0 ? 1 : -1) * cross(arm, unit.m_axis[0], i);
				}
			}
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		for (int side = 0; side < 2; ++side)
			for (int i = 0; i < 6 && row.m_body[side] >= 0; ++i)
				all[size_t(row.m_row)][6 * size_t(row.m_body[side]) + size_t(i)] = row.m_J[6 * side + i];
	return all;
}

/// M^-1 x of all bodies.
Row overMass(const SystemInput& input, Row x)
{
	for (size_t b = 0; b < input.m_bodies.size(); ++b)
	{
		const SystemInput::Body& body = input.m_bodies[b];
		for (size_t i = 0; i < 3; ++i)
			x[6 * b + i] /= body.m_mass[i];
		// Cramer's rule.
		const double* I = body.m_inertia;
		const auto det = [](const double* m)
		{
			return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
				   m[2] * (m[3] * m[7] - m[4] * m[6]);
		};
		double solution[3];
		for (int c = 0; c < 3; ++c)
		{
			double replaced[9];
			std::copy(I, I + 9, replaced);
			for (int r = 0; r < 3; ++r)
				replaced[3 * r + c] = x[6 * b + 3 + size_t(r)];
			solution[c] = det(replaced) / det(I);
		}
		std::copy(solution, solution + 3, &x[6 * b + 3]);
	}
	return x;
}

double dot(const Row& a, const Row& b)
{
	double sum = 0;
	for (size_t i = 0; i < a.size(); ++i)
		sum += a[i] * b[i];
	return sum;
}

/// C lambda of all rows beside its diagonal.
double coupled(const SystemInput& input, size_t i, const Row& impulses)
{
	const SystemInput::Bounded& row = input.m_rows[i];
	if (row.m_partner >= 0)
		return row.m_coupling * impulses[size_t(row.m_partner)];
	double sum = 0;
	for (const SystemInput::Bundle& bundle : input.m_bundles)
		for (int s = 0; s < 2; ++s)
		{
			const SystemInput::Unit& unit = input.m_units[size_t(bundle.m_unit)];
			for (int f = 0; f < unit.m_numFibres && bundle.m_shearRow[s] >= 0; ++f)
			{
				const double coupling = input.m_couplings[size_t(bundle.m_firstCoupling + f)].m_shear[s];
				if (int(i) == bundle.m_shearRow[s])
					sum += coupling * impulses[size_t(unit.getFirstFibreRow() + f)];
				if (int(i) == unit.getFirstFibreRow() + f)
					sum += coupling * impulses[size_t(bundle.m_shearRow[s])];
			}
		}
	return sum;
}

/// Impulses by projected Gauss-Seidel, and the velocities they give.
void reference(const SystemInput& input, Row& impulses, Row& velocity)
{
	const std::vector<Row> J = jacobians(input);
	std::vector<Row> MJ;
	for (const Row& row : J)
		MJ.push_back(overMass(input, row));
	impulses.assign(J.size(), 0.);
	velocity.assign(6 * input.m_bodies.size(), 0.);
	double change = 1;
	for (int sweep = 0; sweep < 200000 && change > 1e-15; ++sweep)
	{
		change = 0;
		for (size_t i = 0; i < J.size(); ++i)
		{
			const SystemInput::Bounded& row = input.m_rows[i];
			const double rest =
				row.m_target - dot(J[i], velocity) - row.m_compliance * impulses[i] - coupled(input, i, impulses);
			const double wanted = impulses[i] + rest / (dot(J[i], MJ[i]) + row.m_compliance);
			const double next = std::max(row.m_lower, std::min(row.m_upper, wanted));
			for (size_t k = 0; k < velocity.size(); ++k)
				velocity[k] += MJ[i][k] * (next - impulses[i]);
			change = std::max(change, std::fabs(next - impulses[i]));
			impulses[i] = next;
		}
	}
	ASSERT_LE(change, 1e-15);
}

// Both solve the same strictly convex problem in double: what is left is the conditioning, some 1e3, times rounding, and the
// sweeps' last change over one less their rate of convergence.
const double EXACT = 1e-10;

TEST(System, AgreesWithADenseReference)
{
	// Bounds that nothing reaches, that half of the rows reach, that nearly all do.
	for (const double tightness : {1e6, 0.3, 0.01})
		for (const int numBodies : {2, 5, 12})
			for (unsigned seed = 1; seed <= 20; ++seed)
			{
				const Kind kinds[] = {PLAIN, PAIRS, FIBRES, BUNDLES};
				SystemInput input = randomChain(numBodies, tightness, seed, kinds[(seed - 1) / 5]);
				Row impulses, velocity;
				reference(input, impulses, velocity);
				btElasticPlasticStatistics statistics;
				System system(statistics);
				int islandId = 0;
				ASSERT_TRUE(system.solve(input, islandId, System::EXACT));
				for (int i = 0; i < input.getNumRows(); ++i)
				{
					EXPECT_NEAR(impulses[size_t(i)], system.getImpulse(i), EXACT) << numBodies << " bodies, row " << i;
					const SystemInput::Bounded& row = input.m_rows[size_t(i)];
					const int bound = *system.getBounds(i);
					EXPECT_EQ(bound > 0   ? row.m_upper
							  : bound < 0 ? row.m_lower
										  : system.getImpulse(i),
							  system.getImpulse(i));
				}
				for (int b = 0; b < numBodies; ++b)
					for (int k = 0; k < 6; ++k)
						EXPECT_NEAR(velocity[size_t(6 * b + k)], system.getVelocityChange(b)[k], EXACT);
			}
}

/// All blocks of H for bounds, assembled from nothing.
std::vector<double> assembledAnew(const SystemInput& input, btElasticPlastic::AdmissibleBox box)
{
	btElasticPlasticStatistics statistics;
	btElasticPlastic::LinearSolver solver(statistics);
	btElasticPlastic::SystemMatrix matrix(solver);
	matrix.begin(input, 0, 1);
	matrix.assemble(input, box);
	const double* const values = solver.getMatrix().getValues();
	return std::vector<double>(values, values + 36 * solver.getMatrix().getNumBlocks());
}

TEST(System, TheMatrixOfFewChangesIsThatOfAllToTheBit)
{
	for (const Kind kind : {PLAIN, PAIRS, FIBRES, BUNDLES})
		for (unsigned seed = 0; seed < 20; ++seed)
		{
			const int numBodies = 12;
			const SystemInput input = randomChain(numBodies, 1, seed, kind);
			btElasticPlasticStatistics statistics;
			btElasticPlastic::LinearSolver solver(statistics);
			btElasticPlastic::SystemMatrix matrix(solver);
			btElasticPlastic::AdmissibleBox box;
			box.begin(input);
			matrix.begin(input, 0, 1);
			matrix.assemble(input, box);
			// Rows of the unit between two bodies, and of the loop between the ends, begin to flow.
			const int changed = 1 + int(seed) % (numBodies - 2);
			std::vector<double> impulses;
			std::vector<signed char> bounds;
			box.getResult(impulses, bounds);
			bounds[size_t(input.m_units[size_t(changed)].m_firstRow)] = 1;
			if (seed % 2)
				bounds[size_t(input.m_singleRows[0].m_row)] = -1;
			box.setResult(impulses, bounds);
			// What is far from them is left alone, even if somebody has spoilt it.
			const int far = (changed + 5) % (numBodies - 2) + 1;
			double& spoilt = solver.getMatrix().diagonal(far)[0];
			const double right = spoilt;
			spoilt = -1;
			matrix.assemble(input, box);
			EXPECT_EQ(-1, spoilt) << "kind " << kind << ", seed " << seed;
			spoilt = right;
			const std::vector<double> anew = assembledAnew(input, box);
			const double* const values = solver.getMatrix().getValues();
			EXPECT_TRUE(std::equal(anew.begin(), anew.end(), values)) << "kind " << kind << ", seed " << seed;
			// If more than bounds has changed, nothing of before is taken for right.
			spoilt = -1;
			matrix.forget();
			matrix.assemble(input, box);
			EXPECT_EQ(right, spoilt);
		}
}

TEST(System, BeginsWithTheBoundsOfTheLastSolution)
{
	SystemInput input = randomChain(12, 0.05, 3);
	btElasticPlasticStatistics statistics;
	System system(statistics);
	int islandId = 0;
	ASSERT_TRUE(system.solve(input, islandId, System::EXACT));
	EXPECT_GT(statistics.m_newtonSteps, 0);
	for (int i = 0; i < input.getNumRows(); ++i)
		input.m_guess[size_t(i)].m_bound = *system.getBounds(i);
	statistics = btElasticPlasticStatistics();
	ASSERT_TRUE(system.solve(input, islandId, System::EXACT));
	EXPECT_EQ(0, statistics.m_newtonSteps);
	EXPECT_EQ(1, statistics.m_factorisations);
}

TEST(System, FindsFewChangesOfBoundsWithTheGuessesFactor)
{
	// By Newton's method it were 3 to 18 factors by search, 155 in all.
	int numChanged = 0;
	long long numFactors = 0;
	for (const Kind kind : {PLAIN, PAIRS, FIBRES})
		for (unsigned seed = 1; seed <= 8; ++seed)
		{
			SCOPED_TRACE(seed);
			const int numBodies = System::FEW_BODIES + 1;
			SystemInput input = randomChain(numBodies, 0.1, seed, kind);
			btElasticPlasticStatistics statistics;
			System system(statistics);
			int islandId = 0;
			ASSERT_TRUE(system.solve(input, islandId, System::EXACT));
			std::mt19937 random(seed);
			for (int i = 0; i < input.getNumRows(); ++i)
				input.m_guess[size_t(i)].m_bound = *system.getBounds(i);
			for (int k = 0; k < 10; ++k)
				input.m_rows[random() % input.m_rows.size()].m_target *= -2;
			statistics = btElasticPlasticStatistics();
			ASSERT_TRUE(system.solve(input, islandId, System::EXACT));
			numFactors += statistics.m_factorisations;
			for (int i = 0; i < input.getNumRows(); ++i)
				numChanged += *system.getBounds(i) != input.m_guess[size_t(i)].m_bound;
			Row impulses, velocity;
			reference(input, impulses, velocity);
			for (int i = 0; i < input.getNumRows(); ++i)
				EXPECT_NEAR(impulses[size_t(i)], system.getImpulse(i), EXACT) << "row " << i;
		}
	// The guess's, and one to end with; two searches may have one more.
	EXPECT_LE(numFactors, 2 * 24 + 2);
	// Some in each, to and fro.
	EXPECT_GT(numChanged, 3 * 24);
}

/// 1/2 lambda^T (A + C) lambda - b^T lambda: what bodies and springs have more after the step.
double energyGained(const SystemInput& input, const System& system)
{
	std::vector<double> momentum(6 * input.m_bodies.size(), 0.);
	btElasticPlastic::addImpulses(input, system.getImpulses(0), momentum);
	double sum = 0;
	for (int b = 0; b < input.getNumBodies(); ++b)
		for (int i = 0; i < 6; ++i)
			sum += 0.5 * momentum[6 * b + i] * system.getVelocityChange(b)[i];
	for (int r = 0; r < input.getNumRows(); ++r)
	{
		const SystemInput::Bounded& row = input.m_rows[r];
		const double impulse = system.getImpulse(r);
		sum += (0.5 * row.m_compliance * impulse - row.m_target) * impulse;
	}
	for (const SystemInput::Bundle& bundle : input.m_bundles)
		sum += input.getCouplingEnergy(bundle, system.getResult().m_impulses);
	return sum;
}

TEST(System, ASearchThatIsCutObeysTheBoundsKeepsMomentumAndGainsNoEnergy)
{
	for (unsigned seed = 1; seed <= 50; ++seed)
		for (const int steps : {0, 1, 2})
		{
			SystemInput input = randomChain(12, 0.05, seed, seed % 2 ? PLAIN : BUNDLES);
			btElasticPlasticStatistics statistics;
			System system(statistics);
			btElasticPlasticSolverSettings settings;
			settings.m_maxNewtonSteps = steps;
			settings.m_maxInteriorIterations = 0;
			system.setSettings(settings);
			int islandId = 0;
			EXPECT_TRUE(system.solve(input, islandId, System::EXACT));
			if (steps == 0)
			{
				EXPECT_EQ(1, statistics.m_cutSearches);
			}
			for (int r = 0; r < input.getNumRows(); ++r)
			{
				EXPECT_LE(input.m_rows[r].m_lower, system.getImpulse(r));
				EXPECT_GE(input.m_rows[r].m_upper, system.getImpulse(r));
			}
			std::vector<double> change, momentum(6 * input.m_bodies.size(), 0.), product(momentum.size());
			for (int b = 0; b < input.getNumBodies(); ++b)
				change.insert(change.end(), system.getVelocityChange(b), system.getVelocityChange(b) + 6);
			btElasticPlastic::multiplyMass(input, change, product);
			btElasticPlastic::addImpulses(input, system.getImpulses(0), momentum);
			// Rounding of sums of a dozen terms of about 1.
			for (size_t i = 0; i < momentum.size(); ++i)
				EXPECT_NEAR(momentum[i], product[i], 1e-9);
			EXPECT_LE(energyGained(input, system), 1e-12);
		}
}

TEST(System, TheInteriorPointMethodComesToTheSameSolution)
{
	for (unsigned seed = 1; seed <= 20; ++seed)
	{
		SystemInput input = randomChain(40, 0.02, seed, seed % 2 ? PLAIN : BUNDLES), other = input;
		btElasticPlasticStatistics statistics;
		System plain(statistics), interior(statistics);
		btElasticPlasticSolverSettings settings;
		settings.m_maxInteriorIterations = 0;
		plain.setSettings(settings);
		int islandId = 0;
		EXPECT_TRUE(plain.solve(input, islandId, System::EXACT));
		EXPECT_TRUE(interior.solve(other, islandId, System::EXACT));
		for (int b = 0; b < input.getNumBodies(); ++b)
			for (int i = 0; i < 6; ++i)
				// Both end with the exact solution for the same set of bounds.
				EXPECT_NEAR(plain.getVelocityChange(b)[i], interior.getVelocityChange(b)[i], 1e-9) << seed;
		EXPECT_EQ(0, statistics.m_cutSearches);
	}
}

/// A body of 2 kg that falls at 3 m/s on the ground, with friction in one direction, along which it slides at 1 m/s.
SystemInput slidingBody(double friction)
{
	SystemInput input;
	SystemInput::Body& body = input.addBody();
	for (int i = 0; i < 3; ++i)
		body.m_mass[i] = 2;
	for (int i = 0; i < 9; ++i)
		body.m_inertia[i] = i % 4 == 0 ? 1 : 0;
	const double target[2] = {3, -1};
	for (int r = 0; r < 2; ++r)
	{
		SystemInput::SingleRow& row = input.addSingleRow();
		std::fill(row.m_J, row.m_J + 12, 0.);
		row.m_J[r] = 1;
		row.m_body[0] = 0;
		row.m_body[1] = -1;
		row.m_isContact = true;
		row.m_softening = 0.005;
		row.m_normal = r == 0 ? -1 : 0;
		row.m_friction = r == 0 ? 0 : friction;
		input.m_rows[size_t(row.m_row)] = {target[r], 1e-12 + row.m_softening, 0, 1e30};
	}
	return input;
}

TEST(System, ContactsAreHardAndFrictionIsBoundedByThem)
{
	for (const double friction : {0.1, 1.})
	{
		SystemInput input = slidingBody(friction);
		btElasticPlasticStatistics statistics;
		System system(statistics);
		int islandId = 0;
		ASSERT_TRUE(system.solve(input, islandId, System::EXACT));
		// The normal impulse stops the fall, 2 kg x 3 m/s; friction takes 0.1 of it, or what stops the sliding, 2 N s.
		// Contacts are solved to a thousandth of the fastest approach.
		EXPECT_NEAR(6, system.getImpulse(0), 2 * 3e-3);
		EXPECT_NEAR(friction < 0.2 ? -0.6 : -2, system.getImpulse(1), 2 * 3e-3);
		EXPECT_EQ(0, statistics.m_looseContacts);
	}
}
}  // namespace testSystem
