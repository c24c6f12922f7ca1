// ODE as an outside competitor of the report: what is known exactly of its direct solver, and that its records are offered.

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cmath>
#include <set>

#include "Cantilever.h"
#include "OdeEngine.h"
#include "Precision.h"
#include "Problem.h"

namespace
{
using namespace ep;

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

TEST(Ode, IsComparedInItsOwnPrecisionOnWhatItCanPose)
{
	EXPECT_TRUE(odeSettings("portal-sway", 60, 1, true).empty());
	const bool isSame = bool(dCheckConfiguration("ODE_double_precision")) == (sizeof(btScalar) == sizeof(double));
	for (const char* problem : PROBLEMS)
	{
		std::set<std::string> kinds;
		for (const Setting& setting : odeSettings(problem, 60, 1, true))
			kinds.insert(setting.engine + " " + setting.scheme);
		EXPECT_EQ(kinds.size(), isSame ? 4u : 0u);
	}
}
}  // namespace
