// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "runs/Figure11.h"

namespace ep
{
namespace
{
const btScalar SPEED = 12, SLOW = 2;  // [m/s]
const double LONGEST_FALL = 600;      // [s]

Leg to(btScalar x, btScalar speed, btScalar wait = 0)
{
	Leg leg;
	leg.to.setX(x);
	leg.speed = speed;
	leg.wait = wait;
	return leg;
}
}  // namespace

const char* Figure11::name(State state)
{
	static const char* const names[STATES] = {"figure-11-a", "figure-11-b", "figure-11-c"};
	return names[state];
}

DemolisherSettings Figure11::settings()
{
	DemolisherSettings s;
	s.scenes = {Scene::Gate, Scene::Fence, Scene::Bridge};
	return s;
}

bool Figure11::reach(State state, const std::function<void()>& stepped)
{
	const DemolisherSettings& s = m_demolisher.settings();
	const btScalar foot = s.rampFoot();
	Leg wait;
	wait.drives = false;
	wait.wait = 3;
	if (state == INITIAL)
		return drive({wait}, stepped);
	if (state == CROSSED)
	{
		// Into the fence by so much, at walking pace.
		const btScalar dent = btScalar(.22),
					   touch = s.placeOf(Scene::Fence) - (s.vehicle.size.z() + s.fence.postThickness) / 2;
		Leg across = to(foot, SPEED);
		across.stops = false;
		return drive({across, to(touch + dent, SLOW, 3)}, stepped);
	}
	for (btScalar side = -1; !hasFallen(); side = -side)
		if (!drive({to(side * (foot + 5), SPEED)}, stepped))
			return false;
	return drive({to(m_demolisher.vehicle().pose().getOrigin().x(), SPEED), wait}, stepped);
}

bool Figure11::drive(const Route& route, const std::function<void()>& stepped)
{
	m_demolisher.follow(route);
	while (!m_demolisher.autopilot().hasArrived())
	{
		if (m_demolisher.time() > LONGEST_FALL)
			return false;
		const bool stood = !hasFallen();
		m_demolisher.stepByAutopilot();
		stepped();
		if (stood && hasFallen())
			return true;
	}
	return true;
}

/// No end of the deck hangs on its support any more.
bool Figure11::hasFallen() const
{
	const std::vector<btElasticPlasticJoint*>& nodes = m_demolisher.bridge()->deck().m_jointAt;
	return nodes.front()->isBroken() && nodes.back()->isBroken();
}
}  // namespace ep
