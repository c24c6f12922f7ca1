#include "Html.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "Judgement.h"
#include "plot.h"

namespace ep
{
namespace
{
struct Family
{
	const char* key;
	const char* name;
};
const Family FAMILIES[] = {
	{"direct", "our joints, our solver, direct"}, {"iterative", "our joints, our solver, iterative"},
	{"stock", "our joints, Bullet's solver"},     {"nncg", "our joints, Bullet's NNCG"},
	{"mlcp", "our joints, Bullet's MLCP"},        {"paper", "the paper's scheme"},
	{"bullet-fixed", "Bullet's fixed joint"},     {"bullet-spring2", "Bullet's 6-dof spring 2"}};

typedef std::vector<const Record*> Selection;

std::string percent(double share)
{
	char text[32];
	if (!std::isfinite(share))
		return "–";
	snprintf(text, sizeof text, share < 1e-5 ? "%.0e %%" : share < 0.0995 ? "%.2g %%" : "%.0f %%", 100 * share);
	return text;
}

std::string microseconds(double seconds)
{
	char text[32];
	snprintf(text, sizeof text, "%.3g ms", 1e3 * seconds);
	return text;
}

Plot errorOverTime(const std::string& problem, const Selection& records)
{
	Plot plot;
	plot.m_title = problem;
	plot.m_xLabel = "run time per simulated second [s]";
	plot.m_yLabel = "relative error";
	plot.m_logX = plot.m_logY = true;
	int color = 0;
	for (const Family& family : FAMILIES)
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
			<< (best ? microseconds(best->cost()) : "") << "</td></tr>\n";
	}
	out << "</table>\n";
}

void families(std::ostream& out, const Selection& records)
{
	out << "<table><tr><th>Family</th><th>Error at 1/60 s</th><th>Least error</th><th>Order of convergence</th>"
		   "<th>Energy created, most</th></tr>\n";
	for (const Family& family : FAMILIES)
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

/// Green to red by the order of magnitude.
const char* shadeOf(double error)
{
	return error <= 0.001  ? "#1a9850"
		   : error <= 0.01 ? "#91cf60"
		   : error <= 0.1  ? "#fee08b"
		   : error <= 1    ? "#fc8d59"
						   : "#d73027";
}

/// Each family's error at the game's step, all problems in one look.
void overview(std::ostream& out, const std::vector<std::string>& names,
			  const std::map<std::string, Selection>& byProblem)
{
	out << "<h2>At the game's step</h2><p>Relative error at 1/60 s without substeps, iterative solvers with 10 "
		   "iterations.</p>"
		   "<table><tr><th>Problem</th>";
	for (const Family& family : FAMILIES)
		out << "<th>" << family.name << "</th>";
	out << "</tr>\n";
	for (const std::string& name : names)
	{
		out << "<tr><td><a href=\"#" << name << "\">" << name << "</a></td>";
		for (const Family& family : FAMILIES)
		{
			double error = NAN;
			for (const Record* r : byProblem.at(name))
				if (r->family() == family.key && r->substeps == 1 && std::lround(1 / r->dt) == 60 &&
					r->iterations == 10 && r->jointClass == "spring2" && r->precision == "float")
					error = r->error;
			out << "<td style=\"background:" << (std::isnan(error) ? "#eee" : shadeOf(error)) << "\">"
				<< (std::isnan(error) ? "" : percent(error)) << "</td>";
		}
		out << "</tr>\n";
	}
	out << "</table>\n";
}
}  // namespace

std::string htmlOf(const std::vector<Record>& records, const std::vector<std::pair<std::string, std::string>>& stamp)
{
	// Each problem is judged by its first quantity.
	std::vector<std::string> names;
	std::map<std::string, Selection> byProblem;
	std::map<std::string, std::string> quantity;
	for (const Record& r : records)
	{
		if (!byProblem.count(r.problem))
		{
			names.push_back(r.problem);
			quantity[r.problem] = r.quantity;
		}
		Selection& selection = byProblem[r.problem];
		if (r.quantity == quantity[r.problem])
			selection.push_back(&r);
	}
	std::ostringstream out;
	out << "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><title>Error against run time</title>\n"
		   "<style>body{font:15px sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222}"
		   "table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #ccc;padding:3px 8px;text-align:left}"
		   "th{background:#f4f4f4}svg{width:100%;height:auto}</style>\n"
		   "<h1>Error against run time</h1>\n<table>";
	for (const auto& line : stamp)
		out << "<tr><td>" << line.first << "</td><td>" << line.second << "</td></tr>";
	out << "</table>\n";
	overview(out, names, byProblem);
	for (const std::string& name : names)
	{
		const Selection& selection = byProblem[name];
		out << "<h2 id=\"" << name << "\">" << name << "</h2><p>" << quantity[name] << "</p>\n"
			<< errorOverTime(name, selection).svg();
		budgets(out, selection);
		families(out, selection);
	}
	out << "</html>\n";
	return out.str();
}
}  // namespace ep
