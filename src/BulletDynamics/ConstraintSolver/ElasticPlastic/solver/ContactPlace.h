// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONTACT_PLACE_H
#define BT_ELASTIC_PLASTIC_CONTACT_PLACE_H

#include "BulletCollision/NarrowPhaseCollision/btManifoldPoint.h"
#include "LinearMath/btTransform.h"

namespace btElasticPlastic
{
/// Puts a contact to where its bodies have carried it. What has slid on each other has it in the middle: impulses along two lines would
/// change the angular momentum.
inline void placeContact(btManifoldPoint& point, const btTransform& a, const btTransform& b)
{
	const btVector3 onA = a(point.m_localPointA), onB = b(point.m_localPointB), middle = (onA + onB) / 2;
	point.m_distance1 = (onA - onB).dot(point.m_normalWorldOnB);
	point.m_positionWorldOnA = middle + point.m_normalWorldOnB * (point.m_distance1 / 2);
	point.m_positionWorldOnB = middle - point.m_normalWorldOnB * (point.m_distance1 / 2);
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_CONTACT_PLACE_H
