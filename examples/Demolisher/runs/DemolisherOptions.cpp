// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "runs/DemolisherOptions.h"

#include "cli/OptionRange.h"
#include "vehicle/RouteFile.h"

namespace ep
{
namespace
{
template <class Value>
CLI::Option* number(CLI::App& app, const char* name, Value& value, const char* help, double low, double high)
{
	return app.add_option(name, value, help)->capture_default_str()->check(optionRange<Value>(low, high));
}

template <class Value>
void addTo(std::string& list, const char* title, const std::vector<Named<Value>>& choices)
{
	list += std::string(title) + "\n";
	for (const Named<Value>& choice : choices)
		list += "  " + std::string(choice.name) + std::string(16 - std::string(choice.name).size(), ' ') + choice.help +
				"\n";
}

std::vector<std::string> sceneChoices()
{
	std::vector<std::string> names = namesOf(scenes());
	names.push_back("all");
	return names;
}
}  // namespace

DemolisherOptions::DemolisherOptions(CLI::App& app)
{
	DemolisherSettings& s = m_settings;
	app.add_option("--scene", m_scenes, "What is built; several are given one after the other")
		->capture_default_str()
		->check(CLI::IsMember(sceneChoices()));
	app.add_option("--joint", m_joint, "What holds the blocks together, see --list")
		->capture_default_str()
		->check(CLI::IsMember(namesOf(jointKinds())));
	app.add_option("--solver", m_solver, "Bullet's, or ours in one of its forms")
		->capture_default_str()
		->check(CLI::IsMember(namesOf(solvers())));
	app.add_option("--autopilot", m_route,
				   "JSON file with the autopilot's route; otherwise it drives through all scenes");
	number(app, "--speed", s.speed, "Speed of the autopilot on its own route [m/s]", 1, 26);
	number(app, "--step", s.step, "Time step [s]", 1e-3, .1);
	number(app, "--substeps", s.substeps, "Solver steps in each step", 1, 1000);
	number(app, "--iterations", s.method.iterations, "Iterations in each substep, where the solver iterates", 1,
		   100000);
	number(app, "--steel-share", s.bridge.steelShare, "Share of steel in the bridge deck's section", .0001, 1);
	number(app, "--fence-steel-share", s.fence.steelShare, "The same of the fence's posts", .0001, 1);
	number(app, "--ductility", s.materials.ductility, "Plastic strain at which steel tears", 1e-4, 10);
	number(app, "--vehicle-mass", s.vehicle.mass, "[kg]", 1000, 1e6);
	app.add_flag("--two-supports", s.gate.twoSupports, "The gate's boom is held at both ends");
}

DemolisherSettings DemolisherOptions::settings() const
{
	DemolisherSettings s = m_settings;
	if (std::find(m_scenes.begin(), m_scenes.end(), "all") == m_scenes.end())
	{
		s.scenes.clear();
		for (const std::string& name : m_scenes)
			if (!s.has(*findNamed(scenes(), name)))
				s.scenes.push_back(*findNamed(scenes(), name));
	}
	s.method = Method(*findNamed(solvers(), m_solver), *findNamed(jointKinds(), m_joint), s.method.iterations);
	if (!m_route.empty())
		s.route = readRoute(m_route);
	return s;
}

std::string DemolisherOptions::list()
{
	std::string list;
	addTo(list, "scenes (--scene; all is all of them)", scenes());
	addTo(list, "joints (--joint)", jointKinds());
	addTo(list, "solvers (--solver)", solvers());
	return list;
}
}  // namespace ep
