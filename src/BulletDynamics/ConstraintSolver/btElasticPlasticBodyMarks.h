/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#ifndef BT_ELASTIC_PLASTIC_BODY_MARKS_H
#define BT_ELASTIC_PLASTIC_BODY_MARKS_H

#include "BulletCollision/CollisionDispatch/btCollisionObject.h"
#include "LinearMath/btAlignedObjectArray.h"

/// Some of a world's bodies, by their place in it.
class btElasticPlasticBodyMarks
{
public:
	/// None of them.
	void clear(int numBodies)
	{
		m_isMarked.resize(0);
		m_isMarked.resize(numBodies, false);
	}

	/// What the world did not have when it was cleared cannot be marked.
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

#endif  // BT_ELASTIC_PLASTIC_BODY_MARKS_H
