// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VEHICLE_SETTINGS_H
#define EP_VEHICLE_SETTINGS_H

#include "LinearMath/btVector3.h"

namespace ep
{
/// Of a heavy dump truck. SI units; the vehicle's own frame is Bullet's usual one: x left, y up, z forward.
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

	/// Of the wheels over the unloaded suspension.
	btScalar chassisHeight() const { return wheelRadius - axleHeight; }  ///< of the box's centre above the ground [m]

	/// Of a passenger car: its body swings at 1.3 Hz, and 0.4 of what would be critical damps that.
	static VehicleSettings car();
};

}  // namespace ep

#endif  // EP_VEHICLE_SETTINGS_H
