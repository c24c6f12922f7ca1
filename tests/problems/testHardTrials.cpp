// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The hard cases that report and viewer have too, see trials/Trial.h. Those that only tests know are beside this: testHard*.

#include <gtest/gtest.h>

#include "LinearMath/btScalar.h"
#include "trials/Catalogue.h"
#include "support/DirectSolver.h"
#include "support/Repeats.h"

namespace testHardTrials
{
using namespace ep;

class HardTrials : public testing::TestWithParam<Trial>
{
};

TEST_P(HardTrials, DirectSolverIsRight)
{
	// An hour takes two fifths of the time of all: see Long.cmake.
	if (GetParam().name == std::string("an hour at 0.9 of yield") && !repeats(1, 0))
		GTEST_SKIP() << "takes long: with EP_LONG_TESTS only";
	for (const JointClass jointClass : {JointClass::Spring2, JointClass::Spring})
	{
		Method method(Solver::Direct);
		method.jointClass = jointClass;
		long long cutSearches = 0;
		const Watch watch = [&](World& world, double)
		{ cutSearches = std::max(cutSearches, statisticsOf(world).m_cutSearches); };
		const std::string complaint = GetParam().run(method, watch).complaint();
		EXPECT_EQ(0, cutSearches);
		if (GetParam().limitOfFloat && sizeof(btScalar) == 4)
		{
			EXPECT_NE("", complaint) << "no limit any more: " << GetParam().limitOfFloat;
		}
		else
		{
			EXPECT_EQ("", complaint);
		}
	}
}

/// Ten iterations do not hold a stiff structure; but they do not blow it up.
TEST_P(HardTrials, IterationsStayFiniteAndCreateNoEnergy)
{
	if (GetParam().group == std::string("long times") && !repeats(1, 0))
		GTEST_SKIP() << "takes long: with EP_LONG_TESTS only";
	for (const Solver solver : {Solver::Iterative, Solver::Stock})
	{
		const Verdict verdict = GetParam().run(solver);
		EXPECT_TRUE(verdict.isFinite);
		EXPECT_LE(verdict.created, Verdict::CREATED);
	}
}

INSTANTIATE_TEST_SUITE_P(All, HardTrials, testing::ValuesIn(stabilityTrials()),
						 [](const testing::TestParamInfo<Trial>& info)
						 {
							 std::string name;
							 for (const char c : info.param.group + ("_" + info.param.name))
								 name += c == '-' ? "minus"
												  : std::string(1, isalnum(static_cast<unsigned char>(c)) ? c : '_');
							 return name;
						 });
}  // namespace testHardTrials
