// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_LIMIT_LOAD_H
#define EP_LIMIT_LOAD_H

#include <algorithm>
#include <cmath>

#include "problems/Run.h"

namespace ep
{
/// Does it stand under a load that is put on within a second and stays for another? Not if it has given way by more than a
/// limit until then: above what stands, but little, as a load just over the limit moves slowly at first.
template <class Structure, class Load, class Give>
bool stands(Structure& structure, const Stepping& stepping, Outcome& outcome, double limit, const Load& load,
			const Give& give)
{
	Run run(structure.m_world, stepping, outcome);
	while (run.stepsUntil(2) > 0)
	{
		const double share = std::min(1., (run.time() + run.dt()) / 1.);
		run.step([&] { load(share); });
		if (!(std::fabs(give()) < limit))
			return false;
	}
	return true;
}

/// The factor on the load at which it does not stand any more, by bisection between 0 and 2, to a thousandth.
template <class Try>
double limitFactor(const Try& standsAt)
{
	double low = 0, high = 2;
	for (int i = 0; i < 11; ++i)
	{
		const double middle = (low + high) / 2;
		(standsAt(middle) ? low : high) = middle;
	}
	return (low + high) / 2;
}
}  // namespace ep

#endif  // EP_LIMIT_LOAD_H
