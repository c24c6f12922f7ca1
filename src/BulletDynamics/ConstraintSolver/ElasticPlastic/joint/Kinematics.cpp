// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Kinematics.h"

#include "../../btElasticPlasticFault.h"

namespace btElasticPlastic
{
namespace
{
/// exp(log(q) / 2): half of the rotation. The quaternion's sign tells which of the two ways round is halved.
btQuaternion halfOf(const btQuaternion& q)
{
	btQuaternion h(q.x(), q.y(), q.z(), q.w() + 1);
	const btScalar length2 = h.length2();
	// The quaternion of a full turn, -1, does not tell its axis; its half is a half turn about any axis.
	if (length2 < btScalar(1e-12))
		return btQuaternion(1, 0, 0, 0);
	return h * (1 / btSqrt(length2));
}

/// Whether a quaternion is exactly no rotation. The scalar part alone does not tell: in float it is 1 up to half a milliradian.
bool isNone(const btQuaternion& q) { return btFabs(q.x()) + btFabs(q.y()) + btFabs(q.z()) == 0; }

/// R v in double whatever Bullet's precision: the distance of the frames is the difference of two such vectors, and a
/// thousandth of their length or less.
struct Arm
{
	double m_world[3];

	Arm(const btMatrix3x3& basis, const btVector3& pivot)
	{
		for (int i = 0; i < 3; ++i)
			m_world[i] =
				double(basis[i].x()) * pivot.x() + double(basis[i].y()) * pivot.y() + double(basis[i].z()) * pivot.z();
	}
	btVector3 rounded() const { return btVector3(btScalar(m_world[0]), btScalar(m_world[1]), btScalar(m_world[2])); }
};

/// Columns of the frame half way from A to B = A R, where q is R and w = cos(angle / 2) is not small. With c = w, v the
/// vector part of q and H = (A + B) / 2: (1 + R) / 2 is the half rotation with what is at a right angle to v shortened by c,
/// so the half way frame is H (1 / c - v v^T / (c (1 + c))).
void halfWay(const btMatrix3x3& A, const btMatrix3x3& B, const btQuaternion& q, btVector3 axis[3])
{
	const btScalar scale = 1 / q.w(), along = scale / (1 + q.w());
	const btVector3 v(q.x(), q.y(), q.z());
	for (int row = 0; row < 3; ++row)
	{
		const btVector3 h = (A[row] + B[row]) * btScalar(0.5);
		const btVector3 m = h * scale - v * (along * h.dot(v));
		for (int i = 0; i < 3; ++i)
			axis[i][row] = m[i];
	}
}
}  // namespace

btVector3 logarithm(const btQuaternion& q)
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

btQuaternion exponential(const btVector3& rotation)
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

namespace
{
/// The quaternion of R; of the two possible ones, the one nearer to the plastic rotation.
btQuaternion relativeOf(const btMatrix3x3& basisA, const btMatrix3x3& basisB, const btQuaternion& plasticRotation)
{
	btQuaternion relative;
	basisA.transposeTimes(basisB).getRotation(relative);
	return relative.dot(plasticRotation) < 0 ? -relative : relative;
}

/// The middle frame is half an elastic rotation from the plastic middle.
btQuaternion middleOf(const btQuaternion& elasticTurn, const btQuaternion& plasticMiddle)
{
	return halfOf(elasticTurn) * plasticMiddle;
}
}  // namespace

RelativeRotation::RelativeRotation(const btMatrix3x3& basisA, const btMatrix3x3& basisB,
								   const btQuaternion& plasticRotation, const btQuaternion& plasticMiddle)
	: m_relative(relativeOf(basisA, basisB, plasticRotation)),
	  m_middle(middleOf(m_relative * plasticRotation.inverse(), plasticMiddle))
{
}

void Kinematics::evaluate(const btTransform& bodyA, const btTransform& bodyB, const btTransform& frameA,
						  const btTransform& frameB, const btVector3& plasticOffset,
						  const btQuaternion& plasticRotation, const btQuaternion& plasticMiddle)
{
	const btMatrix3x3 basisA = bodyA.getBasis() * frameA.getBasis(), basisB = bodyB.getBasis() * frameB.getBasis();
	const btQuaternion relative = relativeOf(basisA, basisB, plasticRotation);
	const bool isStraight = isNone(plasticRotation) && isNone(plasticMiddle);
	const btQuaternion elasticTurn = isStraight ? relative : relative * plasticRotation.inverse();
	btVector3 elastic = logarithm(elasticTurn);
	// The rotation's components in the middle frame are those in the plastic middle.
	if (!isStraight)
		elastic = quatRotate(plasticMiddle.inverse(), elastic);
	if (isStraight && relative.w() > btScalar(0.5))
		halfWay(basisA, basisB, relative, m_axis);
	else
	{
		const btMatrix3x3 mid = basisA * btMatrix3x3(middleOf(elasticTurn, plasticMiddle));
		for (int i = 0; i < 3; ++i)
			m_axis[i] = mid.getColumn(i);
	}

	const Arm armA(bodyA.getBasis(), frameA.getOrigin()), armB(bodyB.getBasis(), frameB.getOrigin());
	btVector3 d(0, 0, 0);
	for (int i = 0; i < 3; ++i)
		d[i] =
			btScalar(double(bodyB.getOrigin()[i]) - double(bodyA.getOrigin()[i]) + (armB.m_world[i] - armA.m_world[i]));
	m_rA = armA.rounded() + d * btScalar(0.5);
	m_rB = armB.rounded() - d * btScalar(0.5);
	m_bow[0] = m_bow[1] = 0;

	for (int i = 0; i < 3; ++i)
	{
		m_strain[i] = d.dot(m_axis[i]) - plasticOffset[i];
		m_strain[3 + i] = elastic[i];
	}
}

bool isDeformation(btScalar strain)
{
	return btElasticPlasticIsFinite(strain) && btFabs(strain) < btScalar(BT_LARGE_FLOAT);
}

bool Kinematics::isUsable() const
{
	bool are = true;
	for (const btScalar strain : m_strain)
		are &= isDeformation(strain);
	return are;
}

void Kinematics::bow(btScalar lengthY, btScalar lengthZ)
{
	const btScalar y = m_strain[4], z = m_strain[5];
	m_bow[0] = z * lengthZ / 6;
	m_bow[1] = -y * lengthY / 6;
	m_strain[0] += strainOfBow(m_strain, lengthY, lengthZ);
}

void Kinematics::projectMotion(const btVector3& linear, const btVector3& angular, btScalar onAxes[6]) const
{
	for (int i = 0; i < 3; ++i)
	{
		onAxes[i] = m_axis[i].dot(linear);
		onAxes[3 + i] = m_axis[i].dot(angular);
	}
	onAxes[0] += m_bow[1] * onAxes[4] - m_bow[0] * onAxes[5];
}

void Kinematics::projectLoad(const btVector3& force, const btVector3& torque, btScalar onAxes[6]) const
{
	for (int i = 0; i < 3; ++i)
	{
		onAxes[i] = m_axis[i].dot(force);
		onAxes[3 + i] = m_axis[i].dot(torque);
	}
	onAxes[4] -= m_bow[1] * onAxes[0];
	onAxes[5] += m_bow[0] * onAxes[0];
}
}  // namespace btElasticPlastic
