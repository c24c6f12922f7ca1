// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/Demolisher.h"

#include <chrono>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"

namespace ep
{
namespace
{
void addGround(World& world)
{
	btRigidBody* const ground =
		world.body(0, world.keep(new btStaticPlaneShape(btVector3(0, 1, 0), 0)), btTransform::getIdentity());
	ground->setFriction(btScalar(.8));
}
}  // namespace

Demolisher::Demolisher(const DemolisherSettings& settings)
	: m_settings(settings),
	  m_world(settings.method, btVector3(0, 0, 0)),
	  m_vehicle(m_world, settings.vehicle, at(settings.startOf(settings.onTheWay().front()))),
	  m_autopilot(settings.actualRoute()),
	  m_joints(m_world)
{
	m_world.beforeSubsteps([this](btScalar dt) { m_vehicle.updateVehicle(dt); });
	addGround(m_world);
	for (Scene scene : m_settings.onTheWay())
		build(scene);
	setEffort(settings.substeps, settings.method.iterations, settings.innerError);
	if (m_settings.sleepSpeed > 0)
		m_world.allowSleep(m_settings.sleepSpeed);
}

void Demolisher::build(Scene scene)
{
	const DemolisherSettings& s = m_settings;
	const btVector3 origin(s.placeOf(scene), 0, 0);
	std::unique_ptr<Structure>& structure = m_structures[size_t(scene)];
	switch (scene)
	{
		case Scene::Gate:
			structure = std::make_unique<Gate>(m_world, s.materials, s.gate, origin);
			break;
		case Scene::Fence:
			structure = std::make_unique<Fence>(m_world, s.materials, s.fence, origin);
			break;
		case Scene::Bridge:
			structure = std::make_unique<Bridge>(m_world, s.materials, s.bridge, origin);
			break;
		case Scene::House:
			structure = std::make_unique<House>(m_world, s.materials, s.house, origin);
			break;
		case Scene::Rod:
			structure = std::make_unique<Rod>(m_world, s.materials, s.rod, origin);
			break;
	}
	for (const btElasticPlasticJoint* joint : structure->joints())
		m_joints.add(scene, *joint);
}

void Demolisher::step(const Controls& controls)
{
	const auto begin = std::chrono::steady_clock::now();
	m_time += double(m_settings.step);
	growGravity();
	m_vehicle.drive(controls, m_settings.step);
	m_world.step(m_settings.step, m_settings.substeps);
	m_vehicle.turnWheels();
	m_wallTime += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
	m_joints.update(m_time);
}

/// Smoothly at both ends, so that nothing swings when gravity is there.
void Demolisher::growGravity()
{
	const btScalar before = btScalar(m_time) - m_settings.step;
	if (before >= m_settings.gravityTime)
		return;
	const btScalar t = btMin(btScalar(1), btScalar(m_time) / m_settings.gravityTime);
	m_world.bullet().setGravity(btVector3(0, -m_settings.gravity * t * t * (3 - 2 * t), 0));
	m_world.keepAwake();
}

void Demolisher::stepByAutopilot()
{
	Controls controls;
	controls.handbrake = true;
	if (m_time > double(m_settings.gravityTime) + .5)
		controls = m_autopilot.drive(m_vehicle.pose(), m_vehicle.speed(), m_settings.step);
	step(controls);
}

void Demolisher::setEffort(int substeps, int iterations, btScalar innerError)
{
	m_settings.substeps = substeps;
	m_settings.innerError = innerError;
	if (auto* const ours = dynamic_cast<btElasticPlasticConstraintSolver*>(m_world.bullet().getConstraintSolver()))
	{
		btElasticPlasticSolverSettings settings = ours->getSettings();
		settings.m_innerError = double(innerError);
		// The fence and the bridge are larger than what takes them by default.
		settings.m_maxInnerWork = 2 * btElasticPlasticSolverSettings().m_maxInnerWork;
		ours->setSettings(settings);
	}
	m_settings.method.iterations = iterations;
	m_world.bullet().getSolverInfo().m_numIterations = iterations;
}

void Demolisher::jumpTo(Scene scene) { m_vehicle.place(at(m_settings.startOf(scene))); }

Demolisher::Moment Demolisher::moment()
{
	return {m_time, m_balls.size(), m_world.save(), m_joints.records(), m_vehicle.memory(), m_autopilot};
}

bool Demolisher::goBack(const Moment& moment)
{
	for (; m_balls.size() > moment.balls; m_balls.pop_back())
		m_world.bullet().removeRigidBody(m_balls.back());
	if (!m_world.restore(moment.world))
		return false;
	m_time = moment.time;
	m_joints.restore(moment.joints);
	m_vehicle.restore(moment.vehicle);
	m_autopilot = moment.autopilot;
	return true;
}

void Demolisher::throwBall(const btVector3& from, const btVector3& velocity)
{
	const btScalar mass = 500, radius = btScalar(.4);
	btRigidBody* const ball =
		m_world.body(mass, m_world.keep(new btSphereShape(radius)), btTransform(btQuaternion(0, 0, 0, 1), from));
	ball->setLinearVelocity(velocity);
	ball->setFriction(btScalar(.6));
	m_balls.push_back(ball);
}

DemolisherSummary Demolisher::summary() const
{
	DemolisherSummary s;
	for (const JointRecord& record : m_joints.records())
	{
		const JointReading joint = m_joints.read(record);
		++s.joints;
		s.yielded += record.yieldTime >= 0 ? 1 : 0;
		s.broken += joint.isBroken ? 1 : 0;
		s.plasticEnergy += joint.plasticEnergy;
		s.elasticEnergy += joint.elasticEnergy;
		s.numericalEnergy += joint.numericalEnergy;
	}
	for (const auto& body : m_world.bodies())
		s.asleep += !body->isStaticObject() && !body->isActive() ? 1 : 0;
	s.kineticEnergy = m_world.kineticEnergy();
	s.sag = bridge() ? double(bridge()->sag()) : 0;
	s.vehicle = m_vehicle.pose().getOrigin();
	s.speed = double(m_vehicle.speed());
	s.crossed = bridge() && s.vehicle.x() > m_settings.rampFoot();
	s.time = m_time;
	s.realTimeFactor = m_wallTime > 0 ? s.time / m_wallTime : 0;
	return s;
}
}  // namespace ep
