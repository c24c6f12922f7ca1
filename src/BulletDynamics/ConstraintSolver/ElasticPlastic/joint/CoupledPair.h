// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_COUPLED_PAIR_H
#define BT_ELASTIC_PLASTIC_COUPLED_PAIR_H

namespace btElasticPlastic
{
/// Two springs whose compliance is coupled, each of which yields by itself: a shear force and the bending moment in its plane, at a
/// place that is not the middle of what is elastic.
///
/// Given the compliance C, symmetric and positive definite, and a deformation u, the force is the one nearest to C^-1 u that both
/// bounds allow, measured by the elastic energy of the difference:
///
///     minimise 1/2 f^T C f - u^T f  for  lower <= f <= upper.
///
/// It is the gradient of a convex potential in u, and is unique. The same holds for impulses and velocities.
template <class Real>
struct CoupledPair
{
	Real m_compliance[2];  ///< on C's diagonal
	Real m_coupling;       ///< beside it

	/// \param bound  gets -1 where the force is at its lower, 1 where it is at its upper bound, else 0; 1 where both are equal
	void project(const Real u[2], const Real lower[2], const Real upper[2], Real force[2], signed char bound[2]) const
	{
		int beyond[2];
		free(u, &force[0], &force[1]);
		for (int i = 0; i < 2; ++i)
		{
			beyond[i] = side(force[i], lower[i], upper[i]);
			bound[i] = 0;
		}
		// The way from the solution to the free optimum leaves the box at once: so one of the bounds that the free optimum is
		// beyond holds. If the solution with the first one at its bound does not press against it, it is the second one.
		for (int i = 0; i < 2; ++i)
		{
			if (beyond[i] == 0)
				continue;
			clampWith(i, beyond[i], u, lower, upper, force, bound);
			const Real pressing = u[i] - m_compliance[i] * force[i] - m_coupling * force[1 - i];
			if (beyond[1 - i] == 0 || pressing * Real(beyond[i]) >= 0)
				return;
		}
	}

	/// C^-1 u
	void free(const Real u[2], Real* first, Real* second) const
	{
		const Real determinant = m_compliance[0] * m_compliance[1] - m_coupling * m_coupling;
		*first = (m_compliance[1] * u[0] - m_coupling * u[1]) / determinant;
		*second = (m_compliance[0] * u[1] - m_coupling * u[0]) / determinant;
	}

	/// The other's force, unbounded, where the force of i is given.
	Real other(int i, Real force, const Real u[2]) const
	{
		return (u[1 - i] - m_coupling * force) / m_compliance[1 - i];
	}

	/// d force / du for the given bounds: on the diagonal, and beside it.
	void getTangent(const signed char bound[2], Real diagonal[2], Real& beside) const
	{
		const bool areBothFree = bound[0] == 0 && bound[1] == 0;
		const Real determinant = m_compliance[0] * m_compliance[1] - m_coupling * m_coupling;
		for (int i = 0; i < 2; ++i)
			diagonal[i] = areBothFree     ? m_compliance[1 - i] / determinant
						  : bound[i] == 0 ? 1 / m_compliance[i]
										  : Real(0);
		beside = areBothFree ? -m_coupling / determinant : Real(0);
	}

private:
	static int side(Real force, Real lower, Real upper)
	{
		return force > upper || lower == upper ? 1 : force < lower ? -1 : 0;
	}

	void clampWith(int i, int at, const Real u[2], const Real lower[2], const Real upper[2], Real force[2],
				   signed char bound[2]) const
	{
		const int j = 1 - i;
		force[i] = at > 0 ? upper[i] : lower[i];
		force[j] = other(i, force[i], u);
		bound[i] = static_cast<signed char>(at);
		bound[j] = static_cast<signed char>(side(force[j], lower[j], upper[j]));
		if (bound[j] != 0)
			force[j] = bound[j] > 0 ? upper[j] : lower[j];
	}
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_COUPLED_PAIR_H
