// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "effects/Particles.h"

#include <algorithm>
#include <cmath>

namespace ep
{
namespace
{
const size_t MOST = 1500, MOST_OF_ONE = 120;
const btScalar FALL = 10, DRAG = btScalar(1.5);  // [m/s^2], of dust [1/s]
const Colour DUST = {.42f, .39f, .34f}, SPARK = {4, 1.9f, .5f};

/// From 0 at 10 J to 1 at a megajoule: what is a hundred times as much looks twice as much.
double strength(double energy) { return std::min(1., std::max(0., (std::log10(std::max(energy, 1.)) - 1) / 5)); }
}  // namespace

btVector3 Particles::randomDirection()
{
	btVector3 direction;
	do
		direction.setValue(2 * random() - 1, 2 * random() - 1, 2 * random() - 1);
	while (direction.length2() > 1 || direction.length2() < btScalar(1e-4));
	return direction.normalized();
}

void Particles::add(const Particle& particle)
{
	m_particles.push_back(particle);
	if (m_particles.size() > MOST)
		m_particles.pop_front();
}

void Particles::add(const Burst& burst)
{
	const double share = strength(burst.energy);
	const size_t count = size_t(share * share * double(MOST_OF_ONE));
	const btScalar size = btScalar(.3 + share);
	const bool isBlow = burst.kind == Burst::Kind::Blow, dust = !burst.isSteel;
	// Of concrete its bars.
	const size_t sparks = isBlow ? 0 : burst.isSteel || burst.kind == Burst::Kind::Charge ? count : count / 4;
	for (size_t i = 0; i < sparks; ++i)
		add({burst.place, randomDirection() * (2 + 8 * random() * size), 0, btScalar(.3) + btScalar(.5) * random(),
			 btScalar(.02), true});
	for (size_t i = 0; dust && i < count / (isBlow ? 6 : 3); ++i)
	{
		const btVector3 direction = randomDirection();
		add({burst.place + direction * (size / 3), direction * (3 * random() * size), 0, 1 + 2 * random(),
			 size * (btScalar(.5) + random() / 2), false});
	}
}

void Particles::step(btScalar dt)
{
	for (Particle& p : m_particles)
	{
		p.age += dt;
		if (p.isSpark)
			p.velocity.setY(p.velocity.y() - FALL * dt);
		else
			p.velocity *= btExp(-DRAG * dt);
		p.place += p.velocity * dt;
		// On the ground.
		if (p.place.y() < p.radius && p.velocity.y() < 0)
			p.velocity.setY(p.isSpark ? -p.velocity.y() / 3 : 0);
	}
	m_particles.erase(
		std::remove_if(m_particles.begin(), m_particles.end(), [](const Particle& p) { return p.age >= p.life; }),
		m_particles.end());
}

std::vector<Puff> Particles::puffs() const
{
	std::vector<Puff> puffs;
	for (const Particle& p : m_particles)
	{
		const btScalar old = p.age / p.life;
		if (p.isSpark)
			puffs.push_back({p.place, p.velocity * btScalar(.03), float(p.radius), SPARK, float(1 - old)});
		else
			puffs.push_back({p.place, btVector3(0, 0, 0), float(p.radius * (btScalar(.3) + btScalar(.7) * btSqrt(old))),
							 DUST, .5f * float(1 - old)});
	}
	return puffs;
}
}  // namespace ep
