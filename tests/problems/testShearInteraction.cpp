// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Sections with fibres in which shear and torsion yield together with axial force and bending.

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/section/Slips.h"
#include "support/Close.h"
#include "support/Corners.h"
#include "support/DirectSolver.h"
#include "support/SectionSurface.h"
#include "world/Place.h"
#include "world/EnergyAudit.h"
#include "support/Repeats.h"

namespace testShearInteraction
{
using namespace ep;

const double PI = 3.14159265358979323846, YIELD = 250e6;

// ---- exact sections

/// Solid: sheared in any direction, by torsion along the contours of the sand heap, or as it turns and warps with y z. Of pure torsion the
/// heap is the least; by itself it would have the two ends of a flat rectangle bear half of the torsion beside whatever else the rest bears.
SectionSurface solidRectangle(double b, double h)
{
	SectionSurface s;
	const int n = 24;
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < n; ++j)
		{
			const double y = ((i + 0.5) / n - 0.5) * h, z = ((j + 0.5) / n - 0.5) * b;
			const double area = b * h / (n * n), fromSide = b / 2 - std::fabs(z), fromTop = h / 2 - std::fabs(y);
			// Half of a cell on a diagonal slips as those at its one side. Were it rounding that chose, shear would twist the section a little.
			const bool isOnDiagonal = std::fabs(fromTop - fromSide) < 0.1 * std::min(b, h) / n;
			for (const bool isNearTop : {false, true})
				if (isOnDiagonal || isNearTop == (fromTop < fromSide))
					s.m_cells.push_back({y,
										 z,
										 isOnDiagonal ? area / 2 : area,
										 {{1, 0, isNearTop ? 0 : -z}, {0, 1, isNearTop ? y : 0}},
										 {0, 0}});
			s.m_warped.push_back({y, z, area, {{1, 0, -z}, {0, 1, y}}, {-z, -y}});
		}
	return s;
}

/// Walls that close a cell, by a warping with y z: of a box any one of them may slip by itself then.
void mayWarp(SectionSurface& s)
{
	for (ShearCell& cell : s.m_cells)
		cell.warping[0] = -cell.z * cell.slip[0][0] - cell.y * cell.slip[0][1];
}

SectionSurface ring(double r, double inner, bool isSolid)
{
	SectionSurface s;
	const int rings = isSolid ? 10 : 3, count = 60;
	for (int i = 0; i < rings; ++i)
	{
		const double a = std::sqrt(inner * inner + (r * r - inner * inner) * i / rings),
					 c = std::sqrt(inner * inner + (r * r - inner * inner) * (i + 1) / rings),
					 middle = 2. / 3 * (c * c * c - a * a * a) / (c * c - a * a), area = PI * (c * c - a * a) / count;
		for (int j = 0; j < count; ++j)
		{
			const double angle = 2 * PI * (j + 0.5) / count, sine = std::sin(angle), cosine = std::cos(angle);
			ShearCell cell = {middle * sine, middle * cosine, area, {{-cosine, sine, middle}, {0, 0, 0}}, {0, 0}};
			if (isSolid)
			{
				cell = {
					middle * sine, middle * cosine, area, {{1, 0, -middle * cosine}, {0, 1, middle * sine}}, {0, 0}};
				ShearCell warped = cell;
				warped.warping[0] = -cell.z;
				warped.warping[1] = -cell.y;
				s.m_warped.push_back(warped);
			}
			s.m_cells.push_back(cell);
		}
	}
	if (!isSolid)
		mayWarp(s);
	return s;
}

/// A thin wall that is sheared along its longer side. \param arm  of the whole wall in torsion, 0: each face by itself
void addWall(SectionSurface& s, double y, double z, double h, double b, double arm)
{
	const bool isHigh = h > b;
	const int along = 40, across = 4;
	for (int i = 0; i < along; ++i)
		for (int j = 0; j < across; ++j)
		{
			const double u = (i + 0.5) / along - 0.5, v = (j + 0.5) / across - 0.5, off = v * (isHigh ? b : h);
			s.m_cells.push_back(
				{y + (isHigh ? u : v) * h,
				 z + (isHigh ? v : u) * b,
				 h * b / (along * across),
				 {{double(isHigh), double(!isHigh), arm != 0 ? arm : (isHigh ? -2 : 2) * off}, {0, 0, 0}},
				 {0, 0}});
		}
}

SectionSurface box(double b, double h, double t)
{
	SectionSurface s;
	for (int side = -1; side <= 1; side += 2)
	{
		addWall(s, side * (h - t) / 2, 0, t, b, side * (h - t) / 2);
		addWall(s, 0, side * (b - t) / 2, h - 2 * t, t, -side * (b - t) / 2);
	}
	mayWarp(s);
	return s;
}

SectionSurface iSection(double b, double h, double web, double flange)
{
	SectionSurface s;
	for (int side = -1; side <= 1; side += 2)
		addWall(s, side * (h - flange) / 2, 0, flange, b, 0);
	addWall(s, 0, 0, h - 2 * flange, web, 0);
	return s;
}

/// Walls at any angle, each about the middle of its two faces.
SectionSurface openWalls(const btElasticPlasticSection& section)
{
	SectionSurface all;
	for (int i = 0; i < section.m_parts.size(); ++i)
	{
		const btElasticPlasticSectionPart& part = section.m_parts[i];
		SectionSurface wall;
		addWall(wall, 0, 0, part.m_height, part.m_width, 0);
		const double c = std::cos(double(part.m_turn)), s = std::sin(double(part.m_turn));
		const auto turn = [&](double& y, double& z)
		{
			const double before = y;
			y = c * y - s * z;
			z = s * before + c * z;
		};
		for (ShearCell& cell : wall.m_cells)
		{
			turn(cell.y, cell.z);
			cell.y += part.m_y;
			cell.z += part.m_z;
			turn(cell.slip[0][0], cell.slip[0][1]);
			all.m_cells.push_back(cell);
		}
	}
	return all;
}

enum class Walls
{
	None,
	Open,
	Closed
};

/// A polygon in 1000 points and more, twisted as it is elastically, with a warping by y z beside. Points of walls are sheared along these, unless they slip
/// elastically by more than 0.4 across, as at corners.
SectionSurface finePolygon(const btElasticPlasticSection& section, Walls walls)
{
	const btElasticPlastic::Region region = btElasticPlastic::regionOf(section);
	std::vector<btElasticPlastic::Region> pieces;
	region.cut(region.moments().m_area / 250, pieces);
	std::vector<btElasticPlastic::SectionPoint> points;
	for (const btElasticPlastic::Region& piece : pieces)
		btElasticPlastic::addPointsOf(piece.moments(), points);
	const std::vector<btElasticPlastic::Slips> slips = btElasticPlastic::slipsOf(points);
	// No part of the warping is a plane that turns.
	double sumYY = 0, sumZZ = 0, sumYYZ = 0, sumYZZ = 0;
	for (const btElasticPlastic::SectionPoint& p : points)
	{
		sumYY += p.m_area * p.m_y * p.m_y;
		sumZZ += p.m_area * p.m_z * p.m_z;
		sumYYZ += p.m_area * p.m_y * p.m_y * p.m_z;
		sumYZZ += p.m_area * p.m_y * p.m_z * p.m_z;
	}
	const double offY = sumYZZ / sumZZ, offZ = sumYYZ / sumYY;
	SectionSurface s;
	for (size_t i = 0; i < points.size(); ++i)
	{
		const btElasticPlastic::SectionPoint& p = points[i];
		const btElasticPlastic::Region::Point &a = slips[i].m_alongY, &b = slips[i].m_alongZ, &twist = slips[i].m_twist;
		ShearCell cell = {p.m_y, p.m_z, p.m_area, {{1, 0, twist.m_y}, {0, 1, twist.m_z}}, {offZ - p.m_z, offY - p.m_y}};
		const double yy = a.m_y * a.m_y + b.m_y * b.m_y, zz = a.m_z * a.m_z + b.m_z * b.m_z,
					 yz = a.m_y * a.m_z + b.m_y * b.m_z, half = std::hypot((yy - zz) / 2, yz),
					 turn = std::atan2(yz, (yy - zz) / 2) / 2, along[2] = {std::cos(turn), std::sin(turn)};
		if (walls != Walls::None && (yy + zz) / 2 - half < 0.4 * 0.4 * ((yy + zz) / 2 + half))
			cell = {p.m_y,
					p.m_z,
					p.m_area,
					{{along[0], along[1], along[0] * twist.m_y + along[1] * twist.m_z}, {}},
					{walls == Walls::Closed ? along[0] * cell.warping[0] + along[1] * cell.warping[1] : 0, 0}};
		s.m_warped.push_back(cell);
		for (double& w : cell.warping)
			w = 0;
		s.m_cells.push_back(cell);
	}
	return s;
}

struct Shape
{
	const char* m_name;
	SectionSurface m_exact;
	btElasticPlasticSection m_section;
};

// ---- the library's

/// A body that is light beside the stiffness of its springs, but not beside its loads, which float would round, in the middle of its joint with the ground, under forces that grow.
class Loaded
{
public:
	explicit Loaded(const btElasticPlasticCapacity& capacity, bool isReversed = false,
					const btQuaternion& turn = btQuaternion(0, 0, 0, 1), const Method& method = withoutInnerSteps())
		: m_world(method, btVector3(0, 0, 0)), m_frame(turn), m_sign(isReversed ? -1 : 1)
	{
		btCollisionShape* const shape = m_world.box(btVector3(1, 1, 1));
		btRigidBody* const ground = m_world.body(0, shape, m_frame, false);
		m_body = m_world.body(1000, shape, m_frame, false);
		m_body->setMassProps(1000, btVector3(10, 10, 10));
		m_body->updateInertiaTensor();
		m_joint = isReversed ? m_world.joint(*m_body, *ground, m_frame, capacity)
							 : m_world.joint(*ground, *m_body, m_frame, capacity);
		for (int i = 0; i < capacity.m_fibres.size(); ++i)
			m_tension += double(capacity.m_fibres[i].m_tension);
	}

	/// One step under a section's forces. \return whether it bears them
	bool bears(const SectionForces6& force)
	{
		btVector3 sum[2];
		for (size_t k = 0; k < 6; ++k)
			sum[k / 3][int(k % 3)] = m_sign * btScalar(force[k]);
		m_body->applyCentralForce(m_frame.getBasis() * sum[0]);
		m_body->applyTorque(m_frame.getBasis() * sum[1]);
		m_world.step(btScalar(1) / 60);
		for (int k = 0; k < 6; ++k)
		{
			double own = m_joint->getCapacity().m_yield[k];
			if (k == BT_EP_AXIAL && force[0] > 0)
				own = std::min(own, m_tension);
			if (std::fabs(m_joint->getAppliedForce(k) - force[size_t(k)]) > 0.01 * own)
				return false;
		}
		return true;
	}

	World m_world;
	btTransform m_frame;
	btScalar m_sign;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;
	double m_tension = 0;  ///< what it bears of that [N]
};

/// \param stiffer  than steel; so stiff that places stay where they are, but not so that float rounds what is elastic of them
/// \param tension  strength in tension over the one in compression
btElasticPlasticMaterial materialOf(double stiffer, double tension)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(YIELD));
	steel.m_ultimatePlasticStrain = btScalar(1e6);
	steel.m_youngsModulus *= btScalar(stiffer);
	steel.m_tensileShare = btScalar(tension);
	return steel;
}

btElasticPlasticCapacity capacityOf(const btElasticPlasticSection& section, double stiffer = inPrecision(100, 10),
									double tension = 1)
{
	const btElasticPlasticMaterial steel = materialOf(stiffer, tension);
	return btElasticPlasticCapacity::fromMember(steel, section, btScalar(0.1), btScalar(0.1));
}

std::vector<Shape> shapes()
{
	typedef btElasticPlasticSection Section;
	const auto s = [](double x) { return btScalar(x); };
	return {
		{"rectangle", solidRectangle(0.1, 0.2), Section::rectangle(s(0.1), s(0.2)).withFibres()},
		{"circle", ring(0.05, 0, true), Section::circle(s(0.05)).withFibres()},
		{"tube", ring(0.05, 0.045, false), Section::hollowCircle(s(0.05), s(0.005)).withFibres()},
		{"box", box(0.1, 0.2, 0.006), Section::hollowRectangle(s(0.1), s(0.2), s(0.006)).withFibres()},
		{"I", iSection(0.1, 0.2, 0.0056, 0.0085), Section::iSection(s(0.1), s(0.2), s(0.0056), s(0.0085)).withFibres()},
		{"square", solidRectangle(0.1, 0.1), Section::rectangle(s(0.1), s(0.1)).withFibres()},
		{"square box", box(0.1, 0.1, 0.006), Section::hollowRectangle(s(0.1), s(0.1), s(0.006)).withFibres()},
		{"wide I", iSection(0.2, 0.2, 0.009, 0.015),
		 Section::iSection(s(0.2), s(0.2), s(0.009), s(0.015)).withFibres()}};
}

/// Solid ones of any flatness.
std::vector<Shape> flatShapes()
{
	typedef btElasticPlasticSection Section;
	std::vector<Shape> shapes;
	for (const double height : {0.3, 0.5, 1.})
		shapes.push_back({height < 0.4   ? "1 : 3"
						  : height < 0.6 ? "1 : 5"
										 : "1 : 10",
						  solidRectangle(0.1, height),
						  Section::rectangle(btScalar(0.1), btScalar(height)).withFibres()});
	return shapes;
}

/// Not cut into fibres yet.
std::vector<Shape> openShapes()
{
	typedef btElasticPlasticSection Section;
	const auto s = [](double x) { return btScalar(x); };
	std::vector<Shape> shapes = {{"T", {}, Section::tSection(s(0.15), s(0.15), s(0.01), s(0.015))},
								 {"channel", {}, Section::channel(s(0.075), s(0.2), s(0.0085), s(0.0115))},
								 {"angle", {}, Section::angle(s(0.1), s(0.1), s(0.01))},
								 {"unequal angle", {}, Section::angle(s(0.1), s(0.15), s(0.012))}};
	for (Shape& shape : shapes)
		shape.m_exact = openWalls(shape.m_section);
	return shapes;
}

/// The same figure, of which nobody knows that it has walls.
btElasticPlasticSection drawn(const btElasticPlasticSection& section)
{
	return btElasticPlasticSection::polygon(&section.m_corners[0], &section.m_numCorners[0], 1);
}

/// Sections by their corners, in decimetres.
std::vector<Shape> polygons()
{
	typedef btElasticPlasticSection Section;
	const double unit = 0.1;
	std::vector<Shape> shapes = {
		{"rectangle 1 : 2", solidRectangle(0.1, 0.2), polygon({rectangle(2, 1)}, unit).withFibres()},
		{"rectangle 1 : 5", solidRectangle(0.1, 0.5), polygon({rectangle(5, 1)}, unit).withFibres()},
		{"flat bar 1 : 15", solidRectangle(0.1, 1.5), polygon({rectangle(15, 1)}, unit).withFibres()}};
	const auto add = [&](const char* name, const Section& section, Walls walls) {
		shapes.push_back({name, finePolygon(section, walls), section.withFibres()});
	};
	add("triangle", polygon({{{0, 0}, {0, 1}, {1, 0}}}, unit), Walls::None);
	add("hexagon", polygon({circle(1, 6)}, unit), Walls::None);
	add("stout L", polygon({{{0, 0}, {0, 2}, {1, 2}, {1, 1}, {2, 1}, {2, 0}}}, unit), Walls::None);
	add("box", polygon({rectangle(2, 1), rectangle(1.88, 0.88)}, unit), Walls::Closed);
	add("trapezium with a hole",
		polygon({{{0, 0}, {0, 3}, {2, 2.5}, {2, 0.5}}, {{0.4, 0.7}, {1.6, 0.8}, {1.6, 2.2}, {0.4, 2.3}}}, unit),
		Walls::Closed);
	add("two cells",
		polygon({{{0, 0}, {0, 8}, {2, 10}, {2, -2}},
				 {{0.3, 0.5}, {1.7, 0.2}, {1.7, 3.8}, {0.3, 3.8}},
				 {{0.3, 4.2}, {1.7, 4.2}, {1.7, 7.8}, {0.3, 7.5}}},
				unit),
		Walls::Closed);
	for (const Shape& walls : openShapes())
		add(walls.m_name, drawn(walls.m_section), Walls::Open);
	return shapes;
}

/// How many times the forces, over what the section bears of each alone, it bears: they grow from 0.75 times by a hundredth in each step.
/// \param isSudden  the 0.75 come at once. By hundredths where shear is borne by pressure, which has to be there: without, it slips in that step
double shareBorne(Loaded& loaded, const SectionForces6& scaled, bool isSudden = true)
{
	const auto bears = [&](double share)
	{
		SectionForces6 now;
		for (size_t k = 0; k < 6; ++k)
			now[k] = share * scaled[k] * double(loaded.m_joint->getCapacity().m_yield[k]);
		return loaded.bears(now);
	};
	double share = 0.75;
	for (double before = 0.01; before < share && !isSudden; before += 0.01)
		bears(before);
	for (int i = 0; i < 10; ++i)
		bears(share);
	while (share < 2.5 && bears(share))
		share += 0.01;
	// Between the last step and this one.
	return share - 0.005;
}

/// \param alone  what the section bears of each force, by which the direction is measured
SectionForces6 scaledToSurface(const SectionSurface& exact, const SectionForces6& alone,
							   const SectionForces6& direction)
{
	SectionForces6 force, scaled;
	for (size_t k = 0; k < 6; ++k)
		force[k] = direction[k] * alone[k];
	const double radius = exact.radius(force);
	for (size_t k = 0; k < 6; ++k)
		scaled[k] = direction[k] * radius;
	return scaled;
}

SectionForces6 scaledToSurface(const SectionSurface& exact, const SectionForces6& direction)
{
	return scaledToSurface(exact, exact.alone(), direction);
}

SectionForces6 anyDirection(std::mt19937& random)
{
	std::normal_distribution<double> normal;
	SectionForces6 direction;
	for (double& d : direction)
		d = normal(random);
	return direction;
}

/// The least and the most that is borne of what should be, in random directions. Shears and torsion are measured by what the section bears of each.
std::pair<double, double> sharesBorne(const SectionSurface& exact, const btElasticPlasticCapacity& capacity,
									  int directions, bool isSudden)
{
	const SectionForces6 alone = exact.aloneAtRest();
	std::mt19937 random(1);
	double least = 2, most = 0;
	for (int i = 0; i < directions; ++i)
	{
		Loaded loaded(capacity);
		SectionForces6 scaled = scaledToSurface(exact, alone, anyDirection(random));
		for (const size_t k : {0, 4, 5})
			scaled[k] *= alone[k] * YIELD / double(capacity.m_yield[k]);
		const double share = shareBorne(loaded, scaled, isSudden);
		least = std::min(least, share);
		most = std::max(most, share);
	}
	return {least, most};
}

/// Much deeper than wide: it yields at so small a turn that float knows its moment to a hundredth only. Near the surface, where a little more of a
/// moment leaves much less of a shear, a step in which rounding adds to it lets the section slip.
bool isDeep(const Shape& shape)
{
	return shape.m_name == std::string("flat bar 1 : 15") || shape.m_name == std::string("two cells");
}

/// Of what is deep a third is as stiff as float can do with: yield is a larger turn then.
double stifferOf(const Shape& shape) { return inPrecision(100, isDeep(shape) ? 3 : 10); }

void expectRight(const Shape& shape, int directions)
{
	const std::pair<double, double> shares =
		sharesBorne(shape.m_exact, capacityOf(shape.m_section, stifferOf(shape)), directions, true);
	// The bound that such sections are asked to keep, and 0.915 measured in 2000 directions of what is deep in float.
	EXPECT_GT(shares.first, 1 - (isDeep(shape) ? inPrecision(0.08, 0.1) : 0.08)) << shape.m_name;
	EXPECT_LT(shares.second, 1 + 0.08) << shape.m_name;
}

/// The same with less strength in tension.
void expectRight(Shape shape, double tension, int directions)
{
	shape.m_exact.m_tension = tension;
	const std::pair<double, double> shares =
		sharesBorne(shape.m_exact, capacityOf(shape.m_section, stifferOf(shape), tension), directions, false);
	// 0.945 to 1.065 measured in 2000 directions with 0.3 and 0.6.
	EXPECT_GT(shares.first, 1 - 0.08) << shape.m_name << ", " << tension;
	EXPECT_LT(shares.second, 1 + 0.08) << shape.m_name << ", " << tension;
}

TEST(ShearInteraction, IsRightInAllDirectionsOfAllSixForces)
{
	int directions = repeats(2000, 50);
	for (const Shape& shape : shapes())
	{
		// Of other sizes of the same.
		if (std::string(shape.m_name) == "square")
			directions = repeats(300, 15);
		expectRight(shape, directions);
	}
}

TEST(ShearInteraction, OfThinClosedWallsLeavesShearWhatTorsionDoesNotTake)
{
	// Any thin wall may slip by itself: V / V_pl + T / T_pl = 1 (EN 1993-1-1, 6.2.7, eq. 6.28). A tube's wall may slip in parts, of which the library's warping
	// has the first.
	typedef btElasticPlasticSection Section;
	const auto s = [](double x) { return btScalar(x); };
	const Section sections[] = {Section::hollowRectangle(s(0.1), s(0.2), s(0.001)).withFibres(),
								Section::hollowRectangle(s(0.1), s(0.1), s(0.001)).withFibres(),
								Section::hollowRectangle(s(0.2), s(0.04), s(0.001)).withFibres(),
								polygon({rectangle(2, 1), rectangle(1.96, 0.96)}, 0.1).withFibres(),
								polygon({rectangle(5, 1), rectangle(4.96, 0.96)}, 0.1).withFibres(),
								polygon({rectangle(5, 1), rectangle(4.96, 0.96)}, 0.1).withFibres(100),
								Section::hollowCircle(s(0.05), s(0.001)).withFibres()};
	const auto isDrawn = [](const Section& section) { return section.m_parts.size() == 0; };
	const auto borne = [](const Section& section, size_t shear, double shearShare, double torsionShare)
	{
		Loaded loaded(capacityOf(section));
		SectionForces6 scaled = {};
		scaled[shear] = shearShare;
		scaled[BT_EP_TORSION] = torsionShare;
		return shareBorne(loaded, scaled);
	};
	for (const Section& section : sections)
		for (const double torsion : {0.1, 0.25, 0.5, 0.75, 0.9})
			for (const size_t shear : {size_t(BT_EP_SHEAR_Y), size_t(BT_EP_SHEAR_Z)})
				// The bound for all six forces. A tenth of a shear is left beside any torsion, so 0.105 measured with that much of it.
				// Drawn boxes: 0.105 measured, and 0.125 of 1 : 5, see limits.md.
				EXPECT_NEAR(1, borne(section, shear, 1 - torsion, torsion),
							isDrawn(section) ? 0.13
							: torsion > 0.8  ? 0.11
											 : 0.08)
					<< "section " << &section - sections << ", " << shear << " beside " << torsion;
}

TEST(ShearInteraction, OfOpenWallsThatRunThroughTheAxisIsNotOfAClosedSection)
{
	// They slip by a twist by as much as they would turn about the axis, as walls around a cell do.
	typedef btElasticPlasticSection Section;
	const auto s = [](double x) { return btScalar(x); };
	std::vector<Shape> shapes = {{"thick T", {}, Section::tSection(s(0.1), s(0.1), s(0.02), s(0.02))},
								 {"thick I", {}, Section::iSection(s(0.1), s(0.2), s(0.02), s(0.02))},
								 {"thick channel", {}, Section::channel(s(0.1), s(0.1), s(0.02), s(0.02))},
								 {"thick angle", {}, Section::angle(s(0.1), s(0.1), s(0.02))}};
	for (Shape& shape : shapes)
	{
		shape.m_exact = openWalls(shape.m_section);
		shape.m_section = shape.m_section.withFibres();
	}
	const auto cross = [](double half, double arm)
	{
		return polygon({{{half, half},
						 {half, arm},
						 {-half, arm},
						 {-half, half},
						 {-1, half},
						 {-1, -half},
						 {-half, -half},
						 {-half, -arm},
						 {half, -arm},
						 {half, -half},
						 {1, -half},
						 {1, half}}},
					   0.1);
	};
	for (const double half : {0.03, 0.1})
		shapes.push_back({half < 0.05 ? "thin cross" : "cross", finePolygon(cross(half, 1), Walls::Open),
						  cross(half, 1).withFibres(36)});
	// Two flat bars that cross each other, given by hand in four layers each.
	Section bars = cross(0.05, 0.5);
	bars.m_fibres.resize(0);
	SectionSurface walls;
	for (const bool isHigh : {true, false})
	{
		const double length = isHigh ? 0.2 : 0.1, thickness = 0.01;
		for (int i = 0; i < 16; ++i)
			for (const double layer : {-0.375, -0.125, 0.125, 0.375})
			{
				const double place = length * ((i + 0.5) / 16 - 0.5), off = layer * thickness;
				btElasticPlasticSectionFibre fibre = {s(isHigh ? place : off), s(isHigh ? off : place),
													  s(length * thickness / 64)};
				fibre.m_bearsShear = true;
				fibre.m_wall[!isHigh] = 1;
				fibre.m_twist[!isHigh] = s((isHigh ? -2 : 2) * off);
				bars.m_fibres.push_back(fibre);
			}
		addWall(walls, 0, 0, isHigh ? length : thickness, isHigh ? thickness : length, 0);
	}
	shapes.push_back({"flat bars", walls, bars});
	for (const Shape& shape : shapes)
		expectRight(shape, repeats(2000, 50));
}

TEST(ShearInteraction, IsRightInFlatSections)
{
	for (const Shape& shape : flatShapes())
		expectRight(shape, repeats(2000, 60));
}

TEST(ShearInteraction, IsRightInSectionsThatAreNotSymmetric)
{
	for (Shape shape : openShapes())
	{
		shape.m_section = shape.m_section.withFibres();
		expectRight(shape, repeats(2000, 50));
	}
}

TEST(ShearInteraction, IsRightInPolygons)
{
	for (const Shape& shape : polygons())
		expectRight(shape, repeats(2000, 25));
	for (const Shape& shape : openShapes())
	{
		// As the walls that it is drawn from, but that the corner of an angle may slip in any direction: 0.925 to 1.095 measured in 2000 directions of
		// that, of the others within 8 %.
		const std::pair<double, double> shares =
			sharesBorne(shape.m_exact, capacityOf(drawn(shape.m_section).withFibres(100)), repeats(2000, 25), true);
		EXPECT_GT(shares.first, 1 - 0.1) << shape.m_name;
		EXPECT_LT(shares.second, 1 + 0.1) << shape.m_name;
	}
}

/// Of a shape that is there in another size, too.
bool isOfOtherSize(const Shape& shape)
{
	return shape.m_name == std::string("square") || shape.m_name == std::string("square box");
}

/// As of cast iron, of timber along its grain, and of concrete.
const double WEAKER[] = {0.3, 0.6, 0.1};

TEST(ShearInteraction, OfUnequalStrengthsHasAReferenceThatIsRight)
{
	for (const double tension : WEAKER)
	{
		SectionSurface square = solidRectangle(1, 1);
		square.m_tension = tension;
		// Stressed evenly: a point of the ellipse through (-1, 0), (0, t_0) and (r, 0). The search ends 2e-6 from it.
		for (const double normal : {-0.9, -0.5, -0.1, 0.05})
		{
			const double shear = std::sqrt((tension - normal) * (normal + 1) / (3 * tension));
			EXPECT_NEAR(1, square.radius({{normal, shear, 0, 0, 0, 0}}), 1e-5) << tension << ", " << normal;
		}
		// Pulled by r above and pressed by 1 below where forces balance, at r / (1 + r) from the edge. Cells are 1/24 wide.
		EXPECT_NEAR(tension / (1 + tension) / 2, square.radius({{0, 0, 0, 0, 0, 1}}), 2e-3) << tension;
	}
}

TEST(ShearInteraction, IsRightOfConcreteWithBars)
{
	// A column with six bars at its sides, and a beam with three below: 1.5 % of steel, 15 times as strong as the concrete, which bears a tenth in tension.
	// Forces are about the middle of the section.
	const double width = 0.3, height = 0.5, tension = 0.1, strength = 15, area = 0.015 / 6 * width * height;
	const std::vector<std::pair<double, double>> bars[] = {
		{{0.21, 0.11}, {0.21, 0}, {0.21, -0.11}, {-0.21, 0.11}, {-0.21, 0}, {-0.21, -0.11}},
		{{-0.21, 0.11}, {-0.21, 0}, {-0.21, -0.11}}};
	for (const auto& places : bars)
	{
		SectionSurface exact = solidRectangle(width, height);
		exact.m_tension = tension;
		btElasticPlasticSection section =
			btElasticPlasticSection::rectangle(btScalar(width), btScalar(height)).withFibres(36);
		btElasticPlasticMaterial steel = materialOf(inPrecision(100, 10), 1);
		steel.m_yieldStress *= btScalar(strength);
		for (const auto& place : places)
		{
			const ShearCell bar = {place.first, place.second, area, {}, {}, strength};
			exact.m_cells.push_back(bar);
			exact.m_warped.push_back(bar);
			section.addBar(btScalar(bar.y), btScalar(bar.z), btScalar(area), steel);
		}
		const std::pair<double, double> shares =
			sharesBorne(exact, capacityOf(section, inPrecision(100, 10), tension), repeats(2000, 20), false);
		// The same bound, kept in 2000 directions. 0.945 to 1.065 measured in 80.
		EXPECT_GT(shares.first, 1 - 0.08) << places.size();
		EXPECT_LT(shares.second, 1 + 0.08) << places.size();
	}
}

TEST(ShearInteraction, IsRightWhereStrengthsAreUnequal)
{
	for (const double tension : WEAKER)
		for (Shape& shape : shapes())
		{
			if (isOfOtherSize(shape))
				continue;
			// Where the pressed part is a tenth of the height the default number of fibres errs by up to 15 % in N and bending alone.
			if (tension < 0.2)
				shape.m_section = shape.m_section.withFibresFor(btScalar(0.01));
			expectRight(shape, tension, repeats(2000, tension < 0.2 ? 5 : 15));
		}
	for (Shape& shape : openShapes())
	{
		shape.m_section = shape.m_section.withFibres();
		expectRight(shape, 0.3, repeats(2000, 10));
	}
	for (const Shape& shape : polygons())
		expectRight(shape, 0.3, repeats(2000, 5));
}

/// The most of one shear beside an axial force, over the strength in compression: the least of h(e, 1) - N e.
double shearBeside(const SectionSurface& exact, size_t dof, double normal)
{
	double from = -5, to = 5;
	const auto at = [&](double elongation)
	{
		SectionForces6 q = {{elongation, 0, 0, 0, 0, 0}};
		q[dof] = 1;
		return exact.support(q) - normal * elongation;
	};
	for (int i = 0; i < 40; ++i)
	{
		const double a = from + (to - from) / 3, b = to - (to - from) / 3;
		(at(a) < at(b) ? to : from) = at(a) < at(b) ? b : a;
	}
	return at((from + to) / 2);
}

/// Moves the body along the axis, up to a share of the axial force's yield value, and then across it or about it, twenty times as far as it takes to yield.
void pressAndSlip(Loaded& loaded, double normal, int dof)
{
	loaded.m_body->setMassProps(btScalar(1e12), btVector3(btScalar(1e12), btScalar(1e12), btScalar(1e12)));
	loaded.m_body->updateInertiaTensor();
	const btElasticPlasticCapacity& capacity = loaded.m_joint->getCapacity();
	const auto elastic = [&](int k) { return capacity.m_yield[k] / capacity.m_stiffness[k]; };
	btVector3 pressing(0, 0, 0), slipping(0, 0, 0);
	pressing[0] = 4 * btScalar(normal) * elastic(0);
	slipping[dof % 3] = 20 * elastic(dof);
	for (int step = 0; step < 240; ++step)
	{
		loaded.m_body->setLinearVelocity(step < 60 ? pressing : dof < 3 ? slipping : btVector3(0, 0, 0));
		loaded.m_body->setAngularVelocity(step < 60 || dof < 3 ? btVector3(0, 0, 0) : slipping);
		loaded.m_world.step(btScalar(1) / 240);
	}
}

TEST(ShearInteraction, SlipsUnderAPressureAsItsStrengthsSay)
{
	// What slips needs no room for it: the normal force stays, or goes to where it is at most half of the way between the strengths or nothing at all.
	for (const double tension : WEAKER)
		for (Shape& shape : shapes())
		{
			if (isOfOtherSize(shape))
				continue;
			shape.m_exact.m_tension = tension;
			const SectionForces6 alone = shape.m_exact.aloneAtRest();
			const btElasticPlasticCapacity capacity = capacityOf(shape.m_section, 1, tension);
			for (const double normal : {-0.8, -0.5, -0.2, 0., 0.5 * tension})
				for (const int dof : {BT_EP_SHEAR_Y, BT_EP_SHEAR_Z})
				{
					Loaded loaded(capacity);
					pressAndSlip(loaded, normal, dof);
					const double yield[2] = {double(capacity.m_yield[0]), double(capacity.m_yield[dof])};
					const double shear = double(loaded.m_joint->getForce(dof)) / yield[1],
								 stays = double(loaded.m_joint->getForce(0)) / yield[0],
								 exact = shearBeside(shape.m_exact, size_t(dof), stays * alone[0]) / alone[size_t(dof)];
					// 0.981 to 1.001 measured: fibres on walls are where the web's middle is, and not all over it.
					EXPECT_NEAR(1, shear / exact, 0.03) << shape.m_name << ", " << tension << " at " << normal;
					// Stressed between both, none of its fibres moves along the axis.
					if (normal <= 0 && normal >= (tension - 1) / 2)
					{
						EXPECT_NEAR(normal, stays, 0.01) << shape.m_name << ", " << tension;
					}
				}
		}
}

/// Three blocks in a row, free to fly, that are struck at random every few steps so that their joints flow in all directions.
class StruckRow
{
public:
	StruckRow(const btElasticPlasticCapacity& capacity, unsigned seed)
		: m_random(seed), m_world(Solver::Direct, btVector3(0, 0, 0))
	{
		btCollisionShape* const shape = m_world.box(btVector3(btScalar(0.1), btScalar(0.2), btScalar(0.2)));
		for (int i = 0; i < 3; ++i)
		{
			m_bodies.push_back(m_world.body(30, shape, at(btScalar(0.1 * i)), false));
			m_bodies.back()->setFlags(0);
			if (i > 0)
				m_joints.push_back(m_world.joint(*m_bodies[size_t(i - 1)], *m_bodies[size_t(i)],
												 at(btScalar(0.1 * (i - 0.5))), capacity));
		}
		for (int k = 0; k < 6; ++k)
			m_flow += double(capacity.m_yield[k] * capacity.m_yield[k] / capacity.m_stiffness[k]);
	}

	/// Some times the energy with which the joints begin to flow.
	void strike()
	{
		std::normal_distribution<double> normal;
		const double energy = std::pow(10, std::uniform_real_distribution<double>(-1, 1.5)(m_random)) * m_flow;
		for (btRigidBody* body : m_bodies)
		{
			const auto any = [&](double share, double inertia)
			{
				const btScalar speed = btScalar(std::sqrt(2 * share * energy / inertia / 3));
				return speed *
					   btVector3(btScalar(normal(m_random)), btScalar(normal(m_random)), btScalar(normal(m_random)));
			};
			body->setLinearVelocity(body->getLinearVelocity() + any(0.5, 30));
			body->setAngularVelocity(body->getAngularVelocity() +
									 any(0.5, 1 / double(body->getInvInertiaDiagLocal().y())));
		}
	}

	double held() const
	{
		double sum = m_world.kineticEnergy();
		for (const btElasticPlasticJoint* joint : m_joints)
			sum += joint->getElasticEnergy() + joint->getPlasticEnergy();
		return sum;
	}

	std::mt19937 m_random;
	World m_world;
	std::vector<btRigidBody*> m_bodies;
	std::vector<btElasticPlasticJoint*> m_joints;
	double m_flow = 0;
};

TEST(ShearInteraction, OfUnequalStrengthsMakesNoEnergyAndIsFoundInFewSteps)
{
	unsigned seed = 0;  // goes on from shape to shape, so that all step lengths are tried
	std::vector<Shape> all = shapes();
	for (const Shape& polygon : polygons())
		if (polygon.m_name == std::string("triangle") || polygon.m_name == std::string("two cells"))
			all.push_back(polygon);
	for (const double tension : WEAKER)
	{
		btElasticPlasticStatistics statistics;
		for (const Shape& shape : all)
		{
			double slipped = 0, plastic = 0;
			for (int trial = 0; trial < repeats(10, 2); ++trial, ++seed)
			{
				StruckRow row(capacityOf(shape.m_section, 1, tension), seed);
				EnergyAudit audit(row.m_world);
				const int rate = 60 << seed % 6;
				double given = 0;
				for (int i = 0; i < 200; ++i)
				{
					const double before = row.m_world.kineticEnergy();
					if (i % 20 == 0)
						row.strike();
					given += row.m_world.kineticEnergy() - before;
					audit.step(btScalar(1) / rate);
					// Flow is counted by a step's last velocity: 1.1e-4 measured, and 0.6e-4 of sections of equal strengths.
					EXPECT_LE(row.held(), given * (1 + 1e-3)) << shape.m_name << ", " << tension << " at step " << i;
				}
				// The same: 1.2e-4 measured, and 3.2e-4 of equal strengths.
				EXPECT_LE(audit.createdByJoints(), 1e-3) << shape.m_name << ", " << tension;
				statistics += solverOf(row.m_world).getStatistics();
				for (const btElasticPlasticJoint* joint : row.m_joints)
				{
					plastic += joint->getPlasticEnergy();
					for (int dof = BT_EP_SHEAR_Y; dof <= BT_EP_TORSION; ++dof)
						slipped += double(joint->getPlasticPath(dof) * joint->getCapacity().m_yield[dof]);
				}
			}
			EXPECT_GT(slipped, 0.3 * plastic) << shape.m_name << ", " << tension;
		}
		EXPECT_EQ(0, statistics.m_cutSearches) << tension;
		EXPECT_EQ(0, statistics.m_notFinite) << tension;
		// 0.10 to 0.28 measured beyond the first linear solution, 0.04 to 0.19 of sections of equal strengths.
		EXPECT_LT(statistics.m_newtonSteps, 0.5 * double(statistics.m_islands)) << tension;
	}
}

TEST(ShearInteraction, PressureAddsNothingToWhatHasNextToNoTension)
{
	// By the ellipse it would be half of what is between the strengths, which is out of all proportion to what they bear of shear without it. A section's
	// material may be such, its fibres by themselves, or what a fire leaves of them.
	const btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.2)).withFibres();
	for (const double tension : {1e-6, 1e-3, 0.09})
		for (const bool byHand : {false, true})
		{
			btElasticPlasticCapacity capacity = capacityOf(section, 1, byHand ? 0.3 : tension);
			for (int i = 0; i < capacity.m_fibres.size() && byHand; ++i)
				capacity.m_fibres[i].m_tension = btScalar(tension) * capacity.m_fibres[i].m_compression;
			for (int dof = BT_EP_SHEAR_Y; dof <= BT_EP_TORSION; ++dof)
			{
				// By itself it bears just what it was given.
				Loaded loaded(capacity);
				pressAndSlip(loaded, -0.4, dof);
				EXPECT_NEAR(1, double(loaded.m_joint->getForce(dof) / capacity.m_yield[dof]), 1e-3)
					<< tension << (byHand ? " by hand" : "") << ", " << dof;
			}
		}
}

TEST(ShearInteraction, IsLeftOutWhereItIsNotAskedFor)
{
	// Each of them by itself: the box of forces reaches beyond the surface where all act.
	const Shape shape = shapes()[0];
	const btElasticPlasticSection apart =
		btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.2)).withFibres(0, false);
	// Where all three are alike, each at 0.6.
	const SectionForces6 scaled = scaledToSurface(shape.m_exact, {{1, 1, 0, 1, 0, 0}});
	Loaded whole(capacityOf(shape.m_section)), loose(capacityOf(apart));
	EXPECT_GT(shareBorne(loose, scaled), 1.5);
	EXPECT_NEAR(1, shareBorne(whole, scaled), 0.08);
}

/// Calls f with each shape, its capacity, and forces on its surface in 20 directions.
template <class F>
void forSomeDirections(unsigned seed, F f)
{
	std::mt19937 random(seed);
	for (const Shape& shape : shapes())
	{
		const btElasticPlasticCapacity capacity = capacityOf(shape.m_section);
		for (int i = 0; i < 20; ++i)
			f(shape, capacity, scaledToSurface(shape.m_exact, anyDirection(random)));
	}
}

TEST(ShearInteraction, IsTheSameInAnyFrameAndWithEitherBodyFirst)
{
	double sum = 0;
	int count = 0;
	forSomeDirections(
		2,
		[&](const Shape& shape, const btElasticPlasticCapacity& capacity, const SectionForces6& scaled)
		{
			Loaded plain(capacity);
			const double share = shareBorne(plain, scaled);
			for (const bool isReversed : {false, true})
				for (const double sign : {-1., 1.})
				{
					SectionForces6 signedForces = scaled;
					for (double& f : signedForces)
						f *= sign;
					Loaded loaded(capacity, isReversed, btQuaternion(btVector3(1, 2, 3).normalized(), 2));
					const double difference = std::fabs(share - shareBorne(loaded, signedForces));
					// Rounding tells which fibre flows first, and with it by up to 0.015 what the section bears in the end, as loads in steps of
					// 0.0025 show. In steps of 0.01 that is two of them in 4 to 8 of 1600 directions with any compiler, with -ffast-math or without,
					// and one with the stiffer springs of double.
					EXPECT_LT(difference, inPrecision(0.011, 0.021)) << shape.m_name;
					sum += difference;
					++count;
				}
		});
	// A frame has no part in it: most bear the same to the step. 0.0001 measured in 1600 directions in double; 0.0007 in float.
	EXPECT_LT(sum / count, inPrecision(0.0005, 0.0015));
}

TEST(ShearInteraction, IsTheSameInTheIterativeForm)
{
	double sum = 0;
	int count = 0;
	forSomeDirections(3,
					  [&](const Shape&, const btElasticPlasticCapacity& capacity, const SectionForces6& scaled)
					  {
						  Loaded exact(capacity), swept(capacity, false, btQuaternion(0, 0, 0, 1), Solver::Iterative);
						  sum += std::fabs(shareBorne(exact, scaled) - shareBorne(swept, scaled));
						  ++count;
					  });
	// The rows of one joint in the middle of its body do not disturb each other: one iteration is enough, and what is left is rounding, as in another frame.
	EXPECT_LT(sum / count, inPrecision(0.0005, 0.0015));
}

TEST(ShearInteraction, BearsWhatIsBelowItsStrengthForEver)
{
	// At 0.9 times what it bears, to and fro, in directions in which shear, torsion, bending and axial force all count: nothing grows.
	std::mt19937 random(3);
	for (const Shape& shape : shapes())
		for (int i = 0; i < 5; ++i)
		{
			const btElasticPlasticCapacity capacity = capacityOf(shape.m_section);
			SectionForces6 scaled = scaledToSurface(shape.m_exact, anyDirection(random));
			Loaded loaded(capacity);
			double path[2] = {};
			for (int half = 0; half < 40; ++half)
			{
				for (int step = 0; step <= 20; ++step)
				{
					SectionForces6 now;
					const double share = 0.9 * (half % 2 ? -1 : 1) * std::sin(step * PI / 20);
					for (size_t k = 0; k < 6; ++k)
						now[k] = share * scaled[k] * double(capacity.m_yield[k]);
					loaded.bears(now);
				}
				path[half >= 20] = loaded.m_joint->getPlasticEnergy();
			}
			// Fibres that have flowed at first to and fro go on to, as those at the edge of a section do beyond its first yield; the section
			// itself does not.
			EXPECT_LE(path[1] - path[0], 1.1 * path[0] + 1e-3) << shape.m_name;
		}
}

TEST(ShearInteraction, DissipatesWhatTheSurfaceDoesWhenItIsMoved)
{
	// A body that goes its way: the force is that of the surface's point whose normal is the way, and stays there.
	std::mt19937 random(4);
	for (const Shape& shape : shapes())
	{
		const btElasticPlasticCapacity capacity = capacityOf(shape.m_section);
		for (int i = 0; i < 10; ++i)
			for (const int rate : {60, 960})
			{
				Loaded loaded(capacity);
				loaded.m_body->setMassProps(btScalar(1e9), btVector3(btScalar(1e9), btScalar(1e9), btScalar(1e9)));
				loaded.m_body->updateInertiaTensor();
				const SectionForces6 way = anyDirection(random), alone = shape.m_exact.alone();
				SectionForces6 q;
				// Each by some hundred times a second what is elastic of it: it flows after a hundredth, and has not turned when it is over.
				btVector3 velocity[2];
				for (size_t k = 0; k < 6; ++k)
				{
					const double speed = 100 * way[k] * double(capacity.m_yield[k]) / double(capacity.m_stiffness[k]);
					velocity[k / 3][int(k % 3)] = btScalar(speed);
					q[k] = speed * double(capacity.m_yield[k]) / alone[k];
				}
				const double exact = shape.m_exact.support(q);
				for (const double sign : {1., -1.})
				{
					double power = 0;
					for (int step = 0; step < rate / 2; ++step)
					{
						loaded.m_body->setLinearVelocity(velocity[0] * btScalar(sign));
						loaded.m_body->setAngularVelocity(velocity[1] * btScalar(sign));
						loaded.m_world.step(btScalar(1) / rate);
						const double before = power;
						power = 0;
						for (int k = 0; k < 6; ++k)
							power += sign * double(velocity[k / 3][k % 3]) * double(loaded.m_joint->getForce(k));
						// It has come to rest there, but for what a step's lag makes near the edges of a surface of few fibres: from step to
						// step it may go from one corner to its neighbour and back, by 4.4 % at the most. (It was 2 % where an elastic slip counted as flow, by which stiff joints lost a quarter of their moment: Fibres.HoldABeamThatIsStruckAsACableDoes.)
						if (step > rate * 9 / 20)
						{
							EXPECT_NEAR(before, power, 0.05 * exact) << shape.m_name;
						}
					}
					EXPECT_NEAR(exact, power, 0.08 * exact) << shape.m_name << " " << i << " at " << rate;
				}
			}
	}
}

/// A mass on two springs at right angles that flow together on a circle: N and V over what each could be alone, by steps that are short.
void integrate(double mass, const double k[2], const double yield[2], double pull, double speed, double time,
			   double plastic[2])
{
	double v[2] = {0, speed}, x[2] = {0, 0}, f[2];
	plastic[0] = plastic[1] = 0;
	const double dt = 1e-7;
	for (int i = 0; i < int(time / dt); ++i)
	{
		const double trial[2] = {k[0] * (x[0] - plastic[0]) / yield[0], k[1] * (x[1] - plastic[1]) / yield[1]};
		double n[2] = {trial[0], trial[1]};
		if (std::hypot(n[0], n[1]) > 1)
		{
			// The nearest point by energy: n_j = trial_j / (1 + l c_j) with c_j = k_j / yield_j^2.
			double l = 0;
			const double c[2] = {k[0] / (yield[0] * yield[0]), k[1] / (yield[1] * yield[1])};
			for (int it = 0; it < 20; ++it)
			{
				double sum = -1, slope = 0;
				for (int j = 0; j < 2; ++j)
				{
					n[j] = trial[j] / (1 + l * c[j]);
					sum += n[j] * n[j];
					slope -= 2 * n[j] * n[j] * c[j] / (1 + l * c[j]);
				}
				l -= sum / slope;
			}
			for (int j = 0; j < 2; ++j)
				plastic[j] = x[j] - n[j] * yield[j] / k[j];
		}
		for (int j = 0; j < 2; ++j)
		{
			f[j] = (j == 0 ? pull : 0) - n[j] * yield[j];
			v[j] += dt * f[j] / mass;
			x[j] += dt * v[j];
		}
	}
}

TEST(ShearInteraction, ABlowAcrossIsStoppedAsByTheFlowOfTheSurface)
{
	// A mass that is pulled along the axis and struck across it. All fibres are stressed alike: N and V flow on a circle.
	const btElasticPlasticCapacity c =
		capacityOf(btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(), 1);
	const double k[2] = {double(c.m_stiffness[0]), double(c.m_stiffness[1])},
				 yield[2] = {double(c.m_yield[0]), double(c.m_yield[1])}, speed = 4, mass = 5000;
	for (const double pull : {0.3, 0.6})
	{
		double exact[2];
		integrate(mass, k, yield, pull * yield[0], speed, 0.05, exact);
		double errors[2][2];
		for (const int fine : {0, 1})
		{
			const int rate = fine ? 15360 : 3840;
			Loaded loaded(c);
			loaded.m_body->setMassProps(btScalar(mass), btVector3(1, 1, 1));
			loaded.m_body->setAngularFactor(0);
			loaded.m_body->setLinearVelocity(btVector3(0, btScalar(speed), 0));
			EnergyAudit audit(loaded.m_world);
			for (int i = 0; i < rate / 20; ++i)
			{
				loaded.m_body->applyCentralForce(btVector3(btScalar(pull * yield[0]), 0, 0));
				audit.step(btScalar(1) / rate);
				const double n = double(loaded.m_joint->getForce(0)) / yield[0],
							 v = double(loaded.m_joint->getForce(1)) / yield[1];
				EXPECT_LT(std::hypot(n, v), 1.02);
			}
			EXPECT_LT(audit.created(), byPrecision(1e-9, 1e-5));
			for (int j = 0; j < 2; ++j)
				errors[fine][j] = std::fabs(double(loaded.m_joint->getPlasticDeformation(j)) / exact[j] - 1);
		}
		// Bounds follow the flow a step late: of the first order of the step. The way along the axis is a fifth of the other.
		EXPECT_LT(errors[1][0], 0.04);
		EXPECT_LT(errors[1][1], 0.005);
		EXPECT_LT(errors[1][0], 0.35 * errors[0][0]);
		EXPECT_LT(errors[1][1], 0.35 * errors[0][1]);
	}
}
}  // namespace testShearInteraction
