// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "StiffStructure.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "BulletCollision/CollisionDispatch/btSimulationIslandManager.h"

namespace ep
{
/// A member's direction, and how its joints' frames are turned.
struct StiffStructure::Direction
{
	btVector3 m_direction;
	btQuaternion m_turn;

	static Direction x() { return {btVector3(1, 0, 0), btQuaternion(0, 0, 0, 1)}; }
	static Direction y() { return {btVector3(0, 1, 0), btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI)}; }
	static Direction z() { return {btVector3(0, 0, 1), btQuaternion(btVector3(0, 1, 0), -SIMD_HALF_PI)}; }
};

/// What a joint holds together.
struct StiffStructure::Part
{
	btScalar m_length, m_width, m_height;
};

namespace
{
const btScalar DENSITY = 2400;

btElasticPlasticMaterial concrete()
{
	btElasticPlasticMaterial material = btElasticPlasticMaterial::steel(btScalar(30e6));
	material.m_youngsModulus = btScalar(30e9);
	material.m_density = DENSITY;
	return material;
}
}  // namespace

StiffStructure::StiffStructure(const Settings& settings)
	: m_settings(settings),
	  m_world(settings.solver, btVector3(0, btScalar(-9.81), 0)),
	  m_ground(m_world.body(0, m_world.box(btVector3(1, 1, 1)),
							btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, -100, 0)), false))
{
	switch (settings.shape)
	{
		case Shape::Chain:
			buildChain(settings.size, 0);
			break;
		case Shape::Chains:
			for (int i = 0; i < settings.size; ++i)
				buildChain(20, btScalar(i));
			break;
		case Shape::Frame:
			buildFrame(settings.size);
			break;
		case Shape::Wall:
			buildWall(settings.size);
			break;
	}
	for (const auto& body : m_world.bodies())
		if (settings.collapsing && body->getInvMass() > 0)
			body->setLinearVelocity(btVector3(3 * btSin(body->getCenterOfMassPosition().y()), 0, 2));
	m_world.bullet().getSimulationIslandManager()->setSplitIslands(settings.splitIslands);
	// All iterations, whether or not there is anything left to do.
	m_world.bullet().getSolverInfo().m_leastSquaresResidualThreshold = -1;
}

double StiffStructure::step()
{
	const auto begin = std::chrono::steady_clock::now();
	m_world.step(btScalar(1) / 60);
	return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

btRigidBody* StiffStructure::block(const btVector3& size, const btVector3& place, const Direction& along)
{
	return m_world.body(DENSITY * size.x() * size.y() * size.z(), m_world.box(size), btTransform(along.m_turn, place),
						false);
}

void StiffStructure::join(btRigidBody& a, btRigidBody& b, const btVector3& place, const Direction& along,
						  const Part& part)
{
	const btTransform frame(along.m_turn, place);
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(part.m_width, part.m_height);
	if (m_settings.fibres > 0)
		section = section.withFibres(m_settings.fibres);
	const btElasticPlasticCapacity capacity =
		btElasticPlasticCapacity::fromMember(concrete(), section, part.m_length, part.m_length);
	++m_numJoints;
	// Not by the world's method, which keeps a joint of ours beside each of Bullet's: memory counts here.
	if (m_settings.joints == Joints::ElasticPlastic)
		m_world.joint(a, b, frame, capacity);
	else
		m_world.add(makeBulletsOwn({m_settings.joints}, a, b, frame, capacity));
}

void StiffStructure::buildChain(int blocks, btScalar z)
{
	const Part part = {btScalar(0.5), btScalar(0.3), btScalar(0.3)};
	btRigidBody* last = m_ground;
	for (int i = 0; i < blocks; ++i)
	{
		const btScalar begin = i * part.m_length;
		btRigidBody* next = block(btVector3(part.m_length, part.m_height, part.m_width),
								  btVector3(begin + part.m_length / 2, 0, z), Direction::x());
		join(*last, *next, btVector3(begin, 0, z), Direction::x(), part);
		last = next;
	}
}

void StiffStructure::buildMember(btRigidBody& from, btRigidBody& to, const btVector3& begin, const Direction& along)
{
	const int parts = 3;
	const Part part = {btScalar(0.75), btScalar(0.4), btScalar(0.4)};
	btRigidBody* last = &from;
	for (int i = 1; i <= parts + 1; ++i)
	{
		const btVector3 place = begin + along.m_direction * (i * part.m_length);
		btRigidBody* next =
			i > parts ? &to : block(btVector3(part.m_length, part.m_height, part.m_width), place, along);
		join(*last, *next, place - along.m_direction * (part.m_length / 2), along, part);
		last = next;
	}
}

void StiffStructure::buildFrame(int bays)
{
	const btScalar pitch = 3;
	const int storeys = bays * 3 / 2;
	std::vector<btRigidBody*> nodes;
	const auto node = [&](int x, int y, int z) -> btRigidBody& { return *nodes[(y * bays + z) * bays + x]; };
	const auto place = [&](int x, int y, int z) { return btVector3(x * pitch, y * pitch, z * pitch); };
	for (int y = 0; y <= storeys; ++y)
		for (int z = 0; z < bays; ++z)
			for (int x = 0; x < bays; ++x)
				nodes.push_back(y == 0 ? m_ground
									   : block(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)), place(x, y, z),
											   Direction::x()));
	for (int y = 0; y <= storeys; ++y)
		for (int z = 0; z < bays; ++z)
			for (int x = 0; x < bays; ++x)
			{
				if (y < storeys)
					buildMember(node(x, y, z), node(x, y + 1, z), place(x, y, z), Direction::y());
				if (y > 0 && x + 1 < bays)
					buildMember(node(x, y, z), node(x + 1, y, z), place(x, y, z), Direction::x());
				if (y > 0 && z + 1 < bays)
					buildMember(node(x, y, z), node(x, y, z + 1), place(x, y, z), Direction::z());
			}
}

void StiffStructure::buildWall(int blocks)
{
	const btScalar side = btScalar(0.5), depth = btScalar(0.25);
	const Part part = {side, depth, side};
	const int pier = std::max(1, blocks / 7), opening = 3 * blocks / 10;
	const auto isPier = [pier](int x) { return x / pier % 2 == 0; };
	std::vector<btRigidBody*> wall;
	for (int y = 0; y < blocks; ++y)
		for (int x = 0; x < blocks; ++x)
			wall.push_back(block(btVector3(side, side, depth), btVector3(x * side, (y + btScalar(0.5)) * side, 0),
								 Direction::x()));
	for (int y = 0; y < blocks; ++y)
		for (int x = 0; x < blocks; ++x)
		{
			btRigidBody& here = *wall[y * blocks + x];
			if (x + 1 < blocks && (y >= opening || isPier(x)))
				join(here, *wall[y * blocks + x + 1],
					 btVector3((x + btScalar(0.5)) * side, (y + btScalar(0.5)) * side, 0), Direction::x(), part);
			if (y > 0 || isPier(x))
				join(y > 0 ? *wall[(y - 1) * blocks + x] : *m_ground, here, btVector3(x * side, y * side, 0),
					 Direction::y(), part);
		}
}

double medianOf(std::vector<double> times)
{
	std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
	return times[times.size() / 2];
}
}  // namespace ep
