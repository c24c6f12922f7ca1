// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TRIALS_H
#define EP_TRIALS_H

#include <chrono>

#include "world/EnergyAudit.h"
#include "problems/Stability.h"

namespace ep
{
/// Steps a world and keeps its verdict.
class Watch
{
public:
	explicit Watch(World& world) : m_world(world), m_audit(world) {}

	void step(double dt)
	{
		const auto begin = std::chrono::steady_clock::now();
		const double energy = m_audit.step(btScalar(dt));
		m_verdict.runTime += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
		m_verdict.isFinite &= std::isfinite(energy) && std::isfinite(m_world.kineticEnergy());
		m_verdict.created = m_audit.created();
		m_verdict.createdByJoints = m_audit.createdByJoints();
	}

	/// Steps of dt until a time has passed [s].
	void run(double time, double dt)
	{
		for (int i = int(time / dt + 0.5); i > 0; --i)
			step(dt);
	}

	/// \param slack  absolute
	Verdict verdict(double value, double exact, double slack)
	{
		m_verdict.value = value;
		m_verdict.exact = exact;
		m_verdict.slack = slack;
		return m_verdict;
	}
	Verdict verdict() { return m_verdict; }

private:
	World& m_world;
	EnergyAudit m_audit;
	Verdict m_verdict;
};

/// Of Bullet's precision, at a place so far from the origin: what a position can tell [m].
inline double roundingAt(double place) { return 4 * double(SIMD_EPSILON) * place; }

// The trials, by what they vary.
void addTrialsOfScale(std::vector<Trial>& trials);     ///< stiffness, mass, size, step, damping
void addTrialsOfMotion(std::vector<Trial>& trials);    ///< turns, spin, impacts, all at once
void addTrialsOfHandling(std::vector<Trial>& trials);  ///< capacities, frames, partners, sleep, long times, bad input
}  // namespace ep

#endif  // EP_TRIALS_H
