// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "structures/House.h"

namespace ep
{
struct House::Build
{
	World& world;
	const HouseSettings& s;
	btElasticPlasticMaterial material;
};

House::House(World& world, const Materials& materials, const HouseSettings& s, const btVector3& origin)
{
	const Build build = {world, s, materials.mixed(s.steelShare)};
	const auto middle = [](int i, int count) { return i - (count - 1) / btScalar(2); };
	for (int i = 0; i < s.columnsAlong; ++i)
		for (int k = 0; k < s.columnsAcross; ++k)
			addColumn(build, origin + btVector3(middle(i, s.columnsAlong), 0, middle(k, s.columnsAcross)) * s.spacing,
					  "column " + std::to_string(i) + std::to_string(k));
	const btMatrix3x3 alongX = btMatrix3x3::getIdentity(), alongZ(0, 0, -1, 0, 1, 0, 1, 0, 0);
	for (int i = 0; i < s.columnsAlong; ++i)
		for (int k = 0; k < s.columnsAcross; ++k)
		{
			const int column = i * s.columnsAcross + k;
			if (i + 1 < s.columnsAlong)
				addBeams(build, column, column + s.columnsAcross, alongX);
			if (k + 1 < s.columnsAcross)
				addBeams(build, column, column + 1, alongZ);
		}
}

void House::addColumn(const Build& build, const btVector3& foot, const std::string& name)
{
	const HouseSettings& s = build.s;
	BeamSettings column;
	column.blocks = s.storeys * s.storeyBlocks;
	column.length = s.storeys * s.storeyHeight;
	column.height = column.width = s.columnThickness;
	column.section = btElasticPlasticSection::rectangle(s.columnThickness, s.columnThickness);
	column.material = build.material;
	column.hingeLength = s.hingeLength;
	// Along y; its y axis is against the vehicle's way, its z axis across.
	const btMatrix3x3 turn(0, -1, 0, 1, 0, 0, 0, 0, 1);
	m_beams.emplace_back(build.world, name, column, btTransform(turn, foot));
	// What it is rooted in stands for the ground.
	const btScalar depth = 1;
	btRigidBody* const root =
		build.world.body(0, build.world.box(btVector3(s.columnThickness, depth, s.columnThickness)),
						 btTransform(btQuaternion(0, 0, 0, 1), foot - btVector3(0, depth / 2, 0)));
	m_beams.back().joinStart(build.world, *root);
}

void House::addBeams(const Build& build, int from, int to, const btMatrix3x3& along)
{
	const HouseSettings& s = build.s;
	BeamSettings beam;
	beam.blocks = s.beamBlocks;
	beam.length = s.spacing - s.columnThickness;
	beam.height = s.beamHeight;
	beam.width = s.columnThickness;
	beam.section = btElasticPlasticSection::rectangle(s.columnThickness, s.beamHeight);
	beam.material = build.material;
	beam.hingeLength = s.hingeLength;
	for (int storey = 0; storey < s.storeys; ++storey)
	{
		const int block = (storey + 1) * s.storeyBlocks - 1;  // the uppermost of the storey
		btRigidBody &start = *m_beams[size_t(from)].m_parts[size_t(block)],
					&end = *m_beams[size_t(to)].m_parts[size_t(block)];
		const btVector3 face = start.getCenterOfMassPosition() + along.getColumn(0) * (s.columnThickness / 2);
		m_beams.emplace_back(build.world,
							 "beam " + std::to_string(from) + std::to_string(to) + "/" + std::to_string(storey), beam,
							 btTransform(along, face));
		m_beams.back().joinStart(build.world, start);
		m_beams.back().joinEnd(build.world, end);
	}
}
}  // namespace ep
