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
	double bar =
		0;  ///< strength of one that is alike in tension and bears no shear, over that of the others; 0: one of these

	double slipBy(size_t row, size_t rate) const { return rate < 3 ? slip[row][rate] : warping[row]; }
};

/// All that a section can bear, by limit analysis: cells that flow at s^2 + 3 t^2 = 1 (von Mises), with elongations of a plane and slips that all
/// of the section has in common. In a direction q it bears h(q) = sum A sqrt(e^2 + g^2 / 3). That is a bound from above for any field of slips,
/// and for the least of several fields.
///
/// Cells of the strength r in tension flow where the paraboloid of Stassi and of Raghava, Caddell and Yeh cuts s and t,
///
///     s^2 + (1 - r) s + r (t / t_0)^2 = r:  ((s - c) / a)^2 + (t / t_m)^2 = 1,  c = (r - 1) / 2,  a = (r + 1) / 2,  t_m = t_0 a / sqrt(r),
///
/// with their strength t_0 = 1 / sqrt(3) in shear where there is no normal stress, and bear h(q) = sum A (c e + sqrt(a^2 e^2 + t_m^2 g^2)).
class SectionSurface
{
public:
	std::vector<ShearCell> m_cells;
	std::vector<ShearCell> m_warped;  ///< with another field of slips; none: that alone
	double m_tension = 1;             ///< r, strength in tension over the one in compression, > 0

	/// h(q), with the warping that makes it the least.
	double support(const SectionForces6& q) const
	{
		const double first = leastSupport(m_cells, q);
		return m_warped.empty() ? first : std::min(first, leastSupport(m_warped, q));
	}

	/// The most that the section bears of each force, which is what it bears of it by itself where it is as strong in tension.
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

	/// What it bears of shears and torsion by themselves where no cell has a normal stress, and under pressure alone, and of moments alone.
	SectionForces6 aloneAtRest() const
	{
		SectionSurface even = *this;
		even.m_tension = 1;
		SectionForces6 rest;
		for (size_t k = 0; k < 6; ++k)
		{
			SectionForces6 one = {};
			one[k] = k == 0 ? -1 : 1;
			rest[k] = k >= 1 && k <= 3 ? even.radius(one) : radius(one);
		}
		return rest;
	}

private:
	typedef std::array<double, 7> Rates;  ///< of what the forces work on, and of the warping

	double middle() const { return (m_tension - 1) / 2; }
	double half() const { return (m_tension + 1) / 2; }
	double squareOfShear() const { return half() * half() / (3 * m_tension); }

	double leastSupport(const std::vector<ShearCell>& cells, const SectionForces6& q) const
	{
		Rates rates = {{q[0], q[1], q[2], q[3], q[4], q[5], 0}};
		double slips = 0, warps = 0;
		for (const ShearCell& c : cells)
			for (size_t row = 0; row < 2; ++row)
			{
				slips =
					std::max(slips, std::fabs(c.slip[row][0] * q[1] + c.slip[row][1] * q[2] + c.slip[row][2] * q[3]));
				warps = std::max(warps, std::fabs(c.warping[row]));
			}
		if (!(warps > 0))
			return support(cells, rates, nullptr);
		// By its warping no cell slips by more than twice what another does without.
		double from = -2 * slips / warps, to = -from;
		const auto with = [&](double warping)
		{
			rates[6] = warping;
			return support(cells, rates, nullptr);
		};
		for (int i = 0; i < 60 && from < to; ++i)
		{
			const double a = from + (to - from) / 3, b = to - (to - from) / 3;
			(with(a) < with(b) ? to : from) = with(a) < with(b) ? b : a;
		}
		return with((from + to) / 2);
	}

	/// h(q). \param rates  gets the root of each cell
	double support(const std::vector<ShearCell>& cells, const Rates& q, std::vector<double>* rates) const
	{
		double sum = 0;
		for (size_t i = 0; i < cells.size(); ++i)
		{
			const ShearCell& c = cells[i];
			const double e = q[0] + q[4] * c.z - q[5] * c.y;
			double square = c.bar > 0 ? c.bar * c.bar * e * e : half() * half() * e * e;
			for (size_t row = 0; row < 2; ++row)
			{
				const double g = c.slipBy(row, 0) * q[1] + c.slipBy(row, 1) * q[2] + c.slipBy(row, 2) * q[3] +
								 c.slipBy(row, 3) * q[6];
				square += squareOfShear() * g * g;
			}
			const double n = std::sqrt(square);
			sum += c.area * (c.bar > 0 ? n : middle() * e + n);
			if (rates)
				(*rates)[i] = n;
		}
		return sum;
	}

	/// The least of h(q) over all q with q f = 1. By weighted least squares, which only lessen it: of q A q / 2 + q m, with what cells bear in the
	/// middle m.
	double radius(const std::vector<ShearCell>& cells, const SectionForces6& f) const
	{
		std::vector<double> weights(cells.size()), rates(cells.size());
		double area = 0;
		SectionForces6 inMiddle = {};
		for (const ShearCell& c : cells)
		{
			if (c.bar > 0)
				continue;
			inMiddle[0] += middle() * c.area;
			inMiddle[4] += middle() * c.area * c.z;
			inMiddle[5] -= middle() * c.area * c.y;
		}
		for (size_t i = 0; i < cells.size(); ++i)
		{
			weights[i] = cells[i].area;
			area += cells[i].area;
		}
		double best = 1e300;
		for (int k = 0; k < (m_tension == 1 ? 40 : 200); ++k)
		{
			double a[7][9] = {};
			for (size_t i = 0; i < cells.size(); ++i)
			{
				const ShearCell& c = cells[i];
				const double normal[3] = {1, c.z, -c.y}, own = c.bar > 0 ? c.bar : half();
				const size_t ofNormal[3] = {0, 4, 5}, ofSlip[4] = {1, 2, 3, 6};
				for (size_t r = 0; r < 3; ++r)
					for (size_t s = 0; s < 3; ++s)
						a[ofNormal[r]][ofNormal[s]] += own * own * weights[i] * normal[r] * normal[s];
				for (size_t r = 0; r < 4; ++r)
					for (size_t s = 0; s < 4; ++s)
						a[ofSlip[r]][ofSlip[s]] += squareOfShear() * weights[i] *
												   (c.slipBy(0, r) * c.slipBy(0, s) + c.slipBy(1, r) * c.slipBy(1, s));
			}
			if (a[6][6] == 0)
				a[6][6] = 1;
			for (size_t r = 0; r < 6; ++r)
			{
				a[r][7] = f[r];
				a[r][8] = inMiddle[r];
			}
			Rates q, byMiddle;
			solve(a, q, byMiddle);
			double work = 0, ofMiddle = 0, most = 0;
			for (size_t r = 0; r < 6; ++r)
			{
				work += q[r] * f[r];
				ofMiddle += byMiddle[r] * f[r];
			}
			for (size_t r = 0; r < 7; ++r)
				q[r] = (1 + ofMiddle) / work * q[r] - byMiddle[r];
			const double h = support(cells, q, &rates);
			for (size_t i = 0; i < cells.size(); ++i)
				most += cells[i].area * rates[i];
			const double least = 1e-4 * most / area;
			best = std::min(best, h);
			for (size_t i = 0; i < cells.size(); ++i)
				weights[i] = cells[i].area / std::max(rates[i], least);
		}
		return best;
	}

	/// Both right sides behind the matrix.
	static void solve(double a[7][9], Rates& first, Rates& second)
	{
		for (size_t i = 0; i < 7; ++i)
			for (size_t r = i + 1; r < 7; ++r)
			{
				const double m = a[r][i] / a[i][i];
				for (size_t c = i; c < 9; ++c)
					a[r][c] -= m * a[i][c];
			}
		for (size_t i = 7; i-- > 0;)
		{
			first[i] = a[i][7];
			second[i] = a[i][8];
			for (size_t c = i + 1; c < 7; ++c)
			{
				first[i] -= a[i][c] * first[c];
				second[i] -= a[i][c] * second[c];
			}
			first[i] /= a[i][i];
			second[i] /= a[i][i];
		}
	}
};

#endif  // EP_TEST_SECTION_SURFACE_H
