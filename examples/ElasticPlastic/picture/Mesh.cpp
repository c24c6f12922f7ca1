// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Mesh.h"

#include <algorithm>
#include <utility>

namespace ep
{
namespace
{
const float FAR_FROM_EDGE = 100;

class PartMesh
{
public:
	PartMesh(const Part& part, std::vector<Vertex>& vertices) : m_part(part), m_vertices(vertices) {}

	void add()
	{
		const size_t n = m_part.profile.size();
		for (const btVector3& corner : m_part.profile)
			m_centre += corner / btScalar(n);
		for (size_t i = 0; i < n; ++i)
			addSide(m_part.profile[i], m_part.profile[(i + 1) % n]);
		for (btScalar end : {btScalar(-1), btScalar(1)})
			addCap(end);
	}

private:
	void addVertex(const btVector3& corner, btScalar end, const btVector3& normal, const std::array<float, 4>& edges)
	{
		const btVector3 position(corner.x(), corner.y(), end * m_part.width / 2);
		m_vertices.push_back({toVector(m_part.pose * position),
							  toVector(m_part.pose.getBasis() * normal),
							  {m_part.colour.r, m_part.colour.g, m_part.colour.b},
							  edges,
							  m_part.gloss});
	}

	/// A profile's outward normal at a corner of a side: the side's own, or that of the curve it stands for.
	btVector3 sideNormal(const btVector3& corner, const btVector3& along) const
	{
		return m_part.round ? (corner - m_centre).normalized() : btVector3(along.y(), -along.x(), 0).normalized();
	}

	void addSide(const btVector3& a, const btVector3& b)
	{
		const btVector3 na = sideNormal(a, b - a), nb = sideNormal(b, b - a);
		const float length = m_part.round ? FAR_FROM_EDGE : float((b - a).length()), width = float(m_part.width);
		const float zero = m_part.round ? FAR_FROM_EDGE : 0;
		const std::array<float, 4> a0 = {zero, length, 0, width}, a1 = {zero, length, width, 0};
		const std::array<float, 4> b0 = {length, zero, 0, width}, b1 = {length, zero, width, 0};
		addVertex(a, -1, na, a0);
		addVertex(b, -1, nb, b0);
		addVertex(b, 1, nb, b1);
		addVertex(a, -1, na, a0);
		addVertex(b, 1, nb, b1);
		addVertex(a, 1, na, a1);
	}

	/// Distance of a point from the side that begins at corner i.
	float distance(const btVector3& point, size_t i) const
	{
		const btVector3 &a = m_part.profile[i], &b = m_part.profile[(i + 1) % m_part.profile.size()];
		return float((point - a).dot(btVector3(a.y() - b.y(), b.x() - a.x(), 0).normalized()));
	}

	/// A fan of triangles; up to four corners have exact distances from all edges, more only from the triangle's own.
	void addCap(btScalar end)
	{
		const size_t n = m_part.profile.size();
		const btVector3 normal(0, 0, end);
		for (size_t i = 0; i < n; ++i)
		{
			const size_t next = (i + 1) % n;
			const btVector3 corners[3] = {m_centre, m_part.profile[i], m_part.profile[next]};
			for (int k = 0; k < 3; ++k)
			{
				const btVector3& corner = corners[end > 0 ? k : (3 - k) % 3];
				std::array<float, 4> edges = {FAR_FROM_EDGE, FAR_FROM_EDGE, FAR_FROM_EDGE, FAR_FROM_EDGE};
				for (size_t e = 0; e < n; ++e)
					if (n <= 4 || e == i)
						edges[n <= 4 ? (e * 2 + e / 2) % 4 : 0] = distance(corner, e);
				addVertex(corner, end, normal, edges);
			}
		}
	}

	const Part& m_part;
	std::vector<Vertex>& m_vertices;
	btVector3 m_centre = btVector3(0, 0, 0);
};

class SkinMesh
{
public:
	SkinMesh(const Skin& skin, std::vector<Vertex>& vertices) : m_skin(skin), m_vertices(vertices) {}

	void add()
	{
		const size_t n = m_skin.outline.size(), last = m_skin.stations.size() - 1;
		for (const btVector3& corner : m_skin.outline)
			m_centre += corner / btScalar(n);
		m_centre.setX(0);
		for (size_t s = 0; s < last; ++s)
			for (size_t i = 0; i < n; ++i)
				addSide(s, m_skin.outline[i], m_skin.outline[(i + 1) % n]);
		addCap(0, -1);
		addCap(last, 1);
	}

private:
	void addVertex(size_t station, const btVector3& corner, const btVector3& normal, const std::array<float, 4>& edges)
	{
		const btTransform& pose = m_skin.stations[station];
		m_vertices.push_back({toVector(pose * btVector3(0, corner.y(), corner.z())),
							  toVector(pose.getBasis() * normal),
							  {m_skin.colour.r, m_skin.colour.g, m_skin.colour.b},
							  edges,
							  m_skin.gloss});
	}

	/// Each station has its own normals: the light runs smoothly over the bend.
	void addSide(size_t s, const btVector3& a, const btVector3& b)
	{
		const btVector3 along = b - a, flat = btVector3(0, -along.z(), along.y()).normalized() * -1;
		const btVector3 na = m_skin.round ? (a - m_centre).normalized() : flat,
						nb = m_skin.round ? (b - m_centre).normalized() : flat;
		const float length = m_skin.round ? FAR_FROM_EDGE : float(along.length()), zero = m_skin.round ? length : 0;
		const std::array<float, 4> atA = {zero, length, FAR_FROM_EDGE, FAR_FROM_EDGE},
								   atB = {length, zero, FAR_FROM_EDGE, FAR_FROM_EDGE};
		addVertex(s, a, na, atA);
		addVertex(s + 1, b, nb, atB);
		addVertex(s, b, nb, atB);
		addVertex(s, a, na, atA);
		addVertex(s + 1, a, na, atA);
		addVertex(s + 1, b, nb, atB);
	}

	void addCap(size_t station, btScalar end)
	{
		const std::array<float, 4> edges = {FAR_FROM_EDGE, FAR_FROM_EDGE, FAR_FROM_EDGE, FAR_FROM_EDGE};
		const size_t n = m_skin.outline.size();
		for (size_t i = 0; i < n; ++i)
		{
			const btVector3 &a = m_skin.outline[i], &b = m_skin.outline[(i + 1) % n];
			addVertex(station, m_centre, btVector3(end, 0, 0), edges);
			addVertex(station, end < 0 ? a : b, btVector3(end, 0, 0), edges);
			addVertex(station, end < 0 ? b : a, btVector3(end, 0, 0), edges);
		}
	}

	const Skin& m_skin;
	std::vector<Vertex>& m_vertices;
	btVector3 m_centre = btVector3(0, 0, 0);
};
}  // namespace

std::vector<Vertex> makeMesh(const std::vector<Part>& parts, const std::vector<Skin>& skins)
{
	std::vector<Vertex> vertices;
	for (const Part& part : parts)
		PartMesh(part, vertices).add();
	for (const Skin& skin : skins)
		if (skin.stations.size() > 1)
			SkinMesh(skin, vertices).add();
	return vertices;
}

std::vector<Vertex> makeMesh(std::vector<Puff> puffs, const Camera& camera)
{
	const auto distance = [&camera](const Puff& puff) { return (puff.place - camera.eye).length2(); };
	std::stable_sort(puffs.begin(), puffs.end(),
					 [&](const Puff& a, const Puff& b) { return distance(a) > distance(b); });
	std::vector<Vertex> vertices;
	for (const Puff& puff : puffs)
	{
		const btVector3 sight = puff.place - camera.eye, upright(0, 1, 0);
		const bool isDrawnOut = puff.trace.cross(sight).length() > SIMD_EPSILON * sight.length();
		const btVector3 side = (isDrawnOut ? puff.trace : upright).cross(sight).normalized() * btScalar(puff.radius);
		const btVector3 along = isDrawnOut ? puff.trace : sight.cross(side).normalized() * btScalar(puff.radius);
		for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, -1),
								   std::pair(1, 1), std::pair(-1, 1)})
			vertices.push_back({toVector(puff.place + side * btScalar(x) + along * btScalar(y)),
								{0, 0, 0},
								{puff.colour.r, puff.colour.g, puff.colour.b},
								{float(x), float(y), puff.opacity, 0},
								0});
	}
	return vertices;
}
}  // namespace ep
