// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Connections as sections: what bears is their bolts or welds.

#include "btElasticPlasticSection.h"

#include "ElasticPlastic/section/CellStrength.h"
#include "ElasticPlastic/section/Convex.h"
#include "ElasticPlastic/section/Region.h"
#include "LinearMath/btMinMax.h"

#include <math.h>

using namespace btElasticPlastic;

namespace
{
const double STRAIGHT_ANGLE = 3.14159265358979323846;
const int MOST_FASTENERS = 400, PIECES_OF_A_WELD = 100;

/// Round or straight, by its middle in the axes in which it was given.
struct Fastener
{
	double m_y, m_z;
	double m_area;
	double m_length;  ///< of a weld; 0 of a bolt
	double m_turn;    ///< of a weld, against y

	/// Second moments about its middle, along it and across.
	double along() const
	{
		return m_length > 0 ? m_area * m_length * m_length / 12 : m_area * m_area / (4 * STRAIGHT_ANGLE);
	}
	double across() const { return m_length > 0 ? pow(m_area / m_length, 2) * m_area / 12 : along(); }

	/// Pieces of it, small enough to be a point each. Those of a weld lie in two rows, which bear a moment about its line as it does.
	void cut(std::vector<Cell>& cells) const
	{
		if (m_length == 0)
		{
			cells.push_back({m_y, m_z, m_area, m_area});
			return;
		}
		const double c = cos(m_turn), s = sin(m_turn), throat = m_area / m_length, area = m_area / PIECES_OF_A_WELD;
		for (int i = 0; i < PIECES_OF_A_WELD; ++i)
		{
			const double u = (i / 2 * 2 + 1. - PIECES_OF_A_WELD / 2) / PIECES_OF_A_WELD * m_length,
						 v = (i % 2 == 0 ? 0.25 : -0.25) * throat;
			cells.push_back({m_y + c * u - s * v, m_z + s * u + c * v, area, area});
		}
	}
};

/// Torsion about x that pieces bear, each by its shear in whatever direction: the least of what they dissipate in a turn about any place.
double plasticTorsion(const std::vector<Cell>& cells, double size)
{
	return leastOf(
		[&](double y)
		{
			return leastOf(
				[&](double z)
				{
					double sum = 0;
					for (const Cell& cell : cells)
						sum += cell.m_tension * hypot(cell.m_y - y, cell.m_z - z);
					return sum;
				},
				size);
		},
		size);
}

btElasticPlasticSection sectionOfFasteners(std::vector<Fastener> fasteners)
{
	btElasticPlasticSection s;
	Region::Moments given;
	for (const Fastener& f : fasteners)
	{
		const double c = cos(f.m_turn), n = sin(f.m_turn);
		given.m_area += f.m_area;
		given.m_y += f.m_area * f.m_y;
		given.m_z += f.m_area * f.m_z;
		given.m_yy += f.m_area * f.m_y * f.m_y + f.along() * c * c + f.across() * n * n;
		given.m_zz += f.m_area * f.m_z * f.m_z + f.along() * n * n + f.across() * c * c;
		given.m_yz += f.m_area * f.m_y * f.m_z + (f.along() - f.across()) * c * n;
	}
	const double turn = nearestPrincipalTurn(given.centred()), y = given.m_y / given.m_area,
				 z = given.m_z / given.m_area, c = cos(turn), n = sin(turn);
	s.m_centroid[0] = btScalar(y);
	s.m_centroid[1] = btScalar(z);
	s.m_turn = btScalar(turn);
	double second[2] = {}, outer[2] = {};
	std::vector<Cell> cells;
	for (Fastener& f : fasteners)
	{
		const double u = f.m_y - y, v = f.m_z - z;
		f.m_y = c * u + n * v;
		f.m_z = c * v - n * u;
		f.m_turn -= turn;
		f.cut(cells);
		const double alongY = fabs(cos(f.m_turn)), alongZ = fabs(sin(f.m_turn)),
					 throat = f.m_length > 0 ? f.m_area / f.m_length : 0,
					 radius = f.m_length > 0 ? 0 : sqrt(f.m_area / STRAIGHT_ANGLE);
		second[0] += f.m_area * f.m_z * f.m_z + f.along() * alongZ * alongZ + f.across() * alongY * alongY;
		second[1] += f.m_area * f.m_y * f.m_y + f.along() * alongY * alongY + f.across() * alongZ * alongZ;
		outer[0] = btMax(outer[0], fabs(f.m_y) + (alongY * f.m_length + alongZ * throat) / 2 + radius);
		outer[1] = btMax(outer[1], fabs(f.m_z) + (alongZ * f.m_length + alongY * throat) / 2 + radius);
		btElasticPlasticSectionPart part;
		part.m_y = btScalar(f.m_y);
		part.m_z = btScalar(f.m_z);
		part.m_height = btScalar(f.m_length);
		part.m_width = btScalar(throat);
		part.m_turn = btScalar(f.m_turn);
		part.m_radius = btScalar(radius);
		s.m_parts.push_back(part);
	}
	// Of bolts about their own middles, which counts where they stand in a row, or one alone: its moduli are 4/3 r^3 and 2 pi/3 r^3.
	double own = 0;
	for (const Fastener& f : fasteners)
		own += f.m_length > 0 ? 0 : 2. / 3 * pow(f.m_area / STRAIGHT_ANGLE, 1.5);
	const double size = btMax(outer[0], outer[1]);
	s.m_area = btScalar(given.m_area);
	for (int i = 0; i < 2; ++i)
	{
		s.m_shearArea[i] = s.m_plasticShearArea[i] = s.m_area;
		s.m_secondMoment[i] = btScalar(second[i]);
		s.m_outerFibre[i] = btScalar(outer[i]);
		s.m_plasticModulus[i] = btScalar(strengthAlone(cells, i == 0 ? MOMENT_Y : MOMENT_Z));
		btSetMax(s.m_plasticModulus[i], btScalar(2 * own));
	}
	s.m_torsionConstant = btScalar(second[0] + second[1]);
	s.m_plasticTorsionModulus = btScalar(btMax(plasticTorsion(cells, size), STRAIGHT_ANGLE * own));
	return s;
}

bool isNumberOfFasteners(btElasticPlasticSection& section, const char* quantity, int count)
{
	if (count < 1 || count > MOST_FASTENERS)
		section.m_fault = btElasticPlasticFault(quantity, btScalar(count), "1 to 400");
	return !section.m_fault;
}
}  // namespace

btElasticPlasticSection btElasticPlasticSection::bolts(const btElasticPlasticSectionPoint* places, int count,
													   btScalar area)
{
	btElasticPlasticSection s;
	s.m_fault = btElasticPlasticCheckPositive("area of a bolt [m^2]", area);
	if (s.m_fault || !isNumberOfFasteners(s, "number of bolts", places ? count : 0))
		return s;
	std::vector<Fastener> fasteners;
	for (int i = 0; i < count; ++i)
	{
		const double y = places[i].m_y, z = places[i].m_z;
		if (!btElasticPlasticIsFinite(y + z))
			s.m_fault = btElasticPlasticFault("place of a bolt, y + z [m]", btScalar(y + z), "finite");
		fasteners.push_back({y, z, double(area), 0, 0});
	}
	return s.m_fault ? s : sectionOfFasteners(fasteners);
}

btElasticPlasticSection btElasticPlasticSection::welds(const btElasticPlasticSectionLine* lines, int count,
													   btScalar throat)
{
	btElasticPlasticSection s;
	s.m_fault = btElasticPlasticCheckPositive("throat of a weld [m]", throat);
	if (s.m_fault || !isNumberOfFasteners(s, "number of welds", lines ? count : 0))
		return s;
	std::vector<Fastener> fasteners;
	for (int i = 0; i < count && !s.m_fault; ++i)
	{
		const btElasticPlasticSectionPoint &a = lines[i].m_from, &b = lines[i].m_to;
		const double y = double(b.m_y) - double(a.m_y), z = double(b.m_z) - double(a.m_z), length = hypot(y, z);
		if (!btElasticPlasticIsFinite(length) || !(length > double(throat)))
			s.m_fault =
				btElasticPlasticFault("length of a weld [m]", btScalar(length), "finite, and more than its throat");
		fasteners.push_back({(double(a.m_y) + double(b.m_y)) / 2, (double(a.m_z) + double(b.m_z)) / 2,
							 length * double(throat), length, atan2(z, y)});
	}
	return s.m_fault ? s : sectionOfFasteners(fasteners);
}
