// What concerns all problems: one look, the profile, parts left out, stability.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "HtmlParts.h"
#include "Judgement.h"
#include "Pictures.h"

namespace ep
{
const std::vector<Family>& families()
{
	static const std::vector<Family> all = {{"profile", "our joints, our solver, profile"},
											{"direct", "our joints, our solver, direct"},
											{"iterative", "our joints, our solver, iterative"},
											{"stock", "our joints, Bullet's solver"},
											{"nncg", "our joints, Bullet's NNCG"},
											{"mlcp", "our joints, Bullet's MLCP"},
											{"paper", "the paper's scheme"},
											{"bullet-fixed", "Bullet's fixed joint"},
											{"bullet-spring2", "Bullet's 6-dof spring 2"},
											{"ode-fixed ode-step", "ODE's fixed joint, direct"},
											{"ode-fixed ode-quickstep", "ODE's fixed joint, QuickStep"},
											{"ode-soft ode-step", "ODE's springs, direct"},
											{"ode-soft ode-quickstep", "ODE's springs, QuickStep"}};
	return all;
}

std::vector<Family> familiesOf(const ByProblem& problems)
{
	std::set<std::string> present;
	for (const auto& problem : problems.records)
		for (const Record* r : problem.second)
			present.insert(r->family());
	std::vector<Family> some;
	for (const Family& family : families())
		if (present.count(family.key))
			some.push_back(family);
	return some;
}

std::string percent(double share)
{
	char text[32];
	if (!std::isfinite(share))
		return "–";
	snprintf(text, sizeof text, share < 1e-5 ? "%.0e %%" : share < 0.0995 ? "%.2g %%" : "%.0f %%", 100 * share);
	return text;
}

std::string milliseconds(double seconds)
{
	char text[32];
	snprintf(text, sizeof text, "%.3g ms", 1e3 * seconds);
	return text;
}

const char* shadeOf(double error)
{
	return std::isnan(error) ? "#eee"
		   : error <= 0.001  ? "#1a9850"
		   : error <= 0.01   ? "#91cf60"
		   : error <= 0.1    ? "#fee08b"
		   : error <= 1      ? "#fc8d59"
							 : "#d73027";
}

std::string cell(double error)
{
	return std::string("<td style=\"background:") + shadeOf(error) + "\">" + (std::isnan(error) ? "" : percent(error)) +
		   "</td>";
}

void writeOverview(std::ostream& out, const ByProblem& problems)
{
	out << "<h2>At the game's step</h2><p>Relative error at 1/60 s, iterative solvers with 10 iterations; only the "
		   "profile, for 1 %, takes substeps.</p>"
		   "<table><tr><th>Problem</th>";
	const std::vector<Family> compared = familiesOf(problems);
	for (const Family& family : compared)
		out << "<th>" << family.name << "</th>";
	out << "</tr>\n";
	for (const std::string& name : problems.names)
	{
		out << "<tr><td><a href=\"#" << name << "\">" << name << "</a></td>";
		for (const Family& family : compared)
		{
			out << cell(errorAtGamesStep(problems.records.at(name), family.key));
		}
		out << "</tr>\n";
	}
	out << "</table>\n";
}

namespace
{
bool isGamesStep(const Record& r) { return std::lround(1 / r.dt) == 60; }

const Record* findScheme(const Selection& records, const std::string& scheme, const std::string& precision,
						 double budget = 0)
{
	for (const Record* r : records)
		if (r->scheme == scheme && r->precision == precision && r->budget == budget)
			return r;
	return nullptr;
}
}  // namespace

void writeProfiles(std::ostream& out, const ByProblem& problems)
{
	out << "<h2>The profile</h2><p>Substeps by btElasticPlasticStepControl for an error of 10, 1 and 0.1 %, direct "
		   "solver, "
		   "double, against the quickest of all of Bullet's settings with steps of 1/60 s in any number of substeps "
		   "that keep to "
		   "it "
		   "(which nobody knows beforehand). Substeps are the mean of a step.</p>\n"
		   "<table><tr><th>Problem</th>";
	for (const char* budget : {"10 %", "1 %", "0.1 %"})
		out << "<th>" << budget << ": error</th><th>substeps</th><th>time over the quickest</th><th>which is</th>";
	out << "</tr>\n";
	for (const std::string& name : problems.names)
	{
		const Selection& records = problems.records.at(name);
		Selection rivals;
		for (const Record* r : records)
			if (isGamesStep(*r) && !r->isOutside() && r->budget == 0 && r->scheme.rfind("with", 0) != 0 &&
				r->precision == "double")
				rivals.push_back(r);
		out << "<tr><td><a href=\"#" << name << "\">" << name << "</a></td>";
		for (const double budget : {0.1, 0.01, 0.001})
		{
			const Record* const mine = findScheme(records, "profile", "double", budget);
			const Record* const best = quickestWithin(rivals, budget);
			if (!mine)
			{
				out << "<td></td><td></td><td></td><td></td>";
				continue;
			}
			char text[64];
			snprintf(text, sizeof text, "<td>%.1f</td>", mine->steps * mine->dt / mine->simulated);
			out << cell(mine->error) << text;
			snprintf(text, sizeof text, "<td>%.2f</td>", best ? mine->cost() / best->cost() : NAN);
			out << (best ? text : "<td></td>") << "<td>" << (best ? best->setting() : "none keeps to it") << "</td>";
		}
		out << "</tr>\n";
	}
	out << "</table>\n";
}

void writeParts(std::ostream& out, const ByProblem& problems)
{
	const char* const schemes[] = {"without elasticity",       "without shear rows",           "without torsion rows",
								   "without contact coupling", "without continuous collision", "without direct solve"};
	out << "<h2>What a scene can leave out</h2><p>1/60 s in 8 substeps, double. In each cell: time left of that with "
		   "everything, and error. The first column has everything; without substeps means one of 1/60 s.</p>\n"
		   "<table><tr><th>Problem</th><th>everything</th>";
	for (const char* scheme : schemes)
		out << "<th>" << scheme << "</th>";
	out << "<th>without substeps</th></tr>\n";
	for (const std::string& name : problems.names)
	{
		const Selection& records = problems.records.at(name);
		const Record* const whole = findScheme(records, "everything", "double");
		if (!whole)
			continue;
		out << "<tr><td><a href=\"#" << name << "\">" << name << "</a></td>" << cell(whole->error);
		Selection others;
		for (const char* scheme : schemes)
			others.push_back(findScheme(records, scheme, "double"));
		const Record* coarse = nullptr;
		for (const Record* r : records)
			if (isGamesStep(*r) && r->substeps == 1 && r->scheme == "default" && r->solver == "direct" &&
				r->precision == "double" && r->jointClass == "spring2")
				coarse = r;
		others.push_back(coarse);
		for (const Record* r : others)
		{
			std::string text = cell(r ? r->error : NAN);
			if (r)
				text.insert(text.find('>') + 1, percent(r->cost() / whole->cost()) + " time, ");
			out << text;
		}
		out << "</tr>\n";
	}
	out << "</table>\n<p>Energies and events cost 0.3 % of a step's instructions (callgrind, 100 joints), so there is "
		   "no "
		   "switch for them.</p>\n";
}

void writeStability(std::ostream& out, const std::vector<TrialRecord>& trials)
{
	if (trials.empty())
		return;
	std::vector<std::string> columns, rows;
	std::map<std::string, std::map<std::string, const TrialRecord*>> table;
	for (const TrialRecord& t : trials)
	{
		const std::string row = t.group + ": " + t.trial, column = t.solver + ", " + t.jointClass + ", " + t.precision;
		if (std::find(columns.begin(), columns.end(), column) == columns.end())
			columns.push_back(column);
		if (!table.count(row))
			rows.push_back(row);
		table[row][column] = &t;
	}
	out << "<h2>Stability</h2><p>Green: everything stays finite, no energy is created, and the answer is right where "
		   "one is "
		   "known. Other cells tell what went wrong.</p>\n<table><tr><th></th>";
	for (const std::string& column : columns)
		out << "<th>" << column << "</th>";
	out << "</tr>\n";
	for (const std::string& row : rows)
	{
		out << "<tr><td>" << row << "</td>";
		for (const std::string& column : columns)
		{
			const TrialRecord* const t = table[row][column];
			const char* const shade = !t ? "#eee" : t->complaint.empty() ? "#91cf60" : "#fc8d59";
			out << "<td style=\"background:" << shade << "\">" << (t ? t->complaint : "") << "</td>";
		}
		out << "</tr>\n";
	}
	out << "</table>\n";
}
}  // namespace ep
