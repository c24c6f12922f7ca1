// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/Hull.h"

#include "LinearMath/btConvexHullComputer.h"

namespace ep
{
std::vector<std::array<btVector3, 3>> hullTriangles(const std::vector<btVector3>& points)
{
	btConvexHullComputer hull;
	hull.compute(&points[0].x(), int(sizeof(btVector3)), int(points.size()), 0, 0);
	// Its own vertices are rounded to a grid of some ten thousand.
	const auto corner = [&](int vertex) { return points[size_t(hull.original_vertex_index[vertex])]; };
	btVector3 middle(0, 0, 0);
	for (int i = 0; i < hull.vertices.size(); ++i)
		middle += corner(i) / btScalar(hull.vertices.size());
	std::vector<std::array<btVector3, 3>> triangles;
	for (int f = 0; f < hull.faces.size(); ++f)
	{
		const btConvexHullComputer::Edge* const first = &hull.edges[hull.faces[f]];
		const btVector3 a = corner(first->getSourceVertex());
		for (const btConvexHullComputer::Edge* edge = first->getNextEdgeOfFace();
			 edge->getTargetVertex() != first->getSourceVertex(); edge = edge->getNextEdgeOfFace())
		{
			const btVector3 b = corner(edge->getSourceVertex()), c = corner(edge->getTargetVertex());
			const bool isOutward = (b - a).cross(c - a).dot(a - middle) > 0;
			triangles.push_back({a, isOutward ? b : c, isOutward ? c : b});
		}
	}
	return triangles;
}
}  // namespace ep
