#ifndef EP_ENERGY_AUDIT_H
#define EP_ENERGY_AUDIT_H

#include <vector>

#include "World.h"

namespace ep
{
/// Kinetic energy + work of the joints - work of gravity and of loads: what contacts and other constraints have not taken. It
/// may fall.
class EnergyAudit
{
public:
	explicit EnergyAudit(World& world) : m_world(world) {}

	/// Steps the world. \return the energy afterwards [J]
	double step(btScalar dt)
	{
		begin();
		m_world.step(dt);
		return end(dt);
	}

	/// Before a step, when all loads are on.
	void begin()
	{
		m_loads.clear();
		for (const auto& body : m_world.bodies())
		{
			const btScalar mass = body->getInvMass() > 0 ? 1 / body->getInvMass() : btScalar(0);
			m_loads.push_back({body->getTotalForce() + body->getGravity() * mass, body->getTotalTorque()});
		}
		m_power = power();
	}

	/// After a step of dt. \return the energy [J]
	double end(btScalar dt)
	{
		// The work of a constant force in a step is force times mean velocity, exactly.
		m_work += (m_power + power()) / 2 * double(dt);
		double energy = m_world.kineticEnergy() - m_work;
		for (const btElasticPlasticJoint* joint : m_world.joints())
			energy += joint->getWork();
		return energy;
	}

private:
	struct Load
	{
		btVector3 m_force, m_torque;
	};

	double power() const
	{
		double sum = 0;
		for (size_t i = 0; i < m_loads.size(); ++i)
		{
			const btRigidBody& body = *m_world.bodies()[i];
			if (body.getInvMass() > 0)
				sum += double(m_loads[i].m_force.dot(body.getLinearVelocity()) +
							  m_loads[i].m_torque.dot(body.getAngularVelocity()));
		}
		return sum;
	}

	World& m_world;
	std::vector<Load> m_loads;  // during a step
	double m_power = 0;
	double m_work = 0;
};
}  // namespace ep

#endif  // EP_ENERGY_AUDIT_H
