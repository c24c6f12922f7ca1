// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Sections cut into fibres.

#include "btElasticPlasticSection.h"

#include "ElasticPlastic/section/CellStrength.h"
#include "ElasticPlastic/section/FibreSlips.h"
#include "ElasticPlastic/section/StiffShares.h"
#include "LinearMath/btMinMax.h"

#include <math.h>

using namespace btElasticPlastic;

namespace
{
const double FULL_TURN = 2 * 3.14159265358979323846;
const int LEAST_FIBRES = 4, MOST_FIBRES = 400;
/// From so many on a rectangle and a circle have their finest fibres.
const int MANY = 80;

/// Four fibres of a rectangle at (+-y, +-z), as shares of height and width, and their share of the area; two where y or z is 0.
struct Orbit
{
	double m_y, m_z, m_share;
};

// Found by search: with these the rectangle bears in pure bending about its axes and under axial force alone what it should, and in
// any direction of N, M_y, M_z the largest deviation either way, given as the share of what it bears exactly, is the least that was found. What is
// missing is largest where a plane of no stretch goes through two fibres.

/// 25 %
const Orbit FOUR[] = {{0.25, 0.25, 1}};
/// 5.5 %
const Orbit EIGHT[] = {{0.35628, 0.35628, 0.51906}, {0.27059, 0, 0.24047}, {0, 0.27059, 0.24047}};
/// 2.9 %
const Orbit TWELVE[] = {
	{0.41105, 0.28831, 0.35584}, {0.17220, 0.39625, 0.32546}, {0.27487, 0, 0.17349}, {0, 0.12701, 0.14521}};
/// 2.4 %, and 2.5 % if the material is half as strong in tension, for which these were sought.
const Orbit SIXTEEN[] = {{0.34409, 0.41758, 0.22929},
						 {0.42641, 0.17098, 0.26078},
						 {0.15325, 0.24220, 0.26760},
						 {0.13129, 0, 0.14391},
						 {0, 0.45574, 0.09841}};
/// 1.0 %
const Orbit THIRTY_SIX[] = {{0.33924, 0.45024, 0.13233}, {0.06584, 0.18302, 0.11124}, {0.40038, 0.29827, 0.18993},
							{0.07205, 0.42893, 0.11680}, {0.24880, 0.07012, 0.14430}, {0.46727, 0.07850, 0.09862},
							{0.24413, 0.17532, 0.04155}, {0.01843, 0.01712, 0.04795}, {0.17323, 0.31844, 0.11729}};

/// A ring of fibres in a solid circle: how many, at which share of the radius, with which share of the area. Found likewise.
struct Ring
{
	int m_count;
	double m_radius, m_share;
};
// Odd numbers: a polygon of n corners then bears as much in 2n directions.
/// 3.2 %
const Ring FOURTEEN[] = {{5, 0.13043, 0.14247}, {9, 0.75576, 0.85753}};
/// 1.8 %
const Ring TWENTY[] = {{7, 0.24572, 0.22290}, {13, 0.78741, 0.77710}};
/// 1.1 %
const Ring THIRTY_THREE[] = {{5, 0.20185, 0.13921}, {11, 0.52819, 0.23964}, {17, 0.82426, 0.62115}};

void add(btElasticPlasticSection& section, double y, double z, double area)
{
	section.m_fibres.push_back({btScalar(y), btScalar(z), btScalar(area)});
}

/// A fibre is sheared along the longer side of its part. In a closed section a twist makes the wall as a whole slip; in an open one its two faces
/// slip to and fro, and the fibres stand for layers between them by turns: four layers tell what torsion leaves of shear.
void shearAlong(btElasticPlasticSectionFibre& fibre, const btElasticPlasticSectionPart& part, bool isClosed, int index)
{
	// Without a mean or a slope along the wall.
	static const double layers[] = {0.125, -0.375, 0.375, -0.125, -0.125, 0.375, -0.375, 0.125};
	const bool isHigh = part.m_height > part.m_width;
	const double c = cos(double(part.m_turn)), s = sin(double(part.m_turn)),
				 along[2] = {isHigh ? c : -s, isHigh ? s : c},
				 off = layers[index % 8] * double(btMin(part.m_height, part.m_width));
	fibre.m_bearsShear = true;
	for (int k = 0; k < 2; ++k)
		fibre.m_wall[k] = btScalar(along[k]);
	fibre.m_twist[0] = isClosed ? -part.m_z : btScalar(2 * off * along[0]);
	fibre.m_twist[1] = isClosed ? part.m_y : btScalar(2 * off * along[1]);
}

/// A fibre is sheared in any direction.
void shearFreely(btElasticPlasticSectionFibre& fibre, double twistY, double twistZ)
{
	fibre.m_bearsShear = true;
	fibre.m_twist[0] = btScalar(twistY);
	fibre.m_twist[1] = btScalar(twistZ);
}

/// Off a part's centre, along its own height and width.
void addTo(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part, double alongHeight,
		   double alongWidth, double area)
{
	if (part.m_turn == 0)
		return add(section, part.m_y + alongHeight, part.m_z + alongWidth, area);
	const double c = cos(double(part.m_turn)), s = sin(double(part.m_turn));
	add(section, part.m_y + c * alongHeight - s * alongWidth, part.m_z + s * alongHeight + c * alongWidth, area);
}

void addOrbits(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part, const Orbit* orbits,
			   int numOrbits)
{
	const double height = part.m_height, width = part.m_width;
	double sum = 0, arm[2] = {};
	for (int i = 0; i < numOrbits; ++i)
	{
		sum += orbits[i].m_share;
		arm[0] += orbits[i].m_share * orbits[i].m_y;
		arm[1] += orbits[i].m_share * orbits[i].m_z;
	}
	// The tables' digits must not show in what is exact.
	const double scaleY = 0.25 * sum / arm[0], scaleZ = 0.25 * sum / arm[1];
	for (int i = 0; i < numOrbits; ++i)
	{
		const Orbit& orbit = orbits[i];
		const bool isOnAxis = orbit.m_y == 0 || orbit.m_z == 0;
		for (int corner = 0; corner < 4; ++corner)
		{
			if ((orbit.m_y == 0 && corner & 1) || (orbit.m_z == 0 && corner & 2))
				continue;
			const double y = (corner & 1 ? 1 : -1) * scaleY * orbit.m_y * height,
						 z = (corner & 2 ? 1 : -1) * scaleZ * orbit.m_z * width;
			addTo(section, part, y, z, height * width * orbit.m_share / sum / (isOnAxis ? 2 : 4));
			if (section.m_parts.size() == 1)
				shearFreely(section.m_fibres[section.m_fibres.size() - 1], -z * height / width, y * width / height);
		}
	}
}

template <int N>
void addOrbits(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part, const Orbit (&orbits)[N])
{
	addOrbits(section, part, orbits, N);
}

/// 0.9 %: in each quarter a lattice of equal shares, no two of which have the same height or width.
void addLattice(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part)
{
	const int n = 28, generator = 11;
	Orbit orbits[n];
	for (int i = 0; i < n; ++i)
		orbits[i] = {(i + 0.5) / (2 * n), (i * generator % n + 0.5) / (2 * n), 1};
	addOrbits(section, part, orbits);
}

void addRectangle(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part, int count)
{
	if (count < 8)
		addOrbits(section, part, FOUR);
	else if (count < 12)
		addOrbits(section, part, EIGHT);
	else if (count == 12)
		addOrbits(section, part, TWELVE);
	else if (count <= 16)
		addOrbits(section, part, SIXTEEN);
	else if (count < MANY)
		addOrbits(section, part, THIRTY_SIX);
	else
		addLattice(section, part);
}

/// A polygon of fibres.
void addRing(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part, int count, double radius,
			 double area, double phase)
{
	for (int i = 0; i < count; ++i)
	{
		const double angle = FULL_TURN * (i + phase) / count;
		add(section, part.m_y + radius * sin(angle), part.m_z + radius * cos(angle), area / count);
		btElasticPlasticSectionFibre& fibre = section.m_fibres[section.m_fibres.size() - 1];
		shearFreely(fibre, -radius * cos(angle), radius * sin(angle));
		if (part.m_innerRadius == 0)
			continue;
		fibre.m_wall[0] = btScalar(-cos(angle));
		fibre.m_wall[1] = btScalar(sin(angle));
	}
}

/// 0.4 %: rings of fibres of one size, each in the middle of its ring's area, moved outwards until they bear in bending what the circle does.
void addManyRings(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part)
{
	const int counts[] = {7, 15, 21, 27, 31}, all = 101, first = section.m_fibres.size();
	const double r = part.m_radius, area = section.m_area;
	double inner = 0;
	for (int k = 0; k < 5; ++k)
	{
		const double share = double(counts[k]) / all, outer = sqrt(inner * inner + share),
					 radius = 2. / 3 * (outer * outer * outer - inner * inner * inner) / share;
		addRing(section, part, counts[k], r * radius, area * share, k % 2 == 0 ? 0.25 : 0.5);
		inner = outer;
	}
	double arm[2] = {};
	for (int i = first; i < section.m_fibres.size(); ++i)
	{
		arm[0] += fabs(double(section.m_fibres[i].m_y - part.m_y)) / all;
		arm[1] += fabs(double(section.m_fibres[i].m_z - part.m_z)) / all;
	}
	const double exact = 8. / 3 / FULL_TURN * r;
	for (int i = first; i < section.m_fibres.size(); ++i)
	{
		btElasticPlasticSectionFibre& fibre = section.m_fibres[i];
		fibre.m_y = part.m_y + btScalar(exact / arm[0]) * (fibre.m_y - part.m_y);
		fibre.m_z = part.m_z + btScalar(exact / arm[1]) * (fibre.m_z - part.m_z);
	}
}

/// Where a ring's area has its plastic modulus.
double plasticRadius(double inner, double outer)
{
	return 2. / 3 * (outer * outer * outer - inner * inner * inner) / (outer * outer - inner * inner);
}

/// A tube whose wall is more than a third of its radius: rings of fibres of one size, more of them outside. 2.9, 2.3 and 1 % with 20, 33 and 60, also
/// where it is half as strong in tension; up to 4 % with 20 if the wall is more than 0.7 of the radius.
void addThickWall(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part, int count)
{
	static const double shares[3][4] = {{0.4, 0.6}, {0.15, 0.33, 0.52}, {0.16, 0.21, 0.28, 0.35}};
	const int numRings = count < 33 ? 2 : count < MANY ? 3 : 4;
	const double r = part.m_radius, area = section.m_area,
				 wall = r * r - double(part.m_innerRadius) * part.m_innerRadius;
	double inner = part.m_innerRadius, share = 0;
	for (int k = 0, sum = 0; k < numRings; ++k)
	{
		share += shares[numRings - 2][k];
		const int own = int(count * share + 0.5) - sum;
		const double outer = sqrt(inner * inner + wall * own / count);
		addRing(section, part, own, plasticRadius(inner, outer), area * own / count, k % 2 == 0 ? 0.25 : 0.5);
		sum += own;
		inner = outer;
	}
}

/// 3 %: next to a solid bar fibres have to stand all over the area.
int defaultOfRound(const btElasticPlasticSectionPart& part)
{
	return part.m_innerRadius > 0 && part.m_innerRadius < btScalar(0.3) * part.m_radius ? 33 : 20;
}

void addRound(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part, int count)
{
	const double r = part.m_radius, inner = part.m_innerRadius, area = section.m_area;
	if (inner == 0 && count >= MANY)
		return addManyRings(section, part);
	if (inner == 0)
	{
		const Ring* const rings = count <= 14 ? FOURTEEN : count <= 20 ? TWENTY : THIRTY_THREE;
		for (int i = 0; i < (count <= 20 ? 2 : 3); ++i)
			addRing(section, part, rings[i].m_count, r * rings[i].m_radius, area * rings[i].m_share,
					i % 2 == 0 ? 0.25 : 0.5);
		return;
	}
	if (inner < 0.65 * r)
		return addThickWall(section, part, count);
	// Two rings of equal areas, staggered. One alone would have no choice of its second moment.
	const double middle = sqrt((r * r + inner * inner) / 2);
	addRing(section, part, (count + 1) / 2, plasticRadius(middle, r), area / 2, 0.25);
	addRing(section, part, count / 2, plasticRadius(inner, middle), area / 2, 0.75);
}

/// Cuts the longer side of a thin part into equal lengths. They stand a quarter of the thickness to either side by turns, + - - +, or, where there
/// are many, three and one eighths, so that a multiple of the pattern has the plastic moduli of the part about both of its axes.
void addStrips(btElasticPlasticSection& section, const btElasticPlasticSectionPart& part, int count)
{
	static const double few[] = {0.25, -0.25, -0.25, 0.25},
						many[] = {0.375, -0.125, -0.375, 0.125, 0.125, -0.375, -0.125, 0.375};
	const bool isHigh = part.m_height > part.m_width, areMany = count >= 16;
	const double length = isHigh ? part.m_height : part.m_width, thickness = isHigh ? part.m_width : part.m_height;
	const int n = areMany ? (count + 4) / 8 * 8 : count;
	for (int i = 0; i < n; ++i)
	{
		const double along = ((i + 0.5) / n - 0.5) * length, across = (areMany ? many[i % 8] : few[i % 4]) * thickness;
		addTo(section, part, isHigh ? along : across, isHigh ? across : along,
			  double(part.m_height) * double(part.m_width) / n);
	}
}

/// Whether the walls of a section form a ring: it is much stiffer in torsion than they are.
bool isRing(const btElasticPlasticSection& section)
{
	double open = 0;
	for (int i = 0; i < section.m_parts.size(); ++i)
	{
		const double h = section.m_parts[i].m_height, b = section.m_parts[i].m_width, thin = btMin(h, b);
		open += btMax(h, b) * thin * thin * thin / 3;
	}
	return double(section.m_torsionConstant) > 2 * open;
}

/// Parts take their shares by the third root of their area: with n strips a part errs by its area over n^2.
void addParts(btElasticPlasticSection& section, int count)
{
	const auto rootOf = [&](int i)
	{ return cbrt(double(section.m_parts[i].m_height) * double(section.m_parts[i].m_width)); };
	// Bolts and welds hold in any direction, and as far from the centre as they are.
	const bool isClosed = isRing(section), areFasteners = section.m_plasticShearArea[0] == section.m_area &&
														  section.m_plasticShearArea[1] == section.m_area;
	double sum = 0;
	for (int i = 0; i < section.m_parts.size(); ++i)
		sum += rootOf(i);
	for (int i = 0; i < section.m_parts.size(); ++i)
	{
		const btElasticPlasticSectionPart& part = section.m_parts[i];
		const int first = section.m_fibres.size();
		if (part.m_radius > 0)
		{
			add(section, part.m_y, part.m_z, FULL_TURN / 2 * double(part.m_radius) * double(part.m_radius));
			shearFreely(section.m_fibres[first], -double(part.m_z), double(part.m_y));
			continue;
		}
		const int own = 4 * btMax(1, int(count * rootOf(i) / sum / 4 + 0.5));
		const btScalar longer = btMax(part.m_height, part.m_width), shorter = btMin(part.m_height, part.m_width);
		// Two rows do not tell a stout part's bending about its longer side.
		if (own >= 12 && longer < 3 * shorter)
			addRectangle(section, part, own);
		else
			addStrips(section, part, own);
		for (int k = first; k < section.m_fibres.size(); ++k)
		{
			btElasticPlasticSectionFibre& fibre = section.m_fibres[k];
			if (areFasteners)
				shearFreely(fibre, -double(fibre.m_z), double(fibre.m_y));
			else
				shearAlong(fibre, part, isClosed, k - first);
		}
	}
}

/// Clusters, moved outwards until they bear in bending about each axis what the section does.
void addClusters(btElasticPlasticSection& section, int count)
{
	const std::vector<Cluster> clusters = clustersOf(regionOf(section), count);
	std::vector<Cell> cells;
	for (const Cluster& cluster : clusters)
		cells.push_back({cluster.m_y, cluster.m_z, cluster.m_area, cluster.m_area});
	const double outwards[2] = {double(section.m_plasticModulus[1]) / strengthAlone(cells, MOMENT_Z),
								double(section.m_plasticModulus[0]) / strengthAlone(cells, MOMENT_Y)};
	const std::vector<FibreSlip> slips = fibreSlipsOf(clusters);
	for (size_t i = 0; i < clusters.size(); ++i)
	{
		add(section, outwards[0] * clusters[i].m_y, outwards[1] * clusters[i].m_z, clusters[i].m_area);
		btElasticPlasticSectionFibre& fibre = section.m_fibres[section.m_fibres.size() - 1];
		shearFreely(fibre, slips[i].m_twist[0], slips[i].m_twist[1]);
		for (int k = 0; k < 2; ++k)
			fibre.m_wall[k] = btScalar(slips[i].m_wall[k]);
	}
}
}  // namespace

btElasticPlasticSection btElasticPlasticSection::withFibres(int count, bool withShear) const
{
	btElasticPlasticSection s = *this;
	if (s.m_fault)
		return s;
	if (count != 0 && (count < LEAST_FIBRES || count > MOST_FIBRES))
		s.m_fault = btElasticPlasticFault("number of fibres", btScalar(count), "4 to 400, or 0 for the default");
	else if (m_parts.size() == 0 && m_corners.size() == 0)
		s.m_fault = btElasticPlasticFault("number of parts of the section to cut into fibres", 0,
										  "1 or more: a section by rectangle(), iSection() and the like");
	else if (s.m_materials.size() > 0)
		s.m_fault =
			btElasticPlasticFault("number of materials added to a section that is cut into fibres",
								  btScalar(s.m_materials.size()), "0: call withFibres() before addBar() and addPart()");
	if (s.m_fault)
		return s;
	s.m_fibres.clear();
	if (m_parts.size() == 0)
		addClusters(s, count > 0 ? count : 36);
	else if (m_parts.size() > 1)
		addParts(s, count > 0 ? count : 24);
	else if (m_parts[0].m_radius > 0)
		addRound(s, m_parts[0], count > 0 ? count : defaultOfRound(m_parts[0]));
	else
		addRectangle(s, m_parts[0], count > 0 ? count : 16);
	for (int i = 0; i < s.m_fibres.size() && !withShear; ++i)
		s.m_fibres[i].m_bearsShear = false;
	return s;
}

btElasticPlasticSection btElasticPlasticSection::withFibresFor(btScalar error, bool withShear) const
{
	btElasticPlasticSection s = *this;
	if (!s.m_fault)
		s.m_fault = btElasticPlasticCheckPositive("error of a section that is cut into fibres", error);
	if (s.m_fault)
		return s;
	struct Choice
	{
		int m_count;
		double m_error;
	};
	static const Choice rectangles[] = {{4, 0.25}, {8, 0.055}, {12, 0.03}, {16, 0.024}, {36, 0.01}, {112, 0}},
						circles[] = {{14, 0.033}, {20, 0.019}, {33, 0.0115}, {101, 0}},
						walls[] = {{12, 0.055}, {24, 0.03}, {60, 0}}, polygons[] = {{36, 0.03}, {100, 0}};
	const bool isRing = m_parts.size() == 1 && m_parts[0].m_innerRadius > 0;
	const Choice* choice = m_parts.size() == 0       ? polygons
						   : m_parts.size() > 1      ? walls
						   : m_parts[0].m_radius > 0 ? circles
													 : rectangles;
	while (double(error) < choice->m_error)
		++choice;
	// A polygon of n fibres, with as many in either half about both axes.
	const double most = 100, quarter = ceil(0.5 / sqrt(double(error)));
	return withFibres(isRing ? 4 * int(btMin(most / 4, quarter)) : choice->m_count, withShear);
}

void btElasticPlasticSection::addBar(btScalar y, btScalar z, btScalar area, const btElasticPlasticMaterial& material)
{
	if (m_fault)
		return;
	m_fault = material.fault();
	if (!m_fault && !(btElasticPlasticIsFinite(y) && btElasticPlasticIsFinite(z)))
		m_fault = btElasticPlasticFault("place of a bar, y + z [m]", y + z, "finite");
	if (!m_fault)
		m_fault = btElasticPlasticCheckPositive("area of a bar [m^2]", area);
	if (!m_fault && m_fibres.size() == 0)
		m_fault =
			btElasticPlasticFault("number of fibres of a section with bars", 0, "4 or more: call withFibres() first");
	if (m_fault)
		return;
	m_materials.push_back(material);
	m_fibres.push_back({y, z, area, m_materials.size()});
}

void btElasticPlasticSection::addPart(const btElasticPlasticSection& part, btScalar y, btScalar z,
									  const btElasticPlasticMaterial& material)
{
	if (m_fault)
		return;
	// Its arrays would move as they are read.
	if (&part == this)
		return addPart(btElasticPlasticSection(part), y, z, material);
	m_fault = part.m_fault ? part.m_fault : material.fault();
	if (!m_fault && !(btElasticPlasticIsFinite(y) && btElasticPlasticIsFinite(z)))
		m_fault = btElasticPlasticFault("place of a part, y + z [m]", y + z, "finite");
	if (!m_fault && (m_fibres.size() == 0 || part.m_fibres.size() == 0))
		m_fault = btElasticPlasticFault("number of fibres of a section and of a part that is added to it", 0,
										"4 or more of both: call withFibres() first");
	if (m_fault)
		return;
	btAlignedObjectArray<double> shares;
	findShares(part, shares);
	m_materials.push_back(material);
	const int own = m_materials.size();
	for (int i = 0; i < part.m_materials.size(); ++i)
		m_materials.push_back(part.m_materials[i]);
	for (int i = 0; i < part.m_fibres.size(); ++i)
	{
		btElasticPlasticSectionFibre fibre = part.m_fibres[i];
		if (fibre.m_material == 0)
			fibre.m_excess = btScalar(shares[i] * double(part.m_area) / double(fibre.m_area) - 1);
		fibre.m_material += own;
		fibre.m_bearsShear = false;
		fibre.m_y += y;
		fibre.m_z += z;
		m_fibres.push_back(fibre);
	}
}
