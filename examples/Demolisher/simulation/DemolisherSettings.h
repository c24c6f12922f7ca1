// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DEMOLISHER_SETTINGS_H
#define EP_DEMOLISHER_SETTINGS_H

#include "structures/Bridge.h"
#include "structures/Fence.h"
#include "structures/Gate.h"
#include "structures/House.h"
#include "structures/Rod.h"
#include "vehicle/Autopilot.h"
#include "vehicle/Vehicle.h"

namespace ep
{
enum class Scene
{
	Gate,
	Fence,
	Bridge,
	Rod,
	House
};
constexpr size_t SCENE_COUNT = 5;

/// Those of F1 to F4 in this order, then the others.
const std::vector<Named<Scene>>& scenes();

/// The paper's third example (section 3.3): a heavy vehicle among things of concrete blocks and steel joints.
struct DemolisherSettings
{
	std::vector<Scene> scenes = {Scene::Gate, Scene::Fence, Scene::Bridge,
								 Scene::Rod};  ///< that are built: not the house
	Method method = Method(Solver::Direct, kinds::Ep2, 50);
	btScalar step = btScalar(1) / 60;  ///< [s]
	int substeps = 4;                  ///< of each step
	/// Of the direct solver: the error at which a blow is taken through inner steps, 0: never.
	btScalar innerError = btScalar(.002);
	btScalar gravity = 10;                ///< [m/s^2]
	btScalar gravityTime = 2;             ///< over which gravity grows: at once it would hit the bridge like a fall [s]
	btScalar sleepSpeed = btScalar(.02);  ///< slower than this for 2 s, things sleep; 0: never [m/s], [rad/s]
	Materials materials;
	GateSettings gate;
	FenceSettings fence;
	BridgeSettings bridge;
	RodSettings rod;
	HouseSettings house;
	VehicleSettings vehicle;
	btScalar speed = 12;  ///< of the autopilot on its own route [m/s]
	Route route;          ///< empty: from the first scene through the last one

	bool has(Scene scene) const;

	/// In the order of the way along x.
	std::vector<Scene> onTheWay() const;

	/// Where the bridge's ramps meet the ground, x and -x [m].
	btScalar rampFoot() const;

	/// Its middle, and where the vehicle starts for it, x [m].
	btScalar placeOf(Scene scene) const;
	btScalar startOf(Scene scene) const;

	/// The autopilot's.
	Route actualRoute() const;
};
}  // namespace ep

#endif  // EP_DEMOLISHER_SETTINGS_H
