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

/// A piece of a section of unit strength per area, and what its slips are: two rows of (V_y, V_z, T), and of a warping.
struct ShearCell
{
	double y, z, area;
	double slip[2][3];
	double warping[2];

	double slipBy(size_t row, size_t rate) const { return rate < 3 ? slip[row][rate] : warping[row]; }
};

/// All that a section can bear, by limit analysis: cells that flow at s^2 + 3 t^2 = 1 (von Mises), with elongations of a plane and slips that all
/// of the section has in common. In a direction q it bears h(q) = sum A sqrt(e^2 + g^2 / 3). That is a bound from above for any field of slips,
/// and for the least of several fields.
class SectionSurface
{
public:
	std::vector<ShearCell> m_cells;
	std::vector<ShearCell> m_warped;  ///< with another field, which may warp as it likes; none: that alone

	/// h(q), with the warping that makes it the least.
	double support(const SectionForces6& q) const
	{
		Rates rates = {{q[0], q[1], q[2], q[3], q[4], q[5], 0}};
		const double first = support(m_cells, rates, nullptr);
		if (m_warped.empty())
			return first;
		// It warps by no more than it twists.
		double from = -std::fabs(q[3]), to = std::fabs(q[3]);
		const auto with = [&](double warping)
		{
			rates[6] = warping;
			return support(m_warped, rates, nullptr);
		};
		for (int i = 0; i < 60; ++i)
		{
			const double a = from + (to - from) / 3, b = to - (to - from) / 3;
			(with(a) < with(b) ? to : from) = with(a) < with(b) ? b : a;
		}
		return std::min(first, with((from + to) / 2));
	}

	/// What the section bears of each force by itself.
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

	/// How many times the forces f the section bears.
	double radius(const SectionForces6& f) const
	{
		const double first = radius(m_cells, f);
		return m_warped.empty() ? first : std::min(first, radius(m_warped, f));
	}

private:
	typedef std::array<double, 7> Rates;  ///< of what the forces work on, and of the warping

	/// h(q). \param rates  gets the root of each cell
	static double support(const std::vector<ShearCell>& cells, const Rates& q, std::vector<double>* rates)
	{
		double sum = 0;
		for (size_t i = 0; i < cells.size(); ++i)
		{
			const ShearCell& c = cells[i];
			const double e = q[0] + q[4] * c.z - q[5] * c.y;
			double square = e * e;
			for (size_t row = 0; row < 2; ++row)
			{
				const double g = c.slipBy(row, 0) * q[1] + c.slipBy(row, 1) * q[2] + c.slipBy(row, 2) * q[3] +
								 c.slipBy(row, 3) * q[6];
				square += g * g / 3;
			}
			const double n = std::sqrt(square);
			sum += c.area * n;
			if (rates)
				(*rates)[i] = n;
		}
		return sum;
	}

	/// The least of h(q) over all q with q f = 1. By weighted least squares, which only lessen it.
	static double radius(const std::vector<ShearCell>& cells, const SectionForces6& f)
	{
		std::vector<double> weights(cells.size()), rates(cells.size());
		double area = 0;
		for (size_t i = 0; i < cells.size(); ++i)
		{
			weights[i] = cells[i].area;
			area += cells[i].area;
		}
		double best = 1e300;
		for (int k = 0; k < 40; ++k)
		{
			double a[7][8] = {};
			for (size_t i = 0; i < cells.size(); ++i)
			{
				const ShearCell& c = cells[i];
				const double normal[3] = {1, c.z, -c.y};
				const size_t ofNormal[3] = {0, 4, 5}, ofSlip[4] = {1, 2, 3, 6};
				for (size_t r = 0; r < 3; ++r)
					for (size_t s = 0; s < 3; ++s)
						a[ofNormal[r]][ofNormal[s]] += weights[i] * normal[r] * normal[s];
				for (size_t r = 0; r < 4; ++r)
					for (size_t s = 0; s < 4; ++s)
						a[ofSlip[r]][ofSlip[s]] +=
							weights[i] * (c.slipBy(0, r) * c.slipBy(0, s) + c.slipBy(1, r) * c.slipBy(1, s)) / 3;
			}
			if (a[6][6] == 0)
				a[6][6] = 1;
			for (size_t r = 0; r < 6; ++r)
				a[r][7] = f[r];
			Rates q = solve(a);
			double work = 0;
			for (size_t r = 0; r < 6; ++r)
				work += q[r] * f[r];
			for (double& x : q)
				x /= work;
			const double h = support(cells, q, &rates), least = 1e-4 * h / area;
			best = std::min(best, h);
			for (size_t i = 0; i < cells.size(); ++i)
				weights[i] = cells[i].area / std::max(rates[i], least);
		}
		return best;
	}

	static Rates solve(double a[7][8])
	{
		for (size_t i = 0; i < 7; ++i)
			for (size_t r = i + 1; r < 7; ++r)
			{
				const double m = a[r][i] / a[i][i];
				for (size_t c = i; c < 8; ++c)
					a[r][c] -= m * a[i][c];
			}
		Rates x = {};
		for (size_t i = 7; i-- > 0;)
		{
			x[i] = a[i][7];
			for (size_t c = i + 1; c < 7; ++c)
				x[i] -= a[i][c] * x[c];
			x[i] /= a[i][i];
		}
		return x;
	}
};

#endif  // EP_TEST_SECTION_SURFACE_H
