// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The reference problems by the direct solver: their exact answers, in both precisions.

#include <gtest/gtest.h>

#include "problems/Catalogue.h"
#include "support/DirectSolver.h"

namespace testProblems
{
using namespace ep;

/// Largest error of any of a problem's quantities at 1/240 and 1/960 s. Those of one degree of freedom fall by the square of the
/// step once it resolves the motion (period 67 ms), with jumps where yield begins in the middle of a step, and what opposite flows leave,
/// plastic offset or angle, is their small difference; beams and frames
/// have the error of their lumping, of the elastic sway that limit analysis does not know, and of the search for the load (a
/// thousandth each); a cantilever that swings loses its deeper half-periods first; a travelling hinge and a blow on contacts
/// are of first order at best.
/// Sections are as right as the number of fibres that they take by themselves (SectionFibres.*: 2.5 % of the most that a section bears in a
/// direction is up to 3.5 % along a load), of concrete 36, where a thin edge alone is pressed; shear by the half that is observed
/// of the 8 % that it is right within. A beam that hangs on its ends bears by its section alone: the 2.4 % that 16 fibres of a rectangle are
/// off. Beams that are struck stop within a game's step or two, as a body on a bar does, and are of the first order. A strut of eight parts that is pushed out of its line buckles 1 to 3 %
/// early. What a body goes along the axis while it turns is what few fibres tell worst (docs/limits.md).
struct Bound
{
	const char* name;
	double coarse, fine;
};
const Bound BOUNDS[] = {
	{"block-released", 0.05, 0.005},
	{"block-reversed-60kN", 0.25, 0.015},
	{"block-reversed-90kN", 0.045, 0.035},
	{"block-overloaded", 0.01, 0.0025},
	{"sudden-load-1", 0.01, 0.001},
	{"sudden-load-3", 0.02, 0.005},
	{"sudden-load-10", 0.05, 0.005},
	{"twisted-bar", 0.02, 0.002},
	{"cyclic-bending", 0.055, 0.015},
	{"cantilever-at-rest", 0.0001, 0.0001},
	{"cantilever-swinging", 0.01, 0.01},
	{"hanging-chain", 0.001, 0.001},
	{"beam-simple", 0.003, 0.003},
	{"beam-propped", 0.003, 0.003},
	{"beam-fixed", 0.003, 0.003},
	{"beam-simple-uniform", 0.003, 0.003},
	{"beam-propped-uniform", 0.003, 0.003},
	{"beam-fixed-uniform", 0.003, 0.003},
	{"portal-beam", 0.005, 0.005},
	{"portal-sway", 0.005, 0.005},
	{"portal-both", 0.005, 0.005},
	{"hinge-stops-body", 0.015, 0.001},
	{"parkes-heavy", 0.25, 0.1},
	{"parkes-light", 0.6, 0.3},
	{"dropped-mass", 0.12, 0.085},
	{"section-rectangle", 0.035, 0.035},
	{"section-circle", 0.02, 0.02},
	{"section-tube", 0.01, 0.01},
	{"section-i", 0.02, 0.02},
	{"section-concrete", 0.04, 0.04},
	{"section-concrete-beam", 0.04, 0.04},
	{"section-shear", 0.04, 0.04},
	{"hardening-cycle", 0.002, 0.002},
	{"crack-opening", 0.003, 0.0003},
	{"rate-stops-body", 0.13, 0.015},
	{"rod-in-fire", 0.01, 0.01},
	{"beam-held-pushed", 0.03, 0.025},
	{"beam-held-struck", 0.1, 0.025},
	{"beam-of-steel-struck", 0.3, 0.1},
	{"beam-of-concrete-struck", 0.33, 0.1},
	{"body-flies-and-turns", 0.05, 0.03},
	{"strut-buckles", 0.035, 0.035},
};

class Problems : public testing::TestWithParam<Bound>
{
};

TEST_P(Problems, DirectSolverIsRight)
{
	const Bound& bound = GetParam();
	const Problem* problem = findProblem(bound.name);
	ASSERT_TRUE(problem);
	for (const double rate : {240., 960.})
	{
		Stepping stepping;
		stepping.step = 1 / rate;
		long long cutSearches = 0, islands = 0;
		stepping.watch = [&](World& world, double)
		{
			cutSearches = std::max(cutSearches, statisticsOf(world).m_cutSearches);
			islands = std::max(islands, statisticsOf(world).m_islands);
		};
		const Outcome outcome = problem->solve(withoutInnerSteps(), stepping);
		EXPECT_GT(islands, 0);
		EXPECT_EQ(0, cutSearches);
		ASSERT_FALSE(outcome.quantities.empty());
		EXPECT_LT(outcome.error(), rate < 500 ? bound.coarse : bound.fine)
			<< outcome.worst().name << ": " << outcome.worst().value << " instead of " << outcome.worst().exact;
		// Contacts by mean velocities may create a ten-thousandth, rounding in float as much (solver/testContacts.cpp).
		EXPECT_LT(outcome.energyCreated, 1e-3);
		EXPECT_GT(outcome.simulated, 0);
	}
}

INSTANTIATE_TEST_SUITE_P(All, Problems, testing::ValuesIn(BOUNDS),
						 [](const testing::TestParamInfo<Bound>& info)
						 {
							 std::string name = info.param.name;
							 for (char& c : name)
								 c = c == '-' ? '_' : c;
							 return name;
						 });

TEST(ProblemList, IsTestedWhole)
{
	EXPECT_EQ(sizeof BOUNDS / sizeof *BOUNDS, problems().size());
	EXPECT_EQ(nullptr, findProblem("no such problem"));
}
}  // namespace testProblems
