// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_AUTOPILOT_H
#define EP_AUTOPILOT_H

#include <vector>

#include "drawing/Controls.h"
#include "LinearMath/btTransform.h"

namespace ep
{
/// A part of a route: along the x axis to a place, or a wait.
struct Leg
{
	bool drives = true;   ///< false: it only waits
	btScalar to = 60;     ///< x, forwards or backwards from where it is [m]
	btScalar speed = 12;  ///< [m/s], > 0
	bool stops = true;    ///< there; else it drives on into the next leg
	btScalar wait = 0;    ///< at the end [s]
};
using Route = std::vector<Leg>;

/// Drives a route and keeps to z = 0. The pose has its x axis forward; backwards it drives in reverse.
class Autopilot
{
public:
	explicit Autopilot(const Route& route) : m_route(route) {}

	/// For the next step of dt.
	Controls drive(const btTransform& pose, btScalar speed, btScalar dt);

	bool hasArrived() const { return m_leg == m_route.size(); }
	size_t leg() const { return m_leg; }

private:
	bool isDone(const Leg& leg, btScalar left, btScalar speed, btScalar dt);
	btScalar steer(const btTransform& pose, btScalar speed) const;

	Route m_route;
	size_t m_leg = 0;
	btScalar m_direction = 0;  ///< of the leg, 1 or -1; 0: it has not begun
	btScalar m_waited = 0;     ///< [s]
};
}  // namespace ep

#endif  // EP_AUTOPILOT_H
