// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_RUN_LOG_H
#define EP_RUN_LOG_H

#include <string>

#include "simulation/Demolisher.h"

namespace ep
{
/// What is written down of a run as it goes.
class RunLog
{
public:
	explicit RunLog(const Demolisher& demolisher) : m_demolisher(demolisher) { sample(); }

	/// After each step: takes a sample when it is time for one.
	void step();

	/// All in JSON, units in the names.
	std::string summary() const;

	/// Every joint at every sample.
	const std::string& jointsCsv() const { return m_joints; }

private:
	void sample();

	struct Place
	{
		double time;
		btVector3 position;
		double speed;
	};
	const Demolisher& m_demolisher;
	std::vector<Place> m_track;
	std::string m_joints;
	int m_samples = 0;
};
}  // namespace ep

#endif  // EP_RUN_LOG_H
