// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_ENERGY_AUDIT_H
#define EP_ENERGY_AUDIT_H

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "world/World.h"

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

	/// Sum of all that the energy has risen by, over the most that it, or the joints' work, has been: what contacts and other
	/// constraints have made.
	double created() const { return m_created > 0 ? m_created / m_most : 0; }

	/// The same of the joints: what they gave beyond all that they had taken, the most at any time, above what the rounding of
	/// places is to their stiffness. Plastic flow is counted by the yield value and a step's last velocity, work by mean ones:
	/// where yield begins or ends within a long step that differs by some hundredths. In float the rounding of places adds up over
	/// thousands of steps: to a sixth in a stiff frame at yield.
	static constexpr double SLACK = sizeof(btScalar) == sizeof(double) ? 0.05 : 0.2;
	double createdByJoints() const { return m_given > m_rounding ? (m_given - m_rounding) / m_most : 0; }

	/// Kinetic energy + what the joints have stored and dissipated by flow - work of loads, all of the time of the velocities [J]. What
	/// the time integration dissipates lowers it, and what it makes raises it. Where the step changes, that time jumps.
	double balance() const { return m_balance; }

	/// The most that kinetic energy, or the joints' work, has been [J].
	double atPlay() const { return m_most; }

	/// Before a step, when all loads are on.
	void begin()
	{
		if (!m_isBegun)
		{
			m_energy = m_balance = m_most = m_world.kineticEnergy();
			m_rounding = rounding();
		}
		m_isBegun = true;
		m_loads.clear();
		for (const auto& body : m_world.bodies())
		{
			const btScalar mass = body->getInvMass() > 0 ? 1 / body->getInvMass() : btScalar(0);
			m_loads.push_back({body->getTotalForce() + body->getGravity() * mass, body->getTotalTorque(),
							   body->getLinearVelocity(), body->getAngularVelocity()});
		}
	}

	/// After a step of dt. \return the energy [J]
	double end(btScalar dt)
	{
		m_work += work(double(dt));
		double energy = m_world.kineticEnergy() - m_work;
		double dissipated = 0;
		for (const btElasticPlasticJoint* joint : m_world.joints())
		{
			energy += joint->getWork();
			dissipated += joint->getWork() - heldHalfAStepAgo(*joint);
			m_most = std::max(m_most, joint->getWork());
		}
		m_given = std::max(m_given, -dissipated);
		m_balance = energy - dissipated;
		m_most = std::max(m_most, m_world.kineticEnergy());
		m_created += std::max(0., energy - m_energy);
		return m_energy = energy;
	}

private:
	/// Of a joint, after a step.
	struct Held
	{
		double m_force[BT_EP_DOF_COUNT] = {}, m_plastic = 0;
	};

	/// What the joint stored and had dissipated when the bodies had their present velocities, which is half a step before they
	/// have their present places: by the means of before and after the step [J]. (For a spring that the step resolves that makes
	/// the balance exact; by the force after the step it would sway by frequency times half a step.)
	double heldHalfAStepAgo(const btElasticPlasticJoint& joint)
	{
		Held& before = m_held[&joint];
		double energy = (joint.getPlasticEnergy() + before.m_plastic) / 2;
		before.m_plastic = joint.getPlasticEnergy();
		// What was in the springs is lost with them.
		if (joint.isBroken())
			return before.m_plastic + joint.getElasticEnergy();
		const btElasticPlasticCapacity& c = joint.getCapacity();
		double mean[BT_EP_DOF_COUNT];
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			const double force = double(joint.getForce(dof));
			mean[dof] = (force + before.m_force[dof]) / 2;
			before.m_force[dof] = force;
			if (c.isElasticPlastic(dof) && !c.isRigidPlastic(dof))
				energy += 0.5 * mean[dof] * mean[dof] / double(c.m_stiffness[dof]);
		}
		if (joint.getState().m_solvedExactly)
			for (int dof = BT_EP_SHEAR_Y; dof <= BT_EP_SHEAR_Z; ++dof)
				energy +=
					mean[dof] * mean[btElasticPlasticCapacity::coupledWith(dof)] * double(c.couplingCompliance(dof));
		return energy;
	}

	struct Load
	{
		btVector3 m_force, m_torque, m_velocity, m_spin;  ///< velocities before the step
	};

	/// Energy of the joints' springs under the rounding of the bodies' places.
	double rounding() const
	{
		double energy = 0;
		for (const btElasticPlasticJoint* joint : m_world.joints())
		{
			const double place = double(joint->getPosition().length()) + 1;
			for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			{
				const btElasticPlasticCapacity& c = joint->getCapacity();
				// A place is a float or double; and where k dt^2 A is beyond 1e16 the solve has no digits below this.
				const double slack = std::max(4 * double(SIMD_EPSILON), 1e-10) * (dof < 3 ? place : 1.);
				if (c.isElasticPlastic(dof) && !c.isRigidPlastic(dof))
					energy += 0.5 * double(c.m_stiffness[dof]) * slack * slack;
			}
		}
		return energy;
	}

	/// The work of a constant force in a step is force times mean velocity, exactly. Bullet's damping comes before the forces.
	double work(double dt) const
	{
		double sum = 0;
		for (size_t i = 0; i < m_loads.size(); ++i)
		{
			const btRigidBody& body = *m_world.bodies()[i];
			const Load& load = m_loads[i];
			if (body.getInvMass() == 0 || !body.isActive())
				continue;
			const double stays = std::pow(1 - double(body.getLinearDamping()), dt),
						 spins = std::pow(1 - double(body.getAngularDamping()), dt);
			sum += double(load.m_force.dot(load.m_velocity)) * stays +
				   double(load.m_force.dot(body.getLinearVelocity())) + double(load.m_torque.dot(load.m_spin)) * spins +
				   double(load.m_torque.dot(body.getAngularVelocity()));
		}
		return sum / 2 * dt;
	}

	World& m_world;
	std::vector<Load> m_loads;  // during a step
	double m_work = 0;
	bool m_isBegun = false;
	double m_energy = 0, m_balance = 0, m_most = 0, m_created = 0;
	double m_given = 0, m_rounding = 0;                   // of joints
	std::map<const btElasticPlasticJoint*, Held> m_held;  // after the last step
};
}  // namespace ep

#endif  // EP_ENERGY_AUDIT_H
