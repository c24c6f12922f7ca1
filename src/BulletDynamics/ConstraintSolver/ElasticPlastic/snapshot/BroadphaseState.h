// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BROADPHASE_STATE_H
#define BT_ELASTIC_PLASTIC_BROADPHASE_STATE_H

#include "WorldImage.h"

struct btBroadphaseProxy;
struct btDbvtBroadphase;
class btCollisionObject;

namespace btElasticPlastic
{
/// Reads and writes all that Bullet's broadphase remembers: its trees with their margins, which decide when a pair is found and
/// when it is dropped.
class BroadphaseState
{
public:
	/// \param objects  by rank, all that are in the broadphase
	BroadphaseState(btDbvtBroadphase& broadphase, const std::vector<btCollisionObject*>& objects);

	BroadphaseImage read() const;

	/// Whether write() can do with an image: it has each object once, and its trees are trees.
	static bool isSound(const BroadphaseImage& image, int numObjects);

	void write(const BroadphaseImage& image);

private:
	int rankOf(const btBroadphaseProxy& proxy) const;
	TreeImage readTree(int set) const;
	void writeTree(int set, const TreeImage& image);

	btDbvtBroadphase& m_broadphase;
	const std::vector<btCollisionObject*>& m_objects;
	std::vector<int> m_rankOfPlace;  ///< by the place in the world's list of objects
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BROADPHASE_STATE_H
