// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "judge/Families.h"

#include <set>

namespace ep
{
const std::vector<Family>& families()
{
	static const std::vector<Family> all = {{"profile", "our joints, our solver, profile"},
											{"direct", "our joints, our solver, direct"},
											{"iterative", "our joints, our solver, iterative"},
											{"stock", "our joints, Bullet's solver"},
											{"nncg", "our joints, Bullet's NNCG"},
											{"mlcp", "our joints, Bullet's MLCP"},
											{"paper", "the paper's scheme"},
											{"bullet-fixed", "Bullet's fixed joint"},
											{"bullet-spring2", "Bullet's 6-dof spring 2"},
											{"ode-fixed ode-step", "ODE's fixed joint, direct"},
											{"ode-fixed ode-quickstep", "ODE's fixed joint, QuickStep"},
											{"ode-soft ode-step", "ODE's springs, direct"},
											{"ode-soft ode-quickstep", "ODE's springs, QuickStep"}};
	return all;
}

std::vector<Family> familiesOf(const ByProblem& problems)
{
	std::set<std::string> present;
	for (const auto& problem : problems.records)
		for (const Record* r : problem.second)
			present.insert(r->family());
	std::vector<Family> some;
	for (const Family& family : families())
		if (present.count(family.key))
			some.push_back(family);
	return some;
}
}  // namespace ep
