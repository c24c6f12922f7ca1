// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_ENERGY_AUDIT_H
#define EP_ENERGY_AUDIT_H

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
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

	/// What the last step has added to kinetic energy + what the joints have stored and dissipated by flow - the loads' work on the way
	/// that the bodies have gone [J]; above 0: from nowhere. Contacts, friction and recovery of penetration have their part in it. A
	/// step that solves all rows exactly makes none where stiff joints are backward Euler, and contacts without restitution. (With
	/// restitution a bounce gives back by weight times speed times half a step what the fall has lost: Bullet's velocities stand half a
	/// step before its places. balance() has both at one time, but for contacts it has no bound.)
	double gain() const { return m_gain; }

	/// The most of gain() that recovery of penetration may have given where no joints are: Bullet's, by velocities [J].
	double bulletsRecovery() const { return m_bulletsRecovery; }

	/// What recovery that moves places only has lifted [J]. No part of gain().
	double lift() const { return m_lift; }

	/// The most that kinetic energy + what the joints have stored and dissipated has been [J].
	double turnover() const { return m_turnover; }

	/// Between steps joints have been given other stiffnesses, and with the same force store more or less [J]: that is no step's gain.
	void takeChange(double stored) { m_held += stored; }

	/// Before a step, when all loads are on. What has changed the bodies' kinetic energy since the last step, and what bodies that are new
	/// have brought along, is no gain.
	void begin()
	{
		if (!m_isBegun)
		{
			m_energy = m_balance = m_most = m_kinetic = m_world.kineticEnergy();
			m_rounding = rounding();
			m_held = 0;
			for (const btElasticPlasticJoint* joint : m_world.joints())
				m_held += heldBy(*joint);
		}
		m_isBegun = true;
		const double given = m_world.kineticEnergy() - m_kinetic;
		m_kinetic += given;
		m_energy += given;
		m_loads.clear();
		for (const auto& body : m_world.bodies())
		{
			const btScalar mass = body->getInvMass() > 0 ? 1 / body->getInvMass() : btScalar(0);
			m_loads.push_back({body->getTotalForce() + body->getGravity() * mass, body->getTotalTorque(),
							   body->getLinearVelocity(), body->getAngularVelocity(), body->getCenterOfMassPosition()});
		}
	}

	/// After a step of dt. \return the energy [J]
	double end(btScalar dt)
	{
		m_dt = double(dt);
		m_work += work(m_dt);
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
		countGain(double(dt));
		return m_energy = energy;
	}

private:
	/// Of a joint, after a step.
	struct Held
	{
		double m_force[BT_EP_DOF_COUNT] = {}, m_dissipated = 0;
	};

	/// What the joint stores and has dissipated [J].
	static double heldBy(const btElasticPlasticJoint& joint)
	{
		return joint.getElasticEnergy() + joint.getPlasticEnergy() + joint.getDampingEnergy();
	}

	/// What the joint stored and had dissipated when the bodies had their present velocities, which is half a step before they
	/// have their present places: by the means of before and after the step [J]. (For a spring that the step resolves that makes
	/// the balance exact; by the force after the step it would sway by frequency times half a step.)
	double heldHalfAStepAgo(const btElasticPlasticJoint& joint)
	{
		Held& before = m_heldBefore[&joint];
		// The step may have been the last of several inner ones: then what has flowed in it is taken for an even share.
		const double last = double(joint.getState().m_lastStep),
					 steps = last > 0 ? std::max(1., std::round(m_dt / last)) : 1.;
		const double dissipated = joint.getPlasticEnergy() + joint.getDampingEnergy();
		double energy = dissipated - (dissipated - before.m_dissipated) / (2 * steps);
		before.m_dissipated = dissipated;
		// What was in the springs is lost with them.
		if (joint.isBroken())
			return before.m_dissipated + joint.getElasticEnergy();
		// Where iterations have ended before the solution, strain is not what has been stored.
		if (!joint.getState().m_solvedExactly)
			return energy + joint.getElasticEnergy();
		const btElasticPlasticCapacity& c = joint.getCapacity();
		double mean[BT_EP_DOF_COUNT];
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			const double force = double(joint.getState().m_force[dof]);
			if (steps > 1)
				before.m_force[dof] = force - double(joint.getState().m_forceRate[dof]) * last;
			mean[dof] = (force + before.m_force[dof]) / 2;
			before.m_force[dof] = force;
			if (c.isElasticPlastic(dof) && !c.isRigidPlastic(dof))
				energy += 0.5 * mean[dof] * mean[dof] / double(c.m_stiffness[dof]);
		}
		for (int dof = BT_EP_SHEAR_Y; dof <= BT_EP_SHEAR_Z; ++dof)
			energy += mean[dof] * mean[btElasticPlasticCapacity::coupledWith(dof)] * double(c.couplingCompliance(dof));
		return energy;
	}

	struct Load
	{
		btVector3 m_force, m_torque, m_velocity, m_spin, m_place;  ///< velocities and place before the step
	};

	/// How a body has gone through the step: with its last velocity, unless the solver has taken inner steps.
	btElasticPlasticInnerMotion motionOf(const btRigidBody& body, double dt) const
	{
		btElasticPlasticInnerMotion motion;
		motion.m_way = body.getLinearVelocity() * btScalar(dt);
		motion.m_turn = body.getAngularVelocity() * btScalar(dt);
		m_world.action().getInnerMotion(body, motion);
		return motion;
	}

	void countGain(double dt)
	{
		const double kinetic = m_world.kineticEnergy();
		double held = 0, work = motorWork(dt);
		for (const btElasticPlasticJoint* joint : m_world.joints())
			held += heldBy(*joint);
		m_lift = 0;
		for (size_t i = 0; i < m_loads.size(); ++i)
		{
			const btRigidBody& body = *m_world.bodies()[i];
			if (body.getInvMass() == 0 || !body.isActive())
				continue;
			const btElasticPlasticInnerMotion inner = motionOf(body, dt);
			const btVector3 &place = body.getCenterOfMassPosition(), lifted = place - m_loads[i].m_place - inner.m_way;
			work += double(m_loads[i].m_force.dot(inner.m_way)) + double(m_loads[i].m_torque.dot(inner.m_turn)) +
					inner.m_shift;
			if (lifted.length() > 4 * SIMD_EPSILON * place.length())
				m_lift -= double(m_loads[i].m_force.dot(lifted));
		}
		m_gain = kinetic - m_kinetic + held - m_held - work;
		m_bulletsRecovery = bulletsRecoveryWork(dt);
		m_kinetic = kinetic;
		m_held = held;
		m_turnover = std::max(m_turnover, kinetic + held);
	}

	/// Contacts' impulses times the speeds at which recovery was to part their bodies, where neither contacts nor constraints lead to an
	/// elastic-plastic joint: such bodies are solved Bullet's way. Elsewhere recovery moves places only, but for that of contacts between
	/// loose bodies below 0.1 m/s (theory.md).
	double bulletsRecoveryWork(double dt) const
	{
		const btContactSolverInfo& info = m_world.bullet().getSolverInfo();
		btDispatcher& dispatcher = *m_world.bullet().getDispatcher();
		std::map<const btCollisionObject*, const btCollisionObject*> next;  // of the same island, up to its root
		const auto rootOf = [&](const btCollisionObject* object)
		{
			for (auto up = next.find(object); up != next.end(); up = next.find(object))
			{
				// Halves the way for those who come later: chains of thousands would be walked again and again.
				const auto further = next.find(up->second);
				if (further != next.end())
					up->second = further->second;
				object = up->second;
			}
			return object;
		};
		const auto join = [&](const btCollisionObject& a, const btCollisionObject& b)
		{
			const btCollisionObject *const rootA = rootOf(&a), *const rootB = rootOf(&b);
			if (!a.isStaticOrKinematicObject() && !b.isStaticOrKinematicObject() && rootA != rootB)
				next[rootA] = rootB;
		};
		for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
		{
			const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
			if (manifold.getNumContacts() > 0)
				join(*manifold.getBody0(), *manifold.getBody1());
		}
		btDiscreteDynamicsWorld& world = m_world.bullet();
		for (int i = 0; i < world.getNumConstraints(); ++i)
			join(world.getConstraint(i)->getRigidBodyA(), world.getConstraint(i)->getRigidBodyB());
		std::set<const btCollisionObject*> joined, withJoints;  // bodies; roots
		for (const btElasticPlasticJoint* joint : m_world.joints())
			for (const btRigidBody* body :
				 {&joint->getConstraint().getRigidBodyA(), &joint->getConstraint().getRigidBodyB()})
				if (!joint->isBroken() && !body->isStaticOrKinematicObject())
				{
					joined.insert(body);
					withJoints.insert(rootOf(body));
				}
		double work = 0;
		for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
		{
			const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
			const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
			const bool isBullets = withJoints.count(rootOf(&a)) + withJoints.count(rootOf(&b)) == 0;
			const double most = isBullets ? HUGE_VAL : joined.count(&a) + joined.count(&b) == 0 ? 0.1 : 0;
			for (int k = 0; (a.isActive() || b.isActive()) && k < manifold.getNumContacts(); ++k)
			{
				const btManifoldPoint& point = manifold.getContactPoint(k);
				const double speed = -double(point.getDistance()) * double(info.m_erp2) / dt;
				if (speed > 0 && speed <= most)
					work += double(point.getAppliedImpulse()) * speed;
			}
		}
		return work;
	}

	/// What hinges with motors, that have a feedback to be read, have given to their bodies [J].
	double motorWork(double dt) const
	{
		double power = 0;
		for (const auto& constraint : m_world.constraints())
		{
			const btJointFeedback* const feedback = constraint->getJointFeedback();
			if (constraint->getConstraintType() != HINGE_CONSTRAINT_TYPE || !feedback)
				continue;
			const btRigidBody &a = constraint->getRigidBodyA(), &b = constraint->getRigidBodyB();
			power += double(feedback->m_appliedForceBodyA.dot(a.getLinearVelocity())) +
					 double(feedback->m_appliedTorqueBodyA.dot(a.getAngularVelocity())) +
					 double(feedback->m_appliedForceBodyB.dot(b.getLinearVelocity())) +
					 double(feedback->m_appliedTorqueBodyB.dot(b.getAngularVelocity()));
		}
		return power * dt;
	}

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
			btElasticPlasticInnerMotion inner;
			if (m_world.action().getInnerMotion(body, inner))
			{
				sum += 2 / dt * (inner.m_work + inner.m_shift);
				continue;
			}
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
	double m_given = 0, m_rounding = 0;                         // of joints
	std::map<const btElasticPlasticJoint*, Held> m_heldBefore;  // after the last step
	double m_dt = 0;                                            // of the step
	double m_kinetic = 0, m_held = 0;                           // after the last step: of bodies, of joints
	double m_gain = 0, m_bulletsRecovery = 0, m_lift = 0, m_turnover = 0;
};
}  // namespace ep

#endif  // EP_ENERGY_AUDIT_H
