// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_REGION_H
#define BT_ELASTIC_PLASTIC_REGION_H

#include <vector>

struct btElasticPlasticSection;

namespace btElasticPlastic
{
/// A plane figure with straight sides, with or without holes, in a section's axes y and z.
class Region
{
public:
	struct Point
	{
		double m_y, m_z;
	};
	/// Corners in the order that has the figure to the left of each side, y being right and z up: holes run the other way.
	typedef std::vector<Point> Outline;

	/// Integrals over the figure.
	struct Moments
	{
		double m_area = 0;
		double m_y = 0, m_z = 0;              ///< of y, z
		double m_yy = 0, m_zz = 0, m_yz = 0;  ///< of y^2, z^2, y z

		/// About the centroid. \pre the area is not 0
		Moments centred() const;
	};

	/// By Green's theorem, exact but for rounding.
	Moments moments() const;

	/// The part where alongY y + alongZ z is at most the limit. Where it falls apart, sides on the cut join its pieces; they enclose nothing.
	Region below(double alongY, double alongZ, double limit) const;

	/// Cuts the figure by halves, across where it is long, into pieces of less than an area.
	void cut(double mostArea, std::vector<Region>& pieces) const;

	/// The same by axes with their origin at (y, z), turned by an angle about x.
	Region seenFrom(double y, double z, double turn) const;

	/// Stretched along y and along z, by factors > 0.
	Region stretched(double y, double z) const;

	std::vector<Outline> m_outlines;
};

/// How far along y^2's largest second moment is turned from y, -pi/2 to pi/2.
double principalTurn(const Region::Moments& centred);

/// Second moments along the axis in which they are greatest, and across it; no less than 0.
struct PrincipalMoments
{
	double m_axis[2];
	double m_greater, m_lesser;
};

PrincipalMoments principalMoments(const Region::Moments& centred);

/// That, or the other principal axis if it is nearer to y.
double nearestPrincipalTurn(const Region::Moments& centred);

double areaOf(const Region::Outline& outline);  ///< negative if it runs the other way round
double distanceTo(const Region::Outline& outline, const Region::Point& point);
bool isInside(const Region::Outline& outline, const Region::Point& point);
/// Whether any two sides of these outlines that are not neighbours have a point in common.
bool areCrossed(const std::vector<Region::Outline>& outlines);

Region regionOf(const btElasticPlasticSection& section);  ///< by its corners
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_REGION_H
