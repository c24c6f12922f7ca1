// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_STATE_FILE_H
#define EP_STATE_FILE_H

#include <nlohmann/json.hpp>

#include "simulation/Simulation.h"

namespace ep
{
/// A state as what CBOR can hold, without a rounding of its numbers.
nlohmann::json packState(const SimulationState& state);

/// Throws a SceneError if it is not a state, or one of another precision or version. Whether it is of a scene, the simulation tells that is
/// made from it.
SimulationState unpackState(const nlohmann::json& packed);
}  // namespace ep

#endif  // EP_STATE_FILE_H
