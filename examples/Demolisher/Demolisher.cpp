#include "Demolisher.h"

#include <chrono>

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

btTransform startPose(btScalar x) { return btTransform(btQuaternion(0, 0, 0, 1), btVector3(x, 0, 0)); }
}  // namespace

Demolisher::Demolisher(const DemolisherSettings& settings)
	: m_settings(settings),
	  m_world(settings.solver, btVector3(0, 0, 0)),
	  m_bridge(m_world, settings.bridge),
	  m_vehicle(m_world, settings.vehicle, startPose(settings.start)),
	  m_autopilot(settings.autopilot)
{
	addGround(m_world);
	m_world.bullet().getSolverInfo().m_numIterations = settings.iterations;
}

void Demolisher::step(const Controls& controls)
{
	const auto begin = std::chrono::steady_clock::now();
	++m_steps;
	// Smooth at both ends, so that the bridge does not swing when gravity is there.
	const btScalar t = btMin(btScalar(1), m_steps * STEP / m_settings.gravityTime);
	m_world.bullet().setGravity(btVector3(0, -m_settings.gravity * t * t * (3 - 2 * t), 0));
	m_vehicle.drive(controls, STEP);
	m_world.step(STEP, m_settings.substeps);
	m_wallTime += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void Demolisher::stepByAutopilot()
{
	Controls controls;
	controls.handbrake = true;
	const bool ready = m_steps * STEP > m_settings.gravityTime + btScalar(.5);
	step(ready ? m_autopilot.drive(m_vehicle.pose(), m_vehicle.speed()) : controls);
}

bool Demolisher::hasArrived() const { return m_autopilot.hasArrived(m_vehicle.pose(), m_vehicle.speed()); }

DemolisherSummary Demolisher::summary() const
{
	DemolisherSummary s;
	for (const btElasticPlasticJoint* joint : m_world.joints())
	{
		++s.joints;
		s.yielded += joint->hasYielded() ? 1 : 0;
		s.broken += joint->isBroken() ? 1 : 0;
		s.plasticEnergy += joint->getPlasticEnergy();
	}
	s.sag = m_bridge.sag();
	s.vehicle = m_vehicle.pose().getOrigin();
	s.speed = m_vehicle.speed();
	const BridgeSettings& b = m_settings.bridge;
	s.crossed = s.vehicle.x() > b.span / 2 + b.supportLength + b.rampLength;
	s.time = m_steps * double(STEP);
	s.realTimeFactor = m_wallTime > 0 ? s.time / m_wallTime : 0;
	return s;
}
}  // namespace ep
