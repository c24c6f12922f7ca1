// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ENERGY_AUDIT_H
#define BT_ELASTIC_PLASTIC_ENERGY_AUDIT_H

#include "BulletDynamics/Dynamics/btActionInterface.h"
#include "LinearMath/btAlignedAllocator.h"
#include "btElasticPlasticPrecision.h"

class btDynamicsWorld;
class btElasticPlasticAction;

namespace btElasticPlastic
{
class EnergyFlow;
}

/// Where the energy of a world comes from and where it goes [J], since the audit began.
///
///     m_kinetic + m_elastic = getGiven() - getTaken() - m_rest
///
/// What is taken may be negative where it gives: a motor, a spring of Bullet's, a support that moves.
struct btElasticPlasticEnergyBalance
{
	// ---- what there is now
	double m_kinetic = 0;  ///< of the rigid bodies that have a mass
	double m_elastic = 0;  ///< in the springs of elastic-plastic joints that hold

	// ---- what has been given
	double m_begin = 0;    ///< kinetic and elastic energy when the audit began
	double m_gravity = 0;  ///< by the bodies' weight
	double m_loads = 0;    ///< by forces and torques that were applied to bodies
	/// Between the substeps: by whoever sets velocities or applies impulses (the game, vehicles), or adds, removes or repairs.
	double m_others = 0;

	// ---- what has been taken
	double m_plastic = 0;    ///< by the joints' plastic flow
	double m_damping = 0;    ///< by the joints' material
	double m_numerical = 0;  ///< by the joints' time integration
	double m_broken = 0;     ///< what joints that broke had in their springs
	double m_contacts = 0;   ///< by contacts' normal impulses: of bodies that collide, less what restitution gives back
	double m_friction = 0;   ///< by contacts' friction along the surface
	double m_constraints = 0;    ///< by other constraints than elastic-plastic joints, and by supports that move joints
	double m_bulletDamping = 0;  ///< by the bodies' linear and angular damping (btRigidBody::setDamping)
	double m_turning = 0;        ///< by Bullet's time integration of the bodies' turn, gyroscopic torques included
	double m_sleep = 0;          ///< the motion that bodies had when they fell asleep

	double m_rest = 0;  ///< what is none of these

	/// What has been lifted against its weight without a velocity, as by the recovery of penetration, less what has sunk so. It is
	/// in none of the sums: velocities know nothing of it.
	double m_lifted = 0;

	/// The most that has been in motion and joints at a time, dissipation included: what errors are to be compared with.
	double m_turnover = 0;

	double getGiven() const { return m_begin + m_gravity + m_loads + m_others; }
	double getTaken() const
	{
		return m_plastic + m_damping + m_numerical + m_broken + m_contacts + m_friction + m_constraints +
			   m_bulletDamping + m_turning + m_sleep;
	}
};

/// Follows the energy of a world's rigid bodies, joints and contacts, substep by substep, with any solver. It changes nothing.
///
///     world.addAction(&action);                          // the joints' one
///     btElasticPlasticEnergyAudit audit(world, action);  // adds itself behind it: add vehicles and other actions afterwards
///     ...
///     audit.begin();
///     world.stepSimulation(dt, 0);
///     printf("friction has taken %.0f J\n", audit.getBalance().m_friction);
///
/// begin() is to be called before each substep. Where stepSimulation() or a btElasticPlasticStepper takes several, it is what
/// Bullet calls before each of them:
///
///     world.setInternalTickCallback([](btDynamicsWorld* w, btScalar)
///         { static_cast<btElasticPlasticEnergyAudit*>(w->getWorldUserInfo())->begin(); }, &audit, true);
///
/// Work is impulse times mean velocity of a step, which is exactly what changes kinetic energy. See docs/games.md for what it is good for,
/// and what goes to the rest.
class btElasticPlasticEnergyAudit : public btActionInterface
{
public:
	/// Adds itself to the world. The joints' action is to be there before; both must outlive the audit.
	btElasticPlasticEnergyAudit(btDynamicsWorld& world, btElasticPlasticAction& action,
								btElasticPlasticOwnPrecision = {});
	/// Takes itself out of the world.
	~btElasticPlasticEnergyAudit() override;
	btElasticPlasticEnergyAudit(const btElasticPlasticEnergyAudit&) = delete;
	btElasticPlasticEnergyAudit& operator=(const btElasticPlasticEnergyAudit&) = delete;

	/// Before a substep: what has changed since the last one is what others have given.
	void begin();

	/// As of the end of the last substep; of begin() if that was later.
	const btElasticPlasticEnergyBalance& getBalance() const;

	/// Begins anew.
	void reset();

	void updateAction(btCollisionWorld* world, btScalar timeStep) override;
	void debugDraw(btIDebugDraw*) override {}

private:
	btDynamicsWorld& m_world;
	btElasticPlastic::EnergyFlow* const m_flow;
};

#endif  // BT_ELASTIC_PLASTIC_ENERGY_AUDIT_H
