// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What others give to bodies' velocities in each step alike, in place of a force.

#include <math.h>

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticEnergyAudit.h"
#include "BulletDynamics/Vehicle/btRaycastVehicle.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "world/EnergyAudit.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testSteadyPushes
{
using namespace ep;

enum Way
{
	FORCE,
	IMPULSE,
	ACTION_BEFORE_OURS,
	ACTION_AFTER_OURS
};

/// Gives a body an impulse after each step.
struct Thruster : btActionInterface
{
	btRigidBody* m_body = nullptr;
	btVector3 m_force = btVector3(0, 0, 0), m_torque = btVector3(0, 0, 0);

	void updateAction(btCollisionWorld*, btScalar dt) override { push(dt); }
	void debugDraw(btIDebugDraw*) override {}
	void push(btScalar dt) const
	{
		m_body->applyCentralImpulse(m_force * dt);
		m_body->applyTorqueImpulse(m_torque * dt);
	}
};

/// A cantilever of four blocks of 50 kg along x of a turned frame, with a thruster at its tip. Its own weight takes a third of what its foot bears.
struct PushedCantilever
{
	static constexpr double LENGTH = 0.5, MASS = 50, YIELD = 6000;  // [m], [kg], [N m]

	btMatrix3x3 m_turn;
	World m_world;
	btRigidBody* m_tip = nullptr;
	btElasticPlasticJoint* m_joints[4];
	Thruster m_thruster;
	Way m_way;

	explicit PushedCantilever(Way way, const btQuaternion& turn = btQuaternion(0, 0, 0, 1))
		: m_turn(turn), m_world(Solver::Direct, m_turn * btVector3(0, btScalar(-9.81), 0)), m_way(way)
	{
		btCollisionShape* const box = m_world.box(btVector3(btScalar(LENGTH), btScalar(0.2), btScalar(0.2)));
		const auto place = [&](double x) { return btTransform(turn, m_turn * btVector3(btScalar(x), 0, 0)); };
		btRigidBody* last = m_world.body(0, box, place(0));
		for (int i = 0; i < 4; ++i)
		{
			m_tip = m_world.body(btScalar(MASS), box, place(LENGTH * (i + 1)));
			btElasticPlasticCapacity capacity = evenCapacity(1e8, 1e6);
			for (int dof = BT_EP_TORSION; dof <= BT_EP_BENDING_Z; ++dof)
				capacity.set(dof, btScalar(2e6), btScalar(YIELD), btScalar(0.5));
			capacity.m_damping = btScalar(0.03);
			m_joints[i] = m_world.joint(*last, *m_tip, place(LENGTH * (i + 0.5)), capacity);
			last = m_tip;
		}
		m_thruster.m_body = m_tip;
		btDiscreteDynamicsWorld& bullet = m_world.bullet();
		if (way == ACTION_AFTER_OURS || way == ACTION_BEFORE_OURS)
			bullet.addAction(&m_thruster);
		if (way == ACTION_BEFORE_OURS)
		{
			bullet.removeAction(&m_world.action());
			bullet.addAction(&m_world.action());
		}
		m_world.beforeSubsteps(
			[&](btScalar dt)
			{
				if (m_way == IMPULSE)
					m_thruster.push(dt);
				if (m_way != FORCE)
					return;
				m_tip->applyCentralForce(m_thruster.m_force);
				m_tip->applyTorque(m_thruster.m_torque);
			});
	}
	~PushedCantilever() { m_world.bullet().removeAction(&m_thruster); }

	/// \param share  of what the foot bears beside the weights
	void setPush(double share)
	{
		const double weights = MASS * 9.81 * LENGTH * (0.5 + 1.5 + 2.5 + 3.5), moment = share * (YIELD - weights);
		m_thruster.m_force = m_turn * btVector3(0, btScalar(-moment / (3.5 * LENGTH)), 0);
		m_thruster.m_torque = m_turn * btVector3(btScalar(0.3 * moment), 0, 0);
	}
	double plasticEnergy() const
	{
		double sum = 0;
		for (const btElasticPlasticJoint* joint : m_joints)
			sum += joint->getPlasticEnergy();
		return sum;
	}
	double footMoment() const { return fabs(double(m_joints[0]->getForce(BT_EP_BENDING_Z))); }
	double numericalEnergy() const
	{
		double sum = 0;
		for (const btElasticPlasticJoint* joint : m_joints)
			sum += joint->getNumericalEnergy();
		return sum;
	}

	/// The push grows to a share of what the foot bears within half a second, and stays so, or ends, for half a second more.
	void load(double share, double hz, bool ends)
	{
		for (int i = 0; i < int(hz); ++i)
		{
			const double ramp = 2 * i / hz;
			setPush(ramp < 1 ? share * ramp : ends ? 0 : share);
			m_world.step(btScalar(1 / hz));
		}
	}
};

TEST(SteadyPushes, AreLoads)
{
	// Each was a blow to the inner steps: at 1/60 s and 0.9 of what it bears the cantilever flowed by 3.5 kJ and broke.
	for (const btQuaternion& turn : {btQuaternion(0, 0, 0, 1), btQuaternion(btVector3(1, 2, 3).normalized(), 2)})
		for (const double hz : {30., 60., 240.})
			for (const double share : {0.9, 1.1, 1.2})
			{
				PushedCantilever forced(FORCE, turn);
				forced.load(share, hz, share > 1);
				for (const Way way : {IMPULSE, ACTION_BEFORE_OURS, ACTION_AFTER_OURS})
				{
					PushedCantilever pushed(way, turn);
					pushed.load(share, hz, share > 1);
					const double plastic = forced.plasticEnergy(), moment = forced.footMoment();
					// The first one is a blow, of a fifteenth of the load at 1/30 s, and what an action gives comes a step later.
					EXPECT_NEAR(plastic, pushed.plasticEnergy(), 0.005 * plastic) << hz << " " << share << " " << way;
					EXPECT_NEAR(moment, pushed.footMoment(), 0.002 * moment) << hz << " " << share << " " << way;
					EXPECT_EQ(share > 1, pushed.plasticEnergy() > 0);
					// What they lost in each step where each was one: 163 to 5000 J.
					EXPECT_LT(pushed.numericalEnergy(), 20) << hz << " " << share << " " << way;
				}
			}
}

TEST(SteadyPushes, ABlowAmongThemIsABlow)
{
	const auto strike = [](Way way, double hz)
	{
		PushedCantilever cantilever(way);
		cantilever.load(0.5, hz, false);
		const double before = cantilever.plasticEnergy();
		cantilever.m_tip->applyCentralImpulse(btVector3(0, -150, 0));
		for (int i = 0; i < int(hz / 2); ++i)
			cantilever.m_world.step(btScalar(1 / hz));
		return cantilever.plasticEnergy() - before;
	};
	const double exact = strike(FORCE, 3840);
	EXPECT_GT(exact, 50);
	for (const double hz : {30., 60.})
		for (const Way way : {FORCE, IMPULSE})
			// Within what the inner steps are right to.
			EXPECT_NEAR(exact, strike(way, hz), 0.05 * exact) << hz << " " << way;
}

TEST(SteadyPushes, KeepTheBooks)
{
	for (const bool turns : {false, true})
	{
		PushedCantilever cantilever(ACTION_AFTER_OURS);
		cantilever.m_world.bullet().removeAction(&cantilever.m_thruster);
		EnergyAudit audit(cantilever.m_world);
		for (int i = 0; i < 60; ++i)
		{
			cantilever.setPush(1.1 * std::min(1., i / 30.));
			cantilever.m_thruster.m_torque *= btScalar(turns ? 1 : 0);
			cantilever.m_thruster.push(btScalar(1) / 60);
			audit.step(btScalar(1) / 60);
		}
		EXPECT_GT(cantilever.plasticEnergy(), 10);
		// Of what turns about two axes at once Bullet's gyroscopic torque is told but so well.
		EXPECT_LT(audit.created(), turns ? byPrecision(1e-9, 1e-4) : byPrecision(1e-12, 1e-4)) << turns;
	}
}

TEST(SteadyPushes, AreOfOthersInTheAudit)
{
	// It told what they give as loads within the step as the weight's, which there was none of.
	PushedCantilever cantilever(IMPULSE);
	cantilever.m_world.bullet().setGravity(btVector3(0, 0, 0));
	btElasticPlasticEnergyAudit audit(cantilever.m_world.bullet(), cantilever.m_world.action());
	double way = 0;
	for (int i = 0; i < 60; ++i)
	{
		cantilever.setPush(std::min(1., i / 30.));
		cantilever.m_thruster.m_torque = btVector3(0, 0, 0);
		const btVector3 before = cantilever.m_tip->getCenterOfMassPosition();
		cantilever.m_thruster.push(btScalar(1) / 60);
		cantilever.m_way = ACTION_AFTER_OURS;
		cantilever.m_world.bullet().removeAction(&cantilever.m_thruster);
		audit.begin();
		cantilever.m_world.step(btScalar(1) / 60);
		way += double(cantilever.m_thruster.m_force.dot(cantilever.m_tip->getCenterOfMassPosition() - before));
	}
	EXPECT_EQ(0, audit.getBalance().m_gravity);
	EXPECT_GT(way, 5);
	// The first one is a blow.
	EXPECT_NEAR(way, audit.getBalance().m_others, 0.05 * way);
}

TEST(SteadyPushes, AreNoneWhereBulletDampsBodies)
{
	// It changes velocities as a step begins, too.
	PushedCantilever cantilever(FORCE);
	for (const auto& body : cantilever.m_world.bodies())
		body->setDamping(btScalar(0.1), btScalar(0.2));
	cantilever.m_tip->setLinearVelocity(btVector3(0, 1, 0));
	for (int i = 0; i < 20; ++i)
	{
		cantilever.m_world.step(btScalar(1) / 60);
		EXPECT_EQ(i == 0, cantilever.m_joints[3]->getState().m_isGiven) << i;
		EXPECT_FALSE(cantilever.m_joints[0]->getState().m_isGiven);
	}
	EXPECT_GT(statisticsOf(cantilever.m_world).m_innerSteps, 0);
}

TEST(SteadyPushes, LeaveForcesThatOthersHaveAppliedAsTheyAre)
{
	// Bullet clears them after all substeps of a frame.
	PushedCantilever cantilever(IMPULSE);
	btRigidBody& tip = *cantilever.m_tip;
	tip.setLinearFactor(btVector3(1, btScalar(0.5), 0));
	for (int i = 0; i < 10; ++i)
	{
		cantilever.setPush(0.5);
		const btVector3 force(btScalar(0.1), 20, 0), torque(3, btScalar(0.7), -1);
		tip.applyCentralForce(force);
		tip.applyTorque(torque);
		const btVector3 before = tip.getTotalForce();
		btVector3 after(0, 0, 0), turning(0, 0, 0);
		struct Reader : btActionInterface
		{
			btRigidBody* m_body;
			btVector3 *m_force, *m_torque;
			void updateAction(btCollisionWorld*, btScalar) override
			{
				*m_force =
					m_body->getTotalForce() - m_body->getGravity() / m_body->getInvMass() * m_body->getLinearFactor();
				*m_torque = m_body->getTotalTorque();
			}
			void debugDraw(btIDebugDraw*) override {}
		} reader;
		reader.m_body = &tip;
		reader.m_force = &after;
		reader.m_torque = &turning;
		cantilever.m_world.bullet().addAction(&reader);
		cantilever.m_world.step(btScalar(1) / 60);
		cantilever.m_world.bullet().removeAction(&reader);
		EXPECT_NEAR(0, double(before.distance(after)), byPrecision(1e-12, 1e-4)) << i;
		EXPECT_EQ(torque, turning) << i;
	}
}

/// Five joined bodies, which a btRaycastVehicle carries in their middle.
struct JointedCar
{
	World m_world{Solver::Direct, btVector3(0, btScalar(-9.81), 0)};
	btDefaultVehicleRaycaster m_raycaster{&m_world.bullet()};
	btRaycastVehicle::btVehicleTuning m_tuning;
	std::unique_ptr<btRaycastVehicle> m_vehicle;

	JointedCar()
	{
		m_world.body(0, m_world.box(btVector3(50, 1, 50)), at(0, -0.5));
		btCollisionShape* const box = m_world.box(btVector3(btScalar(1.6), btScalar(0.5), 1));
		btElasticPlasticCapacity capacity = evenCapacity(1e8, 1e6);
		for (int dof = BT_EP_TORSION; dof <= BT_EP_BENDING_Z; ++dof)
			// Four times what the two bodies at its end weigh, 240 kg each.
			capacity.set(dof, btScalar(8e6), btScalar(4 * 240 * 9.81 * 2), btScalar(0.2));
		btRigidBody* bodies[5];
		for (int i = 0; i < 5; ++i)
		{
			bodies[i] = m_world.body(240, box, at(0, 0.85, i - 2));
			if (i > 0)
				m_world.joint(*bodies[i - 1], *bodies[i],
							  btTransform(btQuaternion(btVector3(0, 1, 0), -SIMD_HALF_PI),
										  btVector3(0, btScalar(0.85), btScalar(i - 2.5))),
							  capacity);
		}
		m_tuning.m_suspensionStiffness = 40;
		m_tuning.m_maxSuspensionForce = 1e6;
		m_vehicle.reset(new btRaycastVehicle(m_tuning, bodies[2], &m_raycaster));
		m_vehicle->setCoordinateSystem(0, 1, 2);
		for (const double x : {-0.8, 0.8})
			for (const double z : {-0.4, 0.4})
				m_vehicle->addWheel(btVector3(btScalar(x), btScalar(-0.1), btScalar(z)), btVector3(0, -1, 0),
									btVector3(-1, 0, 0), btScalar(0.5), btScalar(0.4), m_tuning, z < 0);
		m_world.bullet().addAction(m_vehicle.get());
	}
	~JointedCar() { m_world.bullet().removeAction(m_vehicle.get()); }
};

TEST(SteadyPushes, HoldUpAChassisOfSeveralBodies)
{
	for (const double hz : {30., 60.})
	{
		JointedCar car;
		for (int i = 0; i < int(3 * hz); ++i)
			car.m_world.step(btScalar(1 / hz));
		double plastic = 0;
		for (const btElasticPlasticJoint* joint : car.m_world.joints())
		{
			EXPECT_FALSE(joint->isBroken());
			plastic += joint->getPlasticEnergy();
		}
		// The first impulse is a blow; 8.2 kJ at 1/30 s where each was one.
		EXPECT_LT(plastic, 50) << hz;
	}
}
}  // namespace testSteadyPushes
