// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ODE as an outside competitor of the report: what is known exactly of its direct solver, and that its records are offered.

#include <gtest/gtest.h>
#include <ode/ode.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "scenes/Cantilever.h"
#include "compute/OdeEngine.h"
#include "support/Precision.h"
#include "problems/Catalogue.h"

namespace testOde
{
using namespace ep;
using nlohmann::json;

const char* const PROBLEMS[] = {"cantilever-at-rest", "hanging-chain"};

Method ode(OdeSolver solver, OdeJoints joints)
{
	Method method(Solver::Direct, kinds::None, 10);
	method.engine = makeOde(solver, joints);
	return method;
}

Outcome solve(const char* problem, OdeSolver solver, OdeJoints joints)
{
	Stepping stepping;
	stepping.substeps = 8;
	return findProblem(problem)->solve(ode(solver, joints), stepping);
}

// Statics of springs do not depend on the step, but are exact for small deflections only: the cantilever sags by 5e-4 of its
// length, and what that shortens of its lever counts by the square. Bullet's poses in float are rounded at 2 m to 1e-7 m, of
// 5e-4 m at least.
const double STATICS = byPrecision(1e-6, 1e-3);

TEST(Ode, SpringsOfTheDirectSolverAreExact)
{
	for (const char* problem : PROBLEMS)
	{
		const Outcome outcome = solve(problem, OdeSolver::Step, OdeJoints::Soft);
		EXPECT_LT(outcome.error(), STATICS) << problem;
		EXPECT_GT(outcome.runTime, 0);
		// Nobody has kept ODE's books.
		EXPECT_FALSE(std::isfinite(outcome.energyCreated));
	}
}

// ODE's fixed joint is a spring all the same, kp = ERP / (h CFM) = 0.2 * 480 / 1e-10 = 9.6e11 N/m, against E A / l of the chain's
// links, 4.2e9 N/m, twice that of the first; for the cantilever there is more between.
TEST(Ode, FixedJointsOfTheDirectSolverHardlyGiveWay)
{
	for (const char* problem : PROBLEMS)
	{
		const Quantity sag = solve(problem, OdeSolver::Step, OdeJoints::Fixed).quantities.front();
		EXPECT_LT(std::fabs(sag.value), 0.01 * sag.exact) << problem;
	}
}

TEST(Ode, TakesPosesFromTheSceneAndLeavesThemThere)
{
	Cantilever::Settings settings;
	settings.method = ode(OdeSolver::Step, OdeJoints::Soft);
	settings.turn = btQuaternion(btVector3(1, 2, 3).normalized(), 1);
	Cantilever cantilever(settings);
	for (int i = 0; i < 90; ++i)
		cantilever.m_world.step(btScalar(1) / 60, 8);
	EXPECT_NEAR(double(cantilever.sag()) / cantilever.staticSag(), 1, STATICS);
}

/// What the report's program writes of a problem.
json recordsOf(const std::string& problem)
{
	const std::string file = testing::TempDir() + "ode-" + problem + "-" + std::to_string(::getpid());
	const std::string command =
		std::string(EP_REPORT_CASE) + " --quick --repeats 1 --problem " + problem + " --out " + file;
	EXPECT_EQ(0, std::system(command.c_str())) << command;
	const json records = json::parse(std::ifstream(file), nullptr, false);
	std::remove(file.c_str());
	return records;
}

TEST(Ode, IsRecordedLikeTheOthersInItsOwnPrecision)
{
	const bool isSame = bool(dCheckConfiguration("ODE_double_precision")) == (sizeof(btScalar) == sizeof(double));
	for (const char* problem : PROBLEMS)
	{
		const json records = recordsOf(problem);
		ASSERT_TRUE(records.is_array());
		std::set<std::string> kinds, keys, ours;
		for (const json& record : records)
		{
			std::set<std::string>& those = record.at("joint_class") == "-" ? keys : ours;
			for (const auto& item : record.items())
				those.insert(item.key());
			if (record.at("joint_class") != "-")
				continue;
			kinds.insert(record.at("solver").get<std::string>() + " " + record.at("scheme").get<std::string>());
			EXPECT_EQ(record.at("quantity"), records[0].at("quantity"));
			EXPECT_EQ(record.at("exact"), records[0].at("exact"));
			EXPECT_EQ(record.at("steps"), records[0].at("steps"));
		}
		const std::set<std::string> all = {"ode-step ode-fixed", "ode-quickstep ode-fixed", "ode-step ode-soft",
										   "ode-quickstep ode-soft"};
		EXPECT_EQ(kinds, isSame ? all : std::set<std::string>());
		if (isSame)
		{
			EXPECT_EQ(keys, ours);
		}
	}
	EXPECT_TRUE(odeSettings("portal-sway", 60, 1, true).empty());
}
}  // namespace testOde
