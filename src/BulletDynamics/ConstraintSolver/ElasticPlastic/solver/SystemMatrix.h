// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SYSTEM_MATRIX_H
#define BT_ELASTIC_PLASTIC_SYSTEM_MATRIX_H

#include <vector>

#include "../linear/LinearSolver.h"
#include "BoxLaw.h"
#include "SystemInput.h"

namespace btElasticPlastic
{
/// The matrix H = M + sum J^T (d lambda / du) J of a System: its graph, and what bodies, units and single rows put into it.
class SystemMatrix
{
public:
	explicit SystemMatrix(LinearSolver& solver) : m_solver(solver) {}

	/// Begins a problem. \param islandId  see LinearSolver::begin
	void begin(const SystemInput& input, int islandId);

	/// Computes H for the rows' present tangents, and tells the linear solver what has changed since the last time.
	void assemble(const SystemInput& input, BoxLaw& law);

private:
	int addEdge(const int body[2]);
	void addUnit(const SystemInput::Unit& unit, int edge, const SystemInput& input, const BoxLaw& law);
	void addProduct(const SystemInput::SingleRow& a, const SystemInput::SingleRow& b, int edge, double tangent);
	void noteChange(const int body[2], bool hasChanged);

	LinearSolver& m_solver;
	std::vector<int> m_edges;          // two bodies each
	std::vector<int> m_unitEdge;       // of the matrix, per unit, -1: none
	std::vector<int> m_singleRowEdge;  // the same per single row
	std::vector<int> m_changedBodies;  // by the last assembly
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SYSTEM_MATRIX_H
