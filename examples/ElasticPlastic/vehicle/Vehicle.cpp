// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "vehicle/Vehicle.h"

#include <algorithm>

namespace ep
{
namespace
{
/// Of the chassis, from that of the ground below, with x forward.
btTransform chassisPose(const VehicleSettings& s, const btTransform& pose)
{
	const btVector3 up(0, 1, 0);
	return pose * btTransform(btQuaternion(up, SIMD_HALF_PI), up * s.chassisHeight());
}

btRigidBody& makeChassis(World& world, const VehicleSettings& s, const btTransform& pose)
{
	btRigidBody* const body = world.body(s.mass, world.box(s.size), chassisPose(s, pose));
	body->setFriction(btScalar(.4));
	return *body;
}

/// The impulse that takes the relative velocity of two bodies along a direction to zero, per unit of that velocity.
btScalar massAt(const btRigidBody& a, const btRigidBody& b, const btVector3& point, const btVector3& direction)
{
	return 1 / (a.computeImpulseDenominator(point, direction) + b.computeImpulseDenominator(point, direction));
}

btVector3 velocityAt(const btRigidBody& body, const btVector3& point)
{
	return body.getVelocityInLocalPoint(point - body.getCenterOfMassPosition());
}

/// Rays of the wheels see neither their own chassis nor rubble.
struct RayThroughChassis : btCollisionWorld::ClosestRayResultCallback
{
	RayThroughChassis(const btVector3& from, const btVector3& to, const btRigidBody& chassis)
		: ClosestRayResultCallback(from, to), m_chassis(&chassis)
	{
	}
	bool needsCollision(btBroadphaseProxy* proxy) const override
	{
		const auto* const body = btRigidBody::upcast(static_cast<const btCollisionObject*>(proxy->m_clientObject));
		const bool bears = !body || body->getInvMass() < 100 * m_chassis->getInvMass();
		return bears && body != m_chassis && ClosestRayResultCallback::needsCollision(proxy);
	}
	const btRigidBody* m_chassis;
};
}  // namespace

Vehicle::Vehicle(World& world, const VehicleSettings& settings, const btTransform& pose)
	: Vehicle(world, settings, makeChassis(world, settings, pose))
{
}

Vehicle::Vehicle(World& world, const VehicleSettings& settings, btRigidBody& chassis)
	: btRaycastVehicle(btVehicleTuning(), &chassis, this), m_world(world), m_settings(settings), m_chassis(chassis)
{
	const VehicleSettings& s = m_settings;
	setCoordinateSystem(0, 1, 2);
	btVehicleTuning tuning;
	tuning.m_suspensionStiffness = s.suspensionStiffness;
	tuning.m_suspensionCompression = tuning.m_suspensionDamping = s.suspensionDamping;
	tuning.m_maxSuspensionTravelCm = 100 * s.suspensionLength;
	tuning.m_maxSuspensionForce = 50 * s.mass;
	tuning.m_frictionSlip = s.grip;
	for (bool front : {true, false})
		for (btScalar side : {btScalar(1), btScalar(-1)})
			addWheel(btVector3(side * s.track / 2, s.axleHeight + s.suspensionLength,
							   (front ? s.wheelBase : -s.wheelBase) / 2),
					 btVector3(0, -1, 0), btVector3(-1, 0, 0), s.suspensionLength, s.wheelRadius, tuning, front);
	// Before the first step there are no rays, but there may be a picture.
	resetSuspension();
	turnWheels();
}

void Vehicle::turnWheels()
{
	for (int i = 0; i < getNumWheels(); ++i)
		updateWheelTransform(i, false);
}

void Vehicle::place(const btTransform& pose)
{
	m_chassis.setCenterOfMassTransform(chassisPose(m_settings, pose));
	m_chassis.setInterpolationWorldTransform(m_chassis.getCenterOfMassTransform());
	m_chassis.setLinearVelocity(btVector3(0, 0, 0));
	m_chassis.setAngularVelocity(btVector3(0, 0, 0));
	m_chassis.activate(true);
	m_steer = 0;
	resetSuspension();
}

Vehicle::Memory Vehicle::memory() const
{
	Memory memory;
	for (int i = 0; i < getNumWheels(); ++i)
	{
		const btWheelInfo& wheel = getWheelInfo(i);
		memory.wheels.push_back({wheel.m_rotation, wheel.m_deltaRotation, wheel.m_raycastInfo.m_suspensionLength,
								 wheel.m_wheelsSuspensionForce,
								 size_t(i) < m_ground.size() ? m_ground[size_t(i)] : nullptr});
	}
	memory.steer = m_steer;
	return memory;
}

void Vehicle::restore(const Memory& memory)
{
	m_ground.clear();
	m_steer = memory.steer;
	for (int i = 0; i < getNumWheels(); ++i)
	{
		const Memory::Wheel& remembered = memory.wheels[size_t(i)];
		btWheelInfo& wheel = m_wheelInfo[i];
		wheel.m_rotation = remembered.turn;
		wheel.m_deltaRotation = remembered.lastTurn;
		wheel.m_raycastInfo.m_suspensionLength = remembered.suspension;
		wheel.m_wheelsSuspensionForce = remembered.force;
		m_ground.push_back(remembered.ground);
		steerWheel(i);
	}
	turnWheels();
}

btTransform Vehicle::pose() const
{
	return m_chassis.getCenterOfMassTransform() * btTransform(btQuaternion(btVector3(0, 1, 0), -SIMD_HALF_PI));
}

btScalar Vehicle::speed() const
{
	return m_chassis.getLinearVelocity().dot(m_chassis.getCenterOfMassTransform().getBasis().getColumn(2));
}

btScalar Vehicle::wheelForce() const
{
	btScalar sum = 0;
	for (int i = 0; i < getNumWheels(); ++i)
		sum += getWheelInfo(i).m_wheelsSuspensionForce;
	return sum;
}

void Vehicle::drive(const Controls& controls, btScalar dt)
{
	const VehicleSettings& s = m_settings;
	const btScalar v = speed(), throttle = controls.throttle;
	// Against the way it rolls the pedal brakes.
	const bool braking = throttle * v < 0 && btFabs(v) > btScalar(.5);
	// Constant force, then constant power, and nothing from the speed limit on; half the force backwards.
	btScalar force = btMin(s.driveForce, s.power / btMax(btFabs(v), btScalar(.1))) * throttle;
	if (btFabs(v) > s.topSpeed || braking)
		force = 0;
	if (throttle < 0)
		force /= 2;
	const btScalar brake = s.brakeForce * (controls.handbrake ? 1 : braking ? btFabs(throttle) : btScalar(0));

	// At speed the wheels turn less, and never at once.
	const btScalar wanted = controls.steer * s.maxSteer / (1 + btFabs(v) / 8), rate = btScalar(.8) * dt;
	m_steer += btMax(-rate, btMin(rate, wanted - m_steer));
	for (int i = 0; i < getNumWheels(); ++i)
	{
		applyEngineForce(force / getNumWheels(), i);
		setBrake((brake + s.rollingResistance) / getNumWheels(), i);
		steerWheel(i);
	}
	if (throttle != 0)
		m_chassis.activate();
}

/// Positive turns to the right; Bullet's angle is about the upward axis.
void Vehicle::steerWheel(int index)
{
	setSteeringValue(getWheelInfo(index).m_bIsFrontWheel ? -m_steer : m_steer, index);
}

void* Vehicle::castRay(const btVector3& from, const btVector3& to, btVehicleRaycasterResult& result)
{
	RayThroughChassis ray(from, to, m_chassis);
	m_world.bullet().rayTest(from, to, ray);
	const btRigidBody* const body = ray.hasHit() ? btRigidBody::upcast(ray.m_collisionObject) : nullptr;
	// One ray a wheel, in their order.
	m_ground.push_back(const_cast<btRigidBody*>(body));
	if (!body)
		return nullptr;
	result.m_hitPointInWorld = ray.m_hitPointWorld;
	result.m_hitNormalInWorld = ray.m_hitNormalWorld.normalized();
	result.m_distFraction = ray.m_closestHitFraction;
	return m_ground.back();
}

void Vehicle::updateVehicle(btScalar step)
{
	// Where it sleeps, impulses would add up to a jump when it wakes.
	if (sleeps())
		return;
	m_ground.clear();
	m_loadOnBodies.setZero();
	// Rays, suspension on the chassis, then updateFriction.
	btRaycastVehicle::updateVehicle(step);
	applyDrag(step);
}

bool Vehicle::sleeps()
{
	const btScalar slow = m_chassis.getLinearSleepingThreshold();
	const bool moves = m_chassis.getLinearVelocity().length2() > slow * slow;
	btScalar still = m_chassis.getDeactivationTime();  // for so long all have been slow enough
	for (btRigidBody* ground : m_ground)
	{
		if (!ground || ground->isStaticObject())
			continue;
		// A ground that moves wants the vehicle's weight; one that sleeps has it, until the vehicle moves.
		if (ground->isActive())
			m_chassis.activate();
		else if (moves)
			ground->activate();
		still = btMin(still, ground->getDeactivationTime());
	}
	// So they fall asleep in the same step.
	m_chassis.setDeactivationTime(still);
	for (btRigidBody* ground : m_ground)
		if (ground && !ground->isStaticObject() && ground->isActive())
			ground->setDeactivationTime(still);
	return !m_chassis.isActive();
}

/// In place of Bullet's tyres: the suspension's reaction on the ground, then tyres that push vehicle and ground.
void Vehicle::updateFriction(btScalar step)
{
	int wheelsOnGround = 0;
	for (const btRigidBody* ground : m_ground)
		wheelsOnGround += ground ? 1 : 0;
	for (int i = 0; i < getNumWheels(); ++i)
		if (m_ground[i])
			updateWheel(i, wheelsOnGround, step);
}

/// A damper that is more would throw about a ground that is light for the step: all wheels on it do no more than stop it.
btScalar Vehicle::steadyDamping(int index, btScalar step) const
{
	const btRigidBody* const ground = m_ground[size_t(index)];
	if (ground->getInvMass() == 0)
		return BT_LARGE_FLOAT;
	const auto& contact = m_wheelInfo[index].m_raycastInfo;
	const btScalar wheels = btScalar(std::count(m_ground.begin(), m_ground.end(), ground));
	return massAt(m_chassis, *ground, contact.m_contactPointWS, contact.m_contactNormalWS) / (wheels * step);
}

btScalar Vehicle::springForce(const btWheelInfo& wheel) const
{
	const btScalar pressed = wheel.getSuspensionRestLength() - wheel.m_raycastInfo.m_suspensionLength;
	return wheel.m_suspensionStiffness * pressed * wheel.m_clippedInvContactDotSuspension * m_settings.mass;
}

void Vehicle::updateWheel(int index, int wheelsOnGround, btScalar step)
{
	btWheelInfo& wheel = m_wheelInfo[index];
	const btRigidBody& ground = *m_ground[index];
	const btVector3 &point = wheel.m_raycastInfo.m_contactPointWS, &normal = wheel.m_raycastInfo.m_contactNormalWS;

	// The chassis has this from btRaycastVehicle; its damper, though, took the ground for fixed.
	btScalar& force = wheel.m_wheelsSuspensionForce;
	const btScalar given = btMin(force, wheel.m_maxSuspensionForce);
	const btScalar damping = wheel.m_wheelsDampingCompression * m_settings.mass, steady = steadyDamping(index, step);
	const btScalar wanted = damping <= steady ? given + damping * velocityAt(ground, point).dot(normal)
											  : springForce(wheel) + steady * (velocityAt(ground, point).dot(normal) -
																			   wheel.m_suspensionRelativeVelocity);
	force = btMax(btScalar(0), btMin(wanted, wheel.m_maxSuspensionForce));
	m_chassis.applyImpulse(normal * ((force - given) * step), point - m_chassis.getCenterOfMassPosition());
	loadGround(index, normal * -force);

	// Bullet's wheel has its axle along the wheel's x axis.
	const btVector3 axle = wheel.m_worldTransform.getBasis().getColumn(getRightAxis());
	const btVector3 side = (axle - normal * normal.dot(axle)).normalized(), forward = side.cross(normal);
	const btVector3 slip = velocityAt(m_chassis, point) - velocityAt(ground, point);
	// All wheels of an axle stop the same sideslip: each does its share.
	btVector3 impulse = side * (-slip.dot(side) * massAt(m_chassis, ground, point, side) * 2 / wheelsOnGround);
	const btScalar stop = -slip.dot(forward) * massAt(m_chassis, ground, point, forward) / wheelsOnGround;
	impulse += forward * (wheel.m_engineForce * step + btMax(-wheel.m_brake * step, btMin(wheel.m_brake * step, stop)));
	const btScalar limit = wheel.m_frictionSlip * force * step, size = impulse.length();
	wheel.m_skidInfo = size > limit ? limit / size : btScalar(1);
	applyTyre(index, impulse * wheel.m_skidInfo, step);
}

void Vehicle::applyTyre(int wheel, const btVector3& impulse, btScalar step)
{
	const btVector3& point = m_wheelInfo[wheel].m_raycastInfo.m_contactPointWS;
	m_chassis.applyImpulse(impulse, point - m_chassis.getCenterOfMassPosition());
	loadGround(wheel, impulse / -step);
}

/// By a force, which acts throughout the step, inner steps too: an impulse would be a blow at the step's beginning.
void Vehicle::loadGround(int wheel, const btVector3& force)
{
	btRigidBody& ground = *m_ground[wheel];
	if (ground.getInvMass() == 0 || !ground.isActive())
		return;
	ground.applyForce(force, m_wheelInfo[wheel].m_raycastInfo.m_contactPointWS - ground.getCenterOfMassPosition());
	m_loadOnBodies += force;
}

void Vehicle::applyDrag(btScalar step)
{
	const btVector3& v = m_chassis.getLinearVelocity();
	m_chassis.applyCentralImpulse(v * (-m_settings.airDrag * v.length() * step));
}
}  // namespace ep
