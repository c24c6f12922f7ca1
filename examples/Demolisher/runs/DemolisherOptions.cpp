// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "runs/DemolisherOptions.h"

#include "cli/CommandLine.h"
#include "runs/RouteFile.h"

namespace ep
{
namespace
{
template <class Value>
void number(CommandLine& line, const char* name, Value& value, const char* help, double low, double high)
{
	line.add(name, value, help).within(low, high).showDefault();
}

template <class Value>
void addTo(std::string& list, const char* title, const std::vector<Named<Value>>& choices)
{
	list += std::string(title) + "\n";
	for (const Named<Value>& choice : choices)
		list += "  " + std::string(choice.name) + std::string(16 - std::string(choice.name).size(), ' ') + choice.help +
				"\n";
}

/// All of them is one choice more.
const std::vector<Named<std::vector<Scene>>>& sceneChoices()
{
	static const std::vector<Named<std::vector<Scene>>> all = []
	{
		std::vector<Named<std::vector<Scene>>> choices;
		for (const Named<Scene>& scene : scenes())
			choices.push_back({scene.name, {scene.value}});
		choices.push_back({"all", DemolisherSettings().scenes});
		return choices;
	}();
	return all;
}
}  // namespace

DemolisherOptions::DemolisherOptions(CommandLine& line)
{
	DemolisherSettings& s = m_settings;
	const auto build = [&s](const std::vector<std::string>& names)
	{
		s.scenes.clear();
		for (const std::string& name : names)
			for (const Scene scene : *findNamed(sceneChoices(), name))
				if (!s.has(scene))
					s.scenes.push_back(scene);
	};
	line.addFunction<std::vector<std::string>>("--scene", build, "What is built; several are given one after the other")
		.oneOf(namesOf(sceneChoices()))
		.showDefault("all");
	line.addNamed("--joint", m_joints, "What holds the blocks together, see --list", jointKinds());
	line.addNamed("--solver", s.method.solver, "Bullet's, or ours in one of its forms", solvers());
	line.add("--autopilot", m_route, "JSON file with the autopilot's route; otherwise it drives through all scenes");
	number(line, "--speed", s.speed,
		   "Speed of the autopilot on its own route, where the way is long enough to reach it [m/s]", 1, 26);
	number(line, "--step", s.step, "Time step [s]", 1e-3, .1);
	number(line, "--substeps", s.substeps, "Solver steps in each step", 1, 1000);
	number(line, "--inner-error", s.innerError,
		   "Error at which the direct solver takes a blow through inner steps, 0.01 is 1 %; 0: never", 0, 1);
	number(line, "--iterations", s.method.iterations, "Iterations in each substep, where the solver iterates", 1,
		   100000);
	number(line, "--steel-share", s.bridge.steelShare, "Share of steel in the bridge deck's section", .0001, 1);
	number(line, "--fence-steel-share", s.fence.steelShare, "The same of the fence's posts", .0001, 1);
	number(line, "--ductility", s.materials.ductility, "Plastic strain at which steel tears", 1e-4, 10);
	number(line, "--vehicle-mass", s.vehicle.mass, "[kg]", 1000, 1e6);
	line.addFlag("--two-supports", s.gate.twoSupports, "The gate's boom is held at both ends");
}

DemolisherSettings DemolisherOptions::settings() const
{
	DemolisherSettings s = m_settings;
	s.method = Method(s.method.solver, m_joints, s.method.iterations);
	if (!m_route.empty())
		s.route = readRoute(m_route);
	return s;
}

std::string DemolisherOptions::list()
{
	std::string list;
	addTo(list, "scenes (--scene; all is gate, fence, bridge and rod)", scenes());
	addTo(list, "joints (--joint)", jointKinds());
	addTo(list, "solvers (--solver)", solvers());
	return list;
}
}  // namespace ep
