// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "test/Options.h"

#include "cli/CommandLine.h"
#include "text/Format.h"

namespace ep::charpy
{
template <class Value>
void Options::addName(CommandLine& line, const char* name, const char* help, Value Settings::*field,
					  const std::vector<Named<Value>>& names)
{
	const auto take = [this, field, &names](const std::string& text)
	{
		if (const Value* value = findNamed(names, text))
			m_given.push_back([field, value = *value](Settings& s) { s.*field = value; });
	};
	line.addFunction<std::string>(name, take, help).oneOf(namesOf(names)).showDefault(nameOf(names, Settings().*field));
}

const std::vector<Named<Options::Preset>>& Options::presets()
{
	static const std::vector<Named<Preset>> all = {{"repeatable", [] { return Settings(); }},
												   {"paper", Settings::paper}};
	return all;
}

Options::Options(CommandLine& line)
{
	line.addNamed(
		"--preset", m_preset,
		"What all other settings begin with: paper (its geometry, scheme, time stepping, and Bullet's defaults) "
		"or repeatable, whose defaults are listed here",
		presets());
	addName(line, "--joint", "How the specimen holds together", &Settings::way, joints());
	addName(line, "--geometry", "Of hammer and anvils", &Settings::geometry, geometries());
	addName(line, "--solver", "Bullet's, or ours in one of its forms", &Settings::solver, solvers());
	for (const Number& n : numbers())
	{
		const std::string name = std::string("--") + n.name;
		const auto take = [this, &n](double value)
		{ m_given.push_back([&n, value](Settings& s) { n.set(s, value); }); };
		(n.whole ? line.addFunction<int>(name, take, n.help) : line.addFunction<double>(name, take, n.help))
			.within(n.low, n.high)
			.showDefault(format("%g", n.of(Settings())));
	}
}

Settings Options::settings() const
{
	Settings s = m_preset();
	for (const auto& give : m_given)
		give(s);
	return s;
}
}  // namespace ep::charpy
