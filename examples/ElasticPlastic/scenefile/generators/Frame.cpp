// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/generators/Assembly.h"
#include "text/Format.h"

namespace ep
{
namespace
{
/// A building of columns, beams in two directions and slabs. Members meet in blocks, the nodes.
class FrameGenerator
{
public:
	FrameGenerator(Fields& f, SceneBuilder& builder) : m_assembly(f, builder)
	{
		sectionField(f, "column", builder, m_column, Need::Required);
		sectionField(f, "beam", builder, m_beam, Need::Required);
		f.vector("at", m_at, "m", "foot of its first column");
		f.whole("storeys", m_storeys, 1, 200, "one above another", Need::Required);
		f.whole("bays_x", m_bays[0], 1, 200, "between columns, along x", Need::Required);
		f.whole("bays_z", m_bays[1], 0, 200, "the same along z; 0: it is plane");
		f.number("storey_height", m_height, {.1, 100}, "m", "from floor to floor");
		f.number("bay_x", m_bay[0], {.1, 100}, "m", "from column to column along x");
		f.number("bay_z", m_bay[1], {.1, 100}, "m", "the same along z");
		f.whole("parts", m_parts, 1, 20, "of each member between two nodes");
		f.number("slab", m_slab, {0, 2}, "m", "thickness of its slabs; 0: there are none");
		f.named("feet", m_feet, supports(), "what holds its columns");
	}

	void build()
	{
		Fields& f = m_assembly.fields();
		const double node = nodeSize(), nodes = double(m_bays[0] + 1) * (m_bays[1] + 1) * m_storeys;
		const double least = std::min({m_height, m_bay[0], m_bays[1] > 0 ? m_bay[1] : m_bay[0]});
		if (!f.hasFailed() && !(node < least / 2))
			f.refuse("", format("has members as thick as %g m, which leave no length between nodes", node));
		if (f.hasFailed() || !m_assembly.builder().hasRoom(f, nodes * (2 + 3 * m_parts)))
			return;
		each(
			[&](int x, int y, int z)
			{
				m_nodes.push_back(y == 0 ? SceneDescription::WORLD
										 : m_assembly.box(name("node", x, y, z), middleOf(x, y, z),
														  btVector3(1, 1, 1) * btScalar(node)));
			});
		each([&](int x, int y, int z) { buildFrom(x, y, z); });
	}

private:
	double nodeSize() const { return std::max({m_column.width, m_column.height, m_beam.width, m_beam.height}); }
	static std::string name(const char* what, int x, int y, int z) { return format("%s-%d-%d-%d", what, x, y, z); }

	template <class Act>
	void each(const Act& act) const
	{
		for (int y = 0; y <= m_storeys; ++y)
			for (int z = 0; z <= m_bays[1]; ++z)
				for (int x = 0; x <= m_bays[0]; ++x)
					act(x, y, z);
	}
	int node(int x, int y, int z) const { return m_nodes[size_t((y * (m_bays[1] + 1) + z) * (m_bays[0] + 1) + x)]; }
	/// The top of a floor at a node.
	btVector3 topOf(int x, int y, int z) const
	{
		return m_at + btVector3(btScalar(x * m_bay[0]), btScalar(y * m_height), btScalar(z * m_bay[1]));
	}
	btTransform middleOf(int x, int y, int z) const
	{
		return btTransform(btQuaternion(0, 0, 0, 1), topOf(x, y, z) - btVector3(0, btScalar(nodeSize() / 2), 0));
	}

	/// What begins at a node.
	void buildFrom(int x, int y, int z)
	{
		if (y < m_storeys)
			buildMember(name("column", x, y, z), m_column, node(x, y, z), node(x, y + 1, z), topOf(x, y, z),
						topOf(x, y + 1, z) - btVector3(0, btScalar(nodeSize()), 0), btVector3(1, 0, 0), y == 0);
		if (y == 0)
			return;
		const btVector3 middle = middleOf(x, y, z).getOrigin();
		for (int axis = 0; axis < 2; ++axis)
		{
			const int x2 = x + (axis == 0), z2 = z + (axis == 1);
			if (x2 > m_bays[0] || z2 > m_bays[1])
				continue;
			btVector3 half(0, 0, 0);
			half[axis == 0 ? 0 : 2] = btScalar(nodeSize() / 2);
			buildMember(name(axis == 0 ? "beam-x" : "beam-z", x, y, z), m_beam, node(x, y, z), node(x2, y, z2),
						middle + half, middleOf(x2, y, z2).getOrigin() - half, btVector3(0, 1, 0), false);
		}
		if (m_slab > 0 && x < m_bays[0] && z < m_bays[1])
			buildSlab(x, y, z);
	}

	void buildMember(const std::string& name, const SceneDescription::Section& section, int from, int to,
					 const btVector3& begin, const btVector3& end, const btVector3& up, bool isFoot)
	{
		Assembly::Line line;
		line.name = name + "/";
		line.section = section;
		line.up = up;
		line.bodies[0] = from;
		line.bodies[1] = to;
		if (isFoot)
			line.ends[0] = m_feet;
		for (int i = 0; i <= m_parts; ++i)
			line.nodes.push_back(begin.lerp(end, btScalar(i) / btScalar(m_parts)));
		m_assembly.line(line);
	}

	/// A slab hangs on the nodes at its four corners.
	void buildSlab(int x, int y, int z)
	{
		const double size = nodeSize(), edge = std::min(.3, size);
		const btVector3 sizes(btScalar(m_bay[0] - size), btScalar(m_slab), btScalar(m_bay[1] - size));
		const btVector3 middle = (topOf(x, y, z) + topOf(x + 1, y, z + 1) - btVector3(0, btScalar(m_slab), 0)) / 2;
		const int slab = m_assembly.box(name("slab", x, y, z), btTransform(btQuaternion(0, 0, 0, 1), middle), sizes);
		const btElasticPlasticSection corner = btElasticPlasticSection::rectangle(btScalar(edge), btScalar(m_slab));
		for (int i = 0; i < 4; ++i)
		{
			const int right = i % 2, back = i / 2;
			const btVector3 place =
				middle + btVector3(right ? sizes.x() : -sizes.x(), 0, back ? sizes.z() : -sizes.z()) / 2;
			m_assembly.join({format("slab-%d-%d-%d/%d", x, y, z, i), node(x + right, y, z + back), slab,
							 frameAlong(place, btVector3(right ? btScalar(-1) : btScalar(1), 0, 0), btVector3(0, 1, 0)),
							 corner, 0, std::min(m_bay[0], m_bay[1]) / 2});
		}
	}

	Assembly m_assembly;
	SceneDescription::Section m_column, m_beam;
	btVector3 m_at = btVector3(0, 0, 0);
	int m_storeys = 1, m_bays[2] = {1, 0}, m_parts = 2;
	double m_height = 3, m_bay[2] = {4, 4}, m_slab = 0;
	Support m_feet = Support::Fixed;
	std::vector<int> m_nodes;
};
}  // namespace

void frameStructure(Fields& f, SceneBuilder& builder) { FrameGenerator(f, builder).build(); }
}  // namespace ep
