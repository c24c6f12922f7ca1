// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CONTROLS_H
#define EP_CONTROLS_H

#include "LinearMath/btScalar.h"

namespace ep
{
/// What a driver does.
struct Controls
{
	btScalar throttle = 0;  ///< 1 full ahead, -1 full brake and then reverse
	btScalar steer = 0;     ///< 1 to the right, -1 to the left
	bool handbrake = false;
};
}  // namespace ep

#endif  // EP_CONTROLS_H
