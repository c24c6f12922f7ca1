#ifndef EP_AUTOPILOT_H
#define EP_AUTOPILOT_H

#include "Controls.h"
#include "LinearMath/btTransform.h"

namespace ep
{
/// Drives along the x axis at a set speed, keeps to z = 0, and stops at the end.
class Autopilot
{
public:
	struct Settings
	{
		btScalar speed = 12;  ///< [m/s]
		btScalar end = 60;    ///< where to stop, x [m]
	};

	explicit Autopilot(const Settings& settings) : m_settings(settings) {}

	/// The pose has its x axis forward.
	Controls drive(const btTransform& pose, btScalar speed) const;

	bool hasArrived(const btTransform& pose, btScalar speed) const;

private:
	Settings m_settings;
};
}  // namespace ep

#endif  // EP_AUTOPILOT_H
