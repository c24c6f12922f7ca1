// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "test/Options.h"

#include "cli/NamedOption.h"
#include "cli/OptionRange.h"
#include "text/Format.h"

namespace ep::charpy
{
template <class Value>
void Options::addName(CLI::App& app, const char* name, const char* help, Value Settings::*field,
					  const std::vector<Named<Value>>& names)
{
	const auto take = [this, field, &names](const std::string& text)
	{
		if (const Value* value = findNamed(names, text))
			m_given.push_back([field, value = *value](Settings& s) { s.*field = value; });
	};
	app.add_option_function<std::string>(name, take, help)
		->check(CLI::IsMember(namesOf(names)))
		->default_str(nameOf(names, Settings().*field));
}

const std::vector<Named<Options::Preset>>& Options::presets()
{
	static const std::vector<Named<Preset>> all = {{"repeatable", [] { return Settings(); }},
												   {"paper", Settings::paper}};
	return all;
}

Options::Options(CLI::App& app)
{
	addNamedOption(
		app, "--preset", m_preset,
		"What all other settings begin with: paper (its geometry, scheme, time stepping, and Bullet's defaults) "
		"or repeatable, whose defaults are listed here",
		presets());
	addName(app, "--joint", "How the specimen holds together", &Settings::way, joints());
	addName(app, "--geometry", "Of hammer and anvils", &Settings::geometry, geometries());
	addName(app, "--solver", "Bullet's, or ours in one of its forms", &Settings::solver, solvers());
	for (const Number& n : numbers())
		app.add_option_function<double>(
			   std::string("--") + n.name,
			   [this, &n](double value) { m_given.push_back([&n, value](Settings& s) { n.set(s, value); }); }, n.help)
			->type_name(n.whole ? "INT" : "FLOAT")
			->check(n.whole ? optionRange<int>(n.low, n.high) : optionRange(n.low, n.high))
			->default_str(format("%g", n.of(Settings())));
}

Settings Options::settings() const
{
	Settings s = m_preset();
	for (const auto& give : m_given)
		give(s);
	return s;
}
}  // namespace ep::charpy
