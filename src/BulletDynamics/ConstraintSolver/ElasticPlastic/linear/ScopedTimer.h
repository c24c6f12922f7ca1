// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SCOPED_TIMER_H
#define BT_ELASTIC_PLASTIC_SCOPED_TIMER_H

#include <chrono>

#include "LinearMath/btQuickprof.h"

namespace btElasticPlastic
{
/// Adds the time between its construction and destruction to a sum [s], and is a zone of Bullet's profiler.
class ScopedTimer
{
public:
	ScopedTimer(const char* zone, double& sum)
		: m_zone(zone), m_sum(sum), m_begin(std::chrono::steady_clock::now())
	{
	}
	~ScopedTimer()
	{
		m_sum += std::chrono::duration<double>(std::chrono::steady_clock::now() - m_begin).count();
	}
	ScopedTimer(const ScopedTimer&) = delete;
	ScopedTimer& operator=(const ScopedTimer&) = delete;

private:
	CProfileSample m_zone;
	double& m_sum;
	const std::chrono::steady_clock::time_point m_begin;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SCOPED_TIMER_H
