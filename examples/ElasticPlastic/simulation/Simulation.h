// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SIMULATION_H
#define EP_SIMULATION_H

#include <functional>
#include <memory>
#include <unordered_map>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepControl.h"
#include "scenefile/SceneDescription.h"
#include "simulation/Shapes.h"
#include "vehicle/Vehicle.h"
#include "world/EnergyAudit.h"

namespace ep
{
/// What has happened in a simulation.
struct SceneEvent
{
	enum class Type
	{
		Yield,
		Break,
		Crack,    ///< of a fibre, see btElasticPlasticEvent.h
		Rupture,  ///< of a fibre
		Remove,   ///< by the scene: a body
		Cut,      ///< a joint
		Push      ///< a body
	};

	double time;
	Type type;
	int index;  ///< of the joint or body in the description
	int dof;    ///< of what happens to a joint by itself, else -1
	double energy;
	btVector3 place;
	int part =
		-1;  ///< of the section, that has cracked or ruptured: 0 is the section itself, others come after it in their order
};
const std::vector<Named<SceneEvent::Type>>& sceneEventTypes();

/// Where the energy of a simulation is [J].
struct SceneEnergies
{
	double kinetic = 0;
	double elastic = 0, plastic = 0, damping = 0, numerical = 0;  ///< of joints
	double turnover = 0;    ///< the most that kinetic energy and what joints have stored and dissipated have been
	double gained = 0;      ///< the sum of what steps have added from nowhere
	bool isAudited = true;  ///< false with kinematic bodies and motors, whose work nobody counts
};

/// Why a simulation is over.
enum class Ending
{
	None,
	Time,
	Standstill,
	FirstBreak,
	NotFinite
};
const std::vector<Named<Ending>>& endings();

/// What a simulation has come to between two steps: with its scene another one goes on from there, with the same bits if it is of
/// the same program.
struct SimulationState
{
	/// What has come and gone.
	struct Change
	{
		enum class Type
		{
			Appear,  ///< a body
			Remove,
			Cut  ///< a joint
		};

		Type type;
		int index;
	};

	/// What a vehicle remembers beside its body.
	struct Vehicle
	{
		struct Wheel
		{
			double turn, lastTurn, suspension, force;
			int ground;  ///< body below it, WORLD: none that moves
		};
		std::vector<Wheel> wheels;
		double steer;
		Autopilot::Progress progress;
	};

	double time = 0, calm = 0;  ///< calm: for how long all has stood still [s]
	double lastSubstep = 1;     ///< [s]
	Ending ending = Ending::None;
	SceneEnergies energies;
	std::vector<bool> played;  ///< of the scene's events
	std::vector<SceneEvent> events;
	std::vector<Change> changes;  ///< in their order

	// Only in a state that was saved:
	std::vector<char> world;                                 ///< bodies, contacts and joints that it holds
	std::vector<std::pair<int, btElasticPlasticState>> cut;  ///< joints that it does not hold any more
	std::vector<int> brokenBulletsOwn;                       ///< joints of Bullet's
	std::vector<Vehicle> vehicles;
};

/// A scene that is built and computed, step by step.
class Simulation
{
public:
	/// Throws a SceneError if it cannot be built: bodies without volume, or in each other.
	explicit Simulation(const SceneDescription& scene);

	/// Goes on from a state of the same scene. Throws a SceneError if it is of another one.
	Simulation(const SceneDescription& scene, const SimulationState& state);
	~Simulation();
	Simulation(const Simulation&) = delete;
	Simulation& operator=(const Simulation&) = delete;

	const SceneDescription& scene() const { return m_scene; }
	World& world() { return *m_world; }
	const World& world() const { return *m_world; }

	/// By their places in the description. \return null for the world, and for a body that has not come yet
	btRigidBody* body(int index) const { return index < 0 ? nullptr : m_bodies[size_t(index)].body; }
	/// \return null for one of Bullet's own
	btElasticPlasticJoint* joint(int index) const { return m_joints[size_t(index)].joint; }

	/// A body's pose as the description has it: its centre of mass may be elsewhere.
	btTransform poseOf(int index) const;
	btTransform startOf(int index) const { return m_bodies[size_t(index)].start; }

	/// In the world, and not removed.
	bool isThere(int index) const { return body(index) && body(index)->isInWorld(); }
	/// Of a vehicle, to be drawn: wheels are no bodies.
	struct Wheel
	{
		std::string name;
		SceneDescription::Shape shape;
		btTransform pose;
		int body;  ///< of the vehicle
	};
	std::vector<Wheel> wheels() const;

	bool isBroken(int joint) const;
	bool isCut(int joint) const { return m_joints[size_t(joint)].isCut; }  ///< taken out by the scene

	/// A body that comes into the world now, after all others. It must have a volume.
	void add(const SceneDescription::Body& body);

	/// Loads beside the scene's own, which may change between steps and before each substep.
	std::vector<SceneDescription::Load>& addedLoads() { return m_addedLoads; }

	/// Something is done before each substep, at whose middle the time [s] is. It may change added loads, and must not throw.
	void beforeSubsteps(std::function<void(double time)> act) { m_beforeSubstep = std::move(act); }

	// What the scene's events do, at any time between steps. What is not there any more stays as it is.
	void remove(int body);
	void cut(int joint);
	void push(int body, const btVector3& velocity);

	void step();
	double time() const { return m_run.time; }
	double lastSubstep() const { return m_run.lastSubstep; }  ///< its length [s]
	Ending ending() const { return m_run.ending; }

	/// Between steps. The control of substeps begins anew, as it will in the simulation that goes on from there: else that one would
	/// have other bits. Throws a SceneError where the world's kind of joints cannot be saved.
	SimulationState save();

	/// All so far, in the order of time.
	const std::vector<SceneEvent>& events() const { return m_run.events; }

	const SceneEnergies& energies() const { return m_run.energies; }

	/// Broken so far; those that the scene has cut do not count.
	int numBroken() const;

private:
	struct BuiltBody
	{
		btRigidBody* body = nullptr;
		CentredShape shape;
		btTransform start = btTransform::getIdentity();
	};
	struct BuiltJoint
	{
		btElasticPlasticJoint* joint = nullptr;  ///< null: one of Bullet's own
		btTypedConstraint* constraint = nullptr;
		bool isCut = false, isBroken = false;
	};

	struct Driven
	{
		std::unique_ptr<Vehicle> vehicle;
		Autopilot autopilot;
	};

	void beginControl();
	void restore(const SimulationState& state);
	void buildBodies();
	void buildVehicles();
	void addBody(size_t index);
	void buildJoint(size_t index);
	btTypedConstraint* makeBulletsOwn(const SceneDescription::Joint& joint, btRigidBody& a, btRigidBody& b);
	void refuseOverlaps();
	void substep(btScalar dt);
	void driveVehicles(double dt);
	void moveKinematic(double time);
	void applyLoads(const std::vector<SceneDescription::Load>& loads, double time);
	void applyBlasts(double time, double dt);
	void heatJoints(double time);
	btElasticPlasticCapacity heatedCapacity(int index) const;
	void setGravity();
	void playScript();
	void appear(int body);
	void note(SceneEvent::Type type, int index, const btVector3& place);
	void takeEvents();
	void checkEnd();
	double fastest() const;
	std::vector<SimulationState::Vehicle> vehicleStates() const;
	void restoreVehicles(const std::vector<SimulationState::Vehicle>& states);

	SceneDescription m_scene;
	std::vector<std::unique_ptr<btTriangleMesh>> m_meshes;  // before the world, whose shapes use them
	std::vector<std::unique_ptr<btJointFeedback>> m_feedbacks;
	std::unique_ptr<World> m_world;
	btRigidBody* m_anchor = nullptr;  // what the world is to joints
	std::vector<BuiltBody> m_bodies;
	std::vector<Driven> m_vehicles;
	std::vector<BuiltJoint> m_joints;
	std::unordered_map<const btElasticPlasticJoint*, int> m_indexOf;
	std::unique_ptr<EnergyAudit> m_audit;
	std::unique_ptr<btElasticPlasticStepControl> m_control;
	std::vector<int> m_degrees;  // of the scene's fires, as joints have been given them
	std::vector<SceneDescription::Load> m_addedLoads;
	std::function<void(double)> m_beforeSubstep;
	SimulationState m_run;
	double m_lastDeed = 0;  // of the script: before it nothing stands still
};
}  // namespace ep

#endif  // EP_SIMULATION_H
