// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ITERATIVE_FORM_H
#define BT_ELASTIC_PLASTIC_ITERATIVE_FORM_H

#include <vector>

#include "../joint/JointWorks.h"
#include "FibreBlock.h"
#include "SolverPools.h"

namespace btElasticPlastic
{
/// The iterative form of the solver: Bullet's sequential impulses on exact soft rows.
///
/// Bullet multiplies the impulse by a row's compliance but leaves it out of the diagonal; the iteration then diverges for springs
/// that the step resolves. Here an elastic-plastic row (J v + C lambda = r) is divided by A + C instead of A, which is
/// Gauss-Seidel on the true matrix and converges for every C, if slowly for long stiff chains. The fibres of a joint are one block of it.
class IterativeForm
{
public:
	/// Begins an island.
	void begin() { clear(); }

	/// Sets compliance, right side and bounds of the joint's rows in Bullet's pool, where Bullet has set J, A and -J v / A.
	/// \param firstRow  the first of the joint's elastic-plastic rows in the pool
	/// \param erp       Bullet's error reduction
	void addJoint(JointWorks& joint, int firstRow, const SolverPools& pools, btScalar erp);

	/// Solves the blocks of fibres, before Bullet solves its rows in an iteration.
	/// \return as FibreBlock::solve()
	btScalar solveFibres(int iteration, const SolverPools& pools);

	/// Forgets the island: its joints have no part in the step any more.
	void cancel();

	/// Gives joints their impulses.
	void finish(const SolverPools& pools);

private:
	struct Joint
	{
		JointWorks* m_works;
		int m_firstRow;  ///< in Bullet's pool
		int m_block;     ///< of its fibres, -1: none
	};

	void clear()
	{
		m_joints.resize(0);
		m_numBlocks = 0;
	}

	btAlignedObjectArray<Joint> m_joints;
	std::vector<FibreBlock> m_blocks;  ///< m_numBlocks of them count: their memory serves island after island
	size_t m_numBlocks = 0;
	JointRows m_rows;  ///< with the fibres of one joint after another
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ITERATIVE_FORM_H
