// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Struts.h"

#include <algorithm>

#include "problems/Run.h"
#include "scenes/Strut.h"
#include "text/Format.h"

namespace ep
{
namespace
{
/// At 0.30, 0.58 and 0.87 of Euler's load.
Outcome bucklingStruts(const Method& method, const Stepping& stepping)
{
	const int parts = 8;
	Outcome outcome;
	for (const double slenderness : {30., 45., 60.})
	{
		Strut strut(method, slenderness, parts, Strut::Alloy::material(0), method.fibres);
		const double exact = Strut::Alloy::bucklingStress(slenderness),
					 end = 2 * Strut::Alloy::strain(exact) / Strut::SHORTENING;
		double most = 0;
		{
			Run run(strut.m_world, stepping, outcome);
			while (run.stepsUntil(end) > 0)
			{
				run.step([&] { strut.push(std::min(1., 10 * run.time())); });
				most = std::max(most, strut.pressureAtFoot());
			}
		}
		outcome.quantities.push_back(
			{format("greatest stress at a slenderness of %.0f [Pa]", slenderness), most, exact});
	}
	return outcome;
}
}  // namespace

std::vector<Problem> problemsOfStruts()
{
	return {{"strut-buckles", "struts of aluminium between hinges, pressed until they buckle",
			 "the tangent modulus load (Shanley)", bucklingStruts, true}};
}
}  // namespace ep
