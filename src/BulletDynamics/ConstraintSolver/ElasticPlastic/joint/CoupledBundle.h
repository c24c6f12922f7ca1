// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_COUPLED_BUNDLE_H
#define BT_ELASTIC_PLASTIC_COUPLED_BUNDLE_H

#include <vector>

namespace btElasticPlastic
{
/// Springs side by side, the fibres of a section, and two shear springs whose forces turn the section, as where the joint is not in the
/// middle of what is elastic. Each of them yields by itself.
///
/// With the forces f_i of fibres and V_s of shears, and given deformations u_i and w_s,
///
///     C_i f_i + sum_s b_is V_s = u_i,   D_s V_s + sum_i b_is f_i = w_s   where they are within their bounds, else at a bound.
///
/// This is the least of a convex function as long as D - sum b b^T / C is positive definite. Given the shears, all fibres follow by
/// themselves: two unknowns are left. The same holds for impulses and velocities. CoupledPair is the case of one fibre.
class CoupledBundle
{
public:
	struct Spring
	{
		double m_compliance;  ///< C or D, > 0
		double m_lower, m_upper;
		double m_target;  ///< u or w
		double m_force;
		signed char m_bound;  ///< -1 where the force is at its lower, 1 where it is at its upper bound, else 0
	};
	struct Fibre : Spring
	{
		double m_coupling[2];  ///< b
	};

	std::vector<Fibre> m_fibres;
	Spring m_shear[2];

	/// The matrix D - sum t b b^T, for tangents t of the fibres: yy, yz, zz.
	struct Matrix
	{
		double m_elements[3];

		void subtract(double tangent, const double coupling[2])
		{
			m_elements[0] -= tangent * coupling[0] * coupling[0];
			m_elements[1] -= tangent * coupling[0] * coupling[1];
			m_elements[2] -= tangent * coupling[1] * coupling[1];
		}
		/// Its inverse over the shears that are free; 0 elsewhere.
		Matrix inverse(bool isFirstFree, bool isSecondFree) const;
		double multiply(int s, const double x[2]) const { return m_elements[s] * x[0] + m_elements[s + 1] * x[1]; }
	};

	/// Finds forces and bounds; begins with the bounds that are set.
	void project();

	/// Finds the forces for the bounds that are set, as if they were right.
	void hold();

private:
	bool takeBounds();
	void follow(Fibre& fibre) const;
	double rest(int s);
	void findShear(int s, bool withOther);

	static signed char side(const Spring& spring, double force)
	{
		return static_cast<signed char>(force > spring.m_upper || spring.m_lower == spring.m_upper ? 1
										: force < spring.m_lower                                   ? -1
																								   : 0);
	}
	static double atBound(const Spring& spring) { return spring.m_bound > 0 ? spring.m_upper : spring.m_lower; }
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_COUPLED_BUNDLE_H
