// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "studies/Friction.h"

#include <cmath>

#include "test/Parts.h"

namespace ep::charpy
{
/// Half of the specimen, turned by t, lies on the anvil's corner and the striker's edge: along it
///     s = (g/2 - c sin t) / cos t,  r = (e + d sin t) / cos t
/// from the hinge, across it c and d. There they press with N and P, and the half slides: past the striker inwards, past the
/// anvil outwards at first, m = -mu, and then inwards, m = mu. Its forces along the blow and its moments about the hinge are
///     N (cos t + m sin t) = P (cos t - mu sin t),  N (s + m c) - P (r + mu d) = M.
double quasiStaticFriction(const Settings& settings)
{
	const double mu = settings.friction, c = settings.hingeHeight(), d = settings.height - c, g = settings.gap,
				 e = std::fabs(double(hammerShape(settings).plan[0].z()));
	const auto onAnvil = [=](double t) { return (g / 2 - c * std::sin(t)) / std::cos(t); };
	const auto onStriker = [=](double t) { return (e + d * std::sin(t)) / std::cos(t); };
	const int n = 10000;
	double work = 0;
	for (int i = 0; i < n; ++i)
	{
		const double dt = settings.passingAngle() / 2 / n, t = (i + 0.5) * dt;
		const double ds = onAnvil(t + dt / 2) - onAnvil(t - dt / 2), dr = onStriker(t + dt / 2) - onStriker(t - dt / 2);
		const double m = ds < 0 ? -mu : mu;
		const double ratio = (std::cos(t) + m * std::sin(t)) / (std::cos(t) - mu * std::sin(t));  // P / N
		const double lever = onAnvil(t) + m * c - ratio * (onStriker(t) + mu * d);                // M / N
		if (!(ratio > 0 && lever > 0))
			return HUGE_VAL;
		work += 2 * mu * settings.plasticMoment() / lever * (std::fabs(ds) + ratio * dr);
	}
	return work;
}
}  // namespace ep::charpy
