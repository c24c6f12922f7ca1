// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_WORKER_POOL_H
#define BT_ELASTIC_PLASTIC_WORKER_POOL_H

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace btElasticPlastic
{
/// Threads that share the indices of a task with the calling thread. They sleep between calls.
class WorkerPool
{
public:
	struct Task
	{
		virtual ~Task() {}
		/// \param worker  the worker that runs it, 0 to getNumWorkers() - 1; never two threads at the same time have the same
		///           number
		virtual void run(int index, int worker) = 0;
	};

	/// \param numWorkers  the calling thread included, >= 1
	explicit WorkerPool(int numWorkers);
	~WorkerPool();
	WorkerPool(const WorkerPool&) = delete;
	WorkerPool& operator=(const WorkerPool&) = delete;

	int getNumWorkers() const { return int(m_threads.size()) + 1; }

	/// Runs the task once for each index from 0 to numIndices - 1, in any order, and comes back when all are done.
	void run(Task& task, int numIndices);

private:
	void work(int worker);
	bool takeOne(int worker);

	std::vector<std::thread> m_threads;
	std::mutex m_mutex;
	std::condition_variable m_begin, m_end;
	// Under the mutex.
	Task* m_task = nullptr;
	int m_numIndices = 0;
	int m_next = 0;     // index that nobody has taken
	int m_running = 0;  // taken and not done
	bool m_isOver = false;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_WORKER_POOL_H
