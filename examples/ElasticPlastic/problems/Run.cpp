// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace ep
{
void Run::begin()
{
	m_left = m_stepping.substeps;
	m_control.begin(btScalar(m_stepping.step));
}

btScalar Run::next()
{
	if (m_stepping.error > 0)
		return m_control.next(m_world.bullet());
	return m_left-- > 0 ? btScalar(m_stepping.step / m_stepping.substeps) : btScalar(0);
}

void Run::substep(btScalar dt)
{
	if (m_stepping.watch && m_time == 0)
		m_stepping.watch(m_world, 0);
	m_audit.begin();
	const auto begin = std::chrono::steady_clock::now();
	m_world.step(dt);
	if (m_stepping.error > 0)
		m_control.observe(m_world.bullet(), m_world.action());
	m_outcome.runTime += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
	m_audit.end(dt);
	++m_outcome.substeps;
	m_time += double(dt);
	m_outcome.simulated += double(dt);
	if (m_stepping.watch)
		m_stepping.watch(m_world, m_time);
}

Run::~Run()
{
	const double byJoints = m_audit.createdByJoints() > EnergyAudit::SLACK ? m_audit.createdByJoints() : 0.;
	const double created = std::max(m_audit.created(), byJoints);
	// Bullet's own joints do not tell what they take.
	if (!m_world.method().kind().isElasticPlastic())
		m_outcome.energyCreated = NAN;
	// Of several runs the worst.
	else if (!(created <= m_outcome.energyCreated))
		m_outcome.energyCreated = created;
}
}  // namespace ep
