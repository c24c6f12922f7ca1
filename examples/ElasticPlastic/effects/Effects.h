// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_EFFECTS_H
#define EP_EFFECTS_H

#include "effects/Blows.h"
#include "effects/Particles.h"

namespace ep
{
/// What is to be seen and heard of a world beside its bodies.
class Effects
{
public:
	/// Breaks and charges, which the scene knows; blows are found.
	void add(const Burst& burst) { m_added.push_back(burst); }

	void beforeStep(const World& world) { m_blows.before(world); }
	void afterStep(World& world, btScalar dt);
	void clear() { *this = Effects(); }

	/// Of the last step.
	const std::vector<Burst>& bursts() const { return m_bursts; }
	std::vector<Puff> puffs() const { return m_particles.puffs(); }

private:
	Blows m_blows;
	Particles m_particles;
	std::vector<Burst> m_added, m_bursts;
};
}  // namespace ep

#endif  // EP_EFFECTS_H
