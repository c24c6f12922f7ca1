// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/SceneBuilder.h"

#include <algorithm>

#include "scenefile/Complaints.h"

namespace ep
{
namespace
{
const size_t MOST_BODIES = 50000, MOST_JOINTS = 200000;

/// Does a name fit a pattern in which * stands for any letters?
bool isLike(const std::string& name, const std::string& pattern)
{
	size_t n = 0, p = 0, star = std::string::npos, mark = 0;
	while (n < name.size())
	{
		if (p < pattern.size() && pattern[p] == '*')
		{
			star = p++;
			mark = n;
		}
		else if (p < pattern.size() && pattern[p] == name[n])
		{
			++p;
			++n;
		}
		else if (star != std::string::npos)
		{
			p = star + 1;
			n = ++mark;
		}
		else
			return false;
	}
	while (p < pattern.size() && pattern[p] == '*')
		++p;
	return p == pattern.size();
}
}  // namespace

std::vector<int> placesOf(const std::string& pattern, const Names& names)
{
	std::vector<int> found;
	const auto exact = names.find(pattern);
	if (exact != names.end())
		found.push_back(exact->second);
	else if (pattern.find('*') != std::string::npos)
		for (const auto& [name, index] : names)
			if (isLike(name, pattern))
				found.push_back(index);
	return found;
}

std::vector<std::string> namesIn(const Names& names)
{
	std::vector<std::string> all;
	for (const auto& name : names)
		all.push_back(name.first);
	return all;
}

bool SceneBuilder::addName(Fields& f, Names& names, const std::string& name, size_t index, const char* what)
{
	if (name.empty() || name.size() > 100 || name.find_first_of("*,\"\n") != std::string::npos || name == "world")
		f.refuse("name", std::string("of a ") + what + " is \"" + name +
							 "\"; it must have 1 to 100 characters without * , \" and line ends, and not be world");
	else if (!names.emplace(name, int(index)).second)
		f.refuse("name", "is that of another " + std::string(what) + ", \"" + name + "\"; each must have its own");
	else
		return true;
	return false;
}

int SceneBuilder::add(Fields& f, const SceneDescription::Body& body)
{
	if (m_scene.bodies.size() >= MOST_BODIES)
		f.refuse("", "makes more than " + std::to_string(MOST_BODIES) + " bodies");
	else if (addName(f, m_bodies, body.name, m_scene.bodies.size(), "body"))
	{
		m_scene.bodies.push_back(body);
		return int(m_scene.bodies.size()) - 1;
	}
	m_refused.push_back(body.name);
	return SceneDescription::WORLD;
}

int SceneBuilder::add(Fields& f, const SceneDescription::Joint& joint)
{
	const btElasticPlasticFault fault = joint.capacity.fault();
	char text[200];
	fault.print(text, sizeof text);
	if (fault)
		f.refuse("", "has the joint " + joint.name + " of which the " + text);
	else if (joint.bodies[0] == joint.bodies[1] && !f.hasFailed())
		f.refuse("", "has the joint " + joint.name + " that joins a body with itself");
	else if (m_scene.joints.size() >= MOST_JOINTS)
		f.refuse("", "makes more than " + std::to_string(MOST_JOINTS) + " joints");
	else if (addName(f, m_joints, joint.name, m_scene.joints.size(), "joint"))
	{
		m_scene.joints.push_back(joint);
		return int(m_scene.joints.size()) - 1;
	}
	m_refused.push_back(joint.name);
	return -1;
}

/// Whether it is a name, or a pattern of names, of something that is not there since it has been complained of.
bool SceneBuilder::isLost(const std::string& pattern) const
{
	const std::string fixed = pattern.substr(0, pattern.find('*'));
	const bool isPattern = fixed.size() < pattern.size();
	for (const std::string& structure : m_structures)
	{
		const std::string prefix = structure.empty() ? "" : structure + "/";
		const auto first = m_bodies.lower_bound(prefix);
		const bool hasMade = first != m_bodies.end() && !prefix.empty() && first->first.rfind(prefix, 0) == 0;
		if (!hasMade && (fixed.rfind(prefix, 0) == 0 || (isPattern && prefix.rfind(fixed, 0) == 0)))
			return true;
	}
	return std::any_of(m_refused.begin(), m_refused.end(),
					   [&](const std::string& name) { return isLike(name, pattern); });
}

int SceneBuilder::body(Fields& f, const char* key, const std::string& name)
{
	const auto found = m_bodies.find(name);
	if (found != m_bodies.end())
		return found->second;
	if (name != "world" && !isLost(name))
		f.refuse(key, "is a body that is not there: " + unknownName(name, namesIn(m_bodies)));
	return SceneDescription::WORLD;
}

std::vector<int> SceneBuilder::like(Fields& f, const char* key, const std::string& pattern, const Names& names,
									const char* what)
{
	const std::vector<int> found = placesOf(pattern, names);
	if (found.empty() && !pattern.empty() && !isLost(pattern))
		f.refuse(key, std::string("is no ") + what + ": " + unknownName(pattern, namesIn(names)));
	return found;
}

std::vector<int> SceneBuilder::bodies(Fields& f, const char* key, const std::string& pattern)
{
	return like(f, key, pattern, m_bodies, "body");
}

std::vector<int> SceneBuilder::joints(Fields& f, const char* key, const std::string& pattern)
{
	return like(f, key, pattern, m_joints, "joint");
}

bool SceneBuilder::hasRoom(Fields& f, double bodies)
{
	const bool hasRoom = bodies + double(m_scene.bodies.size()) <= double(MOST_BODIES);
	if (!hasRoom)
		f.refuse("", "would make " + std::to_string((long long)(bodies)) + " bodies; a scene may have " +
						 std::to_string(MOST_BODIES));
	return hasRoom;
}

btTransform turnOf(const btElasticPlasticSection& section)
{
	return btTransform(btQuaternion(btVector3(1, 0, 0), section.m_turn));
}

btTransform frameAlong(const btVector3& origin, const btVector3& along, const btVector3& up)
{
	const btVector3 x = along.normalized();
	btVector3 y = up - x * x.dot(up);
	// What is along has no up: then any across.
	if (y.length() < btScalar(1e-3))
	{
		const btVector3 other = btFabs(x.x()) < btScalar(.9) ? btVector3(1, 0, 0) : btVector3(0, 0, 1);
		y = other - x * x.dot(other);
	}
	y.normalize();
	const btVector3 z = x.cross(y);
	return btTransform(btMatrix3x3(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z()), origin);
}
}  // namespace ep
