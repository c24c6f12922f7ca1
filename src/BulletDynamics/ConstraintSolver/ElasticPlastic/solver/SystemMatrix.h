// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SYSTEM_MATRIX_H
#define BT_ELASTIC_PLASTIC_SYSTEM_MATRIX_H

#include <vector>

#include "../linear/LinearSolver.h"
#include "AdmissibleBox.h"
#include "SystemInput.h"

namespace btElasticPlastic
{
/// The matrix H = M + sum J^T (d lambda / du) J of a System: its graph, and what bodies, units and single rows put into it.
class SystemMatrix
{
public:
	explicit SystemMatrix(LinearSolver& solver) : m_solver(solver) {}

	/// Begins a problem. \param islandId, numSolutions, numLast  see LinearSolver::begin
	void begin(const SystemInput& input, int islandId, int numSolutions, int numLast = 0);

	/// Computes H for the rows' present tangents, and tells the linear solver what has changed since the last time. Where few rows have
	/// begun or ended to flow since then, only the blocks of their bodies are computed anew, to the same bits.
	void assemble(const SystemInput& input, AdmissibleBox& box);

	/// To be called if more has changed than the rows' bounds.
	void forget() { m_isAssembled = false; }

	/// To be called if others may use the memory until the next assembly, which is a new one.
	void lendBuffers()
	{
		forget();
		m_solver.lendBuffers();
	}

	/// Computes H for tangents that have nothing to do with the last ones.
	/// \param tangents  with addTangent(), getTangent(), getTangentWithPartner() and getBundleInverse() of AdmissibleBox
	template <class Tangents>
	void assembleAnew(const SystemInput& input, const Tangents& tangents)
	{
		m_isAssembled = false;
		addMasses(input);
		addCondensed(input.m_condensed);
		addRows(input, tangents);
		m_solver.forgetFactor();
	}

private:
	int addEdge(const int body[2]);
	template <class Tangents>
	void addRows(const SystemInput& input, const Tangents& tangents);
	void addMasses(const SystemInput& input);
	void addMass(const SystemInput& input, int body);
	bool beginPart(const SystemInput& input);
	void setZeroInPart(const int body[2], int edge);
	void addCondensed(const SystemInput::Condensed& condensed);
	/// \param mixed  of shear and bending, null: none
	void addUnit(const SystemInput::Unit& unit, int edge, const double linear[9], const double angular[9],
				 const double* mixed);
	void addProduct(const SystemInput::SingleRow& a, const SystemInput::SingleRow& b, int edge, double tangent);
	void noteChange(const int body[2], bool hasChanged);

	/// Whether blocks of a body are computed in the present assembly.
	bool isInPart(int body) const { return body >= 0 && (m_isWhole || m_isChanged[size_t(body)] != 0); }
	bool isAnyInPart(const int body[2]) const { return isInPart(body[0]) || isInPart(body[1]); }
	/// The block beside the diagonal of two such bodies.
	bool isEdgeInPart(const int body[2], int edge) const { return edge >= 0 && isInPart(body[0]) && isInPart(body[1]); }

	LinearSolver& m_solver;
	std::vector<int> m_edges;           // two bodies each
	std::vector<int> m_unitEdge;        // of the matrix, per unit, -1: none
	std::vector<int> m_singleRowEdge;   // the same per single row
	std::vector<int> m_condensedEdges;  // by pair of condensed bodies
	std::vector<int> m_changedBodies;   // by the last assembly
	std::vector<char> m_isChanged;      // the same, by body
	bool m_isAssembled = false;         // H is that of the bounds of the last assembly
	bool m_isWhole = true;              // all blocks are computed in the present assembly
};

template <class Tangents>
void SystemMatrix::addRows(const SystemInput& input, const Tangents& tangents)
{
	for (size_t i = 0; i < input.m_units.size(); ++i)
	{
		if (!isAnyInPart(input.m_units[i].m_body))
			continue;
		double linear[9] = {}, angular[9] = {}, mixed[9] = {};
		const bool isMixed = tangents.addTangent(input, input.m_units[i], linear, angular, mixed);
		addUnit(input.m_units[i], m_unitEdge[i], linear, angular, isMixed ? mixed : nullptr);
	}
	for (size_t i = 0; i < input.m_singleRows.size(); ++i)
	{
		const SystemInput::SingleRow& row = input.m_singleRows[i];
		if (!isAnyInPart(row.m_body))
			continue;
		if (const double tangent = tangents.getTangent(input, row.m_row))
			addProduct(row, row, m_singleRowEdge[i], tangent);
		if (const double beside = tangents.getTangentWithPartner(input, row.m_row))
			addProduct(row, input.m_singleRows[i + size_t(input.m_rows[size_t(row.m_row)].m_partner - row.m_row)],
					   m_singleRowEdge[i], beside);
	}
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SYSTEM_MATRIX_H
