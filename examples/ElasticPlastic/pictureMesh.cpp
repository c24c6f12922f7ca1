#include "pictureMesh.h"

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
}  // namespace

std::vector<Vertex> makeMesh(const std::vector<Part>& parts)
{
	std::vector<Vertex> vertices;
	for (const Part& part : parts)
		PartMesh(part, vertices).add();
	return vertices;
}
}  // namespace ep
