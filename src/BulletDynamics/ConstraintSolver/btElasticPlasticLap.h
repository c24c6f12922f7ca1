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

#ifndef BT_ELASTIC_PLASTIC_LAP_H
#define BT_ELASTIC_PLASTIC_LAP_H

#include <chrono>

#include "LinearMath/btQuickprof.h"

/// Adds the time of its life to a sum [s], and shows as a zone in Bullet's profile.
class btElasticPlasticLap
{
public:
	btElasticPlasticLap(const char* zone, double& sum)
		: m_zone(zone), m_sum(sum), m_begin(std::chrono::steady_clock::now())
	{
	}
	~btElasticPlasticLap()
	{
		m_sum += std::chrono::duration<double>(std::chrono::steady_clock::now() - m_begin).count();
	}
	btElasticPlasticLap(const btElasticPlasticLap&) = delete;
	btElasticPlasticLap& operator=(const btElasticPlasticLap&) = delete;

private:
	CProfileSample m_zone;
	double& m_sum;
	const std::chrono::steady_clock::time_point m_begin;
};

#endif  // BT_ELASTIC_PLASTIC_LAP_H
