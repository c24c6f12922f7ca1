// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "collect/Choices.h"

namespace ep
{
const std::vector<Named<Precision>>& precisions()
{
	static const std::vector<Named<Precision>> all = {{"double", Precision::Double}, {"float", Precision::Float}};
	return all;
}

const std::vector<Named<ReportSolver>>& reportSolvers()
{
	static const std::vector<Named<ReportSolver>> all = {{"stock", ReportSolver::Stock},
														 {"nncg", ReportSolver::Nncg},
														 {"mlcp", ReportSolver::Mlcp},
														 {"iterative", ReportSolver::Iterative},
														 {"direct", ReportSolver::Direct},
														 {"ode-step", ReportSolver::OdeStep},
														 {"ode-quickstep", ReportSolver::OdeQuickStep}};
	return all;
}

ReportSolver reportSolverOf(Solver solver)
{
	switch (solver)
	{
		case Solver::Stock:
			return ReportSolver::Stock;
		case Solver::Nncg:
			return ReportSolver::Nncg;
		case Solver::Mlcp:
			return ReportSolver::Mlcp;
		case Solver::Iterative:
			return ReportSolver::Iterative;
		case Solver::Direct:
			break;
	}
	return ReportSolver::Direct;
}

bool iterates(ReportSolver solver)
{
	return solver != ReportSolver::Mlcp && solver != ReportSolver::Direct && solver != ReportSolver::OdeStep;
}

const std::vector<Named<Scheme>>& schemes()
{
	static const std::vector<Named<Scheme>> all = {{"default", Scheme::Default},
												   {"paper", Scheme::Paper},
												   {"bullet-fixed", Scheme::BulletFixed},
												   {"bullet-spring2", Scheme::BulletSpring2},
												   {"ode-fixed", Scheme::OdeFixed},
												   {"ode-soft", Scheme::OdeSoft},
												   {"inner steps", Scheme::InnerSteps},
												   {"profile", Scheme::Profile},
												   {"everything", Scheme::Everything},
												   {"without elasticity", Scheme::WithoutElasticity},
												   {"without shear rows", Scheme::WithoutShear},
												   {"without torsion rows", Scheme::WithoutTorsion},
												   {"without contact coupling", Scheme::WithoutContactCoupling},
												   {"without continuous collision", Scheme::WithoutContinuousCollision},
												   {"without direct solve", Scheme::WithoutDirectSolve},
												   {"independent bounds", Scheme::WithoutInteraction},
												   {"4 fibres", Scheme::Fibres4},
												   {"8 fibres", Scheme::Fibres8},
												   {"16 fibres", Scheme::Fibres16},
												   {"60 fibres", Scheme::Fibres60}};
	return all;
}

const std::vector<Named<std::optional<JointClass>>>& jointClasses()
{
	static const std::vector<Named<std::optional<JointClass>>> all = {
		{"spring", JointClass::Spring}, {"spring2", JointClass::Spring2}, {"-", std::nullopt}};
	return all;
}
}  // namespace ep
