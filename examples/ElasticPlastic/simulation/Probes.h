// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PROBES_H
#define EP_PROBES_H

#include "simulation/Simulation.h"

namespace ep
{
/// What a probe reads now, in SI units; angles in rad. NaN, if nothing of what it reads is there.
double readProbe(Simulation& simulation, const SceneDescription::Probe& probe);

/// Expectations of the scene that are not met, a line each. \param values  of the probes at the end
std::vector<std::string> unmetExpectations(const Simulation& simulation, const std::vector<double>& values);
}  // namespace ep

#endif  // EP_PROBES_H
