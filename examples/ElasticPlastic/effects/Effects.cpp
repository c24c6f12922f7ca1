// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "effects/Effects.h"

namespace ep
{
void Effects::afterStep(World& world, btScalar dt)
{
	m_particles.step(dt);
	m_bursts.clear();
	m_bursts.swap(m_added);
	for (const Blow& blow : m_blows.after(world))
		m_bursts.push_back({Burst::Kind::Blow, blow.place, blow.energy, false});
	for (const Burst& burst : m_bursts)
		m_particles.add(burst);
}
}  // namespace ep
