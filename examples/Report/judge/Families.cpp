// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "judge/Families.h"

namespace ep
{
const std::vector<Named<Family>>& families()
{
	static const std::vector<Named<Family>> all = {
		{"our joints, our solver, profile", {Scheme::Profile}},
		{"our joints, our solver, inner steps", {Scheme::InnerSteps}},
		{"our joints, our solver, direct", {Scheme::Default, ReportSolver::Direct}},
		{"our joints, our solver, iterative", {Scheme::Default, ReportSolver::Iterative}},
		{"our joints, Bullet's solver", {Scheme::Default, ReportSolver::Stock}},
		{"our joints, Bullet's NNCG", {Scheme::Default, ReportSolver::Nncg}},
		{"our joints, Bullet's MLCP", {Scheme::Default, ReportSolver::Mlcp}},
		{"the paper's scheme", {Scheme::Paper}},
		{"Bullet's fixed joint", {Scheme::BulletFixed}},
		{"Bullet's 6-dof spring 2", {Scheme::BulletSpring2}},
		{"ODE's fixed joint, direct", {Scheme::OdeFixed, ReportSolver::OdeStep}},
		{"ODE's fixed joint, QuickStep", {Scheme::OdeFixed, ReportSolver::OdeQuickStep}},
		{"ODE's springs, direct", {Scheme::OdeSoft, ReportSolver::OdeStep}},
		{"ODE's springs, QuickStep", {Scheme::OdeSoft, ReportSolver::OdeQuickStep}}};
	return all;
}

std::vector<Named<Family>> familiesOf(const ByProblem& problems)
{
	const auto isIn = [&problems](const Family& family)
	{
		for (const auto& problem : problems.records)
			for (const Record* r : problem.second)
				if (r->family() == family)
					return true;
		return false;
	};
	std::vector<Named<Family>> some;
	for (const Named<Family>& family : families())
		if (isIn(family.value))
			some.push_back(family);
	return some;
}
}  // namespace ep
