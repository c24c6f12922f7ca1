// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/generators/Assembly.h"
#include "text/Format.h"

namespace ep
{
namespace
{
enum class SlabSupport
{
	None,
	Edges,
	Ends,  ///< the two edges across x
	Corners
};

const std::vector<Named<SlabSupport>>& slabSupports()
{
	static const std::vector<Named<SlabSupport>> all = {{"none", SlabSupport::None},
														{"edges", SlabSupport::Edges},
														{"ends", SlabSupport::Ends},
														{"corners", SlabSupport::Corners}};
	return all;
}

/// Boxes in up to three directions, each joined to its neighbours by the area in which they touch.
class BlockArray
{
public:
	BlockArray(Assembly& assembly, const btVector3& corner, const btVector3& size, const int (&count)[3])
		: m_assembly(assembly), m_corner(corner), m_size(size), m_count{count[0], count[1], count[2]}
	{
	}

	bool build()
	{
		Fields& f = m_assembly.fields();
		if (f.hasFailed() || !m_assembly.builder().hasRoom(f, double(m_count[0]) * m_count[1] * m_count[2]))
			return false;
		each(
			[&](const Cell& c) {
				m_bodies.push_back(
					m_assembly.box(nameOf(c), btTransform(btQuaternion(0, 0, 0, 1), middleOf(c)), m_size));
			});
		each(
			[&](const Cell& c)
			{
				for (int axis = 0; axis < 3; ++axis)
					if (c.i[axis] > 0)
						joinBehind(c, axis);
			});
		return true;
	}

	struct Cell
	{
		int i[3];
	};

	template <class Act>
	void each(const Act& act) const
	{
		for (int z = 0; z < m_count[2]; ++z)
			for (int y = 0; y < m_count[1]; ++y)
				for (int x = 0; x < m_count[0]; ++x)
					act(Cell{{x, y, z}});
	}

	bool isAt(const Cell& c, int axis, int side) const { return c.i[axis] == (side < 0 ? 0 : m_count[axis] - 1); }

	/// With the world at its side in a direction.
	void joinWorld(const Cell& c, int axis, int side, bool isPinned)
	{
		btVector3 along(0, 0, 0), place = middleOf(c);
		along[axis] = btScalar(-side);
		place[axis] += m_size[axis] / 2 * btScalar(side);
		m_assembly.join({nameOf(c) + format("/world-%d%c", axis, side < 0 ? 'a' : 'b'), SceneDescription::WORLD,
						 body(c), frameAlong(place, along, upOf(axis)), sectionAcross(axis), 0, double(m_size[axis]),
						 isPinned});
	}

private:
	std::string nameOf(const Cell& c) const { return format("%d-%d-%d", c.i[0] + 1, c.i[1] + 1, c.i[2] + 1); }
	int body(const Cell& c) const { return m_bodies[size_t((c.i[2] * m_count[1] + c.i[1]) * m_count[0] + c.i[0])]; }
	btVector3 middleOf(const Cell& c) const
	{
		return m_corner + m_size * btVector3(btScalar(c.i[0] + .5), btScalar(c.i[1] + .5), btScalar(c.i[2] + .5));
	}

	/// The joint's height is along y, but for joints along y along x.
	static btVector3 upOf(int axis) { return axis == 1 ? btVector3(1, 0, 0) : btVector3(0, 1, 0); }

	btElasticPlasticSection sectionAcross(int axis) const
	{
		const int height = axis == 1 ? 0 : 1, width = 3 - axis - height;
		return btElasticPlasticSection::rectangle(m_size[width], m_size[height]);
	}

	void joinBehind(const Cell& c, int axis)
	{
		Cell behind = c;
		--behind.i[axis];
		btVector3 along(0, 0, 0), place = middleOf(c);
		along[axis] = 1;
		place[axis] -= m_size[axis] / 2;
		m_assembly.join({nameOf(c) + format("/%c", "xyz"[axis]), body(behind), body(c),
						 frameAlong(place, along, upOf(axis)), sectionAcross(axis), double(m_size[axis]),
						 double(m_size[axis])});
	}

	Assembly& m_assembly;
	btVector3 m_corner, m_size;
	int m_count[3];
	std::vector<int> m_bodies;
};
}  // namespace

void slabStructure(Fields& f, SceneBuilder& builder)
{
	Assembly assembly(f, builder);
	btVector3 at(0, 0, 0);
	double x = 4, z = 4, thickness = .2;
	int count[3] = {8, 1, 8};
	SlabSupport support = SlabSupport::Edges;
	bool isPinned = false;
	f.vector("at", at, "m", "corner of its top with the least x and z");
	f.number("length", x, {.01, 1000}, "m", "along x", Need::Required);
	f.number("width", z, {.01, 1000}, "m", "along z", Need::Required);
	f.number("thickness", thickness, {.001, 100}, "m", "downwards from its top", Need::Required);
	f.whole("parts_x", count[0], 1, 200, "along x");
	f.whole("parts_z", count[2], 1, 200, "along z");
	f.named("support", support, slabSupports(), "where the world holds it");
	f.flag("pinned", isPinned, "its supports let it turn");
	const btVector3 size(btScalar(x / count[0]), btScalar(thickness), btScalar(z / count[2]));
	BlockArray blocks(assembly, at - btVector3(0, btScalar(thickness), 0), size, count);
	if (!blocks.build())
		return;
	blocks.each(
		[&](const BlockArray::Cell& c)
		{
			for (int axis : {0, 2})
				for (int side : {-1, 1})
				{
					const bool isCorner =
						(c.i[0] == 0 || blocks.isAt(c, 0, 1)) && (c.i[2] == 0 || blocks.isAt(c, 2, 1));
					if (blocks.isAt(c, axis, side) &&
						(support == SlabSupport::Edges || (support == SlabSupport::Ends && axis == 0) ||
						 (support == SlabSupport::Corners && isCorner && axis == 0)))
						blocks.joinWorld(c, axis, side, isPinned);
				}
		});
}

void gridStructure(Fields& f, SceneBuilder& builder)
{
	Assembly assembly(f, builder);
	btVector3 at(0, 0, 0), size(btScalar(.5), btScalar(.5), btScalar(.5));
	int count[3] = {4, 4, 4};
	bool stands = true;
	f.vector("at", at, "m", "corner with the least coordinates");
	f.vector("size", size, "m", "of a block", Need::Optional, {1e-3, 100});
	f.whole("count_x", count[0], 1, 200, "blocks along x");
	f.whole("count_y", count[1], 1, 200, "blocks along y");
	f.whole("count_z", count[2], 1, 200, "blocks along z");
	f.flag("stands", stands, "the world holds the lowest blocks");
	BlockArray blocks(assembly, at, size, count);
	if (blocks.build() && stands)
		blocks.each(
			[&](const BlockArray::Cell& c)
			{
				if (c.i[1] == 0)
					blocks.joinWorld(c, 1, -1, false);
			});
}
}  // namespace ep
