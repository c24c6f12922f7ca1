// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "page/Page.h"

#include <sstream>

#include "page/Sections.h"
#include "page/Tables.h"
#include "text/Markup.h"

namespace ep
{
std::string htmlOf(const ByProblem& problems, const std::vector<TrialRecord>& trials, const Page& page)
{
	std::ostringstream out;
	out << "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><title>Error against run time</title>\n"
		   "<style>body{font:15px sans-serif;max-width:1500px;margin:2em auto;padding:0 1em;color:#222}"
		   "table{border-collapse:collapse;margin:1em 0;font-size:13px}"
		   "td,th{border:1px solid #ccc;padding:3px 8px;text-align:left}"
		   "th{background:#f4f4f4}svg{width:100%;max-width:1100px;height:auto}"
		   ".beside{display:flex;flex-wrap:wrap;align-items:center;gap:1em}.beside svg{flex:3 1 600px}"
		   ".beside img{flex:1 1 300px;max-width:480px}.warning{background:#fee08b;padding:.6em 1em}</style>\n"
		   "<h1>Error against run time</h1>\n<table>";
	for (const auto& line : page.stamp)
		out << "<tr><td>" << escaped(line.first) << "</td><td>" << escaped(line.second) << "</td></tr>";
	out << "</table>\n";
	if (!page.warning.empty())
		out << "<p class=\"warning\">" << escaped(page.warning) << "</p>\n";
	out << "<p>What to take: our joints with <code>btElasticPlasticConstraintSolver</code> in its direct "
		   "form, and "
		   "<code>btElasticPlasticStepper</code> for the error you allow. Here is what that gives and costs beside all "
		   "else: the same "
		   "solver in its iterative form (iterative), Bullet's sequential impulses (stock), "
		   "<code>btNNCGConstraintSolver</code> "
		   "(nncg), <code>btMLCPSolver</code> with Dantzig's algorithm (mlcp), the paper's scheme, Bullet's own "
		   "joints.</p>\n";
	for (const Grid& grid : {overviewOf(problems), profileOf(problems), partsOf(problems), fibresOf(problems)})
		out << grid.html();
	writeStability(out, trials);
	for (const std::string& name : problems.names)
	{
		out << "<h2 id=\"" << escaped(name) << "\">" << escaped(name) << "</h2><p>";
		for (const std::string& quantity : problems.quantities.at(name))
			out << escaped(quantity) << (&quantity == &problems.quantities.at(name).back() ? "" : ", ");
		out << "; each case by the worst of them.</p>\n";
		const auto view = page.views.find(name);
		writeProblem(out, name, problems.records.at(name), view == page.views.end() ? "" : view->second);
	}
	out << "</html>\n";
	return out.str();
}
}  // namespace ep
