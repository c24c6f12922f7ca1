// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BLOWS_H
#define EP_BLOWS_H

#include <set>
#include <utility>
#include <vector>

#include "world/World.h"

namespace ep
{
/// One body strikes another.
struct Blow
{
	btVector3 place;
	double energy;  ///< of the motion towards each other, with the mass that both have together for it [J]
};

/// Finds blows, for eyes and ears. Look at the world before and after each step.
class Blows
{
public:
	void before(const World& world);
	/// Of pairs that have not touched before the step, and closed at more than walking pace.
	std::vector<Blow> after(World& world);
	void clear() { *this = Blows(); }

private:
	struct Motion
	{
		btVector3 place, velocity, spin;
	};
	using Pair = std::pair<const btCollisionObject*, const btCollisionObject*>;

	btVector3 velocity(const btCollisionObject& object, const btVector3& at) const;

	std::vector<Motion> m_motions;  ///< by bodies' places in the world, before the step
	std::set<Pair> m_touching;      ///< after it
};
}  // namespace ep

#endif  // EP_BLOWS_H
