// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "page/Pictures.h"

#include <algorithm>
#include <cmath>

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
		Plot::Curve curve{family.name, {}, Plot::MARKS, color++, {}};
		for (const Record* r : records)
			if (r->family() == family.value && std::isfinite(r->error))
			{
				// Below what a picture can tell, and above what is of any use, all are the same.
				curve.m_points.emplace_back(r->cost(), std::min(std::max(r->error, 1e-6), 1e2));
				curve.m_tips.push_back(r->setting() + ": " + percent(r->error) + " of " + r->quantity);
			}
		if (!curve.m_points.empty())
			plot.m_curves.push_back(curve);
	}
	Plot::Curve front{"nothing better and quicker", {}, Plot::RINGS, 7, {}};
	for (const Record* r : nonDominated(records))
		front.m_points.emplace_back(r->cost(), std::min(std::max(r->error, 1e-6), 1e2));
	plot.m_curves.push_back(front);
	return plot.svg();
}
}  // namespace ep
