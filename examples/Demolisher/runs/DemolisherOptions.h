// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DEMOLISHER_OPTIONS_H
#define EP_DEMOLISHER_OPTIONS_H

#include <CLI/CLI.hpp>

#include "Demolisher.h"

namespace ep
{
/// The command line's settings.
class DemolisherOptions
{
public:
	explicit DemolisherOptions(CLI::App& app);

	/// Throws std::runtime_error if the autopilot's file is not as it should be.
	DemolisherSettings settings() const;

	/// Scenes, joints and solvers with what they are.
	static std::string list();

private:
	DemolisherSettings m_settings;
	std::vector<std::string> m_scenes = {"all"};
	std::string m_joint = "ep2", m_solver = "direct", m_route;
};
}  // namespace ep

#endif  // EP_DEMOLISHER_OPTIONS_H
