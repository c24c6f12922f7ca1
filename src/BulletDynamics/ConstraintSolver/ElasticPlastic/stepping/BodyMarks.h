// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BODY_MARKS_H
#define BT_ELASTIC_PLASTIC_BODY_MARKS_H

#include "BulletCollision/CollisionDispatch/btCollisionObject.h"
#include "LinearMath/btAlignedObjectArray.h"

namespace btElasticPlastic
{
/// A set of a world's bodies, by their index in the world.
class BodyMarks
{
public:
	/// Makes the set empty, for a world with so many bodies.
	void clear(int numBodies)
	{
		m_isMarked.resize(0);
		m_isMarked.resize(numBodies, false);
	}

	/// Does nothing for a body that came into the world after clear().
	void mark(const btCollisionObject& object)
	{
		if (isKnown(object))
			m_isMarked[object.getWorldArrayIndex()] = true;
	}

	bool isMarked(const btCollisionObject& object) const
	{
		return isKnown(object) && m_isMarked[object.getWorldArrayIndex()];
	}

private:
	bool isKnown(const btCollisionObject& object) const
	{
		return object.getWorldArrayIndex() >= 0 && object.getWorldArrayIndex() < m_isMarked.size();
	}

	btAlignedObjectArray<bool> m_isMarked;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BODY_MARKS_H
