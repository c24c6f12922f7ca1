// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DEMOLISHER_H
#define EP_DEMOLISHER_H

#include <cmath>
#include <memory>

#include "simulation/DemolisherSettings.h"
#include "simulation/JointLog.h"

namespace ep
{
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

	/// What the next steps are solved with.
	void setEffort(int substeps, int iterations, btScalar innerError);

	/// Puts the vehicle at the start of a scene.
	void jumpTo(Scene scene);

	/// All as it is now, to go back to. \return empty with joints of Bullet's own
	struct Moment
	{
		double time;
		size_t balls;
		std::vector<char> world;
		std::vector<JointRecord> joints;
		Vehicle::Memory vehicle;
		Autopilot autopilot;
	};
	Moment moment();
	/// Balls that came later are gone. \return whether it is as it was
	bool goBack(const Moment& moment);

	void throwBall(const btVector3& from, const btVector3& velocity);
	/// That have been thrown, in or out of the world.
	const std::vector<btRigidBody*>& balls() const { return m_balls; }

	double time() const { return m_time; }
	DemolisherSummary summary() const;

	const DemolisherSettings& settings() const { return m_settings; }
	World& world() { return m_world; }
	const World& world() const { return m_world; }
	const Vehicle& vehicle() const { return m_vehicle; }
	const JointLog& joints() const { return m_joints; }

	/// Null if the scene is not built.
	const Structure* structure(Scene scene) const { return m_structures[size_t(scene)].get(); }
	const Gate* gate() const { return static_cast<const Gate*>(structure(Scene::Gate)); }
	const Bridge* bridge() const { return static_cast<const Bridge*>(structure(Scene::Bridge)); }

private:
	void build(Scene scene);
	void growGravity();

	DemolisherSettings m_settings;
	World m_world;
	std::unique_ptr<Structure> m_structures[SCENE_COUNT];
	std::vector<btRigidBody*> m_balls;
	Vehicle m_vehicle;
	Autopilot m_autopilot;
	JointLog m_joints;
	double m_time = 0;
	double m_wallTime = 0;
};
}  // namespace ep

#endif  // EP_DEMOLISHER_H
