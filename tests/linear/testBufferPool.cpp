// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Memory that goes from one plan to the next.

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/linear/BufferPool.h"

namespace testBufferPool
{
using btElasticPlastic::BufferPool;

TEST(BufferPool, GivesWhatIsReadyToWhatFitsIt)
{
	BufferPool pool;
	pool.reserve(100000);
	pool.reserve(40000);
	std::vector<double> factor, matrix, small;
	// A small island leaves it to a large one.
	pool.take(100, small);
	EXPECT_LT(small.capacity(), 1000u);
	pool.take(90000, factor);
	EXPECT_EQ(100000u, factor.capacity()) << "nothing new";
	pool.take(30000, matrix);
	EXPECT_EQ(40000u, matrix.capacity());
}

TEST(BufferPool, TakesTheSmallestThatFits)
{
	BufferPool pool;
	pool.reserve(50000);
	pool.reserve(30000);
	std::vector<double> buffer;
	pool.take(20000, buffer);
	EXPECT_EQ(30000u, buffer.capacity());
	pool.give(buffer);
	EXPECT_EQ(0u, buffer.capacity());
	pool.take(40000, buffer);
	EXPECT_EQ(50000u, buffer.capacity());
}
}  // namespace testBufferPool
