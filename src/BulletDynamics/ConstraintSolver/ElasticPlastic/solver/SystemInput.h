// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SYSTEM_INPUT_H
#define BT_ELASTIC_PLASTIC_SYSTEM_INPUT_H

#include <stddef.h>
#include <vector>

namespace btElasticPlastic
{
/// What a System is to solve: bodies, and compliant rows between them with bounded impulses, in double whatever Bullet's
/// precision.
///
/// The rows of a joint share axes and arms. They are a unit here, a fraction of the memory and of the arithmetic of as many
/// single rows. Other constraints and contacts come as single rows.
struct SystemInput
{
	struct Body
	{
		double m_mass[3];     ///< along the world's axes
		double m_inertia[9];  ///< symmetric, positive definite, world coordinates
	};

	/// What a row asks for: J dv + C lambda = b where lambda is inside its bounds, else lambda at the bound.
	struct Bounded
	{
		double m_target;      ///< b
		double m_compliance;  ///< C > 0
		double m_lower;
		double m_upper;
		/// A row whose impulse adds to what this one asks for, J dv + C lambda + coupling lambda_partner = b, and the other way round;
		/// -1: none. The compliance of both together is positive definite. Both are of one unit, or single rows of the same bodies.
		int m_partner = NONE;
		double m_coupling = 0;

		/// Instead of a partner, for rows of m_bundles.
		enum
		{
			NONE = -1,
			FIBRE_OF_BUNDLE = -2,
			SHEAR_OF_BUNDLE = -3
		};
		bool isInBundle() const { return m_partner < NONE; }
	};

	/// The impulse and bound of a row with which the search begins.
	struct Guess
	{
		double m_impulse = 0;     ///< of a contact
		signed char m_bound = 0;  ///< -1 at the lower, 1 at the upper bound, 0 between
	};

	/// Rows along and about three axes through a point: J = [a, rA x a, -a, -rB x a] and [0, a, 0, -a], but for the first one along, which is at a place as a fibre is.
	/// Those of its fibres come last.
	struct Unit
	{
		double m_axis[3][3];  ///< a, at a right angle to each other, unit length
		double m_arm[2][3];   ///< rA, rB: from the bodies' centres of mass to the point
		double m_place[2];    ///< of the first row, y and z
		int m_body[2];        ///< by index, -1: one that does not move
		int m_firstRow;       ///< of m_rows
		int m_numRows;
		signed char m_dof[6];  ///< of each row but fibres: 0 to 2 along, 3 to 5 about an axis
		int m_firstFibre = 0;  ///< of m_fibres
		int m_numFibres = 0;
		int m_bundle = -1;  ///< of m_bundles, -1: its rows' compliance is not coupled

		int getNumPlainRows() const { return m_numRows - m_numFibres; }
		int getFirstFibreRow() const { return m_firstRow + getNumPlainRows(); }
	};

	/// A row beside a unit's point, along its first axis, at y and z of the other two: J = J_0 + z J_4 - y J_5 of the unit's degrees of
	/// freedom.
	struct Fibre
	{
		double m_y, m_z;
	};

	/// Fibres of a unit whose compliance is coupled with that of its two shears.
	struct Bundle
	{
		int m_unit;
		int m_shearRow[2];    ///< of m_rows, -1: there is none
		int m_firstCoupling;  ///< of m_couplings, as many as the unit has fibres
	};

	/// Of a fibre in a bundle with each of the two shears, see CoupledBundle.
	struct Coupling
	{
		double m_shear[2];
	};

	struct SingleRow
	{
		double m_J[12];  ///< linear and angular part on one body, then on the other
		int m_body[2];   ///< by index, -1: one that does not move
		int m_row;       ///< of m_rows
		/// The part of a contact's compliance that was added to soften it, and that the augmented Lagrangian corrects for; 0
		/// if the contact is soft enough by itself, or the row is not a contact's.
		double m_softening = 0;
		int m_normal = -1;         ///< friction: the single row of its normal impulse
		double m_friction = 0;     ///< friction: coefficient
		double m_frictionMax = 0;  ///< friction: greatest bound, 0: none
		bool m_isContact = false;

		/// Of friction: the greatest impulse that a normal impulse, >= 0, allows.
		double getFrictionBound(double normalImpulse) const
		{
			const double bound = m_friction * normalImpulse;
			return m_frictionMax > 0 && m_frictionMax < bound ? m_frictionMax : bound;
		}
	};

	/// What bodies that have been eliminated leave to the others: a mass, and a momentum, see Condensation.
	struct Condensed
	{
		std::vector<int> m_bodies;
		std::vector<double> m_matrix;    ///< symmetric and full, 6 by body, beside the bodies' own mass
		std::vector<double> m_momentum;  ///< 6 by body

		void clear()
		{
			m_bodies.clear();
			m_matrix.clear();
			m_momentum.clear();
		}
	};

	std::vector<Body> m_bodies;
	std::vector<Unit> m_units;
	std::vector<SingleRow> m_singleRows;
	std::vector<Fibre> m_fibres;    ///< of units, in their order
	std::vector<Bundle> m_bundles;  ///< the same
	std::vector<Coupling> m_couplings;
	std::vector<Bounded> m_rows;  ///< of units and single rows, in the order in which they were added
	std::vector<Guess> m_guess;   ///< of the same
	Condensed m_condensed;

	void clear();

	/// Makes room for so many units of six rows, and for contacts: memory that grows is touched again and again.
	void reserve(size_t numUnits);

	// The references are valid until the next one is added.
	Body& addBody();
	/// \param numFibres  how many of the rows are fibres
	Unit& addUnit(int numRows, int numFibres = 0);
	SingleRow& addSingleRow();

	/// Of a bundle's shears and fibres, sum of V_s b_is lambda_i.
	/// \param impulses  by row
	double getCouplingEnergy(const Bundle& bundle, const std::vector<double>& impulses) const;

	int getNumBodies() const { return int(m_bodies.size()); }
	int getNumRows() const { return int(m_rows.size()); }
	int getNumSingleRows() const { return int(m_singleRows.size()); }
};

inline double SystemInput::getCouplingEnergy(const Bundle& bundle, const std::vector<double>& impulses) const
{
	const Unit& unit = m_units[size_t(bundle.m_unit)];
	double energy = 0;
	for (int s = 0; s < 2; ++s)
		for (int i = 0; bundle.m_shearRow[s] >= 0 && i < unit.m_numFibres; ++i)
			energy += impulses[size_t(bundle.m_shearRow[s])] *
					  m_couplings[size_t(bundle.m_firstCoupling + i)].m_shear[s] *
					  impulses[size_t(unit.getFirstFibreRow() + i)];
	return energy;
}

inline void SystemInput::clear()
{
	m_bodies.clear();
	m_units.clear();
	m_singleRows.clear();
	m_fibres.clear();
	m_bundles.clear();
	m_couplings.clear();
	m_rows.clear();
	m_guess.clear();
	m_condensed.clear();
}

inline void SystemInput::reserve(size_t numUnits)
{
	if (m_units.capacity() >= numUnits)
		return;
	m_units.reserve(numUnits);
	m_rows.reserve(8 * numUnits);
	m_guess.reserve(8 * numUnits);
}

inline SystemInput::Body& SystemInput::addBody()
{
	m_bodies.emplace_back();
	return m_bodies.back();
}

inline SystemInput::Unit& SystemInput::addUnit(int numRows, int numFibres)
{
	m_units.emplace_back();
	Unit& unit = m_units.back();
	unit.m_firstRow = getNumRows();
	unit.m_numRows = numRows;
	unit.m_firstFibre = int(m_fibres.size());
	unit.m_numFibres = numFibres;
	m_fibres.resize(m_fibres.size() + size_t(numFibres));
	m_rows.resize(m_rows.size() + size_t(numRows));
	m_guess.resize(m_rows.size());
	return unit;
}

inline SystemInput::SingleRow& SystemInput::addSingleRow()
{
	m_singleRows.emplace_back();
	m_singleRows.back().m_row = getNumRows();
	m_rows.emplace_back();
	m_guess.emplace_back();
	return m_singleRows.back();
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SYSTEM_INPUT_H
