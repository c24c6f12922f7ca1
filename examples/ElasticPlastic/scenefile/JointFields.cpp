// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/SceneBuilder.h"

#include "text/Format.h"

namespace ep
{
using JointType = SceneDescription::JointType;

const std::vector<Named<JointType>>& jointTypes()
{
	static const std::vector<Named<JointType>> all = {
		{"elastic-plastic", JointType::World, "or whatever the world's joints are"},
		{"elastic-plastic-spring", JointType::Spring, "of Bullet's older class"},
		{"paper", JointType::Paper, "by the paper's scheme"},
		{"fixed", JointType::Fixed, "Bullet's own"},
		{"hinge", JointType::Hinge, "Bullet's own, about the joint's x axis"},
		{"ball", JointType::Ball, "Bullet's own"},
		{"slider", JointType::Slider, "Bullet's own, along the joint's x axis"},
		{"cone-twist", JointType::ConeTwist, "Bullet's own, twists about the joint's x axis"},
		{"six-dof", JointType::SixDof, "Bullet's own, locked but for its freedoms"}};
	return all;
}

namespace
{
const char* const DOF_KEYS[] = {"axial", "shear_y", "shear_z", "torsion", "bending_y", "bending_z"};

void dofFields(Fields& f, btElasticPlasticCapacity& capacity, int dof)
{
	const double never = double(btElasticPlasticCapacity::unlimited());
	double stiffness = 0, yield = never, ductility = never;
	const bool springs =
		f.number("stiffness", stiffness, {1e-20, 1e30}, dof < 3 ? "N/m" : "N m/rad", "else it is rigid");
	const bool yields =
		f.number("yield", yield, Range::above(0), dof < 3 ? "N" : "N m", "at which it flows, else never");
	f.number("ductility", ductility, Range::above(0), dof < 3 ? "m" : "rad",
			 "plastic deformation that breaks it, else none");
	if (!springs && !yields)
		f.refuse("", "must have the key stiffness or yield");
	if (springs)
		capacity.set(dof, btScalar(stiffness), btScalar(yield), btScalar(ductility));
	else
		capacity.setRigidPlastic(dof, btScalar(yield), btScalar(ductility));
}

bool capacityField(Fields& f, btElasticPlasticCapacity& capacity)
{
	return f.object(
		"capacity", "of each degree of freedom, by hand; those that are left out are free",
		[&](Fields& inner)
		{
			inner.scalar("damping_ratio", capacity.m_damping, {0, .1}, "", "of critical, of a structure's modes");
			inner.scalar("friction", capacity.m_friction, {0, 2}, "", "what pressure adds to both shears, over it");
			inner.scalar("bow", capacity.m_length, Range::notNegative(), "m",
						 "length of the member that bows between the bodies' centres; 0: it does not");
			bool hasAny = false;
			for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
				hasAny |= inner.object(DOF_KEYS[dof], "a degree of freedom in the joint's frame",
									   [&](Fields& of) { dofFields(of, capacity, dof); });
			// After them: what springs anew is not coupled.
			std::vector<double> coupling;
			if (inner.numbers("coupling", coupling, 2, 2, {-1, 1}, "",
							  "compliance between shear_y and bending_z, and between shear_z and bending_y, over "
							  "the root of the product of their own") &&
				coupling.size() == 2)
				for (int i = 0; i < 2; ++i)
					capacity.m_coupling[i] = btScalar(coupling[size_t(i)]);
			if (!hasAny)
				inner.refuse("", "holds in no degree of freedom");
		});
}

/// A body's centre; the world has none.
const btVector3* centreOf(const SceneDescription& scene, int body)
{
	return body == SceneDescription::WORLD ? nullptr : &scene.bodies[size_t(body)].pose.getOrigin();
}

/// Where it is and how it stands, if the file does not say: in the middle between the bodies, and along the line from one to the other.
void frameFields(Fields& f, const SceneDescription& scene, bool isToWorld, SceneDescription::Joint& joint)
{
	const btVector3 *const a = centreOf(scene, joint.bodies[0]), *const b = centreOf(scene, joint.bodies[1]);
	btVector3 at(0, 0, 0), along(1, 0, 0), up(0, 1, 0);
	if (a && b)
		at = (*a + *b) / 2;
	const bool isPlaced = f.vector("at", at, "m", "place; else in the middle between the bodies");
	if (!isPlaced && isToWorld)
		f.refuse("", "must have the key at: one of its bodies is the world");
	const btVector3 begin = a ? *a : at, end = b ? *b : at;
	if ((end - begin).length() > btScalar(1e-6))
		along = (end - begin).normalized();
	f.direction("along", along, "the joint's x axis, along the member; else from the first body to the second");
	f.direction("up", up, "direction of the section's height, as near as can be");
	joint.frame = frameAlong(at, along, up);
}

/// Twice the way from a body's centre to the joint; what does not move does not deform.
double lengthOf(const SceneDescription& scene, int body, const btVector3& at)
{
	const btVector3* const centre = centreOf(scene, body);
	if (!centre || scene.bodies[size_t(body)].motion != SceneDescription::Motion::Dynamic)
		return 0;
	return 2 * double((*centre - at).length());
}

bool memberFields(Fields& f, SceneBuilder& builder, SceneDescription::Joint& joint)
{
	SceneDescription::Material material;
	SceneDescription::Section section;
	const bool hasMaterial = materialField(f, "material", builder, material),
			   hasSection = sectionField(f, "section", builder, section);
	std::vector<double> lengths = {lengthOf(builder.scene(), joint.bodies[0], joint.frame.getOrigin()),
								   lengthOf(builder.scene(), joint.bodies[1], joint.frame.getOrigin())};
	double gauge = 0;
	f.numbers("lengths", lengths, 2, 2, {0, 1e5}, "m",
			  "of the two bodies along the member; else twice the way from the joint to their centres");
	f.number("gauge", gauge, {0, 1e5}, "m", "length over which plastic strain spreads; 0: half of both");
	if (hasMaterial != hasSection)
		f.refuse("", hasMaterial ? "has a material and no section" : "has a section and no material");
	if (!hasMaterial || !hasSection || f.hasFailed())
		return hasMaterial || hasSection;
	if (lengths[0] + lengths[1] <= 0)
		f.refuse("", "stands for a member without length: give lengths");
	else
	{
		joint.capacity = btElasticPlasticCapacity::fromMember(material.law, section.section, btScalar(lengths[0]),
															  btScalar(lengths[1]), btScalar(gauge));
		joint.frame = joint.frame * turnOf(section.section);
		joint.height = section.height;
		joint.width = section.width;
	}
	return true;
}

/// Which degrees of freedom each of Bullet's own can have. Bits.
unsigned freedomsOf(JointType type)
{
	const unsigned axial = 1u << BT_EP_AXIAL, torsion = 1u << BT_EP_TORSION, all = (1u << BT_EP_DOF_COUNT) - 1;
	switch (type)
	{
		case JointType::Hinge:
			return torsion;
		case JointType::Slider:
			return axial;
		case JointType::ConeTwist:
			return torsion | 1u << BT_EP_BENDING_Y | 1u << BT_EP_BENDING_Z;
		case JointType::SixDof:
			return all;
		default:
			return 0;
	}
}

void freedomFields(Fields& f, SceneDescription::Freedom& freedom, int dof, JointType type)
{
	const char* const unit = dof < 3 ? "m" : "degrees";
	const Range range = {-1e6, 1e6};
	const double radians = dof < 3 ? 1 : double(SIMD_RADS_PER_DEG);
	double from = 0, to = 0;
	freedom.isGiven = true;
	const bool hasFrom = f.number("from", from, range, unit, "else it has no end there"),
			   hasTo = f.number("to", to, range, unit, "else it has no end there");
	if (hasFrom)
		freedom.from = from * radians;
	if (hasTo)
		freedom.to = to * radians;
	f.number("stiffness", freedom.stiffness, Range::notNegative(), dof < 3 ? "N/m" : "N m/rad", "of a spring; 0: none");
	f.number("damping", freedom.damping, Range::notNegative(), dof < 3 ? "N s/m" : "N m s/rad", "of the spring");
	if (hasFrom != hasTo)
		f.refuse("", "must have both of from and to, or none");
	if (from > to)
		f.refuse("to", "is less than from");
	if (type == JointType::ConeTwist && (!hasFrom || from != -to))
		f.refuse("", "of a cone-twist joint is as wide to both sides: from must be -to");
	if ((freedom.stiffness > 0 || freedom.damping > 0) && type != JointType::SixDof)
		f.refuse("", "springs only in a six-dof joint");
}

void freedomsField(Fields& f, SceneDescription::Joint& joint)
{
	f.object("freedoms", "of hinge, slider, cone-twist and six-dof: how far the second body moves against the first",
			 [&](Fields& inner)
			 {
				 for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
					 if (inner.object(DOF_KEYS[dof], "a degree of freedom in the joint's frame",
									  [&](Fields& of) { freedomFields(of, joint.freedoms[dof], dof, joint.type); }) &&
						 !(freedomsOf(joint.type) >> dof & 1u))
						 inner.refuse(DOF_KEYS[dof], "is no freedom of this type of joint");
			 });
}

void bulletFields(Fields& f, SceneDescription::Joint& joint)
{
	freedomsField(f, joint);
	f.number("breaks_at", joint.breaksAt, Range::notNegative(), "N", "force that breaks one of Bullet's own; 0: none");
	f.number("motor_speed", joint.motorSpeed, {-1e5, 1e5}, "rad/s or m/s", "of a hinge or slider");
	f.number("motor_force", joint.motorForce, Range::notNegative(), "N m or N",
			 "the most that its motor gives; 0: no motor");
	const bool hasMotor = joint.type == JointType::Hinge || joint.type == JointType::Slider;
	if (joint.motorForce > 0 && !hasMotor)
		f.refuse("motor_force", "is for a hinge or a slider");
	if (joint.breaksAt > 0 && joint.type < JointType::Fixed)
		f.refuse("breaks_at", "is for Bullet's own joints; others break by their ductility");
}
}  // namespace

void jointFields(Fields& f, SceneBuilder& builder)
{
	SceneDescription::Joint j;
	std::string a, b = "world";
	f.text("name", j.name, "by which it is found", Need::Required);
	f.text("from", a, "name of its first body, or world", Need::Required);
	f.text("to", b, "name of its second body; else the world");
	if (!a.empty())
		j.bodies[0] = builder.body(f, "from", a);
	j.bodies[1] = builder.body(f, "to", b);
	f.named("type", j.type, jointTypes(), "what it is");
	frameFields(f, builder.scene(), a == "world" || b == "world", j);
	const bool isMember = memberFields(f, builder, j), isByHand = capacityField(f, j.capacity);
	const bool isElasticPlastic = j.type < JointType::Fixed;
	if (isElasticPlastic && isMember == isByHand)
		f.refuse("", "must have either material and section, or capacity");
	if (!isElasticPlastic && (isMember || isByHand))
		f.refuse("", "is one of Bullet's own, which have no material, section or capacity");
	double strength = 1;
	if (f.number("strength", strength, {0, 1e6, true}, "", "factor on all yield values"))
		j.capacity.scaleYield(btScalar(strength));
	f.flag("collides", j.collides, "its bodies with each other");
	bulletFields(f, j);
	builder.add(f, j);
}
}  // namespace ep
