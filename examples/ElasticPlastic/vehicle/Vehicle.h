// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VEHICLE_H
#define EP_VEHICLE_H

#include <vector>

#include "vehicle/Controls.h"
#include "vehicle/VehicleSettings.h"
#include "world/World.h"

namespace ep
{
/// Bullet's ray-cast vehicle on a ground that feels it.
///
/// btRaycastVehicle gives the suspension's and the tyres' impulses to the chassis only and takes all ground as fixed: a
/// bridge would carry a vehicle without noticing. Here each wheel remembers the body its ray has hit, and that body gets
/// the opposite impulse at the contact point; damper and tyres see the velocity of vehicle and ground against each other.
/// Rubble lighter than a hundredth of the vehicle is no ground: tyres roll over it.
///
/// It sleeps when it stands, by itself: wheels make no island with what they stand on. Each waits for the other.
class Vehicle : private btVehicleRaycaster, public btRaycastVehicle
{
public:
	/// The pose is that of the ground below the vehicle, x forward.
	Vehicle(World& world, const VehicleSettings& settings, const btTransform& pose);

	/// On a chassis of the settings' mass and size, in whose frame x is left, y up and z forward.
	Vehicle(World& world, const VehicleSettings& settings, btRigidBody& chassis);

	/// Puts it there, at rest.
	void place(const btTransform& pose);

	const VehicleSettings& settings() const { return m_settings; }
	btRigidBody& chassis() const { return m_chassis; }

	/// Chassis pose with x forward, y up, z to the right, as the world's.
	btTransform pose() const;
	btScalar speed() const;  ///< forward [m/s]

	/// Sets engine, brakes and steering for the next step of dt.
	void drive(const Controls& controls, btScalar dt);

	/// Wheels go with the body: after a step, to be drawn.
	void turnWheels();

	/// Takes what it stands on into account, and pushes it and the vehicle: before each substep.
	void updateVehicle(btScalar step) override;

	/// What it remembers from step to step beside its body.
	struct Memory
	{
		struct Wheel
		{
			btScalar turn = 0, lastTurn = 0;     ///< about its axle, in all and in the last step [rad]
			btScalar suspension = 0, force = 0;  ///< length [m], force [N]
			btRigidBody* ground = nullptr;       ///< null: none
		};
		std::vector<Wheel> wheels;
		btScalar steer = 0;
	};
	Memory memory() const;
	void restore(const Memory& memory);

	/// What the wheels did to bodies with mass in the last substep, mean force [N].
	const btVector3& loadOnBodies() const { return m_loadOnBodies; }

	/// The suspension's force of all wheels in the last substep, whatever they stand on [N].
	btScalar wheelForce() const;

private:
	void updateFriction(btScalar step) override;
	void steerWheel(int index);
	void* castRay(const btVector3& from, const btVector3& to, btVehicleRaycasterResult& result) override;
	bool sleeps();
	btScalar steadyDamping(int index, btScalar step) const;
	btScalar springForce(const btWheelInfo& wheel) const;
	void updateWheel(int index, int wheelsOnGround, btScalar step);
	void applyTyre(int wheel, const btVector3& impulse, btScalar step);
	void loadGround(int wheel, const btVector3& force);
	void applyDrag(btScalar step);

	World& m_world;
	VehicleSettings m_settings;
	btRigidBody& m_chassis;
	std::vector<btRigidBody*> m_ground;  ///< below each wheel, null: none
	btVector3 m_loadOnBodies = btVector3(0, 0, 0);
	btScalar m_steer = 0;
};
}  // namespace ep

#endif  // EP_VEHICLE_H
