// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DEMOLISHER_OPTIONS_H
#define EP_DEMOLISHER_OPTIONS_H

#include "simulation/DemolisherSettings.h"

namespace ep
{
class CommandLine;

/// The command line's settings.
class DemolisherOptions
{
public:
	explicit DemolisherOptions(CommandLine& line);

	/// Throws std::runtime_error if the autopilot's file is not as it should be.
	DemolisherSettings settings() const;

	/// Scenes, joints and solvers with what they are.
	static std::string list();

private:
	DemolisherSettings m_settings;
	JointKind m_joints = m_settings.method.kind();
	std::string m_route;
};
}  // namespace ep

#endif  // EP_DEMOLISHER_OPTIONS_H
