// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "WorkerPool.h"

namespace btElasticPlastic
{
WorkerPool::WorkerPool(int numWorkers)
{
	for (int worker = 1; worker < numWorkers; ++worker)
		m_threads.emplace_back(&WorkerPool::work, this, worker);
}

WorkerPool::~WorkerPool()
{
	{
		const std::lock_guard<std::mutex> lock(m_mutex);
		m_isOver = true;
	}
	m_begin.notify_all();
	for (std::thread& thread : m_threads)
		thread.join();
}

void WorkerPool::run(Task& task, int numIndices)
{
	{
		const std::lock_guard<std::mutex> lock(m_mutex);
		m_task = &task;
		m_numIndices = numIndices;
		m_next = 0;
	}
	m_begin.notify_all();
	while (takeOne(0))
		;
	std::unique_lock<std::mutex> lock(m_mutex);
	m_end.wait(lock, [this] { return m_running == 0; });
	m_task = nullptr;
}

/// Runs the task for one index. \return whether one was left
bool WorkerPool::takeOne(int worker)
{
	std::unique_lock<std::mutex> lock(m_mutex);
	if (!m_task || m_next == m_numIndices)
		return false;
	const int index = m_next++;
	++m_running;
	lock.unlock();
	m_task->run(index, worker);
	lock.lock();
	if (--m_running == 0 && m_next == m_numIndices)
		m_end.notify_one();
	return true;
}

void WorkerPool::work(int worker)
{
	for (;;)
	{
		{
			std::unique_lock<std::mutex> lock(m_mutex);
			m_begin.wait(lock, [this] { return m_isOver || (m_task && m_next < m_numIndices); });
			if (m_isOver)
				return;
		}
		while (takeOne(worker))
			;
	}
}
}  // namespace btElasticPlastic
