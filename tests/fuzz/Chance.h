// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FUZZ_CHANCE_H
#define EP_FUZZ_CHANCE_H

#include <math.h>

#include <limits>
#include <random>

#include "LinearMath/btTransform.h"

/// What is drawn by lot, the same for a seed with every compiler.
class Chance
{
public:
	explicit Chance(unsigned seed) : m_random(seed) {}

	/// 0 to n - 1.
	int below(int n) { return int(m_random() % unsigned(n)); }
	bool oneIn(int n) { return below(n) == 0; }

	btScalar between(double low, double high)
	{
		return btScalar(low + (high - low) * (m_random() / double(std::mt19937::max())));
	}

	/// Each power of ten is as likely as the next one.
	btScalar power(double low, double high) { return btScalar(pow(10, double(between(log10(low), log10(high))))); }

	btVector3 vector(double size)
	{
		return btVector3(between(-size, size), between(-size, size), between(-size, size));
	}

	btTransform frame(double size)
	{
		const btVector3 axis = vector(1) + btVector3(2, 0, 0);
		return btTransform(oneIn(2) ? btQuaternion(0, 0, 0, 1) : btQuaternion(axis.normalized(), between(-3, 3)),
						   vector(size));
	}

	/// What no game should pass.
	btScalar bad()
	{
		const btScalar values[] = {std::numeric_limits<btScalar>::quiet_NaN(),
								   std::numeric_limits<btScalar>::infinity(),
								   -std::numeric_limits<btScalar>::infinity(),
								   std::numeric_limits<btScalar>::max(),
								   std::numeric_limits<btScalar>::denorm_min(),
								   btScalar(-1),
								   btScalar(0),
								   btScalar(1e12),
								   btScalar(-1e30)};
		return values[below(int(sizeof values / sizeof *values))];
	}
	btVector3 badVector()
	{
		btVector3 v = vector(1);
		v[below(3)] = bad();
		return v;
	}

	/// A degree of freedom, or what is none.
	int badDof()
	{
		const int dofs[] = {-1, 6, 7, 1000, -2147483647 - 1, 2147483647};
		return dofs[below(6)];
	}

private:
	std::mt19937 m_random;
};

#endif  // EP_FUZZ_CHANCE_H
