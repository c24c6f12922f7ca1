// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_AUDITED_PLAY_H
#define EP_TEST_AUDITED_PLAY_H

#include <functional>

#include "scenes/destruction/Stage.h"
#include "world/EnergyAudit.h"

/// Plays a stage up to a frame, and follows its energy.
/// \param look  is called after each step, with what the step has gained beyond Bullet's recovery where no joints are [J]
/// \return the energy that went to and fro [J]
inline double playAudited(ep::Stage& stage, int frames, const std::function<void(double gain)>& look)
{
	ep::EnergyAudit audit(stage.world());
	while (stage.frame() < frames)
	{
		stage.playScript();
		audit.begin();
		stage.step();
		audit.end(btScalar(ep::Stage::FRAME));
		look(audit.gain() - audit.bulletsRecovery());
	}
	return audit.turnover();
}

#endif  // EP_TEST_AUDITED_PLAY_H
