// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_AUTOPILOT_H
#define EP_AUTOPILOT_H

#include <vector>

#include "vehicle/Controls.h"
#include "LinearMath/btTransform.h"

namespace ep
{
/// A part of a route: straight on to a place, or a wait.
struct Leg
{
	bool drives = true;                    ///< false: it only waits
	btVector3 to = btVector3(60, 0, 0);    ///< forwards, or backwards from where it is; its height does not matter [m]
	btVector3 along = btVector3(1, 0, 0);  ///< level direction of the lane through that place
	btScalar speed = 12;                   ///< [m/s], > 0
	bool stops = true;                     ///< there; else it drives on into the next leg
	btScalar wait = 0;                     ///< at the end [s]
};
using Route = std::vector<Leg>;

/// Drives a route and keeps to its lanes. The pose has its x axis forward; what lies behind is reached in reverse.
class Autopilot
{
public:
	explicit Autopilot(const Route& route) : m_route(route) {}

	/// For the next step of dt.
	Controls drive(const btTransform& pose, btScalar speed, btScalar dt);

	bool hasArrived() const { return m_progress.leg == m_route.size(); }

	/// It stands where a leg says so, and will drive on or has to stand longer.
	bool isWaiting() const { return !hasArrived() && m_progress.waited > 0; }

	/// How far it has come.
	struct Progress
	{
		size_t leg = 0;
		btScalar facing = 0;     ///< 1: it faces along the leg's lane, -1: against it; 0: the leg has not begun
		btScalar direction = 0;  ///< 1: it drives forwards, -1: backwards
		btScalar waited = 0;     ///< [s]
	};
	const Progress& progress() const { return m_progress; }
	void setProgress(const Progress& progress) { m_progress = progress; }

private:
	bool isDone(const Leg& leg, btScalar left, btScalar speed, btScalar dt);
	btScalar steer(const Leg& leg, const btVector3& lane, const btTransform& pose, btScalar speed) const;

	Route m_route;
	Progress m_progress;
};
}  // namespace ep

#endif  // EP_AUTOPILOT_H
