// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "CharpyOptions.h"

#include <cstdio>

#include "cli/OptionRange.h"

namespace ep
{
namespace
{
std::string toText(double value)
{
	char text[32];
	std::snprintf(text, sizeof text, "%g", value);
	return text;
}
}  // namespace

template <class Value>
void CharpyOptions::addName(CLI::App& app, const char* name, const char* help, Value CharpySettings::*field,
							const std::vector<Named<Value>>& names)
{
	const auto take = [this, field, &names](const std::string& text)
	{
		if (const Value* value = findNamed(names, text))
			m_given.push_back([field, value = *value](CharpySettings& s) { s.*field = value; });
	};
	app.add_option_function<std::string>(name, take, help)
		->check(CLI::IsMember(namesOf(names)))
		->default_str(nameOf(names, CharpySettings().*field));
}

CharpyOptions::CharpyOptions(CLI::App& app)
{
	app.add_option(
		   "--preset", m_preset,
		   "What all other settings begin with: paper (its geometry, scheme, time stepping, and Bullet's defaults) "
		   "or repeatable, whose defaults are listed here")
		->capture_default_str()
		->check(CLI::IsMember({"repeatable", "paper"}));
	addName(app, "--joint", "How the specimen holds together", &CharpySettings::way, charpyWays());
	addName(app, "--geometry", "Of hammer and anvils", &CharpySettings::geometry, charpyGeometries());
	addName(app, "--solver", "Bullet's, or ours in one of its forms", &CharpySettings::solver, solvers());
	for (const CharpyNumber& n : charpyNumbers())
		app.add_option_function<double>(
			   std::string("--") + n.name,
			   [this, &n](double value) { m_given.push_back([&n, value](CharpySettings& s) { n.set(s, value); }); },
			   n.help)
			->type_name(n.whole ? "INT" : "FLOAT")
			->check(n.whole ? optionRange<int>(n.low, n.high) : optionRange(n.low, n.high))
			->default_str(toText(n.of(CharpySettings())));
}

CharpySettings CharpyOptions::settings() const
{
	CharpySettings s = m_preset == "paper" ? CharpySettings::paper() : CharpySettings();
	for (const auto& give : m_given)
		give(s);
	return s;
}
}  // namespace ep
