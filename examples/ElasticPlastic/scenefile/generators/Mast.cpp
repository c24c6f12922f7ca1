// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/generators/Assembly.h"
#include "text/Format.h"

namespace ep
{
namespace
{
/// A lattice mast or boom with four legs: panels one upon another, each with horizontals and a diagonal in every face. Members
/// meet in nodes and are pinned there, but for the legs.
class MastGenerator
{
public:
	MastGenerator(Fields& f, SceneBuilder& builder) : m_assembly(f, builder)
	{
		sectionField(f, "leg", builder, m_leg, Need::Required);
		sectionField(f, "brace", builder, m_brace, Need::Required);
		f.vector("at", m_at, "m", "middle of its foot");
		f.direction("along", m_along, "from its foot to its top");
		f.number("length", m_length, {.1, 1000}, "m", "from its foot to its top", Need::Required);
		f.number("width", m_width, {.05, 100}, "m", "at its foot, between legs", Need::Required);
		m_topWidth = m_width;
		f.number("top_width", m_topWidth, {.05, 100}, "m", "at its top; else as at its foot");
		f.whole("panels", m_panels, 1, 200, "along its length");
		f.named("foot", m_foot, supports(), "what holds its legs");
	}

	void build()
	{
		Fields& f = m_assembly.fields();
		const double size = nodeSize();
		if (!f.hasFailed() && !(size < std::min({m_width, m_topWidth, m_length / m_panels}) / 2))
			f.refuse("", format("has members as thick as %g m, which leave no length between nodes", size));
		if (f.hasFailed() || !m_assembly.builder().hasRoom(f, 16. * m_panels))
			return;
		m_assembly.beLattice();
		for (int panel = 0; panel < m_panels; ++panel)
			for (int leg = 0; leg < 4; ++leg)
				buildPanel(panel, leg);
	}

private:
	double nodeSize() const { return 1.2 * std::max({m_leg.width, m_leg.height, m_brace.width, m_brace.height}); }

	btVector3 nodeAt(int level, int leg) const
	{
		const btTransform frame = frameAlong(m_at, m_along, btVector3(0, 0, 1));
		const double t = double(level) / m_panels, half = (m_width + (m_topWidth - m_width) * t) / 2;
		const bool isRight = leg == 1 || leg == 2;
		return frame *
			   btVector3(btScalar(t * m_length), btScalar(isRight ? half : -half), btScalar(leg >= 2 ? half : -half));
	}

	/// A node of a level; the lowest ones are the world.
	int node(int level, int leg)
	{
		const size_t index = size_t(level * 4 + leg);
		while (m_nodes.size() <= index)
		{
			const int l = int(m_nodes.size() / 4), i = int(m_nodes.size() % 4);
			const btTransform pose = frameAlong(nodeAt(l, i), m_along, btVector3(0, 0, 1));
			m_nodes.push_back(
				l == 0 ? SceneDescription::WORLD
					   : m_assembly.box(format("node-%d-%d", l, i), pose, btVector3(1, 1, 1) * btScalar(nodeSize())));
		}
		return m_nodes[index];
	}

	void buildPanel(int panel, int leg)
	{
		const int next = (leg + 1) % 4;
		member(format("leg-%d-%d/", panel, leg), m_leg, panel, leg, panel + 1, leg,
			   panel == 0 ? m_foot : Support::Fixed, Support::Fixed);
		member(format("ring-%d-%d/", panel + 1, leg), m_brace, panel + 1, leg, panel + 1, next, Support::Pinned,
			   Support::Pinned);
		// Diagonals turn round from panel to panel.
		const bool isTurned = (panel + leg) % 2;
		member(format("brace-%d-%d/", panel, leg), m_brace, panel, isTurned ? next : leg, panel + 1,
			   isTurned ? leg : next, Support::Pinned, Support::Pinned);
	}

	void member(const std::string& name, const SceneDescription::Section& section, int level, int leg, int toLevel,
				int toLeg, Support start, Support end)
	{
		Assembly::Line line;
		line.name = name;
		line.section = section;
		line.bodies[0] = node(level, leg);
		line.bodies[1] = node(toLevel, toLeg);
		line.ends[0] = start;
		line.ends[1] = end;
		const btVector3 from = nodeAt(level, leg), to = nodeAt(toLevel, toLeg),
						half = (to - from).normalized() * btScalar(nodeSize() / 2);
		// The world has no nodes to leave room for.
		line.nodes = {level == 0 ? from : from + half, to - half};
		m_assembly.line(line);
	}

	Assembly m_assembly;
	SceneDescription::Section m_leg, m_brace;
	btVector3 m_at = btVector3(0, 0, 0), m_along = btVector3(0, 1, 0);
	double m_length = 10, m_width = 1, m_topWidth = 1;
	int m_panels = 8;
	Support m_foot = Support::Fixed;
	std::vector<int> m_nodes;
};
}  // namespace

void mastStructure(Fields& f, SceneBuilder& builder) { MastGenerator(f, builder).build(); }
}  // namespace ep
