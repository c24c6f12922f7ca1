// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/SceneBuilder.h"

#include <math.h>

#include <algorithm>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticMaterials.h"

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

/// The first stands for none of them.
std::vector<std::string> readyNames()
{
	std::vector<std::string> names = {"none"};
	for (int i = 0; i < btElasticPlasticReadyMaterial::count(); ++i)
		names.push_back(btElasticPlasticReadyMaterial::at(i).m_name);
	return names;
}

/// What only sections with fibres know.
void fibreFields(Fields& f, btElasticPlasticMaterial& law)
{
	f.scalar("tensile_share", law.m_tensileShare, Range::notNegative(), "",
			 "of fibres: strength in tension over yield_stress, 0 of concrete");
	f.scalar("crushing_strain", law.m_crushingStrain, Range::notNegative(), "",
			 "of fibres: plastic strain at which they are crushed; 0: as when they tear");
	f.scalar("fracture_energy", law.m_fractureEnergy, Range::notNegative(), "J/m^2",
			 "of fibres: taken up by a crack until it is open; 0: strength stays until then");
	f.scalar("kinematic_share", law.m_kinematicShare, {0, 1}, "", "of fibres: how much of the hardening is kinematic");
	std::vector<double> v;
	if (f.numbers("hardening", v, 2, 100, Range::above(0), "",
				  "of fibres: plastic strain, stress [Pa], strain, stress ...: straight between them") &&
		v.size() % 2 != 0)
		f.refuse("hardening", "has an odd number of numbers; each strain has a stress");
	else if (!v.empty())
		law.m_hardening.clear();
	for (size_t i = 0; i + 1 < v.size(); i += 2)
		law.m_hardening.push_back({btScalar(v[i]), btScalar(v[i + 1])});
	v.clear();
	if (f.numbers("rate", v, 2, 2, Range::above(0), "",
				  "of fibres: D [1/s] and q of Cowper and Symonds, by which it is stronger when it flows fast") &&
		v.size() == 2)
		law.m_rate = btElasticPlasticRate::of(btScalar(v[0]), btScalar(v[1]));
}

/// One outline, as the library has it.
int addOutline(Fields& f, const char* key, const char* help, Need need,
			   std::vector<btElasticPlasticSectionPoint>& corners)
{
	std::vector<double> v;
	if (f.numbers(key, v, 6, 1000, Range::place(), "m", help, need) && v.size() % 2 != 0)
		f.refuse(key, "has an odd number of numbers; each corner has a y and a z");
	for (size_t i = 0; i + 1 < v.size(); i += 2)
		corners.push_back({btScalar(v[i]), btScalar(v[i + 1])});
	return int(v.size() / 2);
}

/// The rectangle around what is given by its corners.
template <class Points>
void takeSize(const Points& points, SceneDescription::Section& s)
{
	double low[2] = {double(points[0].m_y), double(points[0].m_z)}, high[2] = {low[0], low[1]};
	for (const auto& point : points)
		for (int k = 0; k < 2; ++k)
		{
			const double place = double(k == 0 ? point.m_y : point.m_z);
			low[k] = std::min(low[k], place);
			high[k] = std::max(high[k], place);
		}
	s.height = high[0] - low[0];
	s.width = high[1] - low[1];
}

void polygonFields(Fields& f, SceneDescription::Section& s)
{
	std::vector<btElasticPlasticSectionPoint> corners;
	std::vector<int> counts;
	counts.push_back(addOutline(f, "polygon", "y, z, y, z ... of its corners", Need::Optional, corners));
	const bool hasHoles = f.list("holes", 100, "in a polygon",
								 [&](Fields& in) {
									 counts.push_back(addOutline(in, "corners", "y, z, y, z ... of the hole's corners",
																 Need::Required, corners));
								 });
	if (counts[0] == 0)
	{
		if (hasHoles)
			f.refuse("holes", "are for a polygon");
		return;
	}
	if (f.hasFailed())
		return;
	s.section = btElasticPlasticSection::polygon(corners.data(), counts.data(), int(counts.size()));
	takeSize(corners, s);
}

void boltFields(Fields& f, SceneDescription::Section& s)
{
	std::vector<double> at;
	double area = 0;
	if (!f.object("bolts", "a connection by bolts of one size",
				  [&](Fields& in)
				  {
					  in.numbers("at", at, 2, 800, Range::place(), "m", "y, z, y, z ... of each", Need::Required);
					  in.number("area", area, Range::above(0), "m^2", "of one in its thread", Need::Required);
					  if (at.size() % 2 != 0)
						  in.refuse("at", "has an odd number of numbers; each bolt has a y and a z");
				  }) ||
		f.hasFailed())
		return;
	std::vector<btElasticPlasticSectionPoint> places;
	for (size_t i = 0; i + 1 < at.size(); i += 2)
		places.push_back({btScalar(at[i]), btScalar(at[i + 1])});
	s.section = btElasticPlasticSection::bolts(places.data(), int(places.size()), btScalar(area));
	takeSize(places, s);
	const double diameter = 2 * sqrt(area / M_PI);
	s.height += diameter;
	s.width += diameter;
}

void weldFields(Fields& f, SceneDescription::Section& s)
{
	std::vector<double> lines;
	double throat = 0;
	if (!f.object("welds", "a connection by welds of one throat",
				  [&](Fields& in)
				  {
					  in.numbers("lines", lines, 4, 1600, Range::place(), "m",
								 "y, z of one end and y, z of the other of each", Need::Required);
					  in.number("throat", throat, Range::above(0), "m", "of each", Need::Required);
					  if (lines.size() % 4 != 0)
						  in.refuse("lines", "has a number of numbers that is no multiple of 4");
				  }) ||
		f.hasFailed())
		return;
	std::vector<btElasticPlasticSectionLine> welds;
	std::vector<btElasticPlasticSectionPoint> ends;
	for (size_t i = 0; i + 3 < lines.size(); i += 4)
	{
		welds.push_back(
			{{btScalar(lines[i]), btScalar(lines[i + 1])}, {btScalar(lines[i + 2]), btScalar(lines[i + 3])}});
		ends.push_back(welds.back().m_from);
		ends.push_back(welds.back().m_to);
	}
	s.section = btElasticPlasticSection::welds(welds.data(), int(welds.size()), btScalar(throat));
	takeSize(ends, s);
	s.height += throat;
	s.width += throat;
}

/// Sections of other materials that are held to this one.
void partFields(Fields& f, SceneBuilder& builder, SceneDescription::Section& s, bool isCut)
{
	f.list("parts", 100,
		   "sections of other materials that are held to one with fibres all along, as a slab to a girder",
		   [&](Fields& in)
		   {
			   std::vector<double> at = {0, 0};
			   SceneDescription::Section part;
			   SceneDescription::Material material;
			   in.numbers("at", at, 2, 2, Range::place(), "m", "y and z of its centroid from the section's",
						  Need::Required);
			   sectionField(in, "section", builder, part, Need::Required);
			   materialField(in, "material", builder, material, Need::Required);
			   if (!isCut)
				   in.refuse("", "is in a section that is not cut: it must have the key fibres");
			   else if (at.size() == 2 && !in.hasFailed())
				   s.section.addPart(part.section, btScalar(at[0]), btScalar(at[1]), material.law);
			   refuseFault(in, s.section.m_fault);
		   });
}

void fibresOf(Fields& f, SceneBuilder& builder, SceneDescription::Section& s)
{
	const int uncut = -1;
	int fibres = uncut;
	f.whole("fibres", fibres, uncut, 400,
			"about how many it is cut into, so that all forces yield together; 0: the usual number, -1: it is not");
	bool shear = true;
	f.flag("shear", shear, "of a section with fibres: shears and torsion yield together with the rest");
	if (fibres != uncut)
		s.section = s.section.withFibres(fibres, shear);
	f.list("bars", 1000, "of reinforcement, in a section with fibres",
		   [&](Fields& in)
		   {
			   std::vector<double> at = {0, 0};
			   double area = 0;
			   SceneDescription::Material material;
			   in.numbers("at", at, 2, 2, Range::place(), "m", "y and z from the section's centroid", Need::Required);
			   in.number("area", area, Range::above(0), "m^2", "of the bar", Need::Required);
			   materialField(in, "material", builder, material, Need::Required);
			   if (fibres == uncut)
				   in.refuse("", "is in a section that is not cut: it must have the key fibres");
			   else if (at.size() == 2 && !in.hasFailed())
				   s.section.addBar(btScalar(at[0]), btScalar(at[1]), btScalar(area), material.law);
		   });
	partFields(f, builder, s, fibres != uncut);
}
}  // namespace

void materialFields(Fields& f, SceneDescription::Material& m)
{
	btElasticPlasticMaterial& law = m.law;
	static const std::vector<std::string> ready = readyNames();
	size_t index = 0;
	if (f.choice("ready", index, ready, "one of the library's, of which the other keys change what they say") &&
		index > 0)
		law = btElasticPlasticReadyMaterial::at(int(index) - 1).m_material;
	bool isRated = false;
	f.flag("rated", isRated,
		   "of fibres: whether it is stronger when it flows fast, as the library's material named by ready is");
	if (isRated && index == 0)
		f.refuse("rated", "is for a material that is one of the library's: name it by ready");
	else if (isRated)
	{
		law.m_rate = btElasticPlasticReadyMaterial::at(int(index) - 1).m_rate;
		if (law.m_rate.m_reference == 0)
			f.refuse("rated", "is for a material whose rate is known: give it by rate");
	}
	f.scalar("youngs_modulus", law.m_youngsModulus, Range::above(0), "Pa", "E");
	f.scalar("poissons_ratio", law.m_poissonsRatio, {-1, .5, true}, "", "nu");
	f.scalar("density", law.m_density, {0, 1e6, true}, "kg/m^3", "of bodies made of it");
	f.scalar("yield_stress", law.m_yieldStress, Range::above(0), "Pa", "in tension");
	f.scalar("ultimate_plastic_strain", law.m_ultimatePlasticStrain, Range::above(0), "", "at which it tears");
	f.scalar("damping_ratio", law.m_dampingRatio, {0, .1}, "", "of critical, of a structure's modes; 0: none");
	f.scalar("load_bearing_share", law.m_loadBearingShare, {0, 1, true}, "",
			 "part of a section that bears load, as the steel in concrete");
	f.named("shear_yield", law.m_shearYield, shearYields(),
			"how the yield stress in shear follows from the one in tension");
	f.scalar("shear_modulus", law.m_shearModulus, Range::notNegative(), "Pa",
			 "G; 0: by youngs_modulus and poissons_ratio");
	f.scalar("shear_strength", law.m_shearStrength, Range::notNegative(), "Pa", "0: by shear_yield");
	f.scalar("friction", law.m_friction, {0, 2}, "", "what pressure adds to the strength in shear");
	fibreFields(f, law);
	f.vector("colour", m.colour, "", "red, green and blue, linear", Need::Optional, {0, 1});
	refuseFault(f, law.fault());
}

void sectionFields(Fields& f, SceneBuilder& builder, SceneDescription::Section& s)
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
	if (is(f.numbers("t", v, 4, 4, size, "m", "width, height, web and flange"), 4))
		rectangle(btElasticPlasticSection::tSection(btScalar(v[0]), btScalar(v[1]), btScalar(v[2]), btScalar(v[3])));
	if (is(f.numbers("channel", v, 4, 4, size, "m", "width, height, web and flange"), 4))
		rectangle(btElasticPlasticSection::channel(btScalar(v[0]), btScalar(v[1]), btScalar(v[2]), btScalar(v[3])));
	if (is(f.numbers("angle", v, 3, 3, size, "m", "width, height and thickness"), 3))
		rectangle(btElasticPlasticSection::angle(btScalar(v[0]), btScalar(v[1]), btScalar(v[2])));
	polygonFields(f, s);
	boltFields(f, s);
	weldFields(f, s);
	f.oneOf({"rectangle", "circle", "tube", "box", "i", "t", "channel", "angle", "polygon", "bolts", "welds"});
	fibresOf(f, builder, s);
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
		[&](Fields& inner) { sectionFields(inner, builder, section); }, need);
}
}  // namespace ep
