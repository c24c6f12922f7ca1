// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/destruction/Buildings.h"

namespace ep
{
namespace
{
const double PITCH = 4;        // from column to column and from floor to floor [m]
const double THICKNESS = 0.4;  // of columns and beams [m]
const double SLAB = 0.2;       // thickness of slabs [m]
const double SLAB_EDGE = 0.3;  // width of a slab's corner where it is joined [m]
const double YIELD = 20e6;     // [Pa]
const double STRAIN = 0.05;
const int PARTS = 2;  // of a member between two nodes
const double PART_LENGTH = (PITCH - THICKNESS) / PARTS;

/// Builds one building, part by part.
class Builder
{
public:
	Builder(Stage& stage, const Building& building)
		: m_stage(stage),
		  m_building(building),
		  m_material(stage.concrete(YIELD, STRAIN)),
		  m_atNode(stage.rectangularMember(m_material, THICKNESS, THICKNESS, PART_LENGTH, THICKNESS)),
		  m_within(stage.rectangularMember(m_material, THICKNESS, THICKNESS, PART_LENGTH, PART_LENGTH)),
		  m_atSlab(stage.rectangularMember(m_material, SLAB_EDGE, SLAB, 1, 1))
	{
		const double length = PART_LENGTH - 2 * Stage::GAP, width = THICKNESS - 2 * Stage::GAP,
					 slab = PITCH - THICKNESS - 2 * Stage::GAP;
		World& world = stage.world();
		m_nodeShape = world.box(vector(THICKNESS, THICKNESS, THICKNESS));
		m_slabShape = world.box(vector(slab, SLAB, slab));
		m_memberShapes[0] = world.box(vector(length, width, width));
		m_memberShapes[1] = world.box(vector(width, length, width));
		m_memberShapes[2] = world.box(vector(width, width, length));
	}

	std::vector<btRigidBody*> build()
	{
		const int n = m_building.bays;
		const double nodeMass = density() * THICKNESS * THICKNESS * THICKNESS;
		for (int y = 0; y <= m_building.storeys; ++y)
			for (int z = 0; z < n; ++z)
				for (int x = 0; x < n; ++x)
					m_nodes.push_back(y == 0 ? &m_stage.ground()
											 : &m_stage.body(nodeMass, m_nodeShape, middleOf(x, y, z)));
		for (int y = 0; y <= m_building.storeys; ++y)
			for (int z = 0; z < n; ++z)
				for (int x = 0; x < n; ++x)
					buildFrom(x, y, z);
		return m_frontColumns;
	}

private:
	double density() const { return double(m_material.m_density); }
	btRigidBody& node(int x, int y, int z) const
	{
		return *m_nodes[size_t((y * m_building.bays + z) * m_building.bays + x)];
	}
	/// The top of a floor at a node.
	btVector3 topOf(int x, int y, int z) const { return m_building.corner + vector(x, y, z) * btScalar(PITCH); }
	btVector3 middleOf(int x, int y, int z) const { return topOf(x, y, z) - vector(0, THICKNESS / 2, 0); }

	/// What begins at a node.
	void buildFrom(int x, int y, int z)
	{
		const int n = m_building.bays;
		if (y < m_building.storeys)
		{
			const std::vector<btRigidBody*> column =
				buildMember(node(x, y, z), node(x, y + 1, z), topOf(x, y, z), Stage::Along::Y);
			if (y == 0 && z == 0)
				m_frontColumns.insert(m_frontColumns.end(), column.begin(), column.end());
		}
		if (y == 0)
			return;
		const btVector3 middle = middleOf(x, y, z);
		if (x + 1 < n)
			buildMember(node(x, y, z), node(x + 1, y, z), middle + vector(THICKNESS / 2, 0, 0), Stage::Along::X);
		if (z + 1 < n)
			buildMember(node(x, y, z), node(x, y, z + 1), middle + vector(0, 0, THICKNESS / 2), Stage::Along::Z);
		if (x + 1 < n && z + 1 < n)
			buildSlab(x, y, z);
	}

	std::vector<btRigidBody*> buildMember(btRigidBody& from, btRigidBody& to, const btVector3& begin,
										  Stage::Along along)
	{
		const int axis = int(along);
		btVector3 part(0, 0, 0);
		part[axis] = btScalar(PART_LENGTH);
		std::vector<btRigidBody*> parts;
		btRigidBody* last = &from;
		for (int i = 0; i < PARTS; ++i)
		{
			btRigidBody& next = m_stage.body(density() * THICKNESS * THICKNESS * PART_LENGTH, m_memberShapes[axis],
											 begin + part * btScalar(i + 0.5));
			m_stage.join(*last, next, begin + part * btScalar(i), along, i == 0 ? m_atNode : m_within);
			parts.push_back(last = &next);
		}
		m_stage.join(*last, to, begin + part * btScalar(PARTS), along, m_atNode);
		return parts;
	}

	/// A slab hangs on the nodes at its four corners.
	void buildSlab(int x, int y, int z)
	{
		const double width = PITCH - THICKNESS;
		btRigidBody& slab = m_stage.body(density() * width * width * SLAB, m_slabShape,
										 topOf(x, y, z) + vector(PITCH / 2, -SLAB / 2, PITCH / 2));
		for (int i = 0; i < 2; ++i)
			for (int k = 0; k < 2; ++k)
				m_stage.join(node(x + i, y, z + k), slab,
							 topOf(x + i, y, z + k) + vector(i ? -THICKNESS / 2 : THICKNESS / 2, -SLAB / 2,
															 k ? -THICKNESS / 2 : THICKNESS / 2),
							 Stage::Along::X, m_atSlab);
	}

	Stage& m_stage;
	const Building& m_building;
	btElasticPlasticMaterial m_material;
	btElasticPlasticCapacity m_atNode, m_within, m_atSlab;
	btCollisionShape *m_nodeShape, *m_slabShape, *m_memberShapes[3];
	std::vector<btRigidBody*> m_nodes, m_frontColumns;
};
}  // namespace

std::vector<btRigidBody*> Building::build(Stage& stage) const { return Builder(stage, *this).build(); }

void Frame::build(Stage& stage) const
{
	Building building;
	building.bays = bays;
	building.storeys = storeys;
	std::vector<btRigidBody*> lost = building.build(stage);
	lost.resize(size_t(PARTS * (bays - 1)));
	const int settled = 60;
	stage.at(settled,
			 [lost](Stage& s)
			 {
				 for (btRigidBody* part : lost)
					 s.remove(*part);
			 });
}

void City::build(Stage& stage) const
{
	const int inRow = 10;
	const double pitch = 9, left = -45, front = -22;
	for (int i = 0; i < buildings; ++i)
	{
		Building building;
		building.bays = building.storeys = 2;
		building.corner = vector(i % inRow * pitch + left, 0, i / inRow * pitch + front);
		building.build(stage);
	}
	const int asleep = 240;
	const double hit = std::min(4, buildings - 1) * pitch + left;
	stage.throwBall(asleep, {btScalar(0.8), 20000, vector(hit + 0.1, 2, front - 8), vector(0, 1, 25)});
}
}  // namespace ep
