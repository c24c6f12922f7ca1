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
		{"slider", JointType::Slider, "Bullet's own, along the joint's x axis"}};
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
	return f.object("capacity", "of each degree of freedom, by hand; those that are left out are free",
					[&](Fields& inner)
					{
						bool hasAny = false;
						for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
							hasAny |= inner.object(DOF_KEYS[dof], "a degree of freedom in the joint's frame",
												   [&](Fields& of) { dofFields(of, capacity, dof); });
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

void bulletFields(Fields& f, SceneDescription::Joint& joint)
{
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
