// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Catalogue.h"

#include "problems/Bars.h"
#include "problems/Beams.h"
#include "problems/Blows.h"
#include "problems/Curves.h"
#include "problems/HeldBeams.h"
#include "problems/Sections.h"
#include "problems/Struts.h"

namespace ep
{
const std::vector<Problem>& problems()
{
	static const std::vector<Problem> all = []
	{
		std::vector<Problem> list;
		for (const auto& group : {problemsOfBars(), problemsOfBeams(), problemsOfBlows(), problemsOfSections(),
								  problemsOfCurves(), problemsOfHeldBeams(), problemsOfStruts()})
			list.insert(list.end(), group.begin(), group.end());
		return list;
	}();
	return all;
}

const Problem* findProblem(const std::string& name)
{
	for (const Problem& problem : problems())
		if (name == problem.name)
			return &problem;
	return nullptr;
}
}  // namespace ep
