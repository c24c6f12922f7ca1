// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "judge/ByProblem.h"

#include <algorithm>

namespace ep
{
ByProblem::ByProblem(const std::vector<Record>& all)
{
	const auto isOfOneCase = [](const Record& a, const Record& b)
	{ return a.method() == b.method() && a.dt == b.dt && a.substeps == b.substeps; };
	for (const Record& r : all)
	{
		if (!records.count(r.problem))
			names.push_back(r.problem);
		Selection& selection = records[r.problem];
		std::vector<std::string>& known = quantities[r.problem];
		if (std::find(known.begin(), known.end(), r.quantity) == known.end())
			known.push_back(r.quantity);
		// The quantities of a case follow each other. What is no number is worst.
		if (selection.empty() || !isOfOneCase(*selection.back(), r))
			selection.push_back(&r);
		else if (!(r.error <= selection.back()->error))
			selection.back() = &r;
	}
}
}  // namespace ep
