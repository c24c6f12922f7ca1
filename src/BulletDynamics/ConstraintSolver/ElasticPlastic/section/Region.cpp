// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Region.h"

#include <math.h>

#include "LinearMath/btMinMax.h"

namespace btElasticPlastic
{
namespace
{
double wedge(const Region::Point& a, const Region::Point& b) { return a.m_y * b.m_z - b.m_y * a.m_z; }

/// Twice the area of a triangle, positive if it is passed with the inside to the left.
double turnOf(const Region::Point& a, const Region::Point& b, const Region::Point& c)
{
	return wedge({b.m_y - a.m_y, b.m_z - a.m_z}, {c.m_y - a.m_y, c.m_z - a.m_z});
}

const Region::Point& after(const Region::Outline& outline, size_t corner)
{
	return outline[corner + 1 < outline.size() ? corner + 1 : 0];
}

/// Of a point on the line through a and b.
bool isBetween(const Region::Point& p, const Region::Point& a, const Region::Point& b)
{
	return btMin(a.m_y, b.m_y) <= p.m_y && p.m_y <= btMax(a.m_y, b.m_y) && btMin(a.m_z, b.m_z) <= p.m_z &&
		   p.m_z <= btMax(a.m_z, b.m_z);
}

bool doMeet(const Region::Point& a, const Region::Point& b, const Region::Point& c, const Region::Point& d)
{
	const double abc = turnOf(a, b, c), abd = turnOf(a, b, d), cda = turnOf(c, d, a), cdb = turnOf(c, d, b);
	if ((abc > 0) != (abd > 0) && (cda > 0) != (cdb > 0) && abc != 0 && abd != 0 && cda != 0 && cdb != 0)
		return true;
	return (abc == 0 && isBetween(c, a, b)) || (abd == 0 && isBetween(d, a, b)) || (cda == 0 && isBetween(a, c, d)) ||
		   (cdb == 0 && isBetween(b, c, d));
}
}  // namespace

Region::Moments Region::Moments::centred() const
{
	Moments own = *this;
	own.m_y = own.m_z = 0;
	own.m_yy -= m_y * m_y / m_area;
	own.m_zz -= m_z * m_z / m_area;
	own.m_yz -= m_y * m_z / m_area;
	return own;
}

Region::Moments Region::moments() const
{
	Moments sum;
	for (const Outline& outline : m_outlines)
		for (size_t i = 0; i < outline.size(); ++i)
		{
			const Point &a = outline[i], &b = after(outline, i);
			const double twice = wedge(a, b);
			sum.m_area += twice / 2;
			sum.m_y += twice * (a.m_y + b.m_y) / 6;
			sum.m_z += twice * (a.m_z + b.m_z) / 6;
			sum.m_yy += twice * (a.m_y * a.m_y + a.m_y * b.m_y + b.m_y * b.m_y) / 12;
			sum.m_zz += twice * (a.m_z * a.m_z + a.m_z * b.m_z + b.m_z * b.m_z) / 12;
			sum.m_yz += twice * (2 * (a.m_y * a.m_z + b.m_y * b.m_z) + a.m_y * b.m_z + b.m_y * a.m_z) / 24;
		}
	return sum;
}

/// Sutherland and Hodgman's clipping, outline by outline.
Region Region::below(double alongY, double alongZ, double limit) const
{
	Region part;
	Outline kept;
	for (const Outline& outline : m_outlines)
	{
		kept.clear();
		for (size_t i = 0; i < outline.size(); ++i)
		{
			const Point &a = outline[i], &b = after(outline, i);
			const double beyondA = alongY * a.m_y + alongZ * a.m_z - limit,
						 beyondB = alongY * b.m_y + alongZ * b.m_z - limit;
			if (beyondA <= 0)
				kept.push_back(a);
			if ((beyondA <= 0) == (beyondB <= 0))
				continue;
			const double share = beyondA / (beyondA - beyondB);
			kept.push_back({a.m_y + share * (b.m_y - a.m_y), a.m_z + share * (b.m_z - a.m_z)});
		}
		if (kept.size() > 2)
			part.m_outlines.push_back(kept);
	}
	return part;
}

void Region::cut(double mostArea, std::vector<Region>& pieces) const
{
	const Moments all = moments();
	// What is left of a cut along a side has no area but by rounding.
	if (!(all.m_area > 1e-9 * mostArea))
		return;
	if (all.m_area <= mostArea)
	{
		pieces.push_back(*this);
		return;
	}
	const double turn = principalTurn(all.centred()), y = cos(turn), z = sin(turn),
				 middle = (y * all.m_y + z * all.m_z) / all.m_area;
	const Region halves[2] = {below(y, z, middle), below(-y, -z, -middle)};
	for (const Region& half : halves)
		// What is so flat that rounding leaves all of it on one side stays whole.
		if (!(half.moments().m_area < 0.999 * all.m_area))
		{
			pieces.push_back(*this);
			return;
		}
	for (const Region& half : halves)
		half.cut(mostArea, pieces);
}

Region Region::seenFrom(double y, double z, double turn) const
{
	const double c = cos(turn), s = sin(turn);
	Region seen = *this;
	for (Outline& outline : seen.m_outlines)
		for (Point& p : outline)
			p = {c * (p.m_y - y) + s * (p.m_z - z), c * (p.m_z - z) - s * (p.m_y - y)};
	return seen;
}

Region Region::stretched(double y, double z) const
{
	Region stretched = *this;
	for (Outline& outline : stretched.m_outlines)
		for (Point& p : outline)
			p = {y * p.m_y, z * p.m_z};
	return stretched;
}

double principalTurn(const Region::Moments& centred)
{
	const double difference = centred.m_yy - centred.m_zz, product = 2 * centred.m_yz,
				 rounding = 1e-9 * (centred.m_yy + centred.m_zz);
	// What is symmetric is not turned, up to the last digit.
	if (fabs(product) < rounding)
		return difference > -rounding ? 0 : atan2(0., -1.) / 2;
	return atan2(product, difference) / 2;
}

PrincipalMoments principalMoments(const Region::Moments& centred)
{
	const double turn = principalTurn(centred), c = cos(turn), s = sin(turn), mixed = 2 * c * s * centred.m_yz;
	return {{c, s},
			btMax(0., c * c * centred.m_yy + s * s * centred.m_zz + mixed),
			btMax(0., s * s * centred.m_yy + c * c * centred.m_zz - mixed)};
}

double nearestPrincipalTurn(const Region::Moments& centred)
{
	const double turn = principalTurn(centred), eighth = atan2(1., 1.);
	return fabs(turn) > eighth * (1 + 1e-6) ? turn - (turn > 0 ? 2 : -2) * eighth : turn;
}

double areaOf(const Region::Outline& outline)
{
	Region alone;
	alone.m_outlines.push_back(outline);
	return alone.moments().m_area;
}

double distanceTo(const Region::Outline& outline, const Region::Point& p)
{
	double least = -1;
	for (size_t i = 0; i < outline.size(); ++i)
	{
		const Region::Point &a = outline[i], &b = after(outline, i);
		const double y = b.m_y - a.m_y, z = b.m_z - a.m_z, length2 = y * y + z * z;
		const double along =
			length2 > 0 ? btMax(0., btMin(1., ((p.m_y - a.m_y) * y + (p.m_z - a.m_z) * z) / length2)) : 0.;
		const double offY = p.m_y - a.m_y - along * y, offZ = p.m_z - a.m_z - along * z,
					 distance2 = offY * offY + offZ * offZ;
		if (least < 0 || distance2 < least)
			least = distance2;
	}
	return sqrt(btMax(least, 0.));
}

bool isInside(const Region::Outline& outline, const Region::Point& p)
{
	bool isIn = false;
	for (size_t i = 0; i < outline.size(); ++i)
	{
		const Region::Point &a = outline[i], &b = after(outline, i);
		if ((a.m_z > p.m_z) != (b.m_z > p.m_z))
			isIn ^= p.m_y < a.m_y + (p.m_z - a.m_z) / (b.m_z - a.m_z) * (b.m_y - a.m_y);
	}
	return isIn;
}

bool areCrossed(const std::vector<Region::Outline>& outlines)
{
	for (size_t i = 0; i < outlines.size(); ++i)
		for (size_t j = i; j < outlines.size(); ++j)
			for (size_t k = 0; k < outlines[i].size(); ++k)
				for (size_t l = i == j ? k + 2 : 0; l < outlines[j].size(); ++l)
				{
					const bool areNeighbours = i == j && k == 0 && l + 1 == outlines[j].size();
					if (!areNeighbours &&
						doMeet(outlines[i][k], after(outlines[i], k), outlines[j][l], after(outlines[j], l)))
						return true;
				}
	return false;
}
}  // namespace btElasticPlastic
