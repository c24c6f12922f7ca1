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
		const Leg& leg = m_route[m_progress.leg];
		btScalar& facing = m_progress.facing;
		btScalar& direction = m_progress.direction;
		// It goes into a bend forwards, also if that is a sharp one.
		if (facing == 0)
			facing = pose.getBasis().getColumn(0).dot(leg.along) < btScalar(-.5) ? btScalar(-1) : btScalar(1);
		const btVector3 lane = leg.along * facing;
		const btScalar way = leg.drives ? (leg.to - pose.getOrigin()).dot(lane) : btScalar(0);
		if (direction == 0)
			direction = way < 0 ? btScalar(-1) : btScalar(1);
		const btScalar left = way * direction;
		if (isDone(leg, left, speed, dt))
		{
			m_progress = {m_progress.leg + 1, 0, 0, 0};
			continue;
		}
		if (left <= 0)
			return controls;
		const btScalar wanted = leg.stops ? btMin(leg.speed, btSqrt(2 * BRAKING * left)) : leg.speed;
		controls.throttle = limited(wanted - speed * direction) * direction;
		controls.handbrake = false;
		controls.steer = steer(leg, lane, pose, speed);
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
		m_progress.waited += dt;
	return stands && m_progress.waited > leg.wait;
}

/// It heads for a point on the lane some way ahead. Backwards all is mirrored.
btScalar Autopilot::steer(const Leg& leg, const btVector3& lane, const btTransform& pose, btScalar speed) const
{
	const btVector3 right = lane.cross(btVector3(0, 1, 0));
	const btScalar beside = (pose.getOrigin() - leg.to).dot(right), heading = pose.getBasis().getColumn(0).dot(right);
	const btScalar ahead = 8 + btFabs(speed), aim = limited(-m_progress.direction * beside / ahead);
	return m_progress.direction * limited(3 * (aim - heading));
}
}  // namespace ep
