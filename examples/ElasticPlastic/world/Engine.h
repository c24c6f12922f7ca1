// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_ENGINE_H
#define EP_ENGINE_H

#include <functional>
#include <memory>

#include "LinearMath/btScalar.h"

namespace ep
{
class World;

/// Another physics engine that steps a scene's bodies and joints in Bullet's stead, for comparisons. It leaves the bodies'
/// poses and velocities in the scene, so that all measures of the scene hold for it too.
class Engine
{
public:
	virtual ~Engine() = default;
	virtual void step(btScalar dt) = 0;
};

/// Takes over a scene that is complete.
typedef std::function<std::unique_ptr<Engine>(World& world)> MakeEngine;
}  // namespace ep

#endif  // EP_ENGINE_H
