// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/DemolisherSettings.h"

#include <algorithm>

namespace ep
{
const std::vector<Named<Scene>>& scenes()
{
	static const std::vector<Named<Scene>> all = {
		{"gate", Scene::Gate, "a slender steel boom across the lane, held by a heavy box"},
		{"fence", Scene::Fence, "posts of reinforced concrete with steel rails"},
		{"bridge", Scene::Bridge, "a deck of reinforced concrete between rigid ramps"},
		{"rod", Scene::Rod, "an upright steel rod"},
		{"house", Scene::House, "the frame of a house of three storeys"}};
	return all;
}

bool DemolisherSettings::has(Scene scene) const
{
	return std::find(scenes.begin(), scenes.end(), scene) != scenes.end();
}

btScalar DemolisherSettings::rampFoot() const { return bridge.span / 2 + bridge.supportLength + bridge.rampLength; }

btScalar DemolisherSettings::placeOf(Scene scene) const
{
	switch (scene)
	{
		case Scene::Gate:
			return -rampFoot() - 14;
		case Scene::Fence:
			return rampFoot() + 26;
		case Scene::Rod:
			return rampFoot() + 60;
		case Scene::House:
			return rampFoot() + 100;
		case Scene::Bridge:
			break;
	}
	return 0;
}

btScalar DemolisherSettings::startOf(Scene scene) const
{
	// With all wheels off the ramp.
	if (scene == Scene::Fence && has(Scene::Bridge))
		return rampFoot() + 5;
	if (scene != Scene::Bridge)
		return placeOf(scene) - 25;
	return -rampFoot() - (has(Scene::Gate) ? 5 : 18);
}

std::vector<Scene> DemolisherSettings::onTheWay() const
{
	std::vector<Scene> way = scenes;
	std::sort(way.begin(), way.end(), [this](Scene a, Scene b) { return placeOf(a) < placeOf(b); });
	return way;
}

Route DemolisherSettings::actualRoute() const
{
	if (!route.empty())
		return route;
	Leg leg;
	const Scene last = onTheWay().back();
	leg.to.setX(last == Scene::Bridge ? rampFoot() + 18 : placeOf(last) + 25);
	leg.speed = speed;
	return {leg};
}
}  // namespace ep
