// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_RUN_FILES_H
#define EP_RUN_FILES_H

#include <nlohmann/json.hpp>

#include "simulation/Simulation.h"

namespace ep
{
/// What a run leaves: probes, energies, events and joints as tables, and a summary.
class RunFiles
{
public:
	explicit RunFiles(Simulation& simulation);

	/// After each step.
	void step();

	/// The values of the probes now.
	const std::vector<double>& values() const { return m_values; }

	nlohmann::ordered_json summary() const;

	/// summary.json, probes.csv, energy.csv, events.csv and joints.csv. Throws a std::runtime_error if one cannot be written.
	void write(const std::string& folder) const;

private:
	struct Extremes
	{
		double least, most;
	};

	void read();
	std::string eventsCsv() const;
	std::string jointsCsv() const;

	Simulation& m_simulation;
	std::vector<double> m_values;
	std::vector<Extremes> m_extremes;
	std::string m_probes, m_energy;
};
}  // namespace ep

#endif  // EP_RUN_FILES_H
