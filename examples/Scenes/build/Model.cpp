// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "build/Model.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "json/JsonFile.h"
#include "modelfile/ModelFile.h"
#include "scenefile/Complaints.h"
#include "simulation/Hull.h"
#include "simulation/Shapes.h"
#include "text/Format.h"

namespace ep
{
namespace
{
const size_t MOST_CORNERS = 100;               // of a hull in a scene
const btScalar SAME = btScalar(1e-5);          // of two corners, over a piece's size
const btScalar DEEPEST_DENT = btScalar(1e-3);  // of what still counts as convex, over a piece's size
const char* const PROPERTIES[] = {"material", "motion", "mass", "density", "friction", "restitution"};

/// The corners of the hull round a mesh. \return what is wrong with the mesh, empty: nothing
std::string cornersOf(const std::vector<btVector3>& triangles, std::vector<btVector3>& corners)
{
	btVector3 low = triangles[0], high = low;
	for (const btVector3& p : triangles)
	{
		low.setMin(p);
		high.setMax(p);
	}
	const btScalar size = (high - low).length();
	std::vector<btVector3> points;
	for (const btVector3& p : triangles)
		if (std::none_of(points.begin(), points.end(),
						 [&](const btVector3& other) { return (p - other).length() <= SAME * size; }))
		{
			points.push_back(p);
			if (points.size() > 20 * MOST_CORNERS)
				return "has thousands of corners: make it of simpler pieces";
		}
	const Solid solid = points.size() < 4 ? Solid() : solidOfHull(points);
	if (!(solid.volume > 1e-6 * std::pow(double(size), 3)))
		return "has no volume";
	const auto hull = hullTriangles(points);
	for (size_t i = 0; i + 2 < triangles.size(); i += 3)
	{
		const btVector3 middle = (triangles[i] + triangles[i + 1] + triangles[i + 2]) / 3;
		btScalar depth = size;
		for (const auto& [a, b, c] : hull)
			if ((b - a).cross(c - a).length2() > 0)
				depth = std::min(depth, (b - a).cross(c - a).normalized().dot(a - middle));
		if (depth > DEEPEST_DENT * size)
			return format("is not convex: a face of it is %.3g m inside its hull; cut it into convex pieces",
						  double(depth));
	}
	for (const btVector3& p : points)
		if (std::any_of(hull.begin(), hull.end(),
						[&](const auto& triangle)
						{ return std::find(triangle.begin(), triangle.end(), p) != triangle.end(); }))
			corners.push_back(p);
	return corners.size() > MOST_CORNERS ? format("has %zu corners; a piece may have %zu", corners.size(), MOST_CORNERS)
										 : "";
}

/// Names as scenes allow them, each once.
class PieceNames
{
public:
	std::string newName(const std::string& given)
	{
		std::string name = given.empty() || given == "world" ? "piece" : given.substr(0, 40);
		for (char& c : name)
			if (strchr("*,\"\n", c))
				c = '_';
		std::string own = name;
		for (int i = 2; !m_names.insert(own).second; ++i)
			own = name + "-" + std::to_string(i);
		return own;
	}

private:
	std::set<std::string> m_names;
};
}  // namespace

std::vector<ModelPiece> readModel(const std::string& file)
{
	std::vector<ModelPiece> pieces;
	Complaints complaints;
	const Place place = {std::make_shared<const std::string>(file), 0};
	PieceNames names;
	try
	{
		for (const ModelNode& node : readModelFile(file))
		{
			ModelPiece piece;
			piece.name = names.newName(node.name);
			piece.surface = node.surface;
			const std::string fault = node.fault.empty() ? cornersOf(node.triangles, piece.corners) : node.fault;
			if (!fault.empty())
				complaints.add(place, shown(piece.name), fault);
			for (const char* key : PROPERTIES)
				if (node.properties.count(key) > 0)
					piece.properties[key] = node.properties.at(key);
			pieces.push_back(piece);
		}
	}
	catch (const std::runtime_error& error)
	{
		complaints.add(place, "", error.what());
	}
	if (pieces.empty() && !complaints.any())
		complaints.add(place, "", "has no meshes");
	complaints.check();
	return pieces;
}
}  // namespace ep
