// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "run/RunFiles.h"

#include <algorithm>
#include <cmath>

#include "simulation/Probes.h"
#include "text/Format.h"
#include "text/OutputFiles.h"
#include "world/JointReading.h"

namespace ep
{
namespace
{
using Json = nlohmann::ordered_json;  // the reader finds what he looks for first

/// A number as a table has it: nothing, where there is none.
std::string cell(double value) { return std::isfinite(value) ? format("%.9g", value) : ""; }

const char* stateOf(const Simulation& s, int index)
{
	if (s.isBroken(index))
		return "broken";
	return s.joint(index) && s.joint(index)->hasYielded() ? "yielded" : "elastic";
}
}  // namespace

RunFiles::RunFiles(Simulation& simulation)
	: m_simulation(simulation), m_energy("time_s,kinetic_J,elastic_J,plastic_J,numerical_J,gained_J\n")
{
	m_probes = "time_s";
	for (const auto& probe : simulation.scene().probes)
		m_probes += "," + probe.name;
	m_probes += "\n";
	m_extremes.resize(simulation.scene().probes.size(), {HUGE_VAL, -HUGE_VAL});
	read();
}

void RunFiles::step() { read(); }

void RunFiles::read()
{
	const auto& probes = m_simulation.scene().probes;
	m_values.resize(probes.size());
	m_probes += cell(m_simulation.time());
	for (size_t i = 0; i < probes.size(); ++i)
	{
		m_values[i] = readProbe(m_simulation, probes[i]);
		m_extremes[i] = {std::min(m_extremes[i].least, m_values[i]), std::max(m_extremes[i].most, m_values[i])};
		m_probes += "," + cell(m_values[i]);
	}
	m_probes += "\n";
	const SceneEnergies& e = m_simulation.energies();
	m_energy += cell(m_simulation.time());
	for (double energy : {e.kinetic, e.elastic, e.plastic, e.numerical, e.gained})
		m_energy += "," + cell(energy);
	m_energy += "\n";
}

nlohmann::ordered_json RunFiles::summary() const
{
	const Simulation& s = m_simulation;
	const SceneEnergies& e = s.energies();
	int yielded = 0;
	for (size_t i = 0; i < s.scene().joints.size(); ++i)
		yielded += s.joint(int(i)) && s.joint(int(i))->hasYielded();
	Json probes = Json::object();
	for (size_t i = 0; i < m_values.size(); ++i)
		probes[s.scene().probes[i].name] = {
			{"last", m_values[i]}, {"least", m_extremes[i].least}, {"most", m_extremes[i].most}};
	return {{"title", s.scene().title},
			{"ending", nameOf(endings(), s.ending())},
			{"is_finite", s.ending() != Ending::NotFinite},
			{"time_s", s.time()},
			{"step_s", s.scene().world.step},
			{"precision", sizeof(btScalar) == sizeof(double) ? "double" : "float"},
			{"bodies", s.scene().bodies.size()},
			{"joints", s.scene().joints.size()},
			{"joints_yielded", yielded},
			{"joints_broken", s.numBroken()},
			{"kinetic_energy_J", e.kinetic},
			{"elastic_energy_J", e.elastic},
			{"plastic_energy_J", e.plastic},
			{"numerical_energy_J", e.numerical},
			{"energy_turnover_J", e.turnover},
			{"energy_gained_J", e.isAudited ? Json(e.gained) : Json()},
			{"energy_gained_share", e.isAudited && e.turnover > 0 ? Json(e.gained / e.turnover) : Json()},
			{"not_as_expected", unmetExpectations(s, m_values)},
			{"probes", probes}};
}

std::string RunFiles::eventsCsv() const
{
	const Simulation& s = m_simulation;
	std::string csv = "time_s,event,name,dof,energy_J,x_m,y_m,z_m\n";
	for (const SceneEvent& event : s.events())
	{
		const bool isBody = event.type == SceneEvent::Type::Remove || event.type == SceneEvent::Type::Push;
		const std::string& name =
			isBody ? s.scene().bodies[size_t(event.index)].name : s.scene().joints[size_t(event.index)].name;
		csv += cell(event.time) + "," + nameOf(sceneEventTypes(), event.type) + "," + name + "," +
			   (event.dof < 0 ? "" : btElasticPlasticDofName(event.dof)) + "," + cell(event.energy);
		for (int i = 0; i < 3; ++i)
			csv += "," + cell(double(event.place[i]));
		csv += "\n";
	}
	return csv;
}

std::string RunFiles::jointsCsv() const
{
	const Simulation& s = m_simulation;
	std::string csv =
		"joint,state,utilisation,damage,axial_N,shear_y_N,shear_z_N,torsion_Nm,bending_y_Nm,bending_z_Nm,"
		"elastic_energy_J,plastic_energy_J\n";
	for (size_t i = 0; i < s.scene().joints.size(); ++i)
	{
		csv += s.scene().joints[i].name + "," + stateOf(s, int(i));
		const JointReading r = s.joint(int(i)) ? readJoint(s.world(), *s.joint(int(i))) : JointReading();
		csv += "," + cell(r.utilisation) + "," + cell(r.damage);
		for (double force : r.force)
			csv += "," + cell(force);
		csv += "," + cell(r.elasticEnergy) + "," + cell(r.plasticEnergy) + "\n";
	}
	return csv;
}

void RunFiles::write(const std::string& folder) const
{
	makeDirectory(folder);
	writeFile(folder, "probes.csv", m_probes);
	writeFile(folder, "energy.csv", m_energy);
	writeFile(folder, "events.csv", eventsCsv());
	writeFile(folder, "joints.csv", jointsCsv());
	// Last: a folder with a summary is whole.
	writeFile(folder, "summary.json", summary().dump(2) + "\n");
}
}  // namespace ep
