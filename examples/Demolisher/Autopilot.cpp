#include "Autopilot.h"

#include "LinearMath/btMinMax.h"

namespace ep
{
namespace
{
btScalar limited(btScalar value) { return btMax(btScalar(-1), btMin(btScalar(1), value)); }
}  // namespace

Controls Autopilot::drive(const btTransform& pose, btScalar speed) const
{
	Controls controls;
	const btScalar left = m_settings.end - pose.getOrigin().x();
	// A gentle braking of 2 m/s^2 ends where it should.
	const btScalar wanted = left > 0 ? btMin(m_settings.speed, btSqrt(2 * 2 * left)) : btScalar(0);
	controls.throttle = limited(wanted - speed);
	controls.handbrake = left <= 0;

	// It heads for a point on the lane some way ahead; z grows to the right.
	const btVector3 heading = pose.getBasis().getColumn(0);
	const btScalar ahead = 8 + speed, aim = -pose.getOrigin().z() / ahead;
	controls.steer = limited(3 * (aim - heading.z()));
	return controls;
}

bool Autopilot::hasArrived(const btTransform& pose, btScalar speed) const
{
	return pose.getOrigin().x() > m_settings.end - 3 && btFabs(speed) < btScalar(.2);
}
}  // namespace ep
