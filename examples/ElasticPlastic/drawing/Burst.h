// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BURST_H
#define EP_BURST_H

#include "LinearMath/btVector3.h"

namespace ep
{
/// Something that is seen and heard for a moment: it breaks, strikes or goes off.
struct Burst
{
	enum class Kind
	{
		Break,
		Blow,
		Charge
	};

	Kind kind;
	btVector3 place;
	double energy;  ///< [J]
	bool isSteel;   ///< it sparks and rings; else it is dust and a thud
};
}  // namespace ep

#endif  // EP_BURST_H
