// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FENCE_H
#define EP_FENCE_H

#include "structures/Structure.h"

namespace ep
{
struct FenceSettings
{
	int posts = 5;
	btScalar spacing = 2;                    ///< of the posts, across the lane [m]
	btScalar height = btScalar(1.5);         ///< of the posts [m]
	int postBlocks = 3;                      ///< in each post
	btScalar postThickness = btScalar(.2);   ///< of their square section, reinforced concrete [m]
	btScalar steelShare = btScalar(.02);     ///< of the posts' section
	int rails = 2;                           ///< one below the other, the uppermost near the top; up to postBlocks
	int railBlocks = 2;                      ///< from post to post
	btScalar railThickness = btScalar(.05);  ///< of their square section, steel [m]
	btScalar postHinge = btScalar(.6);       ///< over which plastic bending of a post spreads: enough to bend over [m]
	btScalar railHinge = btScalar(.15);      ///< the same of a rail [m]
};

/// Posts of reinforced concrete in a row across the lane, rooted in the ground, and steel rails from post to post.
class Fence : public Structure
{
public:
	Fence(World& world, const Materials& materials, const FenceSettings& settings, const btVector3& origin);

private:
	void addPost(World& world, const Materials& materials, const FenceSettings& settings, const btVector3& foot,
				 int index);
	void addRails(World& world, const Materials& materials, const FenceSettings& settings, int bay);
};
}  // namespace ep

#endif  // EP_FENCE_H
