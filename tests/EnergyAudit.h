#ifndef EP_TEST_ENERGY_AUDIT_H
#define EP_TEST_ENERGY_AUDIT_H

#include "World.h"

/// Kinetic energy + work of the joints - work of gravity: what contacts and other constraints have not taken. It may fall.
class EnergyAudit
{
public:
	explicit EnergyAudit(ep::World& world) : m_world(world), m_power(gravityPower()) {}

	/// Steps the world. \return the energy afterwards [J]
	double step(btScalar dt)
	{
		m_world.step(dt);
		// Work of gravity in a step is weight times mean velocity, exactly.
		const double power = gravityPower();
		m_gravity += (m_power + power) / 2 * double(dt);
		m_power = power;
		double energy = m_world.kineticEnergy() - m_gravity;
		for (const btElasticPlasticJoint* joint : m_world.joints())
			energy += joint->getWork();
		return energy;
	}

private:
	double gravityPower() const
	{
		double sum = 0;
		for (const auto& body : m_world.bodies())
			if (body->getInvMass() > 0)
				sum += double(body->getGravity().dot(body->getLinearVelocity())) / double(body->getInvMass());
		return sum;
	}

	ep::World& m_world;
	double m_power;
	double m_gravity = 0;
};

#endif  // EP_TEST_ENERGY_AUDIT_H
