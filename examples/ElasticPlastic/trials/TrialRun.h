// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TRIAL_RUN_H
#define EP_TRIAL_RUN_H

#include <chrono>

#include "trials/Trial.h"
#include "world/EnergyAudit.h"

namespace ep
{
/// Steps a world and keeps its verdict.
class TrialRun
{
public:
	TrialRun(World& world, const TrialSetup& setup) : m_world(world), m_setup(setup), m_audit(world) {}

	void step(double dt)
	{
		if (m_time == 0)
			m_setup.look(m_world, 0);
		const auto begin = std::chrono::steady_clock::now();
		const double energy = m_audit.step(btScalar(dt));
		m_verdict.runTime += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
		m_verdict.isFinite &= std::isfinite(energy) && std::isfinite(m_world.kineticEnergy());
		m_verdict.created = m_audit.created();
		m_verdict.createdByJoints = m_audit.createdByJoints();
		m_time += dt;
		m_setup.look(m_world, m_time);
	}

	/// Steps of dt until a time has passed [s].
	void runFor(double time, double dt)
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
	const TrialSetup& m_setup;
	EnergyAudit m_audit;
	Verdict m_verdict;
	double m_time = 0;
};

/// Of Bullet's precision, at a place so far from the origin: what a position can tell [m].
inline double roundingAt(double place) { return 4 * double(SIMD_EPSILON) * place; }
}  // namespace ep

#endif  // EP_TRIAL_RUN_H
