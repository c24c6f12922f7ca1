// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The worker pool: every index once, no two at the same time by one worker, again and again.

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/solver/WorkerPool.h"

namespace testWorkerPool
{
using btElasticPlastic::WorkerPool;

struct Counting : WorkerPool::Task
{
	std::vector<std::atomic<int>> m_runs;
	std::vector<std::atomic<int>> m_busy;
	std::atomic<bool> m_hasOverlapped{false};
	std::atomic<bool> m_isWorkerOutOfRange{false};

	Counting(int indices, int workers) : m_runs(size_t(indices)), m_busy(size_t(workers)) {}

	void run(int index, int worker) override
	{
		if (worker < 0 || size_t(worker) >= m_busy.size())
		{
			m_isWorkerOutOfRange = true;
			return;
		}
		if (m_busy[size_t(worker)].fetch_add(1) != 0)
			m_hasOverlapped = true;
		++m_runs[size_t(index)];
		--m_busy[size_t(worker)];
	}
};

TEST(WorkerPool, RunsEveryIndexOnce)
{
	for (const int workers : {1, 2, 5})
	{
		WorkerPool pool(workers);
		EXPECT_EQ(workers, pool.getNumWorkers());
		for (const int indices : {1, 3, 1000})
		{
			Counting task(indices, workers);
			pool.run(task, indices);
			for (const auto& runs : task.m_runs)
				EXPECT_EQ(1, runs.load());
			EXPECT_FALSE(task.m_hasOverlapped);
			EXPECT_FALSE(task.m_isWorkerOutOfRange);
		}
	}
}

TEST(WorkerPool, ComesBackAfterThousandsOfCalls)
{
	WorkerPool pool(3);
	Counting task(7, 3);
	for (int i = 0; i < 5000; ++i)
		pool.run(task, 7);
	for (const auto& runs : task.m_runs)
		EXPECT_EQ(5000, runs.load());
}

TEST(WorkerPool, ComesBackWithNothingToDo)
{
	WorkerPool pool(2);
	Counting task(1, 2);
	pool.run(task, 0);
	EXPECT_EQ(0, task.m_runs[0].load());
}
}  // namespace testWorkerPool
