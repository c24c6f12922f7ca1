// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "judge/ByProblem.h"

namespace ep
{
ByProblem::ByProblem(const std::vector<Record>& all)
{
	for (const Record& r : all)
	{
		// Each problem is judged by its first quantity.
		if (!records.count(r.problem))
		{
			names.push_back(r.problem);
			quantity[r.problem] = r.quantity;
		}
		Selection& selection = records[r.problem];
		if (r.quantity == quantity[r.problem])
			selection.push_back(&r);
	}
}
}  // namespace ep
