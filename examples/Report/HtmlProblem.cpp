// A problem's own section: error over run time, budgets, families.

#include <algorithm>
#include <cmath>

#include "HtmlParts.h"
#include "Judgement.h"
#include "plot.h"

namespace ep
{
namespace
{
Plot errorOverTime(const std::string& problem, const Selection& records)
{
	Plot plot;
	plot.m_title = problem;
	plot.m_xLabel = "run time per simulated second [s]";
	plot.m_yLabel = "relative error";
	plot.m_logX = plot.m_logY = true;
	int color = 0;
	for (const Family& family : families())
	{
		Plot::Curve curve{family.name, {}, Plot::MARKS, color++, {}};
		for (const Record* r : records)
			if (r->family() == family.key && std::isfinite(r->error))
			{
				// Below what a picture can tell, and above what is of any use, all are the same.
				curve.m_points.emplace_back(r->cost(), std::min(std::max(r->error, 1e-6), 1e2));
				curve.m_tips.push_back(r->setting() + ": " + percent(r->error));
			}
		if (!curve.m_points.empty())
			plot.m_curves.push_back(curve);
	}
	Plot::Curve front{"nothing better and quicker", {}, Plot::RINGS, 7, {}};
	for (const Record* r : nonDominated(records))
		front.m_points.emplace_back(r->cost(), std::min(std::max(r->error, 1e-6), 1e2));
	plot.m_curves.push_back(front);
	return plot;
}

void budgets(std::ostream& out, const Selection& records)
{
	out << "<table><tr><th>Error allowed</th><th>Quickest setting</th><th>Error</th><th>Run time per "
		   "second</th></tr>\n";
	for (const double budget : {0.1, 0.01, 0.001})
	{
		const Record* best = quickestWithin(records, budget);
		out << "<tr><td>" << percent(budget) << "</td><td>" << (best ? best->setting() : "none of those tried")
			<< "</td><td>" << (best ? percent(best->error) : "") << "</td><td>"
			<< (best ? milliseconds(best->cost()) : "") << "</td></tr>\n";
	}
	out << "</table>\n";
}

void writeFamilies(std::ostream& out, const Selection& records)
{
	out << "<table><tr><th>Family</th><th>Error at 1/60 s</th><th>Least error</th><th>Order of convergence</th>"
		   "<th>Energy created, most</th></tr>\n";
	for (const Family& family : families())
	{
		double coarse = HUGE_VAL, least = HUGE_VAL, created = 0;
		bool has = false, audited = false;
		for (const Record* r : records)
		{
			if (r->family() != family.key)
				continue;
			has = true;
			least = std::min(least, r->error);
			if (r->substeps == 1 && std::lround(1 / r->dt) == 60 && r->iterations == 10)
				coarse = std::min(coarse, r->error);
			if (std::isfinite(r->energyAudit))
			{
				created = std::max(created, r->energyAudit);
				audited = true;
			}
		}
		if (!has)
			continue;
		const double order = orderOf(records, family.key);
		char text[32] = "–";
		if (std::isfinite(order))
			snprintf(text, sizeof text, "%.1f", order);
		out << "<tr><td>" << family.name << "</td><td>" << percent(coarse) << "</td><td>" << percent(least)
			<< "</td><td>" << text << "</td><td>" << (audited ? percent(created) : "–") << "</td></tr>\n";
	}
	out << "</table>\n";
}

}  // namespace

void writeProblem(std::ostream& out, const std::string& name, const Selection& records)
{
	// What the profile and the study of parts made has tables of its own.
	Selection compared;
	for (const Record* r : records)
		for (const Family& family : families())
			if (r->family() == family.key)
				compared.push_back(r);
	out << errorOverTime(name, compared).svg();
	budgets(out, compared);
	writeFamilies(out, compared);
}
}  // namespace ep
