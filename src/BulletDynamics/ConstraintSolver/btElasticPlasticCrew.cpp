/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#include "btElasticPlasticCrew.h"

btElasticPlasticCrew::btElasticPlasticCrew(int numWorkers)
{
	for (int worker = 1; worker < numWorkers; ++worker)
		m_threads.emplace_back(&btElasticPlasticCrew::work, this, worker);
}

btElasticPlasticCrew::~btElasticPlasticCrew()
{
	{
		const std::lock_guard<std::mutex> lock(m_mutex);
		m_isOver = true;
	}
	m_begin.notify_all();
	for (std::thread& thread : m_threads)
		thread.join();
}

void btElasticPlasticCrew::run(Task& task, int numIndices)
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

/// \return whether there was one left
bool btElasticPlasticCrew::takeOne(int worker)
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

void btElasticPlasticCrew::work(int worker)
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
