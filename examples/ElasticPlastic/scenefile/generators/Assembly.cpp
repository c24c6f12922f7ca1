// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/generators/Assembly.h"

namespace ep
{
namespace
{
const btScalar GAP = btScalar(.004);       // round a part [m], or
const btScalar GAP_SHARE = btScalar(.01);  // of its size

btVector3 withGap(const btVector3& size)
{
	btVector3 smaller = size;
	for (int i = 0; i < 3; ++i)
		smaller[i] -= 2 * btMin(GAP, GAP_SHARE * size[i]);
	return smaller;
}

/// A rope has no bending stiffness that could bear a force across it: it turns into the force. So a joint bears the same in all
/// directions, and twists freely.
void beRope(btElasticPlasticCapacity& c)
{
	for (int dof : {BT_EP_SHEAR_Y, BT_EP_SHEAR_Z})
		c.set(dof, c.m_stiffness[BT_EP_AXIAL], c.m_yield[BT_EP_AXIAL], c.m_ductility[BT_EP_AXIAL]);
	c.clear(BT_EP_TORSION);
	c.m_length = 0;
}
}  // namespace

const std::vector<Named<Support>>& supports()
{
	static const std::vector<Named<Support>> all = {
		{"free", Support::Free}, {"pinned", Support::Pinned}, {"fixed", Support::Fixed}};
	return all;
}

Assembly::Assembly(Fields& f, SceneBuilder& builder) : m_fields(f), m_builder(builder)
{
	f.text("name", m_name, "with which the names of its parts begin", Need::Required);
	builder.beginStructure(m_name);
	materialField(f, "material", builder, m_material, Need::Required);
}

int Assembly::add(SceneDescription::Body body, const std::string& name, const btTransform& pose)
{
	body.name = m_name + "/" + name;
	body.pose = pose;
	body.colour = m_material.colour;
	body.density = double(m_material.law.m_density);
	body.isOfLattice = m_isLattice;
	return m_builder.add(m_fields, body);
}

int Assembly::box(const std::string& name, const btTransform& pose, const btVector3& size)
{
	SceneDescription::Body body;
	body.shape.size = withGap(size);
	body.mass = double(m_material.law.m_density) * double(size.x()) * double(size.y()) * double(size.z());
	return add(body, name, pose);
}

int Assembly::part(const std::string& name, const btTransform& pose, double length,
				   const SceneDescription::Section& section)
{
	SceneDescription::Body body;
	body.shape.size = withGap(btVector3(btScalar(length), btScalar(section.height), btScalar(section.width)));
	body.mass = double(m_material.law.m_density) * double(section.section.m_area) * length;
	return add(body, name, pose);
}

void Assembly::join(const Tie& tie)
{
	SceneDescription::Joint joint;
	joint.name = m_name + "/" + tie.name;
	joint.bodies[0] = tie.a;
	joint.bodies[1] = tie.b;
	joint.frame = tie.frame * turnOf(tie.section);
	joint.height = 2 * double(tie.section.m_outerFibre[0]);
	joint.width = 2 * double(tie.section.m_outerFibre[1]);
	joint.capacity =
		btElasticPlasticCapacity::fromMember(m_material.law, tie.section, btScalar(tie.lengthA), btScalar(tie.lengthB));
	if (tie.isPinned || tie.isRope)
		for (int dof : {BT_EP_BENDING_Y, BT_EP_BENDING_Z})
			joint.capacity.clear(dof);
	if (tie.isRope)
		beRope(joint.capacity);
	m_builder.add(m_fields, joint);
}

std::vector<int> Assembly::line(const Line& l)
{
	const size_t count = l.nodes.size() - 1;
	const auto span = [&](size_t i) { return l.nodes[i + 1] - l.nodes[i]; };
	std::vector<int> parts;
	for (size_t i = 0; i < count; ++i)
		parts.push_back(part(l.name + std::to_string(i + 1),
							 frameAlong((l.nodes[i] + l.nodes[i + 1]) / 2, span(i), l.up), double(span(i).length()),
							 l.section));
	for (size_t i = 0; i <= count; ++i)
	{
		const bool isStart = i == 0, isEnd = i == count;
		const Support support = isStart ? l.ends[0] : isEnd ? l.ends[1] : Support::Fixed;
		if (support == Support::Free)
			continue;
		const btVector3 along = (isStart ? span(0) : span(i - 1).normalized()) +
								(isStart || isEnd ? btVector3(0, 0, 0) : span(i).normalized());
		join({l.name + std::to_string(i), isStart ? l.bodies[0] : parts[i - 1], isEnd ? l.bodies[1] : parts[i],
			  frameAlong(l.nodes[i], along, l.up), l.section.section, isStart ? 0 : double(span(i - 1).length()),
			  isEnd ? 0 : double(span(i).length()), support == Support::Pinned, l.isRope});
	}
	return parts;
}
}  // namespace ep
