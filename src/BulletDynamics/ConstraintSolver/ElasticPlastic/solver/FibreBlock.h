// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FIBRE_BLOCK_H
#define BT_ELASTIC_PLASTIC_FIBRE_BLOCK_H

#include <vector>

#include "../joint/JointRows.h"
#include "SolverPools.h"

namespace btElasticPlastic
{
/// The fibres of a joint in the iterative form. Their sums N, M_y and M_z, three rows in Bullet's pool, are one block of Gauss-Seidel.
///
/// With the velocities w that the three rows would have without them, A = J M^-1 J^T of the three, and the impulse of each fibre
/// f(v) = (r - v) / C at its place's velocity v, within its bounds, the block solves
///
///     s = sum f(w + A s)
///
/// by Newton's method. Fibres one by one, which are nearly the same row, would take many iterations to come as far as the three rows do
/// in one. s is the least of a convex function, and no step goes beyond where that is least along it.
class FibreBlock
{
public:
	/// Takes the fibres of a joint. \param firstRow  of the three in Bullet's pool, which Bullet leaves as they are from now on
	void begin(const JointRows& rows, int firstRow, const SolverPools& pools);

	/// Whether Bullet solves the joint's rows in an iteration: each joint may want a number of its own.
	bool isIn(int iteration, const SolverPools& pools) const
	{
		return iteration < pools.m_constraints[m_firstRow].m_overrideNumSolverIterations;
	}

	/// Solves the block for the present velocities of all bodies.
	/// \return the largest square of a velocity by which this changes a row, as Bullet tells it of its rows
	btScalar solve(const SolverPools& pools);

	// Of the fibres:
	const double* getImpulses() const { return m_impulses.data(); }
	const signed char* getBounds() const { return m_bounds.data(); }

private:
	/// N, M_y and M_z, or the velocities of their rows.
	struct Triple
	{
		double m_x[3];

		double dot(const Triple& other) const
		{
			return m_x[0] * other.m_x[0] + m_x[1] * other.m_x[1] + m_x[2] * other.m_x[2];
		}
		void add(double factor, const Triple& other)
		{
			for (int i = 0; i < 3; ++i)
				m_x[i] += factor * other.m_x[i];
		}
	};
	struct Fibre
	{
		double m_target, m_compliance, m_lower, m_upper;
		Triple m_place;  ///< by how much the elongation and the turns about y and z elongate it

		double velocityAt(const Triple& velocity) const { return m_place.dot(velocity); }
	};
	/// Where a fibre leaves a bound, or comes to one.
	struct Kink
	{
		double m_share;   ///< of a step
		double m_change;  ///< of the rise of the slope along it
	};
	struct Matrix
	{
		double m_x[3][3];

		Triple operator*(const Triple& v) const;
	};

	Triple velocityOf(const SolverPools& pools) const;
	bool sumAt(const Triple& velocity, Triple& sum);
	Matrix tangent() const;
	Triple findStep(const Triple& error) const;
	double findLeast(const Triple& velocity, const Triple& along, double slope, double rise);
	void set(const Triple& sum, const SolverPools& pools);

	int m_firstRow = 0;
	Matrix m_response = {};  ///< A
	Triple m_sum = {};       ///< s as it is applied
	std::vector<Fibre> m_fibres;
	std::vector<double> m_impulses;
	std::vector<signed char> m_bounds;
	std::vector<Kink> m_kinks;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_FIBRE_BLOCK_H
