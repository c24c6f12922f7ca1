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

#include "btElasticPlasticKinematics.h"

namespace
{
/// exp(log(q) / 2): half of the rotation, along the way that the quaternion's sign tells.
btQuaternion halfOf(const btQuaternion& q)
{
	btQuaternion h(q.x(), q.y(), q.z(), q.w() + 1);
	const btScalar length2 = h.length2();
	// A full turn has no half of its own direction: any axis at a right angle to none will do.
	if (length2 < btScalar(1e-12))
		return btQuaternion(1, 0, 0, 0);
	return h * (1 / btSqrt(length2));
}

/// Is it exactly no rotation? The scalar part alone does not tell: in float it is 1 up to half a milliradian.
bool isNone(const btQuaternion& q) { return q.x() == 0 && q.y() == 0 && q.z() == 0; }

/// p_B - p_A. In double whatever Bullet's precision: it is a thousandth of what it is the difference of.
btVector3 separation(const btTransform& bodyA, const btTransform& bodyB, const btVector3& pivotA,
					 const btVector3& pivotB)
{
	btVector3 d(0, 0, 0);
	for (int i = 0; i < 3; ++i)
	{
		const btVector3 &a = bodyA.getBasis()[i], &b = bodyB.getBasis()[i];
		const double armA = double(a.x()) * pivotA.x() + double(a.y()) * pivotA.y() + double(a.z()) * pivotA.z();
		const double armB = double(b.x()) * pivotB.x() + double(b.y()) * pivotB.y() + double(b.z()) * pivotB.z();
		d[i] = btScalar(double(bodyB.getOrigin()[i]) - double(bodyA.getOrigin()[i]) + (armB - armA));
	}
	return d;
}
}  // namespace

btVector3 btElasticPlasticLog(const btQuaternion& q)
{
	const btVector3 v(q.x(), q.y(), q.z());
	const btScalar s2 = v.length2();
	if (s2 < btScalar(1e-3) && q.w() > 0)
	{
		// 2 asin(s) / s, error below 1e-16 of it
		const btScalar series =
			1 + s2 * (btScalar(1. / 6) +
					  s2 * (btScalar(3. / 40) + s2 * (btScalar(15. / 336) + s2 * btScalar(105. / 3456))));
		return v * (2 * series);
	}
	const btScalar s = btSqrt(s2);
	return s > 0 ? v * (2 * btAtan2(s, q.w()) / s) : btVector3(0, 0, 0);
}

btQuaternion btElasticPlasticExp(const btVector3& rotation)
{
	const btScalar angle = rotation.length();
	if (angle < btScalar(1e-4))
	{
		// cos and sin to fourth order, then unit length
		const btScalar h = btScalar(0.5) - angle * angle / 48;
		return btQuaternion(rotation.x() * h, rotation.y() * h, rotation.z() * h, 1 - angle * angle / 8).normalized();
	}
	const btScalar s = btSin(angle / 2) / angle;
	return btQuaternion(rotation.x() * s, rotation.y() * s, rotation.z() * s, btCos(angle / 2));
}

btElasticPlasticTurn btElasticPlasticKinematics::evaluate(const btTransform& bodyA, const btTransform& bodyB,
														  const btTransform& frameA, const btTransform& frameB,
														  const btVector3& plasticOffset,
														  const btQuaternion& plasticRotation,
														  const btQuaternion& plasticMiddle)
{
	btElasticPlasticTurn turn;
	const btMatrix3x3 basisA = bodyA.getBasis() * frameA.getBasis(), basisB = bodyB.getBasis() * frameB.getBasis();
	basisA.transposeTimes(basisB).getRotation(turn.m_relative);
	if (turn.m_relative.dot(plasticRotation) < 0)
		turn.m_relative = -turn.m_relative;
	btVector3 elastic;
	if (isNone(plasticRotation) && isNone(plasticMiddle))
	{
		turn.m_middle = halfOf(turn.m_relative);
		elastic = btElasticPlasticLog(turn.m_relative);
	}
	else
	{
		// The middle frame is half an elastic rotation from the plastic middle: the rotation's components are the same in both.
		const btQuaternion elasticTurn = turn.m_relative * plasticRotation.inverse();
		turn.m_middle = halfOf(elasticTurn) * plasticMiddle;
		elastic = quatRotate(plasticMiddle.inverse(), btElasticPlasticLog(elasticTurn));
	}
	const btMatrix3x3 mid = basisA * btMatrix3x3(turn.m_middle);
	for (int i = 0; i < 3; ++i)
		m_axis[i] = mid.getColumn(i);

	const btVector3 armA = bodyA.getBasis() * frameA.getOrigin(), armB = bodyB.getBasis() * frameB.getOrigin();
	const btVector3 d = separation(bodyA, bodyB, frameA.getOrigin(), frameB.getOrigin());
	m_rA = armA + d * btScalar(0.5);
	m_rB = armB - d * btScalar(0.5);

	for (int i = 0; i < 3; ++i)
	{
		m_strain[i] = d.dot(m_axis[i]) - plasticOffset[i];
		m_strain[3 + i] = elastic[i];
	}
	return turn;
}
