// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "page/Pictures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "judge/Families.h"
#include "page/Grid.h"
#include "judge/Judgement.h"
#include "plot/Plot.h"

namespace ep
{
Selection comparedOf(const Selection& records)
{
	Selection compared;
	for (const Record* r : records)
		for (const Named<Family>& family : families())
			if (r->family() == family.value)
				compared.push_back(r);
	return compared;
}

namespace
{
/// Below what a picture can tell, and above what is of any use, all are the same.
double shownError(const Record& r) { return std::min(std::max(r.error, 1e-6), 1e2); }

/// What a family has of numbers, each method by itself from its coarsest step to its finest: steps of their own, and substeps of a
/// frame, which begin with the frame as one step.
std::vector<Selection> methodsOf(const Family& family, const Selection& records)
{
	enum Way
	{
		STEPS,
		SUBSTEPS
	};
	std::map<std::pair<decltype(std::declval<Record>().method()), Way>, Selection> methods;
	const auto isFrame = [&records](const Record* r)
	{
		return std::any_of(records.begin(), records.end(),
						   [r](const Record* other) { return other->substeps > 1 && other->dt == r->dt; });
	};
	for (const Record* r : records)
		if (r->family() == family && std::isfinite(r->error))
			for (const Way way : {STEPS, SUBSTEPS})
				if (way == STEPS ? r->substeps == 1 : r->substeps > 1 || isFrame(r))
					methods[{r->method(), way}].push_back(r);
	std::vector<Selection> list;
	for (auto& method : methods)
	{
		std::sort(method.second.begin(), method.second.end(),
				  [](const Record* a, const Record* b) { return a->substep() > b->substep(); });
		list.push_back(method.second);
	}
	return list;
}
}  // namespace

std::string problemPicture(const std::string& name, const Selection& records)
{
	Plot plot;
	plot.m_title = name;
	plot.m_xLabel = "run time per simulated second [s]";
	plot.m_yLabel = "relative error";
	plot.m_logX = plot.m_logY = true;
	int color = 0;
	for (const Named<Family>& family : families())
	{
		std::string label = family.name;
		for (const Selection& method : methodsOf(family.value, records))
		{
			Plot::Curve curve{label, {}, Plot::JOINED, color, {}};
			for (const Record* r : method)
			{
				curve.m_points.emplace_back(r->cost(), shownError(*r));
				curve.m_tips.push_back(r->setting() + ": " + percent(r->error) + " of " + r->quantity);
			}
			plot.m_curves.push_back(curve);
			label.clear();
		}
		++color;
	}
	Plot::Curve front{"nothing better and quicker", {}, Plot::RINGS, 7, {}};
	for (const Record* r : nonDominated(records))
		front.m_points.emplace_back(r->cost(), shownError(*r));
	plot.m_curves.push_back(front);
	return plot.svg();
}
}  // namespace ep
