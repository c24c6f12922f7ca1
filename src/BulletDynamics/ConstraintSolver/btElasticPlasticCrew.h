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

#ifndef BT_ELASTIC_PLASTIC_CREW_H
#define BT_ELASTIC_PLASTIC_CREW_H

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

/// Threads that share tasks with the one that calls. They wait without cost between calls.
class btElasticPlasticCrew
{
public:
	struct Task
	{
		virtual ~Task() {}
		/// \param worker  who does it, 0 to getNumWorkers() - 1; no two do anything at the same time with the same number
		virtual void run(int index, int worker) = 0;
	};

	/// \param numWorkers  the calling thread included, >= 1
	explicit btElasticPlasticCrew(int numWorkers);
	~btElasticPlasticCrew();
	btElasticPlasticCrew(const btElasticPlasticCrew&) = delete;
	btElasticPlasticCrew& operator=(const btElasticPlasticCrew&) = delete;

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

#endif  // BT_ELASTIC_PLASTIC_CREW_H
