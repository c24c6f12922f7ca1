#include "CharpyOptions.h"

#include <cstdio>

#include "OptionRange.h"

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

void CharpyOptions::addNumber(CLI::App& app, const char* name, const char* help, double CharpySettings::*field,
							  double unit, double low, double high)
{
	const auto take = [this, field, unit](const double& value)
	{ m_given.push_back([field, value, unit](CharpySettings& s) { s.*field = value * unit; }); };
	CLI::Option* const option = app.add_option_function<double>(name, take, help);
	option->check(optionRange(low, high))->default_str(toText(CharpySettings().*field / unit));
}

void CharpyOptions::addNumber(CLI::App& app, const char* name, const char* help, int CharpySettings::*field, int low,
							  int high)
{
	const auto take = [this, field](const int& value)
	{ m_given.push_back([field, value](CharpySettings& s) { s.*field = value; }); };
	CLI::Option* const option = app.add_option_function<int>(name, take, help);
	option->check(optionRange<int>(low, high))->default_str(toText(CharpySettings().*field));
}

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
	addNumber(app, "--dt", "Time step in the impact [ms]", &CharpySettings::step, 1e-3, 1e-4, 5);
	addNumber(app, "--hinge-step", "Greatest rotation of the hinge in an internal substep, 0: no bound [rad]",
			  &CharpySettings::hingeStep, 1, 0, 1);
	addNumber(app, "--iterations", "Of the solver, where it iterates", &CharpySettings::iterations, 1, 100000);
	addNumber(app, "--friction", "Coefficient of friction of all contacts", &CharpySettings::friction, 1, 0, 2);
	addNumber(app, "--restitution", "Of the blow on a rigid specimen", &CharpySettings::restitution, 1, 0, 1);
	addNumber(app, "--yield", "Yield stress [MPa]", &CharpySettings::yieldStress, 1e6, 1, 1e5);
	addNumber(app, "--max-rotation", "Plastic rotation at which a joint breaks [rad]", &CharpySettings::maxRotation, 1,
			  1e-6, 100);
	addNumber(app, "--notch", "Depth of the notch [mm]", &CharpySettings::notch, 1e-3, 0, 9);
	addNumber(app, "--width", "Of the specimen's section, upright [mm]", &CharpySettings::width, 1e-3, 1, 100);
	addNumber(app, "--pieces", "Of the specimen, an even number", &CharpySettings::pieces, 2, 64);
	addNumber(app, "--release", "Angle from which the hammer falls [rad]", &CharpySettings::release, 1, 0.2, 2.8);
	addNumber(app, "--shift", "Of the hammer along the blow [um]", &CharpySettings::shift, 1e-6, -2000, 2000);
	addNumber(app, "--lengths-per-metre", "Bullet's units of length in a metre", &CharpySettings::lengthsPerMetre, 1, 1,
			  1e4);
}

CharpySettings CharpyOptions::settings() const
{
	CharpySettings s = m_preset == "paper" ? CharpySettings::paper() : CharpySettings();
	for (const auto& give : m_given)
		give(s);
	return s;
}
}  // namespace ep
