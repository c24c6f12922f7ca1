// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PARTICLES_H
#define EP_PARTICLES_H

#include <deque>
#include <random>

#include "drawing/Burst.h"
#include "drawing/Drawing.h"

namespace ep
{
/// The sparks and dust of bursts, for the eye alone: nothing in the world feels them. The same bursts make the same ones.
class Particles
{
public:
	void add(const Burst& burst);
	void step(btScalar dt);
	void clear() { *this = Particles(); }

	std::vector<Puff> puffs() const;

private:
	struct Particle
	{
		btVector3 place, velocity;
		btScalar age, life;  ///< [s]
		btScalar radius;     ///< when it is old [m]
		bool isSpark;
	};

	btScalar random() { return btScalar(m_random() - m_random.min()) / btScalar(m_random.max() - m_random.min()); }
	btVector3 randomDirection();
	void add(const Particle& particle);

	std::deque<Particle> m_particles;
	std::minstd_rand m_random;
};
}  // namespace ep

#endif  // EP_PARTICLES_H
