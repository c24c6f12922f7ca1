// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <algorithm>
#include <cmath>

#include "scenefile/generators/Assembly.h"
#include "text/Format.h"

namespace ep
{
namespace
{
/// A wall of blocks in running bond: each row is half a block beside the one below.
class WallGenerator
{
public:
	WallGenerator(Fields& f, SceneBuilder& builder) : m_assembly(f, builder)
	{
		f.vector("at", m_at, "m", "middle of its foot's beginning");
		f.direction("along", m_along, "level direction of its length");
		f.number("length", m_length, {.01, 1000}, "m", "along its foot", Need::Required);
		f.number("height", m_height, {.01, 1000}, "m", "from its foot to its top", Need::Required);
		f.number("thickness", m_thickness, {.01, 100}, "m", "across", Need::Required);
		f.number("block_length", m_blockLength, {.01, 100}, "m", "adapted so that whole blocks make the length");
		f.number("block_height", m_blockHeight, {.01, 100}, "m", "adapted so that whole rows make the height");
		f.named("foot", m_foot, supports(), "what holds its lowest row");
		const btVector3 up(0, 1, 0);
		if (btFabs(m_along.dot(up)) > btScalar(.01))
			f.refuse("along", "is not level");
	}

	void build()
	{
		Fields& f = m_assembly.fields();
		const double columns = std::max(1., std::round(m_length / m_blockLength)),
					 rows = std::max(1., std::round(m_height / m_blockHeight));
		if (f.hasFailed() || !m_assembly.builder().hasRoom(f, (columns + 1) * rows))
			return;
		m_blockLength = m_length / columns;
		m_blockHeight = m_height / rows;
		std::vector<Block> below;
		for (int row = 0; row < int(rows); ++row)
		{
			const std::vector<Block> blocks = buildRow(row, int(columns));
			for (const Block& block : blocks)
				joinBelow(row, block, below);
			below = blocks;
		}
	}

private:
	struct Block
	{
		int body;
		std::string name;
		double begin, end;  ///< along the wall [m]
	};

	btVector3 place(double along, double up) const
	{
		return m_at + m_along * btScalar(along) + btVector3(0, btScalar(up), 0);
	}

	std::vector<Block> buildRow(int row, int columns)
	{
		// Beside whole blocks a half one at each end of every second row.
		std::vector<double> edges = {0};
		for (int i = 0; i < columns; ++i)
			edges.push_back((i + (row % 2 ? .5 : 1)) * m_blockLength);
		if (row % 2)
			edges.push_back(m_length);
		std::vector<Block> blocks;
		const btVector3 up(0, 1, 0);
		for (size_t i = 0; i + 1 < edges.size(); ++i)
		{
			const double begin = edges[i], end = edges[i + 1], middle = (row + .5) * m_blockHeight;
			const std::string name = format("%d-%zu", row + 1, i + 1);
			const btTransform pose = frameAlong(place((begin + end) / 2, middle), m_along, up);
			const int body = m_assembly.box(
				name, pose, btVector3(btScalar(end - begin), btScalar(m_blockHeight), btScalar(m_thickness)));
			if (!blocks.empty())
				m_assembly.join({name + "/side", blocks.back().body, body,
								 frameAlong(place(begin, middle), m_along, up),
								 btElasticPlasticSection::rectangle(btScalar(m_thickness), btScalar(m_blockHeight)),
								 begin - blocks.back().begin, end - begin});
			blocks.push_back({body, name, begin, end});
		}
		return blocks;
	}

	/// With what it lies on; the lowest row with the world.
	void joinBelow(int row, const Block& block, const std::vector<Block>& below)
	{
		if (row == 0 && m_foot != Support::Free)
			joinBed(block.name + "/foot", SceneDescription::WORLD, block, block.begin, block.end, 0);
		int number = 0;
		for (const Block& other : below)
		{
			const double begin = std::max(block.begin, other.begin), end = std::min(block.end, other.end);
			if (end - begin > 1e-3 * m_blockLength)
				joinBed(block.name + format("/bed-%d", ++number), other.body, block, begin, end, row);
		}
	}

	void joinBed(const std::string& name, int below, const Block& block, double begin, double end, int row)
	{
		const btTransform frame =
			frameAlong(place((begin + end) / 2, row * m_blockHeight), btVector3(0, 1, 0), m_along);
		m_assembly.join({name, below, block.body, frame,
						 btElasticPlasticSection::rectangle(btScalar(m_thickness), btScalar(end - begin)),
						 row == 0 ? 0 : m_blockHeight, m_blockHeight, row == 0 && m_foot == Support::Pinned});
	}

	Assembly m_assembly;
	btVector3 m_at = btVector3(0, 0, 0), m_along = btVector3(1, 0, 0);
	double m_length = 1, m_height = 1, m_thickness = .24, m_blockLength = .5, m_blockHeight = .25;
	Support m_foot = Support::Fixed;
};
}  // namespace

void wallStructure(Fields& f, SceneBuilder& builder) { WallGenerator(f, builder).build(); }
}  // namespace ep
