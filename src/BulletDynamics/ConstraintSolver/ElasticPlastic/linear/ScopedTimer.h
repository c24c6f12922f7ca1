// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SCOPED_TIMER_H
#define BT_ELASTIC_PLASTIC_SCOPED_TIMER_H

#include <chrono>

#include "LinearMath/btQuickprof.h"

namespace btElasticPlastic
{
/// A zone of Bullet's profiler. Adds the time between its construction and destruction to a sum [s], if that is asked for: where islands are small,
/// reading the clock takes longer than what it measures.
class ScopedTimer
{
public:
	ScopedTimer(const char* zone, double& sum, bool isMeasured) : m_zone(zone), m_sum(isMeasured ? &sum : nullptr)
	{
		if (m_sum)
			m_begin = std::chrono::steady_clock::now();
	}
	~ScopedTimer()
	{
		if (m_sum)
			*m_sum += std::chrono::duration<double>(std::chrono::steady_clock::now() - m_begin).count();
	}
	ScopedTimer(const ScopedTimer&) = delete;
	ScopedTimer& operator=(const ScopedTimer&) = delete;

private:
	CProfileSample m_zone;
	double* const m_sum;
	std::chrono::steady_clock::time_point m_begin;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SCOPED_TIMER_H
