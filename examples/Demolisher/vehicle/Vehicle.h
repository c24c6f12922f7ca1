// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VEHICLE_H
#define EP_VEHICLE_H

#include <vector>

#include "drawing/Controls.h"
#include "world/World.h"

namespace ep
{
/// A heavy dump truck. SI units; the vehicle's own frame is Bullet's usual one: x left, y up, z forward.
struct VehicleSettings
{
	btScalar mass = 50000;                                        ///< [kg]
	btVector3 size = btVector3(btScalar(2.8), btScalar(1.5), 7);  ///< of the box: width, height, length [m]
	btScalar wheelRadius = btScalar(.8);                          ///< [m]
	btScalar wheelBase = btScalar(4.2);                           ///< between the axles [m]
	btScalar track = btScalar(2.7);                               ///< between the wheels of an axle [m]
	btScalar axleHeight = btScalar(-.7);                          ///< of the unloaded wheels, from the box's centre [m]
	btScalar suspensionLength = btScalar(.5);                     ///< unloaded [m]
	btScalar suspensionStiffness = 50;                            ///< of a wheel, over the vehicle's mass [1/s^2]
	btScalar suspensionDamping = btScalar(4.5);                   ///< of a wheel, over the vehicle's mass [1/s]
	btScalar grip = btScalar(.8);                                 ///< friction of the tyres
	btScalar driveForce = 220e3;                                  ///< of all wheels at low speed [N]
	btScalar power = 1200e3;                                      ///< of the engine [W]
	btScalar brakeForce = 250e3;                                  ///< of all wheels [N]
	btScalar topSpeed = btScalar(95 / 3.6);                       ///< [m/s]
	btScalar rollingResistance = 7.5e3;                           ///< of all wheels [N]
	btScalar airDrag = btScalar(.5 * 1.2 * .9 * 9);               ///< rho/2 c_d A [N s^2/m^2]
	btScalar maxSteer = btScalar(.3);  ///< of all wheels, the rear ones against the front ones [rad]
};

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
	~Vehicle() override;

	/// Puts it there, at rest.
	void place(const btTransform& pose);

	const VehicleSettings& settings() const { return m_settings; }
	btRigidBody& chassis() const { return m_chassis; }

	/// Chassis pose with x forward, y up, z to the right, as the world's.
	btTransform pose() const;
	btScalar speed() const;  ///< forward [m/s]

	/// Sets engine, brakes and steering for the next step of dt.
	void drive(const Controls& controls, btScalar dt);

	/// What it remembers from step to step beside its body.
	struct Memory
	{
		std::vector<btWheelInfo> wheels;
		std::vector<btRigidBody*> ground;
		btScalar steer;
	};
	Memory memory() const;
	void restore(const Memory& memory);

	/// What the wheels did to bodies with mass in the last substep, mean force [N].
	const btVector3& loadOnBodies() const { return m_loadOnBodies; }

	/// The suspension's force of all wheels in the last substep, whatever they stand on [N].
	btScalar wheelForce() const;

	void updateVehicle(btScalar step) override;
	void updateFriction(btScalar step) override;

private:
	void* castRay(const btVector3& from, const btVector3& to, btVehicleRaycasterResult& result) override;
	bool sleeps();
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
