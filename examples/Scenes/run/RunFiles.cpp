// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "run/RunFiles.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "simulation/Probes.h"
#include "simulation/SectionStrength.h"
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

RunFiles::RunFiles(Simulation& simulation) : RunFiles(simulation, {}) { step(); }

RunFiles::RunFiles(Simulation& simulation, const std::vector<std::vector<double>>& columns) : m_simulation(simulation)
{
	m_columns.emplace_back("time_s");
	for (const auto& probe : simulation.scene().probes)
		m_columns.emplace_back(probe.name);
	for (const char* energy : {"kinetic_J", "elastic_J", "plastic_J", "damping_J", "numerical_J", "gained_J"})
		m_columns.emplace_back(energy);
	if (columns.empty())
		return;
	if (columns.size() != m_columns.size())
		throw std::runtime_error("what was read before has other columns");
	for (size_t i = 0; i < columns.size(); ++i)
	{
		if (columns[i].empty() || columns[i].size() != columns[0].size())
			throw std::runtime_error("what was read before has columns of different lengths");
		for (double value : columns[i])
			m_columns[i].add(value);
	}
}

void RunFiles::step()
{
	const SceneEnergies& e = m_simulation.energies();
	size_t column = 0;
	m_columns[column++].add(m_simulation.time());
	for (const auto& probe : m_simulation.scene().probes)
		m_columns[column++].add(readProbe(m_simulation, probe));
	for (double energy : {e.kinetic, e.elastic, e.plastic, e.damping, e.numerical, e.gained})
		m_columns[column++].add(energy);
}

/// The time and some of the columns.
std::string RunFiles::csv(size_t begin, size_t end) const
{
	std::string text = m_columns[0].title();
	for (size_t k = begin; k < end; ++k)
		text += "," + m_columns[k].title();
	text += "\n";
	for (size_t row = 0; row < m_columns[0].size(); ++row)
	{
		text += cell(m_columns[0][row]);
		for (size_t k = begin; k < end; ++k)
			text += "," + cell(m_columns[k][row]);
		text += "\n";
	}
	return text;
}

std::vector<double> RunFiles::values() const
{
	std::vector<double> last;
	for (size_t i = 0; i < m_simulation.scene().probes.size(); ++i)
		last.push_back(probe(i)[probe(i).size() - 1]);
	return last;
}

nlohmann::ordered_json RunFiles::summary() const
{
	const Simulation& s = m_simulation;
	const SceneEnergies& e = s.energies();
	int yielded = 0;
	for (size_t i = 0; i < s.scene().joints.size(); ++i)
		yielded += s.joint(int(i)) && s.joint(int(i))->hasYielded();
	Json probes = Json::object();
	const std::vector<double> last = values();
	for (size_t i = 0; i < s.scene().probes.size(); ++i)
	{
		const Column& column = probe(i);
		double least = HUGE_VAL, most = -HUGE_VAL;
		for (size_t row = 0; row < column.size(); ++row)
		{
			least = std::min(least, column[row]);
			most = std::max(most, column[row]);
		}
		probes[column.title()] = {{"last", last[i]}, {"least", least}, {"most", most}};
	}
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
			{"damping_energy_J", e.damping},
			{"numerical_energy_J", e.numerical},
			{"energy_turnover_J", e.turnover},
			{"energy_gained_J", e.isAudited ? Json(e.gained) : Json()},
			{"energy_gained_share", e.isAudited && e.turnover > 0 ? Json(e.gained / e.turnover) : Json()},
			{"not_as_expected", unmetExpectations(s, last)},
			{"probes", probes}};
}

std::string RunFiles::eventsCsv() const
{
	const Simulation& s = m_simulation;
	std::string csv = "time_s,event,name,dof,energy_J,x_m,y_m,z_m,part\n";
	for (const SceneEvent& event : s.events())
	{
		const bool isBody = event.type == SceneEvent::Type::Remove || event.type == SceneEvent::Type::Push;
		const std::string& name =
			isBody ? s.scene().bodies[size_t(event.index)].name : s.scene().joints[size_t(event.index)].name;
		csv += cell(event.time) + "," + nameOf(sceneEventTypes(), event.type) + "," + name + "," +
			   (event.dof < 0 ? "" : btElasticPlasticDofName(event.dof)) + "," + cell(event.energy);
		for (int i = 0; i < 3; ++i)
			csv += "," + cell(double(event.place[i]));
		csv += "," + (event.part < 0 ? "" : std::to_string(event.part)) + "\n";
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

/// What sections of joints that are probed bear of N and M together, first as they were, then as they are.
std::string RunFiles::strengthCsv() const
{
	const Simulation& s = m_simulation;
	std::set<int> probed;
	for (const SceneDescription::Probe& probe : s.scene().probes)
		if (SceneDescription::isOfJoint(probe.measure))
			probed.insert(probe.things.begin(), probe.things.end());
	std::string csv;
	for (const int index : probed)
		for (const bool isAboutZ : {false, true})
			for (const bool isNow : {false, true})
				if (s.joint(index))
					for (const auto& point : sectionStrength(*s.joint(index), isAboutZ, isNow))
						csv += s.scene().joints[size_t(index)].name + (isAboutZ ? ",bending_z," : ",bending_y,") +
							   (isNow ? "end," : "start,") + cell(point.first) + "," + cell(point.second) + "\n";
	return csv;
}

void RunFiles::write(const std::string& folder) const
{
	makeDirectory(folder);
	writeFile(folder, "probes.csv", csv(1, firstEnergy()));
	writeFile(folder, "energy.csv", csv(firstEnergy(), m_columns.size()));
	writeFile(folder, "events.csv", eventsCsv());
	writeFile(folder, "joints.csv", jointsCsv());
	const std::string strength = strengthCsv();
	if (strength.empty())
		// Of another scene that was run with this folder.
		removeFile(folder, "strength.csv");
	else
		writeFile(folder, "strength.csv", "joint,moment,when,axial_N,moment_Nm\n" + strength);
	// Last: a folder with a summary is whole.
	writeFile(folder, "summary.json", summary().dump(2) + "\n");
}
}  // namespace ep
