// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BOUNDS_H
#define EP_BOUNDS_H

#include "LinearMath/btVector3.h"

namespace ep
{
/// A box along the axes, empty at first.
struct Bounds
{
	btVector3 low = btVector3(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT), high = -low;

	bool isEmpty() const { return low.x() > high.x(); }
	btVector3 centre() const { return (low + high) / 2; }
	btVector3 size() const { return high - low; }

	void add(const btVector3& point)
	{
		low.setMin(point);
		high.setMax(point);
	}

	void add(const Bounds& other)
	{
		low.setMin(other.low);
		high.setMax(other.high);
	}
};
}  // namespace ep

#endif  // EP_BOUNDS_H
