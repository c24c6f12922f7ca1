// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Sections with straight sides.

#include "btElasticPlasticSection.h"

#include "ElasticPlastic/section/Convex.h"
#include "ElasticPlastic/section/Torsion.h"
#include "LinearMath/btMinMax.h"

#include <math.h>

using namespace btElasticPlastic;

namespace
{
const int MOST_CORNERS = 1000, SLICES = 400;
/// Of an outline, of the square of its farthest corner's distance from the origin: rounding makes cuts of less than this into nothing.
const double LEAST_AREA = 1e-6;

btElasticPlasticFault faultOfOutlines(const std::vector<Region::Outline>& outlines)
{
	for (const Region::Outline& outline : outlines)
		for (const Region::Point& p : outline)
			if (!btElasticPlasticIsFinite(p.m_y + p.m_z))
				return btElasticPlasticFault("corner of a section, y + z [m]", btScalar(p.m_y + p.m_z), "finite");
	for (const Region::Outline& outline : outlines)
	{
		double reach2 = 0;
		for (const Region::Point& p : outline)
			reach2 = btMax(reach2, p.m_y * p.m_y + p.m_z * p.m_z);
		const double area = fabs(areaOf(outline));
		if (!(area > 0))
			return btElasticPlasticFault("area in an outline of a section [m^2]", 0, "greater than 0");
		if (!(area > LEAST_AREA * reach2))
			return btElasticPlasticFault(
				"area in an outline of a section, of the square of its distance from the origin",
				btScalar(area / reach2), "greater than 1e-6");
	}
	if (areCrossed(outlines))
		return btElasticPlasticFault("number of places where outlines of a section meet", 1,
									 "0: its sides have no point in common but corners of neighbours");
	for (size_t i = 1; i < outlines.size(); ++i)
		for (size_t j = 0; j < outlines.size(); ++j)
			if (i != j && isInside(outlines[j], outlines[i][0]) != (j == 0))
				return btElasticPlasticFault("number of a section's hole", btScalar(i),
											 "one inside the outer outline and outside of other holes");
	return btElasticPlasticFault();
}

/// W_pl: the least of the integral of |y + b z + n| over b and n; for bending about y, y and z change places.
double plasticModulus(const Region& region, const Region::Moments& whole, const double size[2], bool isAboutY)
{
	const double own = size[isAboutY ? 1 : 0], other = size[isAboutY ? 0 : 1];
	const double reach = 8 * own / other;
	const auto modulus = [&](double slope, double shift)
	{
		const double alongY = isAboutY ? slope : 1, alongZ = isAboutY ? 1 : slope;
		const Region::Moments below = region.below(alongY, alongZ, -shift).moments();
		return shift * whole.m_area - 2 * (alongY * below.m_y + alongZ * below.m_z + shift * below.m_area);
	};
	return leastOf([&](double slope) { return leastOf([&](double shift) { return modulus(slope, shift); }, 9 * own); },
				   reach);
}

/// A_s = I^2 / integral of S^2 / b: the energy of Jourawski's stress V S / (I b).
double shearArea(const Region& region, const double size[2], double second, bool isAlongY)
{
	const double alongY = isAlongY ? 1 : 0, alongZ = isAlongY ? 0 : 1, reach = size[isAlongY ? 0 : 1],
				 step = 2 * reach / SLICES;
	double area = 0, energy = 0;
	for (int i = 1; i <= SLICES; ++i)
	{
		const double height = i * step - reach;
		const Region::Moments below = region.below(alongY, alongZ, height).moments(),
							  half = region.below(alongY, alongZ, height - step / 2).moments();
		const double first = alongY * half.m_y + alongZ * half.m_z, slice = below.m_area - area;
		area = below.m_area;
		if (slice > 0)
			energy += first * first * step * step / slice;
	}
	return second * second / energy;
}

/// By its corners and the origin of its axes, all but torsion.
/// \param region  gets the figure, seen from the section's axes
btElasticPlasticSection sectionOf(std::vector<Region::Outline> outlines, Region& region)
{
	btElasticPlasticSection s;
	s.m_fault = faultOfOutlines(outlines);
	if (s.m_fault)
		return s;
	for (size_t i = 0; i < outlines.size(); ++i)
		if ((areaOf(outlines[i]) > 0) != (i == 0))
			outlines[i] = Region::Outline(outlines[i].rbegin(), outlines[i].rend());
	Region drawn;
	drawn.m_outlines = outlines;
	const Region::Moments given = drawn.moments();
	const double turn = nearestPrincipalTurn(given.centred());
	region = drawn.seenFrom(given.m_y / given.m_area, given.m_z / given.m_area, turn);
	const Region::Moments m = region.moments();
	double size[2] = {};
	for (const Region::Outline& outline : region.m_outlines)
	{
		s.m_numCorners.push_back(int(outline.size()));
		for (const Region::Point& p : outline)
		{
			s.m_corners.push_back({btScalar(p.m_y), btScalar(p.m_z)});
			size[0] = btMax(size[0], fabs(p.m_y));
			size[1] = btMax(size[1], fabs(p.m_z));
		}
	}
	s.m_centroid[0] = btScalar(given.m_y / given.m_area);
	s.m_centroid[1] = btScalar(given.m_z / given.m_area);
	s.m_turn = btScalar(turn);
	s.m_area = btScalar(m.m_area);
	s.m_secondMoment[0] = btScalar(m.m_zz);
	s.m_secondMoment[1] = btScalar(m.m_yy);
	for (int i = 0; i < 2; ++i)
	{
		s.m_outerFibre[i] = btScalar(size[i]);
		s.m_plasticModulus[i] = btScalar(plasticModulus(region, m, size, i == 0));
		const double shear = shearArea(region, size, i == 0 ? m.m_yy : m.m_zz, i == 0);
		s.m_shearArea[i] = btScalar(shear);
		s.m_plasticShearArea[i] = btScalar(btMin(1.2 * shear, m.m_area));
	}
	return s;
}

bool isThinner(btElasticPlasticSection& section, const char* quantity, btScalar value, btScalar limit,
			   const char* range)
{
	section.m_fault = btElasticPlasticCheckPositive(quantity, value);
	if (!section.m_fault && !(value < limit))
		section.m_fault = btElasticPlasticFault(quantity, value, range);
	return !section.m_fault;
}

bool areSizes(btElasticPlasticSection& section, btScalar width, btScalar height)
{
	section.m_fault = btElasticPlasticCheckPositive("section width [m]", width);
	if (!section.m_fault)
		section.m_fault = btElasticPlasticCheckPositive("section height [m]", height);
	return !section.m_fault;
}

/// A wall of a section, drawn as the section is.
struct Wall
{
	double m_y, m_z, m_height, m_width;
	int m_freeEnds;  ///< that do not stand on another wall
};

/// Takes walls as parts, and torsion by them: J is the sum of s t^3 / 3, and the plastic modulus that of a heap on each, with a hip at each free end.
void setWalls(btElasticPlasticSection& s, const std::vector<Wall>& walls)
{
	const double c = cos(double(s.m_turn)), n = sin(double(s.m_turn));
	double constant = 0, modulus = 0;
	for (const Wall& wall : walls)
	{
		const double y = wall.m_y - double(s.m_centroid[0]), z = wall.m_z - double(s.m_centroid[1]);
		btElasticPlasticSectionPart part;
		part.m_y = btScalar(c * y + n * z);
		part.m_z = btScalar(c * z - n * y);
		part.m_height = btScalar(wall.m_height);
		part.m_width = btScalar(wall.m_width);
		part.m_turn = -s.m_turn;
		s.m_parts.push_back(part);
		const double t = btMin(wall.m_height, wall.m_width), length = btMax(wall.m_height, wall.m_width);
		constant += length * t * t * t / 3;
		modulus += length * t * t / 2 - wall.m_freeEnds * t * t * t / 12;
	}
	s.m_torsionConstant = btScalar(constant);
	s.m_plasticTorsionModulus = btScalar(modulus);
}

btElasticPlasticSection withWalls(const Region::Outline& outline, const std::vector<Wall>& walls)
{
	Region region;
	btElasticPlasticSection s = sectionOf({outline}, region);
	if (!s.m_fault)
		setWalls(s, walls);
	return s;
}
}  // namespace

namespace btElasticPlastic
{
Region regionOf(const btElasticPlasticSection& section)
{
	Region region;
	for (int i = 0, corner = 0; i < section.m_numCorners.size(); ++i)
	{
		Region::Outline outline;
		for (int k = 0; k < section.m_numCorners[i] && corner < section.m_corners.size(); ++k, ++corner)
			outline.push_back({double(section.m_corners[corner].m_y), double(section.m_corners[corner].m_z)});
		region.m_outlines.push_back(outline);
	}
	return region;
}
}  // namespace btElasticPlastic

btTransform btElasticPlasticSection::principalFrame() const
{
	return btTransform(btQuaternion(btVector3(1, 0, 0), m_turn), btVector3(0, m_centroid[0], m_centroid[1]));
}

btElasticPlasticSection btElasticPlasticSection::polygon(const btElasticPlasticSectionPoint* corners,
														 const int* numCorners, int numOutlines)
{
	btElasticPlasticSection s;
	std::vector<Region::Outline> outlines;
	int sum = 0;
	if (numOutlines < 1)
		s.m_fault = btElasticPlasticFault("number of outlines of a section", btScalar(numOutlines), "1 or more");
	else if (!corners || !numCorners)
		s.m_fault = btElasticPlasticFault("address of a section's corners, or of their numbers", 0, "not null");
	for (int i = 0; i < numOutlines && !s.m_fault; ++i)
	{
		if (numCorners[i] < 3 || numCorners[i] > MOST_CORNERS - sum)
		{
			s.m_fault = btElasticPlasticFault("number of corners of an outline", btScalar(numCorners[i]),
											  "3 or more, and 1000 at most in all outlines");
			break;
		}
		Region::Outline outline;
		for (int k = 0; k < numCorners[i]; ++k, ++sum)
			outline.push_back({double(corners[sum].m_y), double(corners[sum].m_z)});
		outlines.push_back(outline);
	}
	if (s.m_fault)
		return s;
	Region region;
	s = sectionOf(outlines, region);
	if (s.m_fault)
		return s;
	const Torsion torsion = torsionOf(region);
	s.m_torsionConstant = btScalar(torsion.m_constant);
	s.m_plasticTorsionModulus = btScalar(torsion.m_plasticModulus);
	return s;
}

btElasticPlasticSection btElasticPlasticSection::tSection(btScalar width, btScalar height, btScalar web,
														  btScalar flange)
{
	btElasticPlasticSection s;
	if (!areSizes(s, width, height) ||
		!isThinner(s, "section web [m]", web, width, "greater than 0 and less than the width") ||
		!isThinner(s, "section flange [m]", flange, height, "greater than 0 and less than the height"))
		return s;
	const double b = width, h = height, tw = web, tf = flange;
	return withWalls({{0, b / 2},
					  {-tf, b / 2},
					  {-tf, tw / 2},
					  {-h, tw / 2},
					  {-h, -tw / 2},
					  {-tf, -tw / 2},
					  {-tf, -b / 2},
					  {0, -b / 2}},
					 {{-tf / 2, 0, tf, b, 2}, {-(h + tf) / 2, 0, h - tf, tw, 1}});
}

btElasticPlasticSection btElasticPlasticSection::channel(btScalar width, btScalar height, btScalar web, btScalar flange)
{
	btElasticPlasticSection s;
	if (!areSizes(s, width, height) ||
		!isThinner(s, "section web [m]", web, width, "greater than 0 and less than the width") ||
		!isThinner(s, "section flange [m]", flange, height / 2, "greater than 0 and less than half of the height"))
		return s;
	const double b = width, h = height, tw = web, tf = flange;
	return withWalls(
		{{h / 2, 0},
		 {h / 2, b},
		 {h / 2 - tf, b},
		 {h / 2 - tf, tw},
		 {tf - h / 2, tw},
		 {tf - h / 2, b},
		 {-h / 2, b},
		 {-h / 2, 0}},
		{{(h - tf) / 2, b / 2, tf, b, 2}, {(tf - h) / 2, b / 2, tf, b, 2}, {0, tw / 2, h - 2 * tf, tw, 0}});
}

btElasticPlasticSection btElasticPlasticSection::angle(btScalar width, btScalar height, btScalar thickness)
{
	btElasticPlasticSection s;
	if (!areSizes(s, width, height) || !isThinner(s, "section thickness [m]", thickness, btMin(width, height),
												  "greater than 0 and less than width and height"))
		return s;
	const double b = width, h = height, t = thickness;
	s = withWalls({{0, 0}, {0, b}, {t, b}, {t, t}, {h, t}, {h, 0}},
				  {{t / 2, b / 2, t, b, 2}, {(h + t) / 2, t / 2, h - t, t, 1}});
	if (s.m_fault)
		return s;
	// Legs by their middle lines; each is a rectangle to a force along it, of which 5/6 count and all yields.
	const double leg[2] = {(h - t / 2) * t, (b - t / 2) * t}, c = cos(double(s.m_turn)), n = sin(double(s.m_turn));
	const double along[2][2] = {{c, n}, {-n, c}};
	for (int i = 0; i < 2; ++i)
	{
		const double first = fabs(along[i][0]), second = fabs(along[i][1]);
		s.m_shearArea[i] = btScalar(5. / 6 / (first * first / leg[0] + second * second / leg[1]));
		s.m_plasticShearArea[i] = btScalar(1 / btMax(first / leg[0], second / leg[1]));
	}
	return s;
}
