// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "build/BondedScene.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticBonding.h"
#include "json/JsonFile.h"
#include "scenefile/Complaints.h"
#include "scenefile/SceneBuilder.h"
#include "scenefile/SceneFile.h"
#include "simulation/Hull.h"
#include "text/Format.h"
#include "world/World.h"

namespace ep
{
namespace
{
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const double NEAR = 10;          // gaps: pieces that are no further apart are told of
const size_t MOST_REMARKS = 20;  // of a kind
const btScalar SQUARE = btScalar(1e-4);

/// As a person would write it: 0.3, and not 0.300000012.
double rounded(btScalar value)
{
	const double clean = std::strtod(format("%.6g", double(value)).c_str(), nullptr);
	return std::fabs(clean) < 1e-7 ? 0 : clean;
}
Json listOf(const btVector3& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

btVector3 middleOf(const std::vector<btVector3>& points)
{
	btVector3 sum(0, 0, 0);
	for (const btVector3& p : points)
		sum += p / btScalar(points.size());
	return sum;
}

struct Box
{
	btVector3 size;
	btMatrix3x3 axes;  ///< columns: its x, y and z, each as near to the world's as can be
};

/// \return whether these are the corners of a box
bool isBox(const std::vector<btVector3>& corners, Box& box)
{
	if (corners.size() != 8)
		return false;
	const auto square = [](const btVector3& a, const btVector3& b)
	{ return btFabs(a.dot(b)) <= SQUARE * a.length() * b.length(); };
	// From one corner to three others along its edges: then the sum of these is the way to the corner that is furthest.
	const btVector3 first = corners[0], through = 2 * (middleOf(corners) - first);
	for (size_t i = 1; i < 8; ++i)
		for (size_t j = i + 1; j < 8; ++j)
			for (size_t k = j + 1; k < 8; ++k)
			{
				btVector3 edges[] = {corners[i] - first, corners[j] - first, corners[k] - first};
				if (!square(edges[0], edges[1]) || !square(edges[0], edges[2]) || !square(edges[1], edges[2]) ||
					(edges[0] + edges[1] + edges[2] - through).length() > SQUARE * through.length())
					continue;
				for (int axis = 0; axis < 3; ++axis)
				{
					const auto steeper = [axis](const btVector3& a, const btVector3& b)
					{ return btFabs(a[axis]) / a.length() < btFabs(b[axis]) / b.length(); };
					std::iter_swap(edges + axis, std::max_element(edges + axis, edges + 3, steeper));
				}
				box.size.setValue(edges[0].length(), edges[1].length(), edges[2].length());
				for (int axis = 0; axis < 2; ++axis)
					edges[axis] *= (edges[axis][axis] < 0 ? -1 : 1) / edges[axis].length();
				edges[2] = edges[0].cross(edges[1]);
				for (int row = 0; row < 3; ++row)
					box.axes[row].setValue(edges[0][row], edges[1][row], edges[2][row]);
				return true;
			}
	return false;
}

Json bodyOf(const ModelPiece& piece)
{
	const btVector3 middle = middleOf(piece.corners);
	Json body = {{"name", piece.name}};
	Box box;
	if (isBox(piece.corners, box))
	{
		body["box"] = listOf(box.size);
		body["at"] = listOf(middle);
		btQuaternion turn;
		box.axes.getRotation(turn);
		if (turn.getAngle() > btScalar(1e-5) && turn.getAngle() < 2 * SIMD_PI - btScalar(1e-5))
		{
			body["turn"] = listOf(turn.getAxis());
			body["turn"].push_back(rounded(btDegrees(turn.getAngle())));
		}
		return body;
	}
	body["hull"] = Json::array();
	for (const btVector3& corner : piece.corners)
		for (const auto& number : listOf(corner - middle))
			body["hull"].push_back(number);
	body["at"] = listOf(middle);
	return body;
}

using Materials = std::map<std::string, SceneDescription::Material>;

/// What pieces may be of.
Materials knownMaterials(const std::string& file)
{
	return file.empty() ? Materials{{"steel", {}}} : describeMaterials(SceneText::read(file));
}

/// By what a section of it bears.
std::string weakerOf(const std::string& a, const std::string& b, const Materials& known)
{
	const auto strength = [&](const std::string& name)
	{
		const auto found = known.find(name);
		return found == known.end() ? SIMD_INFINITY
									: found->second.law.m_yieldStress * found->second.law.m_loadBearingShare;
	};
	return strength(b) < strength(a) ? b : a;
}

std::string pair(const std::string& a, const std::string& b) { return "'" + a + "' and '" + b + "'"; }

/// The pieces as hulls without margins in a world of Bullet's, to see where they touch.
class Touching
{
public:
	Touching(const std::vector<ModelPiece>& pieces, const std::vector<bool>& isFixed, double gap)
		: m_pieces(pieces), m_gap(gap)
	{
		for (size_t i = 0; i < pieces.size(); ++i)
		{
			auto* const hull = new btConvexHullShape();
			const btVector3 middle = middleOf(pieces[i].corners);
			for (const btVector3& corner : pieces[i].corners)
				hull->addPoint(corner - middle, false);
			hull->recalcLocalAabb();
			hull->setMargin(0);
			m_bodies.push_back(m_world.body(isFixed[i] ? btScalar(0) : btScalar(1), m_world.keep(hull),
											btTransform(btQuaternion::getIdentity(), middle)));
			m_indexOf[m_bodies.back()] = i;
		}
	}

	/// Faces that are wide enough to bear; the others go to the remarks.
	std::vector<btElasticPlasticFace> faces(std::vector<std::string>& remarks)
	{
		btAlignedObjectArray<btElasticPlasticFace> found;
		btElasticPlasticBonding::findFaces(m_bodies.data(), int(m_bodies.size()), btScalar(m_gap), found);
		std::vector<btElasticPlasticFace> wide;
		for (int i = 0; i < found.size(); ++i)
		{
			const auto& face = found[i];
			m_told.insert(std::minmax(indexOf(face.m_bodyA), indexOf(face.m_bodyB)));
			if (double(btMin(face.m_width, face.m_height)) > m_gap)
				wide.push_back(face);
			else
				remarks.push_back(format("%s touch in a strip of %.3g x %.3g m only: no joint",
										 pair(nameOf(face.m_bodyA), nameOf(face.m_bodyB)).c_str(), double(face.m_width),
										 double(face.m_height)));
		}
		return wide;
	}

	/// Of pairs without a face: gaps, overlaps, and what touches at an edge.
	void remarkOthers(std::vector<std::string>& remarks)
	{
		std::vector<std::string> edges;
		for (size_t i = 0; i < m_bodies.size(); ++i)
			for (size_t j = i + 1; j < m_bodies.size(); ++j)
			{
				if (m_told.count({i, j}) || (m_bodies[i]->getInvMass() == 0 && m_bodies[j]->getInvMass() == 0) ||
					!areNear(i, j))
					continue;
				const double distance = distanceOf(i, j);
				const std::string names = pair(m_pieces[i].name, m_pieces[j].name);
				const double depth = distance < m_gap ? depthOf(m_pieces[i], m_pieces[j]) : 0;
				if (depth > m_gap)
					remarks.push_back(format("%s stand %.3g m deep in each other: no joint", names.c_str(), depth));
				else if (distance <= m_gap)
					edges.push_back(names);
				else if (distance <= NEAR * m_gap)
					remarks.push_back(
						format("%s are %.3g m apart: no joint; --gap is %g", names.c_str(), distance, m_gap));
			}
		if (edges.empty())
			return;
		const size_t shown = std::min<size_t>(3, edges.size());
		std::string text;
		for (size_t i = 0; i < shown; ++i)
			text += (i > 0 ? "; " : "") + edges[i];
		if (edges.size() > shown)
			text += format("; and %zu more pairs", edges.size() - shown);
		remarks.push_back(text + " touch in an edge, a corner or at an angle only: no joint");
	}

	const std::string& nameOf(const btRigidBody* body) const { return m_pieces[indexOf(body)].name; }
	size_t indexOf(const btRigidBody* body) const { return m_indexOf.at(body); }

private:
	bool areNear(size_t i, size_t j) const
	{
		const btScalar margin = btScalar(NEAR * m_gap);
		btVector3 low, high, otherLow, otherHigh;
		m_bodies[i]->getAabb(low, high);
		m_bodies[j]->getAabb(otherLow, otherHigh);
		return TestAabbAgainstAabb2(low - btVector3(margin, margin, margin), high + btVector3(margin, margin, margin),
									otherLow, otherHigh);
	}

	/// The least way that parts two pieces along a normal of one of their faces.
	static double depthOf(const ModelPiece& a, const ModelPiece& b)
	{
		double depth = HUGE_VAL;
		for (const auto& [from, to] : {std::make_pair(&a, &b), std::make_pair(&b, &a)})
			for (const auto& [p, q, r] : hullTriangles(from->corners))
			{
				const btVector3 across = (q - p).cross(r - p);
				if (across.length2() == 0)
					continue;
				double deepest = 0;
				for (const btVector3& corner : to->corners)
					deepest = std::max(deepest, double(across.normalized().dot(p - corner)));
				depth = std::min(depth, deepest);
			}
		return depth;
	}

	/// Below 0 in each other; Bullet does not tell exactly how deep.
	double distanceOf(size_t i, size_t j)
	{
		struct Nearest : btCollisionWorld::ContactResultCallback
		{
			double distance = HUGE_VAL;
			btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
									 const btCollisionObjectWrapper*, int, int) override
			{
				distance = std::min(distance, double(point.getDistance()));
				return 0;
			}
		} nearest;
		nearest.m_closestDistanceThreshold = btScalar(2 * NEAR * m_gap);
		m_world.bullet().contactPairTest(m_bodies[i], m_bodies[j], nearest);
		return nearest.distance;
	}

	const std::vector<ModelPiece>& m_pieces;
	double m_gap;
	World m_world;
	std::vector<btRigidBody*> m_bodies;
	std::map<const btRigidBody*, size_t> m_indexOf;
	std::set<std::pair<size_t, size_t>> m_told;
};

std::vector<bool> fixedOf(const std::vector<ModelPiece>& pieces, const std::vector<std::string>& patterns)
{
	std::vector<bool> isFixed;
	Names names;
	for (const ModelPiece& piece : pieces)
	{
		names[piece.name] = int(isFixed.size());
		const auto motion = piece.properties.find("motion");
		isFixed.push_back(motion != piece.properties.end() && motion->second == "\"static\"");
	}
	for (const std::string& pattern : patterns)
	{
		const std::vector<int> found = placesOf(pattern, names);
		if (found.empty())
			throw SceneError("--static is no piece: " + unknownName(pattern, namesIn(names)));
		for (int index : found)
			isFixed[size_t(index)] = true;
	}
	return isFixed;
}

/// By its custom property; by its surface, if that is a material's name; else what is given for all.
std::string materialOf(const ModelPiece& piece, const Materials& known, const std::string& orElse)
{
	const auto own = piece.properties.find("material");
	if (own != piece.properties.end())
		return Json::parse(own->second).is_string() ? Json::parse(own->second).get<std::string>() : own->second;
	return known.count(piece.surface) ? piece.surface : orElse;
}
}  // namespace

BondedScene bondPieces(const std::vector<ModelPiece>& pieces, const BondSettings& settings, const std::string& file)
{
	const Materials known = knownMaterials(settings.materials);
	const std::vector<bool> isFixed = fixedOf(pieces, settings.fixed);
	const fs::path folder = fs::absolute(file).parent_path();
	Json scene = {{"version", 1}, {"title", fs::path(file).stem().string()}};
	if (settings.materials.empty())
		scene["materials"] = {{"steel", Json::object()}};
	else
		scene["include"] = {fs::absolute(settings.materials).lexically_normal().lexically_proximate(folder).string()};
	scene["world"] = {{"ground", settings.ground}, {"ramp", 0.5}};

	std::vector<std::string> materials;
	scene["bodies"] = Json::array();
	for (size_t i = 0; i < pieces.size(); ++i)
	{
		materials.push_back(materialOf(pieces[i], known, settings.material));
		Json body = bodyOf(pieces[i]);
		for (const auto& [key, value] : pieces[i].properties)
			body[key] = Json::parse(value);
		body["material"] = materials[i];
		if (isFixed[i])
			body["motion"] = "static";
		scene["bodies"].push_back(body);
	}

	BondedScene bonded;
	Touching touching(pieces, isFixed, settings.gap);
	scene["joints"] = Json::array();
	for (const btElasticPlasticFace& face : touching.faces(bonded.remarks))
	{
		const size_t a = touching.indexOf(face.m_bodyA), b = touching.indexOf(face.m_bodyB);
		const btMatrix3x3& axes = face.m_frame.getBasis();
		scene["joints"].push_back({{"name", pieces[a].name + "--" + pieces[b].name},
								   {"from", pieces[a].name},
								   {"to", pieces[b].name},
								   {"at", listOf(face.m_frame.getOrigin())},
								   {"along", listOf(axes.getColumn(0))},
								   {"up", listOf(axes.getColumn(1))},
								   {"material", weakerOf(materials[a], materials[b], known)},
								   {"section", {{"rectangle", {rounded(face.m_width), rounded(face.m_height)}}}},
								   {"lengths", {rounded(face.m_lengthA), rounded(face.m_lengthB)}}});
	}
	touching.remarkOthers(bonded.remarks);
	if (bonded.remarks.size() > MOST_REMARKS)
	{
		const size_t more = bonded.remarks.size() - MOST_REMARKS;
		bonded.remarks.resize(MOST_REMARKS);
		bonded.remarks.push_back("and " + std::to_string(more) + " more");
	}
	scene["end"] = {{"time", 5}};

	std::string text = "{\n";
	for (auto item = scene.begin(); item != scene.end(); ++item)
	{
		text += "\t" + Json(item.key()).dump() + ": ";
		if (item->is_array() && item.key() != "include")
		{
			text += "[";
			for (size_t i = 0; i < item->size(); ++i)
				text += (i > 0 ? ",\n\t\t" : "\n\t\t") + (*item)[i].dump();
			text += "]";
		}
		else
			text += item->dump();
		text += std::next(item) == scene.end() ? "\n}\n" : ",\n";
	}
	bonded.text = text;
	// As whoever reads it will: errors have the lines of the file.
	bonded.scene = describeScene(SceneText::parse(text, file, {}, folder.string()));
	return bonded;
}
}  // namespace ep
