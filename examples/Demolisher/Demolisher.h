// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DEMOLISHER_H
#define EP_DEMOLISHER_H

#include <cmath>
#include <memory>

#include "vehicle/Autopilot.h"
#include "structures/Bridge.h"
#include "structures/Fence.h"
#include "structures/Gate.h"
#include "structures/JointBook.h"
#include "structures/Rod.h"
#include "vehicle/Vehicle.h"

namespace ep
{
enum class Scene
{
	Gate,
	Fence,
	Bridge,
	Rod
};

/// In the order of F1 to F4.
const std::vector<Named<Scene>>& scenes();

/// The paper's third example (section 3.3): a heavy vehicle among things of concrete blocks and steel joints.
struct DemolisherSettings
{
	std::vector<Scene> scenes = {Scene::Gate, Scene::Fence, Scene::Bridge, Scene::Rod};  ///< that are built
	Method method = Method(Solver::Direct, kinds::Ep2, 50);
	btScalar step = btScalar(1) / 60;     ///< [s]
	int substeps = 4;                     ///< of each step; with one, a tenth less flows
	btScalar gravity = 10;                ///< [m/s^2]
	btScalar gravityTime = 2;             ///< over which gravity grows: at once it would hit the bridge like a fall [s]
	btScalar sleepSpeed = btScalar(.02);  ///< slower than this for 2 s, things sleep; 0: never [m/s], [rad/s]
	Materials materials;
	GateSettings gate;
	FenceSettings fence;
	BridgeSettings bridge;
	RodSettings rod;
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

/// How things stand.
struct DemolisherSummary
{
	int joints = 0, yielded = 0, broken = 0;
	double plasticEnergy = 0, elasticEnergy = 0, numericalEnergy = 0, kineticEnergy = 0;  ///< [J]
	double sag = 0;                          ///< of the bridge's middle, 0 without [m]
	btVector3 vehicle = btVector3(0, 0, 0);  ///< position of its centre [m]
	double speed = 0;                        ///< forward [m/s]
	bool crossed = false;                    ///< the vehicle stands on the ground on the bridge's far side
	int asleep = 0;                          ///< bodies
	double time = 0;                         ///< simulated [s]
	double realTimeFactor = 0;               ///< simulated time over time spent on it, drawing excluded

	/// Some joints fly apart at some steps.
	bool isFinite() const { return std::isfinite(kineticEnergy + elasticEnergy); }
};

class Demolisher
{
public:
	explicit Demolisher(const DemolisherSettings& settings);

	/// One step.
	void step(const Controls& controls);

	/// One step, driven by the autopilot, which waits until gravity is there and things are at rest.
	void stepByAutopilot();
	const Autopilot& autopilot() const { return m_autopilot; }

	/// Gives the autopilot another route from here.
	void follow(const Route& route) { m_autopilot = Autopilot(route); }

	/// Puts the vehicle at the start of a scene.
	void jumpTo(Scene scene);

	double time() const { return m_time; }
	DemolisherSummary summary() const;

	const DemolisherSettings& settings() const { return m_settings; }
	World& world() { return m_world; }
	const World& world() const { return m_world; }
	const Vehicle& vehicle() const { return m_vehicle; }
	const JointBook& book() const { return m_book; }

	/// Null if the scene is not built.
	const Structure* structure(Scene scene) const { return m_structures[size_t(scene)].get(); }
	const Gate* gate() const { return static_cast<const Gate*>(structure(Scene::Gate)); }
	const Bridge* bridge() const { return static_cast<const Bridge*>(structure(Scene::Bridge)); }

private:
	void build(Scene scene);
	void growGravity();

	DemolisherSettings m_settings;
	World m_world;
	std::unique_ptr<Structure> m_structures[4];
	Vehicle m_vehicle;
	Autopilot m_autopilot;
	JointBook m_book;
	double m_time = 0;
	double m_wallTime = 0;
};
}  // namespace ep

#endif  // EP_DEMOLISHER_H
