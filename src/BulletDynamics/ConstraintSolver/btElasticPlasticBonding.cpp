// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticBonding.h"

#include <algorithm>
#include <vector>

#include "BulletCollision/CollisionShapes/btBoxShape.h"
#include "BulletCollision/CollisionShapes/btCompoundShape.h"
#include "BulletCollision/CollisionShapes/btConvexHullShape.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "ElasticPlastic/joint/BodyGate.h"
#include "LinearMath/btConvexHullComputer.h"
#include "btElasticPlasticAction.h"

namespace
{
typedef std::vector<btVector3> Polygon;

/// A face of a convex piece: its corners, in order about its normal, which points outwards.
struct Side
{
	btVector3 m_normal;
	btScalar m_distance;  ///< of its plane from the world's origin along the normal
	Polygon m_corners;
};

/// A convex part of a body, in world coordinates.
struct Piece
{
	btRigidBody* m_body;
	btVector3 m_least, m_most;
	std::vector<Side> m_sides;
};

/// Normals of one side deviate by rounding, those of two sides by more than this cosine tells (0.8 degrees).
const btScalar SAME_DIRECTION = btScalar(0.9999);

/// Two vectors across a normal, right-handed with it.
void makeAxes(const btVector3& normal, btVector3& u, btVector3& v) { btPlaneSpace1(normal, u, v); }

btScalar cross2(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& u, const btVector3& v)
{
	return (b - a).dot(u) * (c - a).dot(v) - (b - a).dot(v) * (c - a).dot(u);
}

/// The convex hull of points in a plane, in order about the normal (Andrew's monotone chain).
Polygon hullInPlane(std::vector<btVector3> points, const btVector3& normal)
{
	btVector3 u, v;
	makeAxes(normal, u, v);
	std::sort(points.begin(), points.end(),
			  [&](const btVector3& a, const btVector3& b)
			  { return a.dot(u) != b.dot(u) ? a.dot(u) < b.dot(u) : a.dot(v) < b.dot(v); });
	Polygon hull;
	if (points.empty())
		return hull;
	for (int pass = 0; pass < 2; ++pass)
	{
		const size_t begin = hull.size();
		for (const btVector3& point : points)
		{
			while (hull.size() >= begin + 2 && cross2(hull[hull.size() - 2], hull[hull.size() - 1], point, u, v) <= 0)
				hull.pop_back();
			hull.push_back(point);
		}
		hull.pop_back();
		std::reverse(points.begin(), points.end());
	}
	return hull;
}

/// Twice the area of a polygon as a vector along its normal (Newell): no three corners have to be far apart.
btVector3 doubleArea(const Polygon& polygon)
{
	btVector3 sum(0, 0, 0);
	for (size_t i = 1; i + 1 < polygon.size(); ++i)
		sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
	return sum;
}

/// The side whose normal is nearly the given one: the corners that lie in the outermost plane, from which normal and distance follow.
Side makeSide(const std::vector<btVector3>& points, const btVector3& roughNormal, btScalar rounding)
{
	Side side;
	btScalar outermost = -BT_LARGE_FLOAT;
	for (const btVector3& point : points)
		btSetMax(outermost, point.dot(roughNormal));
	std::vector<btVector3> corners;
	for (const btVector3& point : points)
		if (point.dot(roughNormal) > outermost - rounding)
			corners.push_back(point);
	side.m_corners = hullInPlane(corners, roughNormal);
	side.m_normal = doubleArea(side.m_corners);
	if (side.m_corners.size() < 3 || side.m_normal.length2() < rounding * rounding * rounding * rounding)
		side.m_corners.clear();
	else
		side.m_normal.normalize();
	side.m_distance = 0;
	for (const btVector3& corner : side.m_corners)
		side.m_distance += corner.dot(side.m_normal) / btScalar(side.m_corners.size());
	return side;
}

void findSides(const std::vector<btVector3>& points, Piece& piece)
{
	btConvexHullComputer hull;
	hull.compute(&points[0].x(), sizeof(btVector3), int(points.size()), 0, 0);
	// Bullet moves the hull's corners to a lattice.
	const btScalar rounding = (piece.m_most - piece.m_least).length() * btScalar(1e-3);
	for (int f = 0; f < hull.faces.size(); ++f)
	{
		Polygon corners;
		const btConvexHullComputer::Edge* const first = &hull.edges[hull.faces[f]];
		const btConvexHullComputer::Edge* edge = first;
		do
		{
			corners.push_back(hull.vertices[edge->getSourceVertex()]);
			edge = edge->getNextEdgeOfFace();
		} while (edge != first);
		btVector3 normal = doubleArea(corners);
		if (normal.length2() < rounding * rounding * rounding * rounding)
			continue;
		normal.normalize();
		if (normal.dot(corners[0] - (piece.m_least + piece.m_most) / 2) < 0)
			normal = -normal;
		const Side side = makeSide(points, normal, rounding);
		const auto isSame = [&](const Side& other) { return other.m_normal.dot(side.m_normal) > SAME_DIRECTION; };
		if (!side.m_corners.empty() && std::none_of(piece.m_sides.begin(), piece.m_sides.end(), isSame))
			piece.m_sides.push_back(side);
	}
}

void addPieces(btRigidBody& body, const btCollisionShape& shape, const btTransform& pose, std::vector<Piece>& pieces)
{
	if (shape.isCompound())
	{
		const btCompoundShape& compound = static_cast<const btCompoundShape&>(shape);
		for (int i = 0; i < compound.getNumChildShapes(); ++i)
			addPieces(body, *compound.getChildShape(i), pose * compound.getChildTransform(i), pieces);
		return;
	}
	std::vector<btVector3> points;
	if (shape.getShapeType() == BOX_SHAPE_PROXYTYPE)
		for (int i = 0; i < 8; ++i)
		{
			const btVector3 half = static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin();
			points.push_back(
				btVector3(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(), i & 4 ? half.z() : -half.z()));
		}
	else if (shape.getShapeType() == CONVEX_HULL_SHAPE_PROXYTYPE)
		for (int i = 0; i < static_cast<const btConvexHullShape&>(shape).getNumPoints(); ++i)
			points.push_back(static_cast<const btConvexHullShape&>(shape).getScaledPoint(i));
	if (points.size() < 4)
		return;
	Piece piece;
	piece.m_body = &body;
	for (size_t i = 0; i < points.size(); ++i)
	{
		points[i] = pose * points[i];
		if (i == 0)
			piece.m_least = piece.m_most = points[0];
		piece.m_least.setMin(points[i]);
		piece.m_most.setMax(points[i]);
	}
	findSides(points, piece);
	pieces.push_back(piece);
}

/// What a convex polygon has on the inner side of another one's edges (Sutherland and Hodgman). Both turn about the normal.
Polygon clip(Polygon polygon, const Polygon& by, const btVector3& normal)
{
	for (size_t e = 0; e < by.size() && !polygon.empty(); ++e)
	{
		const btVector3 inwards = normal.cross(by[(e + 1) % by.size()] - by[e]);
		Polygon kept;
		for (size_t i = 0; i < polygon.size(); ++i)
		{
			const btVector3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
			const btScalar a = inwards.dot(from - by[e]), b = inwards.dot(to - by[e]);
			if (a >= 0)
				kept.push_back(from);
			if ((a > 0 && b < 0) || (a < 0 && b > 0))
				kept.push_back(from.lerp(to, a / (a - b)));
		}
		polygon.swap(kept);
	}
	return polygon;
}

/// Area, middle and second moments of a polygon in a plane, about axes through its middle.
struct Moments
{
	btScalar m_area = 0;
	btVector3 m_middle = btVector3(0, 0, 0);
	btScalar m_uu = 0, m_vv = 0, m_uv = 0;

	Moments(const Polygon& polygon, const btVector3& u, const btVector3& v)
	{
		double area = 0, sumU = 0, sumV = 0, uu = 0, vv = 0, uv = 0;
		for (size_t i = 1; i + 1 < polygon.size(); ++i)
		{
			// By triangles from the first corner.
			const btVector3 p = polygon[i] - polygon[0], q = polygon[i + 1] - polygon[0];
			const double pu = p.dot(u), pv = p.dot(v), qu = q.dot(u), qv = q.dot(v), twice = pu * qv - pv * qu;
			area += twice / 2;
			sumU += twice * (pu + qu) / 6;
			sumV += twice * (pv + qv) / 6;
			uu += twice * (pu * pu + pu * qu + qu * qu) / 12;
			vv += twice * (pv * pv + pv * qv + qv * qv) / 12;
			uv += twice * (2 * pu * pv + pu * qv + qu * pv + 2 * qu * qv) / 24;
		}
		if (!(area > 0))
			return;
		m_area = btScalar(area);
		m_middle = polygon[0] + u * btScalar(sumU / area) + v * btScalar(sumV / area);
		m_uu = btScalar(uu - sumU * sumU / area);
		m_vv = btScalar(vv - sumV * sumV / area);
		m_uv = btScalar(uv - sumU * sumV / area);
	}
};

/// Second moments that differ by less than this share have no principal axes.
const btScalar ROUND = btScalar(1e-3);

btVector3 longestSide(const Polygon& polygon)
{
	btVector3 longest(0, 0, 0);
	for (size_t i = 0; i < polygon.size(); ++i)
	{
		const btVector3 side = polygon[(i + 1) % polygon.size()] - polygon[i];
		if (side.length2() > longest.length2() * (1 + btScalar(1e-4)))
			longest = side;
	}
	return longest;
}

/// A face of a polygon between two pieces. \param normal  from the first piece to the second
btElasticPlasticFace makeFace(const Piece& a, const Piece& b, const Polygon& polygon, const btVector3& normal)
{
	btVector3 u, v;
	makeAxes(normal, u, v);
	const Moments moments(polygon, u, v);
	btElasticPlasticFace face;
	face.m_bodyA = a.m_body;
	face.m_bodyB = b.m_body;
	face.m_area = moments.m_area;
	const btScalar mean = (moments.m_uu + moments.m_vv) / 2,
				   half = btSqrt(btPow((moments.m_uu - moments.m_vv) / 2, 2) + moments.m_uv * moments.m_uv);
	// The height is along the axis with the larger second moment, of a square or the like along a side: about its diagonals the section would be drawn turned by
	// rounding alone.
	const btVector3 side = longestSide(polygon);
	const btScalar angle = half > ROUND * mean ? btAtan2(2 * moments.m_uv, moments.m_uu - moments.m_vv) / 2
											   : btAtan2(side.dot(v), side.dot(u));
	const btScalar ratio = btSqrt((mean + half) / btMax(mean - half, mean * SIMD_EPSILON));
	face.m_height = btSqrt(face.m_area * ratio);
	face.m_width = face.m_area / btMax(face.m_height, SIMD_EPSILON);
	const btVector3 y = u * btCos(angle) + v * btSin(angle), z = normal.cross(y);
	face.m_frame.setBasis(btMatrix3x3(normal.x(), y.x(), z.x(), normal.y(), y.y(), z.y(), normal.z(), y.z(), z.z()));
	face.m_frame.setOrigin(moments.m_middle);
	const auto lengthOf = [&](const btRigidBody& body)
	{
		const btScalar way = btFabs((moments.m_middle - body.getCenterOfMassPosition()).dot(normal));
		return body.getInvMass() > 0 ? 2 * way : btScalar(0);
	};
	face.m_lengthA = lengthOf(*a.m_body);
	face.m_lengthB = lengthOf(*b.m_body);
	return face;
}

/// The largest face in which two pieces lie on each other. \return whether there is one
bool findFace(const Piece& a, const Piece& b, btScalar gap, btElasticPlasticFace& face)
{
	btScalar largest = 0;
	for (const Side& sideA : a.m_sides)
		for (const Side& sideB : b.m_sides)
		{
			const btScalar apart = -sideA.m_distance - sideB.m_distance;
			if (sideA.m_normal.dot(sideB.m_normal) > -SAME_DIRECTION || btFabs(apart) > gap)
				continue;
			// In the plane half way between them. B's corners turn about its own normal, the other way round.
			Polygon mine, others(sideB.m_corners.rbegin(), sideB.m_corners.rend());
			const btScalar middle = sideA.m_distance + apart / 2;
			const auto lay = [&](const btVector3& corner)
			{ return corner + sideA.m_normal * (middle - corner.dot(sideA.m_normal)); };
			for (const btVector3& corner : sideA.m_corners)
				mine.push_back(lay(corner));
			for (btVector3& corner : others)
				corner = lay(corner);
			const btElasticPlasticFace found = makeFace(a, b, clip(mine, others, sideA.m_normal), sideA.m_normal);
			if (found.m_area > largest)
			{
				largest = found.m_area;
				face = found;
			}
		}
	// Corners and edges that touch by rounding are no faces.
	return largest > gap * gap;
}
}  // namespace

bool btElasticPlasticBonding::findFaces(btRigidBody* const* bodies, int numBodies, btScalar gap,
										btAlignedObjectArray<btElasticPlasticFace>& faces)
{
	faces.resize(0);
	if (!(gap > 0) || !btElasticPlasticIsFinite(double(gap)))
		return false;
	std::vector<Piece> pieces;
	for (int i = 0; i < numBodies; ++i)
		if (!bodies[i] || !btElasticPlastic::isWellFormed(*bodies[i]))
			return false;
	for (int i = 0; i < numBodies; ++i)
		addPieces(*bodies[i], *bodies[i]->getCollisionShape(), bodies[i]->getCenterOfMassTransform(), pieces);
	// Bodies are given in any order, and so are the joints found; only what overlaps along x is compared.
	std::vector<size_t> order(pieces.size());
	for (size_t i = 0; i < order.size(); ++i)
		order[i] = i;
	std::stable_sort(order.begin(), order.end(),
					 [&](size_t a, size_t b) { return pieces[a].m_least.x() < pieces[b].m_least.x(); });
	for (size_t i = 0; i < order.size(); ++i)
		for (size_t j = i + 1; j < order.size() && pieces[order[j]].m_least.x() <= pieces[order[i]].m_most.x() + gap;
			 ++j)
		{
			const Piece &a = pieces[std::min(order[i], order[j])], &b = pieces[std::max(order[i], order[j])];
			const btVector3 margin(gap, gap, gap);
			btElasticPlasticFace face;
			if (a.m_body != b.m_body && (a.m_body->getInvMass() > 0 || b.m_body->getInvMass() > 0) &&
				TestAabbAgainstAabb2(a.m_least - margin, a.m_most + margin, b.m_least, b.m_most) &&
				findFace(a, b, gap, face))
				faces.push_back(face);
		}
	return true;
}

btElasticPlasticCapacity btElasticPlasticBonding::capacityOf(const btElasticPlasticFace& face,
															 const btElasticPlasticMaterial& material,
															 btScalar gaugeLength)
{
	return btElasticPlasticCapacity::fromMember(material,
												btElasticPlasticSection::rectangle(face.m_width, face.m_height),
												face.m_lengthA, face.m_lengthB, gaugeLength);
}

btElasticPlastic6DofSpring2Constraint* btElasticPlasticBonding::join(const btElasticPlasticFace& face,
																	 const btElasticPlasticCapacity& capacity)
{
	btElasticPlastic6DofSpring2Constraint* const joint = new btElasticPlastic6DofSpring2Constraint(
		*face.m_bodyA, *face.m_bodyB, face.m_bodyA->getCenterOfMassTransform().inverse() * face.m_frame,
		face.m_bodyB->getCenterOfMassTransform().inverse() * face.m_frame);
	joint->setCapacity(capacity);
	return joint;
}

bool btElasticPlasticBonding::joinAll(btDynamicsWorld& world, btElasticPlasticAction& action,
									  btRigidBody* const* bodies, int numBodies, btScalar gap,
									  const btElasticPlasticMaterial& material,
									  btAlignedObjectArray<btElasticPlastic6DofSpring2Constraint*>& joints)
{
	btAlignedObjectArray<btElasticPlasticFace> faces;
	if (material.fault() || !findFaces(bodies, numBodies, gap, faces))
		return false;
	for (int i = 0; i < faces.size(); ++i)
	{
		btElasticPlastic6DofSpring2Constraint* const joint = join(faces[i], capacityOf(faces[i], material));
		joints.push_back(joint);
		world.addConstraint(joint, true);
		action.addJoint(joint);
	}
	return true;
}
