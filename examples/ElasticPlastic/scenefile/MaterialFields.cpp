// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/SceneBuilder.h"

namespace ep
{
namespace
{
template <class Thing>
std::vector<std::string> keysOf(const std::map<std::string, Thing>& things)
{
	std::vector<std::string> keys;
	for (const auto& thing : things)
		keys.push_back(thing.first);
	return keys;
}

const std::vector<Named<btElasticPlasticShearYield>>& shearYields()
{
	static const std::vector<Named<btElasticPlasticShearYield>> all = {{"tresca", BT_EP_TRESCA},
																	   {"von-mises", BT_EP_VON_MISES}};
	return all;
}

/// What the library says of a fault.
void refuseFault(Fields& f, const btElasticPlasticFault& fault)
{
	char text[200];
	fault.print(text, sizeof text);
	if (fault)
		f.refuse("", std::string("is not possible: ") + text);
}
}  // namespace

void materialFields(Fields& f, SceneDescription::Material& m)
{
	btElasticPlasticMaterial& law = m.law;
	f.scalar("youngs_modulus", law.m_youngsModulus, Range::above(0), "Pa", "E");
	f.scalar("poissons_ratio", law.m_poissonsRatio, {-1, .5, true}, "", "nu");
	f.scalar("density", law.m_density, {0, 1e6, true}, "kg/m^3", "of bodies made of it");
	f.scalar("yield_stress", law.m_yieldStress, Range::above(0), "Pa", "in tension");
	f.scalar("ultimate_plastic_strain", law.m_ultimatePlasticStrain, Range::above(0), "", "at which it tears");
	f.scalar("load_bearing_share", law.m_loadBearingShare, {0, 1, true}, "",
			 "part of a section that bears load, as the steel in concrete");
	f.named("shear_yield", law.m_shearYield, shearYields(),
			"how the yield stress in shear follows from the one in tension");
	f.vector("colour", m.colour, "", "red, green and blue, linear", Need::Optional, {0, 1});
	refuseFault(f, law.fault());
}

void sectionFields(Fields& f, SceneDescription::Section& s)
{
	const Range size = Range::above(0);
	std::vector<double> v;
	double radius = 0;
	const auto rectangle = [&](btElasticPlasticSection section)
	{
		s.section = section;
		s.width = v[0];
		s.height = v[1];
	};
	const auto round = [&](btElasticPlasticSection section, double r)
	{
		s.section = section;
		s.width = s.height = 2 * r;
	};
	const auto is = [&](bool isThere, size_t count) { return isThere && v.size() == count; };
	if (is(f.numbers("rectangle", v, 2, 2, size, "m", "width and height"), 2))
		rectangle(btElasticPlasticSection::rectangle(btScalar(v[0]), btScalar(v[1])));
	if (f.number("circle", radius, size, "m", "radius") && radius > 0)
		round(btElasticPlasticSection::circle(btScalar(radius)), radius);
	if (is(f.numbers("tube", v, 2, 2, size, "m", "outer radius and wall"), 2))
		round(btElasticPlasticSection::hollowCircle(btScalar(v[0]), btScalar(v[1])), v[0]);
	if (is(f.numbers("box", v, 3, 3, size, "m", "width, height and wall"), 3))
		rectangle(btElasticPlasticSection::hollowRectangle(btScalar(v[0]), btScalar(v[1]), btScalar(v[2])));
	if (is(f.numbers("i", v, 4, 4, size, "m", "width, height, web and flange"), 4))
		rectangle(btElasticPlasticSection::iSection(btScalar(v[0]), btScalar(v[1]), btScalar(v[2]), btScalar(v[3])));
	f.oneOf({"rectangle", "circle", "tube", "box", "i"});
	refuseFault(f, s.section.m_fault);
}

bool materialField(Fields& f, const char* key, SceneBuilder& builder, SceneDescription::Material& material, Need need)
{
	return f.reference(
		key, "material", keysOf(builder.m_materials),
		[&](const std::string& name) { material = builder.m_materials.at(name); }, "name of a material, or one",
		[&](Fields& inner) { materialFields(inner, material); }, need);
}

bool sectionField(Fields& f, const char* key, SceneBuilder& builder, SceneDescription::Section& section, Need need)
{
	return f.reference(
		key, "section", keysOf(builder.m_sections),
		[&](const std::string& name) { section = builder.m_sections.at(name); }, "name of a section, or one",
		[&](Fields& inner) { sectionFields(inner, section); }, need);
}
}  // namespace ep
