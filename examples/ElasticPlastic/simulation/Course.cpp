// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/Course.h"

#include <algorithm>
#include <cmath>

namespace ep
{
namespace
{
double mix(double a, double b, double share) { return a + (b - a) * share; }
btVector3 mix(const btVector3& a, const btVector3& b, double share) { return a.lerp(b, btScalar(share)); }

/// Straight between a table's points, even before and after them.
template <class Value>
Value between(const std::vector<std::pair<double, Value>>& table, double time)
{
	const auto next = std::find_if(table.begin(), table.end(), [&](const auto& point) { return point.first > time; });
	if (next == table.begin())
		return next->second;
	const auto& last = *(next - 1);
	return next == table.end() ? last.second
							   : mix(last.second, next->second, (time - last.first) / (next->first - last.first));
}
}  // namespace

double factorAt(const SceneDescription::Course& c, double time)
{
	const double factor = c.table.empty() ? 1 : between(c.table, time);
	const double pi = 3.14159265358979323846;
	return c.frequency > 0 ? factor * std::sin(2 * pi * c.frequency * time + c.phase * pi / 180) : factor;
}

btVector3 onPath(const std::vector<std::pair<double, btVector3>>& path, double time) { return between(path, time); }

double meanOfPulse(double begin, double duration, double time, double dt)
{
	// The integral of 1 - s from one share s of the duration to another.
	const auto upTo = [&](double t)
	{
		const double s = std::min(1., std::max(0., (t - begin) / duration));
		return s - s * s / 2;
	};
	return (upTo(time + dt) - upTo(time)) * duration / dt;
}
}  // namespace ep
