// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SLIPS_H
#define BT_ELASTIC_PLASTIC_SLIPS_H

#include <vector>

#include "Region.h"

namespace btElasticPlastic
{
/// A point of integration over a figure.
struct SectionPoint
{
	double m_y, m_z, m_area;
};

/// How a figure slips at a point when all of it slips by 1 along y or along z, or is twisted by 1 about the origin.
struct Slips
{
	Region::Point m_alongY, m_alongZ, m_twist;
};

/// As it slips elastically: it warps so that the integral of the slip's square is the least. By that thin walls slip along themselves, and of a twist it is
/// Saint-Venant's torsion; about which point that turns makes no difference. By shears it does not warp as a plane that turns.
///
/// The warping is of second degree along both sides of the cells of a grid, so walls may be thinner than a cell. Those that are as close to each other as a cell warp together.
///
/// \param points  some in each cell, with the figure's area and moments of inertia: see addPointsOf()
std::vector<Slips> slipsOf(const std::vector<SectionPoint>& points);

/// Sums of the products of the slips by both shears, as centred moments: by their principal axes the ways in which it slips most and least.
Region::Moments shearProducts(const Slips& slips);

const int POINTS_OF_A_PIECE = 4;

/// Adds points that stand for a piece of a figure, with its area and moments of inertia.
void addPointsOf(const Region::Moments& piece, std::vector<SectionPoint>& points);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SLIPS_H
