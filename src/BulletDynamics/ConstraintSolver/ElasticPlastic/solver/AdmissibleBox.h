// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ADMISSIBLE_BOX_H
#define BT_ELASTIC_PLASTIC_ADMISSIBLE_BOX_H

#include <vector>

#include "../joint/CoupledBundle.h"
#include "../joint/CoupledPair.h"
#include "SystemInput.h"
#include "UnitTangent.h"

namespace btElasticPlastic
{
/// The set of admissible impulses of rows, and the projection of a trial onto it: the interface between the search and what units
/// can bear.
///
/// A unit's rows are asked for u = b - J dv. Its admissible set projects u onto an impulse lambda(u), the gradient of a convex
/// potential psi(u), and gives the tangent d lambda / du, symmetric and positive semidefinite. The search (System) and the
/// matrix (SystemMatrix) know no more of it than the functions of this class. A set that couples the rows of a unit, such as a
/// yield surface, stands beside this one with the same functions for its own units, and fills the unit's whole tangent.
///
/// Here the bounds of all rows are independent, a box: lambda = clamp(u / C, lower, upper), row by row, and for two rows with
/// coupled compliance as CoupledPair says, for fibres and shears as CoupledBundle does.
class AdmissibleBox
{
public:
	/// Begins a search with the rows' guessed bounds.
	void begin(const SystemInput& input)
	{
		const size_t n = input.m_rows.size();
		m_impulse.resize(n);
		m_bound.resize(n);
		m_isInTangent.assign(n, 0);
		for (size_t i = 0; i < n; ++i)
		{
			m_impulse[i] = input.m_guess[i].m_impulse;
			m_bound[i] = input.m_guess[i].m_bound;
		}
	}

	/// Sets the impulses at dv = 0 as if the present bounds were right: the right side of the linear problem with these bounds.
	void holdBounds(const SystemInput& input)
	{
		for (size_t i = 0; i < m_impulse.size(); ++i)
		{
			const SystemInput::Bounded& row = input.m_rows[i];
			m_impulse[i] = m_bound[i] == 0  ? row.m_target / row.m_compliance
						   : m_bound[i] > 0 ? row.m_upper
											: row.m_lower;
			if (row.m_partner < int(i) && row.m_partner >= 0)
				holdPair(input, row.m_partner, int(i));
		}
		for (const SystemInput::Bundle& bundle : input.m_bundles)
		{
			readBundle(input, bundle, [&](int row) { return input.m_rows[size_t(row)].m_target; });
			m_bundle.hold();
			writeBundle(input, bundle);
		}
	}

	/// Computes impulses and bounds for a trial.
	/// \param along  J dv of all rows
	/// \return whether a bound, and so the tangent, has changed
	bool project(const SystemInput& input, const std::vector<double>& along)
	{
		bool hasChanged = false;
		for (size_t i = 0; i < m_impulse.size(); ++i)
		{
			const SystemInput::Bounded& row = input.m_rows[i];
			if (row.m_partner >= 0)
			{
				hasChanged |= row.m_partner > int(i) && projectPair(input, along, int(i), row.m_partner);
				continue;
			}
			if (row.isInBundle())
				continue;
			const double impulse = (row.m_target - along[i]) / row.m_compliance;
			// Where both bounds are equal, as of friction without a normal impulse, the row counts as at its upper bound:
			// otherwise rounding would decide on a bound, and count as a change.
			const signed char bound = impulse > row.m_upper || row.m_lower == row.m_upper ? 1
									  : impulse < row.m_lower                             ? -1
																						  : 0;
			m_impulse[i] = bound > 0 ? row.m_upper : bound < 0 ? row.m_lower : impulse;
			hasChanged |= bound != m_bound[i];
			m_bound[i] = bound;
		}
		for (const SystemInput::Bundle& bundle : input.m_bundles)
		{
			readBundle(input, bundle, [&](int row) { return input.m_rows[size_t(row)].m_target - along[size_t(row)]; });
			m_bundle.project();
			hasChanged |= writeBundle(input, bundle);
		}
		return hasChanged;
	}

	/// Adds psi(u) of all rows, u^2 / 2C between the bounds and straight on beyond them, for the impulses of the last project().
	/// \param terms  gets the absolute values added
	void addPotential(const SystemInput& input, const std::vector<double>& along, double& sum, double& terms) const
	{
		for (size_t i = 0; i < m_impulse.size(); ++i)
		{
			const SystemInput::Bounded& row = input.m_rows[i];
			double strain = 0.5 * row.m_compliance * m_impulse[i];
			if (row.m_partner >= 0)
				strain += 0.5 * row.m_coupling * m_impulse[size_t(row.m_partner)];
			const double term = m_impulse[i] * (row.m_target - along[i] - strain);
			sum += term;
			terms += term < 0 ? -term : term;
		}
		for (const SystemInput::Bundle& bundle : input.m_bundles)
		{
			const double term = -input.getCouplingEnergy(bundle, m_impulse);
			sum += term;
			terms += term < 0 ? -term : term;
		}
	}

	/// Begins a line search. \param start, step  J dv of all rows at the step's start, and of the step
	void beginLine(const SystemInput& input, const std::vector<double>& start, const std::vector<double>& step)
	{
		m_lineStart.resize(m_impulse.size());
		m_lineRate.resize(m_impulse.size());
		for (size_t i = 0; i < m_impulse.size(); ++i)
		{
			const double weight = 1 / input.m_rows[i].m_compliance;
			m_lineStart[i] = weight * (input.m_rows[i].m_target - start[i]);
			m_lineRate[i] = weight * step[i];
		}
	}

	/// Adds the derivatives of psi along the step, at a share t of it.
	void addDerivatives(const SystemInput& input, const std::vector<double>& step, double t, double& first,
						double& second)
	{
		for (size_t i = 0; i < m_impulse.size(); ++i)
		{
			const SystemInput::Bounded& row = input.m_rows[i];
			if (row.m_partner >= 0)
			{
				if (row.m_partner > int(i))
					addPairDerivatives(input, step, t, int(i), row.m_partner, first, second);
				continue;
			}
			if (row.isInBundle())
				continue;
			const double impulse = m_lineStart[i] - t * m_lineRate[i];
			const double bounded = impulse < row.m_upper ? impulse : row.m_upper;
			first -= step[i] * (bounded > row.m_lower ? bounded : row.m_lower);
			second += impulse > row.m_lower && impulse < row.m_upper ? step[i] * m_lineRate[i] : 0.;
		}
		for (const SystemInput::Bundle& bundle : input.m_bundles)
			addBundleDerivatives(input, bundle, step, t, first, second);
	}

	/// Adds a unit's tangent in world coordinates, see addUnitTangent().
	bool addTangent(const SystemInput& input, const SystemInput::Unit& unit, double linear[9], double angular[9],
					double mixed[9]) const
	{
		return addUnitTangent(*this, input, unit, linear, angular, mixed);
	}

	/// The tangent of a row, d lambda / du; of a fibre in a bundle as long as the shears' impulses stay, of these shears 0.
	double getTangent(const SystemInput& input, int row) const
	{
		if (m_bound[row] != 0)
			return 0;
		const SystemInput::Bounded& terms = input.m_rows[row];
		if (terms.m_partner == SystemInput::Bounded::SHEAR_OF_BUNDLE)
			return 0;
		if (terms.m_partner < 0)
			return 1 / terms.m_compliance;
		double diagonal[2], beside;
		const signed char bounds[2] = {0, m_bound[terms.m_partner]};
		pairOf(input, row, terms.m_partner).getTangent(bounds, diagonal, beside);
		return diagonal[0];
	}

	/// d lambda / du of a row by its partner's u, 0 without a partner.
	double getTangentWithPartner(const SystemInput& input, int row) const
	{
		const int partner = input.m_rows[row].m_partner;
		if (partner < 0)
			return 0;
		double diagonal[2], beside;
		const signed char bounds[2] = {m_bound[row], m_bound[partner]};
		pairOf(input, row, partner).getTangent(bounds, diagonal, beside);
		return beside;
	}

	/// By a bundle's shears, see CoupledBundle::Matrix.
	CoupledBundle::Matrix getBundleInverse(const SystemInput& input, int index) const
	{
		const SystemInput::Bundle& bundle = input.m_bundles[size_t(index)];
		CoupledBundle::Matrix matrix = {{1, 0, 1}};
		bool isFree[2];
		for (int s = 0; s < 2; ++s)
		{
			const int row = bundle.m_shearRow[s];
			isFree[s] = row >= 0 && m_bound[size_t(row)] == 0;
			if (row >= 0)
				matrix.m_elements[2 * s] = input.m_rows[size_t(row)].m_compliance;
		}
		const SystemInput::Unit& unit = input.m_units[size_t(bundle.m_unit)];
		for (int i = 0; i < unit.m_numFibres; ++i)
			matrix.subtract(getTangent(input, unit.getFirstFibreRow() + i),
							input.m_couplings[size_t(bundle.m_firstCoupling + i)].m_shear);
		return matrix.inverse(isFree[0], isFree[1]);
	}

	/// Notes that the rows' present tangent is in the matrix. \return whether it was another one before
	bool noteTangent(int firstRow, int numRows)
	{
		bool hasChanged = false;
		for (int i = firstRow; i < firstRow + numRows; ++i)
		{
			const char isIn = m_bound[i] == 0;
			hasChanged |= isIn != m_isInTangent[i];
			m_isInTangent[i] = isIn;
		}
		return hasChanged;
	}

	void getResult(std::vector<double>& impulses, std::vector<signed char>& bounds) const
	{
		impulses = m_impulse;
		bounds = m_bound;
	}
	void setResult(const std::vector<double>& impulses, const std::vector<signed char>& bounds)
	{
		m_impulse = impulses;
		m_bound = bounds;
	}

	const std::vector<double>& getImpulses() const { return m_impulse; }
	double getImpulse(int row) const { return m_impulse[row]; }
	const double* getImpulses(int row) const { return m_impulse.data() + row; }
	const signed char* getBounds(int row) const { return m_bound.data() + row; }

private:
	typedef CoupledPair<double> Pair;

	static Pair pairOf(const SystemInput& input, int i, int j)
	{
		return {{input.m_rows[i].m_compliance, input.m_rows[j].m_compliance}, input.m_rows[i].m_coupling};
	}

	/// Both rows' impulses by holdBounds(), from those that each would have by itself.
	void holdPair(const SystemInput& input, int i, int j)
	{
		const int at[2] = {i, j};
		const Pair pair = pairOf(input, i, j);
		const double u[2] = {input.m_rows[i].m_target, input.m_rows[j].m_target};
		for (int k = 0; k < 2; ++k)
			if (m_bound[at[k]] != 0 && m_bound[at[1 - k]] == 0)
				m_impulse[at[1 - k]] = pair.other(k, m_impulse[at[k]], u);
		if (m_bound[i] == 0 && m_bound[j] == 0)
			pair.free(u, &m_impulse[i], &m_impulse[j]);
	}

	/// \return whether a bound has changed
	bool projectPair(const SystemInput& input, const std::vector<double>& along, int i, int j)
	{
		const int at[2] = {i, j};
		double u[2], lower[2], upper[2], impulse[2];
		signed char bound[2];
		for (int k = 0; k < 2; ++k)
		{
			const SystemInput::Bounded& row = input.m_rows[at[k]];
			u[k] = row.m_target - along[at[k]];
			lower[k] = row.m_lower;
			upper[k] = row.m_upper;
		}
		pairOf(input, i, j).project(u, lower, upper, impulse, bound);
		bool hasChanged = false;
		for (int k = 0; k < 2; ++k)
		{
			hasChanged |= bound[k] != m_bound[at[k]];
			m_impulse[at[k]] = impulse[k];
			m_bound[at[k]] = bound[k];
		}
		return hasChanged;
	}

	void addPairDerivatives(const SystemInput& input, const std::vector<double>& step, double t, int i, int j,
							double& first, double& second) const
	{
		const int at[2] = {i, j};
		double u[2], lower[2], upper[2], impulse[2], diagonal[2], beside;
		signed char bound[2];
		for (int k = 0; k < 2; ++k)
		{
			const SystemInput::Bounded& row = input.m_rows[at[k]];
			u[k] = (m_lineStart[at[k]] - t * m_lineRate[at[k]]) * row.m_compliance;
			lower[k] = row.m_lower;
			upper[k] = row.m_upper;
		}
		const Pair pair = pairOf(input, i, j);
		pair.project(u, lower, upper, impulse, bound);
		pair.getTangent(bound, diagonal, beside);
		first -= step[i] * impulse[0] + step[j] * impulse[1];
		second += step[i] * step[i] * diagonal[0] + step[j] * step[j] * diagonal[1] + 2 * step[i] * step[j] * beside;
	}

	// ---- bundles

	/// Fills m_bundle with terms and present bounds. \param targetOf  function of a row
	template <class F>
	void readBundle(const SystemInput& input, const SystemInput::Bundle& bundle, F targetOf)
	{
		const auto read = [&](int row, CoupledBundle::Spring& spring)
		{
			const SystemInput::Bounded& terms = input.m_rows[size_t(row)];
			spring.m_compliance = terms.m_compliance;
			spring.m_lower = terms.m_lower;
			spring.m_upper = terms.m_upper;
			spring.m_target = targetOf(row);
			spring.m_bound = m_bound[size_t(row)];
		};
		const SystemInput::Unit& unit = input.m_units[size_t(bundle.m_unit)];
		m_bundle.m_fibres.resize(size_t(unit.m_numFibres));
		for (int i = 0; i < unit.m_numFibres; ++i)
		{
			CoupledBundle::Fibre& fibre = m_bundle.m_fibres[size_t(i)];
			read(unit.getFirstFibreRow() + i, fibre);
			for (int s = 0; s < 2; ++s)
				fibre.m_coupling[s] = input.m_couplings[size_t(bundle.m_firstCoupling + i)].m_shear[s];
		}
		for (int s = 0; s < 2; ++s)
			if (bundle.m_shearRow[s] >= 0)
				read(bundle.m_shearRow[s], m_bundle.m_shear[s]);
			else
				m_bundle.m_shear[s] = {1, 0, 0, 0, 0, 1};
	}

	/// Takes m_bundle's impulses and bounds. \return whether a bound has changed
	bool writeBundle(const SystemInput& input, const SystemInput::Bundle& bundle)
	{
		bool hasChanged = false;
		const auto write = [&](int row, const CoupledBundle::Spring& spring)
		{
			m_impulse[size_t(row)] = spring.m_force;
			hasChanged |= m_bound[size_t(row)] != spring.m_bound;
			m_bound[size_t(row)] = spring.m_bound;
		};
		const SystemInput::Unit& unit = input.m_units[size_t(bundle.m_unit)];
		for (int i = 0; i < unit.m_numFibres; ++i)
			write(unit.getFirstFibreRow() + i, m_bundle.m_fibres[size_t(i)]);
		for (int s = 0; s < 2; ++s)
			if (bundle.m_shearRow[s] >= 0)
				write(bundle.m_shearRow[s], m_bundle.m_shear[s]);
		return hasChanged;
	}

	/// The derivatives of psi of a bundle along a step.
	void addBundleDerivatives(const SystemInput& input, const SystemInput::Bundle& bundle,
							  const std::vector<double>& step, double t, double& first, double& second)
	{
		readBundle(input, bundle,
				   [&](int row)
				   {
					   const size_t i = size_t(row);
					   return (m_lineStart[i] - t * m_lineRate[i]) * input.m_rows[i].m_compliance;
				   });
		m_bundle.project();
		const SystemInput::Unit& unit = input.m_units[size_t(bundle.m_unit)];
		const bool isFree[2] = {m_bundle.m_shear[0].m_bound == 0, m_bundle.m_shear[1].m_bound == 0};
		CoupledBundle::Matrix matrix = {{m_bundle.m_shear[0].m_compliance, 0, m_bundle.m_shear[1].m_compliance}};
		double shear[2] = {};
		for (int s = 0; s < 2; ++s)
			if (bundle.m_shearRow[s] >= 0)
			{
				shear[s] = step[size_t(bundle.m_shearRow[s])];
				first -= shear[s] * m_bundle.m_shear[s].m_force;
			}
		for (int i = 0; i < unit.m_numFibres; ++i)
		{
			const CoupledBundle::Fibre& fibre = m_bundle.m_fibres[size_t(i)];
			const double along = step[size_t(unit.getFirstFibreRow() + i)];
			first -= along * fibre.m_force;
			if (fibre.m_bound != 0)
				continue;
			const double tangent = 1 / fibre.m_compliance;
			matrix.subtract(tangent, fibre.m_coupling);
			second += tangent * along * along;
			for (int s = 0; s < 2; ++s)
				shear[s] -= tangent * fibre.m_coupling[s] * along;
		}
		const CoupledBundle::Matrix inverse = matrix.inverse(isFree[0], isFree[1]);
		second += shear[0] * inverse.multiply(0, shear) + shear[1] * inverse.multiply(1, shear);
	}

	std::vector<double> m_impulse;     // lambda, by row
	std::vector<signed char> m_bound;  // -1 at the lower, 1 at the upper bound, 0 between
	std::vector<char> m_isInTangent;
	CoupledBundle m_bundle;                       // the one at hand
	std::vector<double> m_lineStart, m_lineRate;  // u / C at a line's start, and what it falls by along it
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ADMISSIBLE_BOX_H
