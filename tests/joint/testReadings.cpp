// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What a joint tells of each of its degrees of freedom: energies, damage, the forces in Bullet's feedback.

#include <math.h>

#include <gtest/gtest.h>

#include "support/Pair.h"
#include "support/Precision.h"

namespace testReadings
{
using namespace ep;

const double STIFFNESS = 1e6, LOAD = 1000;

/// Pulls or turns the right cube by one degree of freedom of its joint, which is in its centre: other degrees of freedom stay free
/// of force.
struct Loaded
{
	Pair m_pair{Solver::Direct};
	btElasticPlasticJoint* m_joint;

	explicit Loaded(double yield, double ductility = double(btElasticPlasticCapacity::unlimited()))
	{
		btElasticPlasticCapacity capacity;
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			capacity.set(dof, btScalar(STIFFNESS), btScalar(yield), btScalar(ductility));
		m_pair.m_frame = at(1);
		m_joint = m_pair.join(capacity);
	}

	void step(int dof, double load, btScalar dt = FRAME)
	{
		btVector3 axis(0, 0, 0);
		axis[dof % 3] = btScalar(load);
		if (dof < 3)
			m_pair.m_b->applyCentralForce(axis);
		else
			m_pair.m_b->applyTorque(axis);
		m_pair.m_world.step(dt);
	}

	/// Lets a load grow for a second and rest for two.
	void rest(int dof, double load)
	{
		m_pair.m_b->setDamping(btScalar(0.99), btScalar(0.99));
		for (int i = 0; i < 180; ++i)
			step(dof, load * btMin(1., (i + 1) / 60.));
	}
};

TEST(Readings, ElasticEnergyOfEachDegreeOfFreedom)
{
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
	{
		Loaded loaded(1e9);
		loaded.rest(dof, LOAD);
		const btElasticPlasticJoint& joint = *loaded.m_joint;
		// At rest but for what is left of a swing; positions and turns of 1 mm in float have four digits.
		EXPECT_NEAR(LOAD, joint.getForce(dof), byPrecision(1e-3, 1e-2) * LOAD) << dof;
		EXPECT_NEAR(LOAD / STIFFNESS, joint.getElasticDeformation(dof), byPrecision(1e-3, 1e-2) * LOAD / STIFFNESS)
			<< dof;
		EXPECT_NEAR(LOAD * LOAD / 2 / STIFFNESS, joint.getElasticEnergy(),
					byPrecision(2e-3, 2e-2) * LOAD * LOAD / 2 / STIFFNESS)
			<< dof;
		EXPECT_EQ(0, joint.getPlasticEnergy()) << dof;
	}
}

TEST(Readings, DamageOfEachDegreeOfFreedom)
{
	const double ductility = 0.05;
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
	{
		Loaded loaded(LOAD / 2, ductility);
		while (loaded.m_joint->getPlasticPath(dof) < ductility / 4)
			loaded.step(dof, LOAD, FRAME / 16);
		const btElasticPlasticJoint& joint = *loaded.m_joint;
		EXPECT_FALSE(joint.isBroken());
		for (int other = 0; other < BT_EP_DOF_COUNT; ++other)
			EXPECT_NEAR(other == dof ? double(joint.getPlasticPath(dof)) / ductility : 0, joint.getDamage(other), 1e-6)
				<< dof << ", " << other;
		EXPECT_NEAR(joint.getDamage(dof), joint.getDamage(), 1e-6) << dof;
		EXPECT_NEAR(LOAD / 2 * double(joint.getPlasticPath(dof)), joint.getState().m_plasticEnergy,
					1e-5 * LOAD * ductility)
			<< dof;
		// And it breaks when that is spent, in whichever degree of freedom.
		for (int i = 0; i < 960 && !joint.isBroken(); ++i)
			loaded.step(dof, LOAD, FRAME / 16);
		EXPECT_TRUE(joint.isBroken()) << dof;
		EXPECT_GE(joint.getDamage(dof), 1) << dof;
	}
}

/// Bullet's feedback has the force and, about the centre of mass, the torque on each body. With both bodies free, a force on one
/// changes their momenta by just these and the load.
TEST(Readings, FeedbackIsWhatMovesBothBodies)
{
	for (const JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
		for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		{
			Pair pair(solver, 7, 12);
			pair.m_frame = btTransform(btQuaternion(btVector3(1, 2, 3).normalized(), 1),
									   btVector3(btScalar(0.3), btScalar(0.4), btScalar(-0.2)));
			btElasticPlasticJoint* joint = pair.join(evenCapacity(1e5), jointClass);
			btJointFeedback feedback;
			joint->getConstraint().setJointFeedback(&feedback);
			btRigidBody* const bodies[2] = {pair.m_a, pair.m_b};
			// No gyroscopic torques: momenta change by forces alone.
			for (btRigidBody* body : bodies)
				body->setFlags(0);
			pair.m_b->setLinearVelocity(btVector3(1, 2, -1));
			pair.m_b->setAngularVelocity(btVector3(-1, 1, 2));
			for (int i = 0; i < 10; ++i)
			{
				btVector3 momentum[2], spin[2], before[2], spinBefore[2];
				for (int b = 0; b < 2; ++b)
				{
					before[b] = bodies[b]->getLinearVelocity();
					spinBefore[b] = bodies[b]->getAngularVelocity();
				}
				pair.m_world.step(btScalar(1) / 240);
				const btVector3 force[2] = {feedback.m_appliedForceBodyA, feedback.m_appliedForceBodyB},
								torque[2] = {feedback.m_appliedTorqueBodyA, feedback.m_appliedTorqueBodyB};
				for (int b = 0; b < 2; ++b)
				{
					// Cubes have the same inertia about every axis: m / 6.
					const btScalar mass = 1 / bodies[b]->getInvMass(),
								   inertia = 1 / bodies[b]->getInvInertiaDiagLocal().x();
					momentum[b] = (bodies[b]->getLinearVelocity() - before[b]) * mass * 240;
					spin[b] = (bodies[b]->getAngularVelocity() - spinBefore[b]) * inertia * 240;
					// Of forces of 1 kN; rounding of velocities in float, times mass over step.
					EXPECT_NEAR(0, (momentum[b] - force[b]).length(), byPrecision(1e-8, 5e-3)) << b << ", step " << i;
					EXPECT_NEAR(0, (spin[b] - torque[b]).length(), byPrecision(1e-8, 5e-3)) << b << ", step " << i;
				}
				EXPECT_GT(force[0].length(), 10) << i;
			}
		}
}

/// A rigid-plastic joint that stands apart, as a solver's error may have left it, closes by Bullet's error reduction: by this share
/// in each step.
TEST(Readings, ARigidPlasticJointClosesByErrorReduction)
{
	for (const JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
		for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
			for (int dof = 0; dof < 3; ++dof)
				for (const double erp : {0.2, 0.5})
				{
					Pair pair(solver);
					btElasticPlasticCapacity capacity;
					for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
						capacity.setRigidPlastic(i, btElasticPlasticCapacity::unlimited());
					pair.m_world.bullet().getSolverInfo().m_erp = btScalar(erp);
					pair.m_world.bullet().getSolverInfo().m_numIterations = 200;
					btElasticPlasticJoint* joint = pair.join(capacity, jointClass);
					btTransform pose = pair.m_b->getCenterOfMassTransform();
					const double gap = 0.01;
					pose.getOrigin()[dof] += btScalar(gap);
					pair.m_b->setCenterOfMassTransform(pose);
					pair.m_b->setInterpolationWorldTransform(pose);
					double left = gap;
					for (int i = 0; i < 5; ++i)
					{
						pair.m_world.step(FRAME);
						left *= 1 - erp;
						const double now = double((pair.m_b->getCenterOfMassPosition() - btVector3(1, 0, 0))[dof]);
						// The joint is beside the cube's centre: it turns by the gap squared, and 200 iterations leave a thousandth.
						EXPECT_NEAR(left, now, 0.01 * gap)
							<< "solver " << int(solver) << ", dof " << dof << ", erp " << erp << ", step " << i;
					}
					EXPECT_EQ(0, joint->getPlasticEnergy());
				}
}
}  // namespace testReadings
