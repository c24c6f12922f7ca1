// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PROPS_H
#define EP_PROPS_H

#include "scenes/destruction/Stage.h"

namespace ep
{
/// Signs on steel poles and wooden fences that stand on the ground by their weight, and balls that roll into them.
struct Props
{
	int count = 200;

	void build(Stage& stage) const;
};
}  // namespace ep

#endif  // EP_PROPS_H
