// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// A problem's own section: error over run time, budgets, families.

#include <algorithm>
#include <cmath>

#include "judge/Families.h"
#include "page/Grid.h"
#include "page/Sections.h"
#include "judge/Judgement.h"
#include "page/Pictures.h"
#include "text/Markup.h"

namespace ep
{
namespace
{
std::string milliseconds(double seconds)
{
	char text[32];
	snprintf(text, sizeof text, "%.3g ms", 1e3 * seconds);
	return text;
}

void budgets(std::ostream& out, const Selection& records)
{
	// Whoever uses Bullet has a choice of its settings, not of engines. NNCG may be quick here and blow up the next scene.
	Selection bullets, outside;
	for (const Record* r : records)
		if (r->solver != ReportSolver::Nncg)
			(r->isOutside() ? outside : bullets).push_back(r);
	const char* const heads = "</th><th>Error</th><th>Run time per second</th>";
	out << "<table><tr><th>Error allowed</th><th>Recommended setting" << heads;
	if (!outside.empty())
		out << "<th>Of another engine" << heads;
	out << "</tr>\n";
	for (const double budget : {0.1, 0.01, 0.001})
	{
		out << "<tr><td>" << percent(budget) << "</td>";
		for (const Selection* choice : {&bullets, &outside})
		{
			if (choice->empty())
				continue;
			const Record* best = quickestReliable(*choice, budget);
			out << "<td>" << (best ? best->setting() : "none of those tried") << "</td><td>"
				<< (best ? percent(best->error) : "") << "</td><td>" << (best ? milliseconds(best->cost()) : "")
				<< "</td>";
		}
		out << "</tr>\n";
	}
	out << "</table>\n<p>Recommended is the quickest that keeps to the error with every finer step as well, "
		   "without NNCG, which is not safe; the profile finds the step by itself.</p>\n";
	if (!outside.empty())
		out << "<p>ODE's fixed joints have its default ERP and CFM and hardly give way. Its springs are ball joints "
			   "and angular motors that ERP and CFM give the section's stiffness; a fixed joint cannot be given one "
			   "for rotations.</p>\n";
}

void writeFamilies(std::ostream& out, const Selection& records)
{
	out << "<table><tr><th>Family</th><th>Error at 1/60 s</th><th>Least error</th><th>Order of convergence</th>"
		   "<th>Energy created, most</th></tr>\n";
	for (const Named<Family>& family : families())
	{
		double least = HUGE_VAL, created = 0;
		const Record* coarse = nullptr;
		bool has = false, audited = false;
		for (const Record* r : records)
		{
			if (r->family() != family.value)
				continue;
			has = true;
			least = std::min(least, r->error);
			if (r->substeps == 1 && std::lround(1 / r->dt) == 60 && r->iterations == 10)
				coarse = coarse && coarse->error <= r->error ? coarse : r;
			if (std::isfinite(r->energyAudit))
			{
				created = std::max(created, r->energyAudit);
				audited = true;
			}
		}
		if (!has)
			continue;
		const double order = orderOf(records, family.value);
		char text[32] = "–";
		if (std::isfinite(order))
			snprintf(text, sizeof text, "%.1f", order);
		out << "<tr><td>" << family.name << "</td><td>"
			<< (coarse ? percent(coarse->error) + " of " + escaped(coarse->quantity) : percent(HUGE_VAL)) << "</td><td>"
			<< percent(least) << "</td><td>" << text << "</td><td>" << (audited ? percent(created) : "–")
			<< "</td></tr>\n";
	}
	out << "</table>\n";
}

}  // namespace

void writeProblem(std::ostream& out, const std::string& name, const Selection& records, const std::string& view)
{
	const Selection compared = comparedOf(records);
	out << "<div class=\"beside\">" << problemPicture(name, compared);
	if (!view.empty())
		out << "<img alt=\"" << escaped(name) << "\" src=\"data:image/png;base64," << view << "\">";
	out << "</div>\n";
	budgets(out, compared);
	writeFamilies(out, compared);
}
}  // namespace ep
