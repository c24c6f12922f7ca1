// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What the report concludes from its records.

#include <gtest/gtest.h>

#include <cmath>

#include "judge/Judgement.h"

namespace testJudgement
{
using namespace ep;

/// One second in substeps of 1/60 s, with what it took [s] and its error.
Record recordOf(int substeps, double runTime, double error, ReportSolver solver = ReportSolver::Direct)
{
	Record r = {};
	r.scheme = Scheme::Default;
	r.solver = solver;
	r.jointClass = JointClass::Spring2;
	r.precision = Precision::Double;
	r.iterations = 10;
	r.dt = 1. / 60;
	r.substeps = substeps;
	r.simulated = 1;
	r.runTime = runTime;
	r.error = error;
	return r;
}

std::vector<const Record*> pointersTo(const std::vector<Record>& records)
{
	std::vector<const Record*> pointers;
	for (const Record& r : records)
		pointers.push_back(&r);
	return pointers;
}

TEST(Judgement, LuckIsNoRecommendation)
{
	// Two substeps hit by luck what four miss.
	const std::vector<Record> records = {recordOf(1, 1, 0.48), recordOf(2, 2, 0.033), recordOf(4, 4, 0.044),
										 recordOf(8, 8, 0.013)};
	const auto all = pointersTo(records);
	EXPECT_EQ(&records[1], quickestWithin(all, 0.04));
	EXPECT_EQ(&records[3], quickestReliable(all, 0.04));
	EXPECT_EQ(&records[1], quickestReliable(all, 0.05));
	EXPECT_EQ(nullptr, quickestReliable(all, 0.01));
}

TEST(Judgement, SpreadOfTimesIsThatOfTheMedianCase)
{
	std::vector<Record> records(4, recordOf(1, 1, 0.1));
	records[0].spread = 0.3;
	records[1].spread = NAN;  // timed once
	records[2].spread = 0.02;
	records[3].spread = 0.05;
	EXPECT_EQ(0.05, spreadOfTimes(records));
	EXPECT_TRUE(std::isnan(spreadOfTimes({records[1]})));
}

TEST(Judgement, OneMethodsFailureIsNotAnothers)
{
	const std::vector<Record> records = {recordOf(1, 3, 0.05), recordOf(2, 6, 0.01),
										 recordOf(1, 1, 0.02, ReportSolver::Stock),
										 recordOf(2, 2, NAN, ReportSolver::Stock)};
	EXPECT_EQ(&records[0], quickestReliable(pointersTo(records), 0.1));
}

TEST(Judgement, FrontHasWhatNothingBeats)
{
	const std::vector<Record> records = {recordOf(4, 4, 0.02), recordOf(1, 1, 0.3), recordOf(2, 2, 0.4),
										 recordOf(8, 8, NAN)};
	const std::vector<const Record*> front = nonDominated(pointersTo(records));
	ASSERT_EQ(2u, front.size());
	EXPECT_EQ(&records[1], front[0]);
	EXPECT_EQ(&records[0], front[1]);
}

TEST(Judgement, OrderIsTheSlope)
{
	std::vector<Record> records;
	for (const int rate : {60, 120, 240, 480})
	{
		records.push_back(recordOf(1, 1, 100. / rate / rate));
		records.back().dt = 1. / rate;
	}
	EXPECT_NEAR(2, orderOf(pointersTo(records), {Scheme::Default, ReportSolver::Direct}),
				1e-12);  // exact but for rounding
	EXPECT_TRUE(std::isnan(orderOf(pointersTo(records), {Scheme::Default, ReportSolver::Stock})));
}
}  // namespace testJudgement
