// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_ONE_SCENE_H
#define EP_TEST_ONE_SCENE_H

#include "simulation/Demolisher.h"

/// The demolisher's settings with one scene built.
inline ep::DemolisherSettings only(ep::Scene scene)
{
	ep::DemolisherSettings settings;
	settings.scenes = {scene};
	return settings;
}

#endif  // EP_TEST_ONE_SCENE_H
