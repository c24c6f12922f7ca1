// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_RUN_FILES_H
#define EP_RUN_FILES_H

#include <nlohmann/json.hpp>

#include "run/Column.h"
#include "simulation/Simulation.h"

namespace ep
{
/// What a run leaves: probes, energies, events and joints as tables, and a summary.
class RunFiles
{
public:
	explicit RunFiles(Simulation& simulation);

	/// Goes on from what another one had read: values of all columns, one column after another. Throws a std::runtime_error if these are not
	/// as many as there are columns, or not equally many of each.
	RunFiles(Simulation& simulation, const std::vector<std::vector<double>>& columns);

	/// After each step.
	void step();

	/// The values of the probes now.
	std::vector<double> values() const;

	/// What has been read since the beginning: the time, the probes in the scene's order, and energies.
	const std::vector<Column>& columns() const { return m_columns; }

	nlohmann::ordered_json summary() const;

	/// summary.json, probes.csv, energy.csv, events.csv and joints.csv. Throws a std::runtime_error if one cannot be written.
	void write(const std::string& folder) const;

private:
	size_t firstEnergy() const { return 1 + m_simulation.scene().probes.size(); }
	const Column& probe(size_t index) const { return m_columns[1 + index]; }
	std::string csv(size_t begin, size_t end) const;
	std::string eventsCsv() const;
	std::string jointsCsv() const;
	std::string strengthCsv() const;

	Simulation& m_simulation;
	std::vector<Column> m_columns;
};
}  // namespace ep

#endif  // EP_RUN_FILES_H
