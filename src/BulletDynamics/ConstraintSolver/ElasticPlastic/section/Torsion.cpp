// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Torsion.h"

#include <math.h>

#include "LinearMath/btMinMax.h"
#include "Slips.h"

namespace btElasticPlastic
{
namespace
{
const int PIECES = 2000, LEVELS = 200;
/// Slopes whose squares are below this are those of a ridge: elsewhere the roof rises by 1.
const double FLAT = 0.1;
/// By how much the torsion constant of elastic slips is above that of the roof where the latter is next to exact: thin walls, circles. And more than this it is
/// only where walls stand too close to each other for the grid of the slips.
const double ALIKE = 1.03, APART = 1.5;

double gapBetween(const Region::Outline& a, const Region::Outline& b)
{
	double least = distanceTo(a, b[0]);
	for (const Region::Point& p : b)
		least = btMin(least, distanceTo(a, p));
	for (const Region::Point& p : a)
		least = btMin(least, distanceTo(b, p));
	return least;
}

/// The roof's height over each outline: 0 over the outer one, the first, and over a hole the shortest way from there, through holes for nothing.
std::vector<double> heightsOf(const std::vector<Region::Outline>& outlines)
{
	const size_t n = outlines.size();
	std::vector<double> heights(n, 0.);
	for (size_t i = 1; i < n; ++i)
		heights[i] = gapBetween(outlines[0], outlines[i]);
	for (size_t round = 1; round < n; ++round)
		for (size_t i = 1; i < n; ++i)
			for (size_t j = 1; j < n; ++j)
				if (i != j)
					heights[i] = btMin(heights[i], heights[j] + gapBetween(outlines[i], outlines[j]));
	return heights;
}

/// A bound from above, but for what the grid makes of it: right within 0.6 % of compact figures, and up to 3 % high where a closed wall is thin.
double constantOfSlips(const std::vector<SectionPoint>& points)
{
	const std::vector<Slips> slips = slipsOf(points);
	double constant = 0;
	for (size_t i = 0; i < points.size(); ++i)
	{
		const Region::Point& twist = slips[i].m_twist;
		constant += points[i].m_area * (twist.m_y * twist.m_y + twist.m_z * twist.m_z);
	}
	return constant;
}
}  // namespace

Torsion torsionOf(const Region& region)
{
	const std::vector<double> heights = heightsOf(region.m_outlines);
	const auto roofAt = [&](const Region::Point& p)
	{
		double roof = distanceTo(region.m_outlines[0], p);
		for (size_t h = 1; h < heights.size(); ++h)
			roof = btMin(roof, heights[h] + distanceTo(region.m_outlines[h], p));
		return roof;
	};
	/// By how much the roof falls from the middle of a piece to its sides, as of a rectangle's.
	const auto dropAcross = [&](const Region::Moments& m, double roof)
	{
		const PrincipalMoments own = principalMoments(m.centred());
		const double c = own.m_axis[0], s = own.m_axis[1];
		double drop = 0;
		for (int axis = 0; axis < 2; ++axis)
			for (const double way : {-1., 1.})
			{
				const double reach = way * sqrt(3 * (axis == 0 ? own.m_greater : own.m_lesser) / m.m_area);
				const Region::Point side = {m.m_y / m.m_area + reach * (axis == 0 ? c : -s),
											m.m_z / m.m_area + reach * (axis == 0 ? s : c)};
				drop = btMax(drop, roof - roofAt(side));
			}
		return drop;
	};
	/// A piece of the figure, and between which heights the roof over it lies.
	struct Tile
	{
		double m_area, m_low, m_high;
	};
	std::vector<Region> pieces;
	region.cut(region.moments().m_area / PIECES, pieces);
	std::vector<Tile> tiles;
	double volume = 0, highest = 0;
	std::vector<SectionPoint> points;
	for (const Region& piece : pieces)
	{
		const Region::Moments m = piece.moments();
		addPointsOf(m, points);
		const Region::Point middle = {m.m_y / m.m_area, m.m_z / m.m_area};
		const double roof = roofAt(middle), off = 1e-3 * sqrt(m.m_area);
		const double slopeY =
						 (roofAt({middle.m_y + off, middle.m_z}) - roofAt({middle.m_y - off, middle.m_z})) / off / 2,
					 slopeZ =
						 (roofAt({middle.m_y, middle.m_z + off}) - roofAt({middle.m_y, middle.m_z - off})) / off / 2;
		const Region::Moments own = m.centred();
		const double square = slopeY * slopeY * own.m_yy + 2 * slopeY * slopeZ * own.m_yz + slopeZ * slopeZ * own.m_zz;
		// As of a rectangle with a side along the line of even height; of one that the roof's ridge divides, half of it to either side.
		const bool isRidge = slopeY * slopeY + slopeZ * slopeZ < FLAT;
		const double half = sqrt(btMax(3 * square / m.m_area, 0.)), down = isRidge ? dropAcross(m, roof) : half;
		const Tile tile = {m.m_area, btMax(roof - down, 0.), isRidge ? roof : roof + half};
		volume += tile.m_area * (isRidge ? (tile.m_low + tile.m_high) / 2 : roof);
		highest = btMax(highest, tile.m_high);
		tiles.push_back(tile);
	}
	for (size_t h = 1; h < heights.size(); ++h)
		volume -= areaOf(region.m_outlines[h]) * heights[h];

	const double step = highest / LEVELS;
	double inLevel[LEVELS] = {};
	for (const Tile& tile : tiles)
	{
		const double high = btMax(tile.m_high, tile.m_low + 1e-9 * step);
		for (int k = btMin(int(tile.m_low / step), LEVELS - 1); k < LEVELS && k * step < high; ++k)
			inLevel[k] += tile.m_area * btMax(0., btMin(high, (k + 1) * step) - btMax(tile.m_low, k * step)) /
						  (high - tile.m_low);
	}
	double constant = 0, within = 0;
	for (int k = LEVELS - 1; k >= 0; --k)
	{
		for (size_t h = 1; h < heights.size(); ++h)
			if (btMin(int(heights[h] / step - 0.5), LEVELS - 1) == k)
				within -= areaOf(region.m_outlines[h]);
		const double inner = within;
		within += inLevel[k];
		if (inLevel[k] > 0)
			constant += 4. / 3 * (inner * inner + inner * within + within * within) * step * step / inLevel[k];
	}
	const double above = constantOfSlips(points);
	const bool isAbove = above > ALIKE * constant && above < APART * constant;
	// Nothing is stiffer than if it did not warp, as circles do not.
	const Region::Moments all = region.moments().centred();
	return {btMin(isAbove ? above : constant, all.m_yy + all.m_zz), 2 * volume};
}
}  // namespace btElasticPlastic
