// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_SECTION_SURFACE_H
#define EP_TEST_SECTION_SURFACE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

/// N, V_y, V_z, T, M_y, M_z, in the order of btElasticPlasticDof.
typedef std::array<double, 6> SectionForces6;

/// A piece of a section of unit strength per area, and what its slips are: two rows of (V_y, V_z, T).
struct ShearCell
{
	double y, z, area;
	double slip[2][3];
};

/// All that a section can bear, by limit analysis: cells that flow at s^2 + 3 t^2 = 1 (von Mises), with elongations of a plane and slips that all
/// of the section has in common. In a direction q it bears h(q) = sum A sqrt(e^2 + g^2 / 3).
class SectionSurface
{
public:
	std::vector<ShearCell> m_cells;

	/// h(q). \param rates  gets the root of each cell
	double support(const SectionForces6& q, std::vector<double>* rates = nullptr) const
	{
		double sum = 0;
		for (size_t i = 0; i < m_cells.size(); ++i)
		{
			const ShearCell& c = m_cells[i];
			const double e = q[0] + q[4] * c.z - q[5] * c.y;
			double square = e * e;
			for (const auto& row : c.slip)
			{
				const double g = row[0] * q[1] + row[1] * q[2] + row[2] * q[3];
				square += g * g / 3;
			}
			const double n = std::sqrt(square);
			sum += c.area * n;
			if (rates)
				(*rates)[i] = n;
		}
		return sum;
	}

	SectionForces6 alone() const
	{
		SectionForces6 alone;
		for (size_t k = 0; k < 6; ++k)
		{
			SectionForces6 q = {};
			q[k] = 1;
			alone[k] = support(q);
		}
		return alone;
	}

	/// How many times the forces f the section bears: the least of h(q) over all q with q f = 1. By weighted least squares, which only lessen it.
	double radius(const SectionForces6& f) const
	{
		std::vector<double> weights(m_cells.size()), rates(m_cells.size());
		double area = 0;
		for (size_t i = 0; i < m_cells.size(); ++i)
		{
			weights[i] = m_cells[i].area;
			area += m_cells[i].area;
		}
		double best = 1e300;
		for (int k = 0; k < 40; ++k)
		{
			double a[6][7] = {};
			for (size_t i = 0; i < m_cells.size(); ++i)
			{
				const ShearCell& c = m_cells[i];
				const double normal[3] = {1, c.z, -c.y};
				const size_t place[3] = {0, 4, 5};
				for (size_t r = 0; r < 3; ++r)
					for (size_t s = 0; s < 3; ++s)
					{
						a[place[r]][place[s]] += weights[i] * normal[r] * normal[s];
						a[1 + r][1 + s] += weights[i] * (c.slip[0][r] * c.slip[0][s] + c.slip[1][r] * c.slip[1][s]) / 3;
					}
			}
			for (size_t r = 0; r < 6; ++r)
				a[r][6] = f[r];
			SectionForces6 q = solve(a);
			double work = 0;
			for (size_t r = 0; r < 6; ++r)
				work += q[r] * f[r];
			for (double& x : q)
				x /= work;
			const double h = support(q, &rates), least = 1e-4 * h / area;
			best = std::min(best, h);
			for (size_t i = 0; i < m_cells.size(); ++i)
				weights[i] = m_cells[i].area / std::max(rates[i], least);
		}
		return best;
	}

private:
	static SectionForces6 solve(double a[6][7])
	{
		for (size_t i = 0; i < 6; ++i)
			for (size_t r = i + 1; r < 6; ++r)
			{
				const double m = a[r][i] / a[i][i];
				for (size_t c = i; c < 7; ++c)
					a[r][c] -= m * a[i][c];
			}
		SectionForces6 x = {};
		for (size_t i = 6; i-- > 0;)
		{
			x[i] = a[i][6];
			for (size_t c = i + 1; c < 6; ++c)
				x[i] -= a[i][c] * x[c];
			x[i] /= a[i][i];
		}
		return x;
	}
};

#endif  // EP_TEST_SECTION_SURFACE_H
