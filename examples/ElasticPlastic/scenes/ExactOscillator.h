// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_EXACT_OSCILLATOR_H
#define EP_EXACT_OSCILLATOR_H

#include <math.h>

#include <algorithm>

namespace ep
{
/// A mass on an elastic-perfectly plastic spring under a force that is constant for a while: the exact motion, phase by phase.
/// Elastic: u = x - plastic - force/k swings as R cos(w t - phi); plastic: constant acceleration until it stands.
struct ExactOscillator
{
	double m_mass, m_stiffness, m_yield;
	double m_place = 0, m_velocity = 0, m_plastic = 0, m_path = 0;
	int m_flow = 0;  ///< sign of the force while it flows

	double energy() const { return m_yield * m_path; }

	void advance(double force, double duration)
	{
		while (duration > 0)
			duration -= m_flow ? flow(force, duration) : swing(force, duration);
	}

private:
	/// \return the time it took
	double flow(double force, double duration)
	{
		const double acceleration = (force - m_flow * m_yield) / m_mass;
		double t = duration;
		if (acceleration * m_flow < 0)
			t = std::min(t, -m_velocity / acceleration);
		const double way = m_velocity * t + acceleration * t * t / 2;
		m_place += way;
		m_plastic += way;
		m_path += fabs(way);
		m_velocity += acceleration * t;
		if (t < duration)
		{
			m_velocity = 0;
			m_flow = 0;
		}
		return t;
	}

	double swing(double force, double duration)
	{
		const double w = sqrt(m_stiffness / m_mass), middle = m_plastic + force / m_stiffness;
		const double u0 = m_place - middle, r = hypot(u0, m_velocity / w), phi = atan2(m_velocity / w, u0);
		double t = duration;
		int flow = 0;
		for (int sign = -1; sign <= 1; sign += 2)
		{
			const double limit = m_plastic + sign * m_yield / m_stiffness - middle;
			if (fabs(limit) >= r)
				continue;
			// Outward through the limit: cos(w t - phi) = limit / r with velocity of the limit's sign.
			double hit = (phi - sign * acos(limit / r)) / w;
			while (hit <= 1e-12)
				hit += 2 * M_PI / w;
			if (hit < t)
			{
				t = hit;
				flow = sign;
			}
		}
		m_place = middle + r * cos(w * t - phi);
		m_velocity = -r * w * sin(w * t - phi);
		m_flow = flow;
		return t;
	}
};
}  // namespace ep

#endif  // EP_EXACT_OSCILLATOR_H
