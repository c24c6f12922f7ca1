// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "vehicle/VehicleSettings.h"

namespace ep
{
VehicleSettings VehicleSettings::car()
{
	VehicleSettings s;
	s.mass = 1400;
	s.size.setValue(btScalar(1.7), btScalar(.7), btScalar(4.2));
	s.wheelRadius = btScalar(.3);
	s.wheelBase = btScalar(2.6);
	s.track = btScalar(1.5);
	s.axleHeight = btScalar(-.4);
	s.suspensionLength = btScalar(.35);
	s.suspensionStiffness = 17;
	s.suspensionDamping = btScalar(1.6);
	s.driveForce = 5e3;
	s.power = 90e3;
	s.brakeForce = 11e3;
	s.topSpeed = 50;
	s.rollingResistance = 200;
	s.airDrag = btScalar(.5 * 1.2 * .32 * 2.2);
	return s;
}
}  // namespace ep
