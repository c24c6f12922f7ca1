// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "vehicle/Autopilot.h"

#include "LinearMath/btMinMax.h"

namespace ep
{
namespace
{
const btScalar BRAKING = 2;  // gentle [m/s^2]

btScalar limited(btScalar value) { return btMax(btScalar(-1), btMin(btScalar(1), value)); }
}  // namespace

Controls Autopilot::drive(const btTransform& pose, btScalar speed, btScalar dt)
{
	Controls controls;
	controls.handbrake = true;
	while (!hasArrived())
	{
		const Leg& leg = m_route[m_leg];
		const btScalar way = leg.drives ? leg.to - pose.getOrigin().x() : btScalar(0);
		if (m_direction == 0)
			m_direction = way < 0 ? btScalar(-1) : btScalar(1);
		const btScalar left = way * m_direction;
		if (isDone(leg, left, speed, dt))
		{
			++m_leg;
			m_direction = m_waited = 0;
			continue;
		}
		if (left <= 0)
			return controls;
		const btScalar wanted = leg.stops ? btMin(leg.speed, btSqrt(2 * BRAKING * left)) : leg.speed;
		controls.throttle = limited(wanted - speed * m_direction) * m_direction;
		controls.handbrake = false;
		controls.steer = steer(pose, speed);
		return controls;
	}
	return controls;
}

bool Autopilot::isDone(const Leg& leg, btScalar left, btScalar speed, btScalar dt)
{
	if (leg.drives && !leg.stops)
		return left <= 0;
	const bool stands = !leg.drives || (left < 3 && btFabs(speed) < btScalar(.2));
	if (stands)
		m_waited += dt;
	return stands && m_waited > leg.wait;
}

/// It heads for a point on the lane some way ahead; z grows to the right. Backwards all is mirrored.
btScalar Autopilot::steer(const btTransform& pose, btScalar speed) const
{
	const btVector3 heading = pose.getBasis().getColumn(0);
	const btScalar ahead = 8 + btFabs(speed), aim = -m_direction * pose.getOrigin().z() / ahead;
	return m_direction * limited(3 * (aim - heading.z()));
}
}  // namespace ep
