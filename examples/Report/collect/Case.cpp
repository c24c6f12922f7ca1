// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "collect/Case.h"

namespace ep
{
std::string Case::name() const
{
	const std::string end = "." + nameOf(precisions(), precision);
	if (problem == STABILITY)
		return problem + end;
	return problem + "." + std::to_string(rate) + "x" + std::to_string(substeps) + end;
}

namespace
{
struct Stepped
{
	int rate, substeps;
};
const Stepped QUICK[] = {{60, 1}, {240, 1}, {60, 8}};
const Stepped FULL[] = {{30, 1},   {60, 1}, {120, 1}, {240, 1}, {480, 1}, {960, 1},
						{1920, 1}, {60, 2}, {60, 4},  {60, 8},  {60, 16}, {60, 32}};
}  // namespace

std::vector<Case> casesOf(const std::vector<std::string>& problems, const std::vector<Precision>& precisions,
						  bool quick)
{
	std::vector<Case> cases;
	for (const std::string& problem : problems)
		for (const Precision precision : precisions)
		{
			if (problem == Case::STABILITY)
			{
				cases.push_back({problem, precision});
				continue;
			}
			const Stepped* const begin = quick ? QUICK : FULL;
			const Stepped* const end = quick ? std::end(QUICK) : std::end(FULL);
			for (const Stepped* s = begin; s != end; ++s)
				cases.push_back({problem, precision, s->rate, s->substeps});
		}
	return cases;
}
}  // namespace ep
