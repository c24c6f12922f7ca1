// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The sparse block matrix, against dense ones.

#include <gtest/gtest.h>

#include "linear/BlockMatrices.h"

namespace testBlockMatrix
{
using namespace ep;

TEST(BlockMatrix, MultipliesLikeADenseOne)
{
	for (const auto& [name, graph] : smallGraphs())
	{
		SCOPED_TRACE(name);
		Matrix matrix = matrixOf(graph);
		const Values x = randomValues(graph.m_numBodies), full = dense(matrix, graph);
		Values expected(x.size());
		for (size_t i = 0; i < x.size(); ++i)
			for (size_t j = 0; j < x.size(); ++j)
				expected[i] += full[i * x.size() + j] * x[j];
		EXPECT_LT(difference(expected, product(matrix, x)), 1e-13);
	}
}

TEST(BlockMatrix, RepeatedEdgesShareABlock)
{
	const int edges[][2] = {{2, 0}, {0, 1}, {0, 2}, {1, 0}, {2, 0}};
	Matrix matrix;
	matrix.setPattern(3, edges, 5);
	matrix.setZero();
	EXPECT_EQ(matrix.getNumPairs(), 2);
	bool transposed[5];
	double* block[5];
	for (int e = 0; e < 5; ++e)
		block[e] = matrix.offDiagonal(e, transposed[e]);
	EXPECT_EQ(block[0], block[2]);
	EXPECT_EQ(block[0], block[4]);
	EXPECT_EQ(block[1], block[3]);
	EXPECT_NE(block[0], block[1]);
	EXPECT_EQ(transposed[0], transposed[4]);
	EXPECT_NE(transposed[0], transposed[2]);
	EXPECT_NE(transposed[1], transposed[3]);

	// Rows of an edge's block are its first body's: degree of freedom 4 of body 2 feels 1 of body 0.
	block[0][transposed[0] ? 6 * 4 + 1 : 6 * 1 + 4] = 3;
	Values x(18), expected(18);
	x[1] = 1;
	expected[12 + 4] = 3;
	EXPECT_EQ(product(matrix, x), expected);
	x[1] = 0;
	x[12 + 4] = 1;
	expected[12 + 4] = 0;
	expected[1] = 3;
	EXPECT_EQ(product(matrix, x), expected);

	matrix.setZero();
	EXPECT_EQ(norm(product(matrix, Values(18, 1.0))), 0);
}
}  // namespace testBlockMatrix
