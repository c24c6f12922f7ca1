// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// One step of a joint: evaluated, taken back, committed.

#include <math.h>

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/JointWorks.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepControl.h"
#include "support/Pair.h"
#include "support/Precision.h"
#include "support/Row.h"

namespace testJointStep
{
using namespace ep;

TEST(JointStep, EvaluatingChangesNothing)
{
	// Trial and revert: rows may be asked for as often as one likes; only a commit moves the state.
	Row row(1);
	row.run(20);
	btElasticPlasticJoint* joint = row.m_joints[0];
	btElasticPlastic::JointStep& step = btElasticPlastic::JointWorks::from(&joint->getConstraint())->m_step;
	const btElasticPlasticState before = joint->getState();
	for (int i = 0; i < 5; ++i)
	{
		EXPECT_EQ(6, step.prepare());
		step.revert();
		EXPECT_EQ(0, step.commit(1, false));
	}
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		EXPECT_EQ(before.m_force[i], joint->getState().m_force[i]);
		EXPECT_EQ(before.m_plastic[i], joint->getState().m_plastic[i]);
	}
	EXPECT_EQ(before.m_work, joint->getState().m_work);
}

/// A body that turns about a stiff hinge. Nothing loads it but what keeps the body on its circle, m w^2 r = 600 N, which is 3 % of
/// the yield value.
struct Hinge
{
	World m_world;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;

	explicit Hinge(Solver solver, JointClass jointClass) : m_world(solver, btVector3(0, 0, 0))
	{
		btCollisionShape* cube = m_world.box(btVector3(1, 1, 1));
		btRigidBody* support = m_world.body(0, cube, at(0), false);
		m_body = m_world.body(100, cube, at(btScalar(1.5)), false);
		btElasticPlasticCapacity capacity;
		for (int i = 0; i < BT_EP_BENDING_Z; ++i)
			capacity.set(i, btScalar(1e9), btScalar(2e4), btScalar(0.01));
		m_joint = m_world.joint(*support, *m_body, at(0), capacity, jointClass);
		m_body->setLinearVelocity(btVector3(0, 3, 0));
		m_body->setAngularVelocity(btVector3(0, 0, 2));
	}

	void expectNoFlow(const testing::Message& when) const
	{
		EXPECT_EQ(0, m_joint->getPlasticEnergy()) << when;
		EXPECT_EQ(0, m_joint->getDamage()) << when;
		EXPECT_FALSE(m_joint->hasYielded()) << when;
		EXPECT_FALSE(m_joint->isBroken()) << when;
	}
};

TEST(JointStep, AHingeDoesNotFlowWhereTheStepGetsShorter)
{
	for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
		for (int rate : {30, 60, 120})
		{
			Hinge hinge(Solver::Direct, jointClass);
			const btScalar dt = btScalar(1) / btScalar(rate);
			const double energy = hinge.m_world.kineticEnergy();
			btElasticPlasticStepControl control;
			run(hinge.m_world, 20, dt);
			hinge.expectNoFlow(testing::Message() << "constant step, rate " << rate);
			for (btScalar shorter : {dt / 10, btScalar(1e-4)})
			{
				run(hinge.m_world, 3, shorter);
				hinge.expectNoFlow(testing::Message() << "step " << shorter << ", rate " << rate);
				run(hinge.m_world, 3, dt);
				hinge.expectNoFlow(testing::Message() << "after step " << shorter << ", rate " << rate);
			}
			for (int i = 0; i < 3; ++i)
			{
				control.expectBlow();
				control.step(hinge.m_world.bullet(), hinge.m_world.action(), dt);
				hinge.expectNoFlow(testing::Message() << "step control, rate " << rate);
			}
			// Each step of straight motion leaves the circle by an angle of w dt = 1/15 at most, which the next one takes from the
			// speed: (w dt)^2 / 2 of it a step. Nothing of that may be made.
			EXPECT_LE(hinge.m_world.kineticEnergy(), energy * (1 + byPrecision(1e-12, 1e-5)));
		}
}

TEST(JointStep, AHingeDoesNotFlowWhereStepsChangeAllTheTime)
{
	// Without inner steps, those of the direct form, a step of a hundredth resolves the spring: then the 0.2 m/s by which the velocity of
	// a body that has turned through a step of 1/30 s points off its circle load it by 60 kN, three times its yield value.
	const double all[] = {0.5, 0.25, 0.1, 0.01};
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
			for (int rate : {30, 60, 120})
				for (int s = 0; s < (solver == Solver::Direct ? 4 : 3); ++s)
				{
					Hinge hinge(solver, jointClass);
					const btScalar dt = btScalar(1) / btScalar(rate);
					const testing::Message when = testing::Message() << "solver " << int(solver) << ", rate " << rate
																	 << ", shorter by " << all[s];
					for (int i = 0; i < 10; ++i)
					{
						run(hinge.m_world, 3, dt);
						run(hinge.m_world, 1 + i % 3, btScalar(all[s]) * dt);
						hinge.expectNoFlow(when);
					}
					run(hinge.m_world, 1, dt / 3);
					run(hinge.m_world, 1, dt / 8);
					hinge.expectNoFlow(when);
				}
}

TEST(JointStep, AGreaterStiffnessKeepsTheForce)
{
	for (Solver solver : {Solver::Direct, Solver::Iterative})
		for (double factor : {1000., 30.})
		{
			Pair pair(solver, 0, 1000, btVector3(10, 0, 0));
			const double stiffness = 1e6;
			btElasticPlasticJoint* joint = pair.join(evenCapacity(stiffness));
			// Comes to rest by Bullet's damping of bodies.
			pair.m_b->setDamping(btScalar(0.99), btScalar(0.99));
			run(pair.m_world, 1200);
			pair.m_b->setDamping(0, 0);
			double force[BT_EP_DOF_COUNT], largest = 0;
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			{
				force[i] = double(joint->getForce(i));
				largest = fmax(largest, fabs(force[i]));
			}
			ASSERT_GT(largest, 5000);
			const double kinetic = pair.m_world.kineticEnergy(), held = joint->getElasticEnergy();
			EXPECT_TRUE(joint->setCapacity(evenCapacity(stiffness * factor)));
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
				EXPECT_EQ(force[i], double(joint->getForce(i)));
			EXPECT_NEAR(held / factor, joint->getElasticEnergy(), held / factor * byPrecision(1e-12, 1e-5));
			run(pair.m_world, 1, btScalar(1) / 240);
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
				// What it still moves in the step, times the new stiffness.
				EXPECT_NEAR(force[i], double(joint->getForce(i)),
							largest * 1e-3 + stiffness * factor * sqrt(2 * kinetic / 1000) / 240);
			double most = 0;
			for (int i = 0; i < 240; ++i)
			{
				run(pair.m_world, 1, btScalar(1) / 240);
				most = fmax(most, pair.m_world.kineticEnergy());
			}
			// The joint bears the weight as before, so nothing has to move but what still did, and what the rounding of places of 1 m
			// makes of forces: f = 2 epsilon k by the stiffer spring, and f^2 / 2k by the new one.
			const double rounding = 2 * double(SIMD_EPSILON) * stiffness * fmax(1., factor);
			EXPECT_LE(most, kinetic * 1.1 + rounding * rounding / (2 * stiffness * factor) + 1e-9 * held)
				<< "solver " << int(solver) << ", factor " << factor << ", held " << held;
			EXPECT_LE(most, kinetic + held);
		}
}

/// What hangs on a joint in all its directions is held, weight and all, and let go when gravity is none any more. With the force that it had, a
/// spring that is a thousand times softer would throw it a thousand times as far.
TEST(JointStep, ALesserStiffnessKeepsTheDeformation)
{
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (const bool withFibres : {false, true})
			for (const double factor : {0.5, 1e-3})
			{
				SCOPED_TRACE(testing::Message()
							 << "solver " << int(solver) << ", fibres " << withFibres << ", " << factor);
				Pair pair(solver, 0, 10, btVector3(4, -6, 2));
				btElasticPlasticMaterial material = btElasticPlasticMaterial::steel();
				btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.2));
				if (withFibres)
					section = section.withFibres(16);
				const auto capacity = [&](double share)
				{
					btElasticPlasticMaterial softer = material;
					softer.m_youngsModulus *= btScalar(share);
					btElasticPlasticCapacity made = btElasticPlasticCapacity::fromMember(softer, section, 1, 1);
					EXPECT_FALSE(made.fault());
					return made;
				};
				btElasticPlasticJoint* const joint = pair.join(capacity(1));
				run(pair.m_world, 600);
				const double held = joint->getElasticEnergy();
				ASSERT_GT(held, 0);
				double force[BT_EP_DOF_COUNT], largest[2] = {0, 0};
				for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
				{
					force[i] = double(joint->getForce(i));
					largest[i / 3] = fmax(largest[i / 3], fabs(force[i]));
				}
				EXPECT_TRUE(joint->setCapacity(capacity(factor)));
				for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
					EXPECT_NEAR(factor * force[i], double(joint->getForce(i)),
								factor * byPrecision(1e-9, 1e-4) * largest[i / 3])
						<< i;
				EXPECT_NEAR(factor * held, joint->getElasticEnergy(), factor * held * byPrecision(1e-6, 1e-3));
				pair.m_world.bullet().setGravity(btVector3(0, 0, 0));
				for (const auto& body : pair.m_world.bodies())
				{
					body->setLinearVelocity(btVector3(0, 0, 0));
					body->setAngularVelocity(btVector3(0, 0, 0));
				}
				double most = 0;
				for (int i = 0; i < 240; ++i)
				{
					run(pair.m_world, 1, btScalar(1) / 240);
					most = fmax(most, pair.m_world.kineticEnergy());
				}
				EXPECT_LE(most, factor * held * (1 + byPrecision(1e-6, 1e-3)));
			}
}

/// Two bodies that fly and turn about a joint, whose capacity changes while its springs are loaded: bodies and joint never have more than at the start.
TEST(JointStep, NoChangeOfCapacityGivesEnergy)
{
	typedef btElasticPlasticCapacity Capacity;
	const auto member = [](int fibres)
	{
		btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(1e9));
		steel.m_youngsModulus = btScalar(1e8);
		steel.m_dampingRatio = 0;
		btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.2));
		Capacity made =
			Capacity::fromMember(steel, fibres > 0 ? section.withFibres(fibres) : section, btScalar(0.6), 1);
		made.m_length = 0;
		return made;
	};
	const auto heated = [](const Capacity& capacity, double stiffness)
	{
		btElasticPlasticHeat heat;
		heat.m_stiffness = btScalar(stiffness);
		return capacity.heated(heat);
	};
	const auto rigid = [](Capacity capacity, int dof)
	{
		capacity.setRigidPlastic(dof, btScalar(1e9));
		return capacity;
	};
	const auto withoutFibres = [](Capacity capacity)
	{
		capacity.m_fibres.clear();
		return capacity;
	};
	std::vector<std::vector<Capacity>> cases = {
		{member(8), heated(member(8), 47), withoutFibres(heated(member(8), 47))},
		{member(8), member(16), member(0), member(8)},
		{member(0), heated(member(0), 1e-3), heated(member(0), 1e3), member(0)},
		{member(8), heated(member(8), 1e-3), heated(member(8), 1e3), member(8)}};
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		cases.push_back({member(0), rigid(member(0), dof), member(0)});
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (size_t i = 0; i < cases.size(); ++i)
			for (const int rate : {60, 240, 1000})
				for (const int before : {7, 13, 22})
				{
					Pair pair(solver, 100, 100);
					pair.m_frame = at(btScalar(0.5));
					btElasticPlasticJoint* const joint = pair.join(cases[i][0]);
					pair.m_b->setLinearVelocity(btVector3(btScalar(0.2), btScalar(-0.1), btScalar(0.15)));
					pair.m_b->setAngularVelocity(btVector3(btScalar(0.1), btScalar(0.2), btScalar(-0.1)));
					const double start = pair.m_world.kineticEnergy();
					double most = 0;
					for (size_t k = 1; k <= cases[i].size(); ++k)
					{
						for (int step = 0; step < before; ++step)
						{
							pair.m_world.step(btScalar(1) / btScalar(rate));
							most = fmax(most, pair.m_world.kineticEnergy() + joint->getElasticEnergy() +
												  joint->getPlasticEnergy());
						}
						if (k < cases[i].size())
						{
							EXPECT_TRUE(joint->setCapacity(cases[i][k]));
						}
					}
					EXPECT_LE(most, start * (1 + byPrecision(1e-3, 5e-3)))
						<< "solver " << int(solver) << ", case " << i << ", rate " << rate << ", before " << before;
				}
}

/// A capacity that bends and twists easily, and is stiff along its axis and in shear. \param length  that bows [m]
btElasticPlasticCapacity pliant(double length, double turn = 20)
{
	btElasticPlasticCapacity capacity;
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		capacity.set(dof, btScalar(dof < 3 ? 1e7 : turn), btScalar(1e12));
	capacity.m_length = btScalar(length);
	return capacity;
}

/// Where a pair of bodies stands that turn against each other, which of them is fixed, and which way their joint's axis points.
struct BentPair
{
	Pair m_pair;
	btElasticPlasticJoint* m_joint;
	double m_start;

	BentPair(Solver solver, int fixed, int turned, const btElasticPlasticCapacity& capacity)
		: m_pair(solver, fixed == 1 ? 0 : 100, fixed == 2 ? 0 : 100)
	{
		const btQuaternion turns[3] = {btQuaternion::getIdentity(),
									   btQuaternion(btVector3(0, 0, 1), btScalar(3.14159265)),
									   btQuaternion(btVector3(2, 1, 3).normalized(), btScalar(0.7))};
		m_pair.m_frame.setRotation(turns[turned]);
		m_joint = m_pair.join(capacity);
		const double sides[2] = {-0.5, 0.5};
		btRigidBody* const bodies[2] = {m_pair.m_a, m_pair.m_b};
		for (int i = 0; i < 2; ++i)
			if (bodies[i]->getInvMass() > 0)
			{
				bodies[i]->setAngularVelocity(btVector3(btScalar(0.2), btScalar(0.25), btScalar(0.3)) *
											  btScalar(2 * sides[i]));
				bodies[i]->setLinearVelocity(
					bodies[i]->getAngularVelocity().cross(btVector3(btScalar(sides[i]), 0, 0)));
			}
		m_start = energy();
	}

	double energy() const
	{
		return m_pair.m_world.kineticEnergy() + m_joint->getElasticEnergy() + m_joint->getPlasticEnergy() +
			   m_joint->getDampingEnergy();
	}

	double largestGain(int steps, int rate)
	{
		double most = 0;
		for (int i = 0; i < steps; ++i)
		{
			m_pair.m_world.step(btScalar(1) / btScalar(rate));
			most = fmax(most, energy() / m_start - 1);
		}
		return most;
	}
};

TEST(JointStep, ABowThatComesOrGoesGivesNoEnergy)
{
	// Bodies are turned against each other by a quarter of a radian when the joint gets a capacity that bows by another length: the ends of a bow of 1 m are
	// 5 mm closer together, which with 1e7 N/m along the axis were 125 J, where the bodies have 30.
	typedef btElasticPlasticCapacity Capacity;
	const auto without = [](Capacity capacity, int dof)
	{
		capacity.clear(dof);
		return capacity;
	};
	const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(1e9));
	const btElasticPlasticSection square = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1));
	const Capacity member = Capacity::fromMember(steel, square, 1, 1),
				   fibres = Capacity::fromMember(steel, square.withFibres(8), 1, 1);
	ASSERT_GT(member.m_length, 0);
	const std::vector<std::vector<Capacity>> cases = {
		{pliant(0), member},
		{pliant(0), fibres, member},
		{pliant(0), pliant(1), pliant(0)},
		{pliant(1), pliant(0), pliant(3)},
		// What is stiffer keeps its force, and with less of a turn, less of a bow.
		{pliant(1), pliant(1, 200)},
		// A hinge does not bow.
		{pliant(1), without(pliant(1), BT_EP_BENDING_Z), pliant(1)},
		{without(pliant(1), BT_EP_BENDING_Y), pliant(1), without(pliant(0), BT_EP_BENDING_Z)}};
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (size_t i = 0; i < cases.size(); ++i)
			for (int fixed = 0; fixed < 3; ++fixed)
				for (int turned = 0; turned < 3; ++turned)
				{
					BentPair bent(solver, fixed, turned, cases[i][0]);
					double most = 0;
					for (size_t k = 0; k < cases[i].size(); ++k)
					{
						if (k > 0)
						{
							EXPECT_TRUE(bent.m_joint->setCapacity(cases[i][k]));
						}
						most = fmax(most, bent.largestGain(60, 240));
					}
					EXPECT_LE(most, 1e-2)
						<< "solver " << int(solver) << ", case " << i << ", fixed " << fixed << ", turned " << turned;
				}
}

TEST(JointStep, ABowThatComesWhereNobodyKnowsABodysPlaceChangesNoReference)
{
	BentPair bent(Solver::Direct, 0, 0, pliant(0));
	bent.largestGain(60, 240);
	const btElasticPlasticState before = bent.m_joint->getState();
	const btTransform place = bent.m_pair.m_b->getWorldTransform();
	bent.m_pair.m_b->setWorldTransform(btTransform(place.getBasis(), btVector3(btScalar(NAN), 0, 0)));
	EXPECT_TRUE(bent.m_joint->setCapacity(pliant(1)));
	for (int i = 0; i < 3; ++i)
		EXPECT_EQ(before.m_initial[i], bent.m_joint->getState().m_initial[i]);
}

/// A member with fibres of whose shears one is coupled with bending, and one is not.
TEST(JointStep, FibresMayBeCoupledWithOneShear)
{
	for (int shear = 0; shear < 2; ++shear)
		for (int loaded = 0; loaded < 2; ++loaded)
		{
			btVector3 gravity(0, 0, 0);
			gravity[1 + loaded] = -10;
			Pair pair(Solver::Direct, 0, 100, gravity);
			btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
				btElasticPlasticMaterial::steel(),
				btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(8), 0, 2);
			capacity.m_coupling[shear] = 0;
			btElasticPlasticJoint* const joint = pair.join(capacity);
			run(pair.m_world, 300);
			const int dof = BT_EP_SHEAR_Y + loaded;
			EXPECT_NEAR(-1000, double(joint->getForce(dof)), 5);
			EXPECT_NEAR(double(joint->getAppliedForce(dof)), double(joint->getForce(dof)), 5);
		}
}

/// Bullet's own solvers give explicit rows: whatever a fast heavy body does to them, what has borne no force has not flowed.
TEST(JointStep, NeitherFlowNorBreakWithoutAnImpulse)
{
	for (Solver solver : {Solver::Stock, Solver::Nncg, Solver::Mlcp})
		for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
			for (double speed : {0.1, 1., 10.})
			{
				Pair pair(solver, 0, 100000);
				btElasticPlasticCapacity capacity = evenCapacity(1e6, 10);
				for (btScalar& ductility : capacity.m_ductility)
					ductility = btScalar(1e-3);
				btElasticPlasticJoint* joint = pair.join(capacity, jointClass);
				pair.m_b->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
				double before = joint->getPlasticEnergy();
				for (int i = 0; i < 10 && !joint->isBroken(); ++i)
				{
					run(pair.m_world, 1, btScalar(1) / 240);
					if (joint->getPlasticEnergy() != before)
					{
						// The yield value, to the spring's force under the rounding of places of 1 m.
						EXPECT_GE(fabs(double(joint->getAppliedForce(BT_EP_AXIAL))), 10 - 1e6 * double(SIMD_EPSILON))
							<< "solver " << int(solver) << ", speed " << speed << ", step " << i;
					}
					before = joint->getPlasticEnergy();
				}
				EXPECT_TRUE(joint->isBroken()) << "solver " << int(solver) << ", speed " << speed;
			}
}

TEST(JointStep, EventsHaveADegreeOfFreedom)
{
	for (Solver solver : {Solver::Stock, Solver::Nncg, Solver::Mlcp, Solver::Iterative, Solver::Direct})
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			for (double speed : {0.1, 1., 10.})
			{
				Pair pair(solver, 0, 100000);
				btElasticPlasticCapacity capacity = evenCapacity(1e6, 10);
				for (btScalar& ductility : capacity.m_ductility)
					ductility = btScalar(1e-3);
				pair.join(capacity);
				btVector3 motion(0, 0, 0);
				motion[dof % 3] = btScalar(speed);
				if (dof < 3)
					pair.m_b->setLinearVelocity(motion);
				else
					pair.m_b->setAngularVelocity(motion);
				run(pair.m_world, 10, btScalar(1) / 240);
				btElasticPlasticEvent event;
				int count = 0;
				while (pair.m_world.action().popEvent(event))
				{
					++count;
					EXPECT_GE(event.m_dof, 0) << "solver " << int(solver) << ", speed " << speed;
					EXPECT_LT(event.m_dof, int(BT_EP_DOF_COUNT)) << "solver " << int(solver) << ", speed " << speed;
				}
				EXPECT_EQ(2, count) << "solver " << int(solver) << ", speed " << speed;
			}
}

TEST(JointStep, ChangingStepsDoNotLengthenWhatTurns)
{
	// Two blocks that spin about each other, 5 rad/s. In every step they leave their circle by a drift; whatever the steps, it has to
	// be taken back. Even steps of 1/60 s stretch the pair by r (w dt)^2 / 2, 0.35 % of its length.
	const double spin = 5, dt = 1. / 60;
	for (const double other : {1., 0.98, 0.8, 0.5, 0.1})
	{
		Pair pair(Solver::Direct, 12, 12);
		btElasticPlasticJoint* joint = pair.join(evenCapacity(1e8));
		for (btRigidBody* body : {pair.m_a, pair.m_b})
		{
			body->setAngularVelocity(btVector3(0, 0, btScalar(spin)));
			body->setLinearVelocity(btVector3(0, btScalar(body == pair.m_a ? -0.5 * spin : 0.5 * spin), 0));
		}
		for (int i = 0; i < 1000; ++i)
			pair.m_world.step(btScalar(i % 2 == 0 ? dt : dt * other));
		const double length =
			double((pair.m_b->getCenterOfMassPosition() - pair.m_a->getCenterOfMassPosition()).length());
		// Two of these drifts: one may be withheld while the next one comes.
		EXPECT_NEAR(1, length, (spin * dt) * (spin * dt)) << other;
		EXPECT_FALSE(joint->hasYielded());
	}
}

/// A stretched spring that is to move on, in one of many short steps or of a few.
struct StretchedSpring
{
	static constexpr double FORCE = 1e4, SPEED = 0.01;
	static constexpr btScalar STEP = btScalar(1) / 1920;

	Pair m_pair{Solver::Direct, 12, 12};
	double m_stiffness;
	btElasticPlasticJoint* m_joint;
	btElasticPlastic::JointStep* m_step;
	btElasticPlastic::JointRows m_rows;
	int m_axial = 0;

	/// \param before  force and mean forces of the two last steps, over FORCE
	StretchedSpring(double stiffness, double last, const double (&before)[3]) : m_stiffness(stiffness)
	{
		m_joint = m_pair.join(evenCapacity(stiffness, 1e6));
		run(m_pair.m_world, 1);
		btElasticPlasticState state = m_joint->getState();
		state.m_lastStep = btScalar(last);
		state.m_force[BT_EP_AXIAL] = btScalar(before[0] * FORCE);
		state.m_applied[BT_EP_AXIAL] = btScalar(before[1] * FORCE);
		state.m_appliedBefore[BT_EP_AXIAL] = btScalar(before[2] * FORCE);
		EXPECT_TRUE(m_joint->setState(state));
		m_pair.m_b->setWorldTransform(at(1 + before[0] * FORCE / stiffness));
		m_pair.m_b->setLinearVelocity(btVector3(btScalar(SPEED), 0, 0));
		m_step = &btElasticPlastic::JointWorks::from(&m_joint->getConstraint())->m_step;
	}

	void begin(int steps)
	{
		ASSERT_EQ(6, m_step->prepare());
		ASSERT_TRUE(m_step->begin(STEP, btScalar(0.2), {btScalar(1) / btScalar(steps), steps >= 32}, m_rows));
		while (m_rows.m_row[m_axial].m_dof != BT_EP_AXIAL)
			++m_axial;
	}
	const btElasticPlastic::SoftRow& row() const { return m_rows.m_row[m_axial].m_soft; }
	double alpha() const { return 1 / (double(row().m_compliance) * m_stiffness * double(STEP) * double(STEP)); }
	/// The mean force over the step if velocities stay.
	double applied() const { return (double(row().m_velocity) + SPEED) / double(row().m_compliance) / double(STEP); }
	double change() const { return m_stiffness * double(STEP) * SPEED; }

	/// With a unit impulse. \return the mean forces of this step and of the one before it as the next one sees them
	std::pair<double, double> commit(int steps)
	{
		double impulses[BT_EP_DOF_COUNT] = {};
		const signed char bounds[BT_EP_DOF_COUNT] = {};
		impulses[m_axial] = 1;
		m_step->setSolution(impulses, bounds);
		m_step->commit(1. / steps, false);
		const btElasticPlasticState& after = m_joint->getState();
		return {double(after.m_applied[BT_EP_AXIAL]), double(after.m_appliedBefore[BT_EP_AXIAL])};
	}
};

constexpr double StretchedSpring::FORCE, StretchedSpring::SPEED;
constexpr btScalar StretchedSpring::STEP;

TEST(JointStep, WavesOfABlowBeginWithBackwardEuler)
{
	// From a long step into a short one that does not resolve it. As one of many that is backward Euler, alpha = 1, whatever was before, and by mode, alpha = 0.4,
	// from then on; as one of a few it is by row.
	for (const int steps : {16, 32, 64})
		for (const double last : {1. / 60, 1. / 1920})
		{
			StretchedSpring spring(1e8, last, {1, 0.6, 0.4});
			spring.begin(steps);
			const bool isEven = last < 0.01;
			if (steps > 16)
			{
				EXPECT_NEAR(isEven ? 0.4 : 1, spring.alpha(), 1e-4);
				const double force = StretchedSpring::FORCE, change = spring.change();
				EXPECT_NEAR(isEven ? 0.4 * (force + change) + (0.8 * 0.6 - 0.2 * 0.4) * force : force + change,
							spring.applied(), 0.01 * force);
				const std::pair<double, double> after = spring.commit(steps);
				EXPECT_NEAR(1 / double(StretchedSpring::STEP), after.first, 0.01);
				EXPECT_NEAR(isEven ? 0.6 * force : 1 / double(StretchedSpring::STEP), after.second, 0.01);
			}
			else if (isEven)
			{
				// What damps a changed step would come on top.
				EXPECT_GT(spring.alpha(), 0.5);
				EXPECT_LT(spring.alpha(), 0.95);
			}
			spring.m_step->revert();
		}
}

TEST(JointStep, WhatABlowFindsAtRestHasAPastForStepsOfAnyLength)
{
	// It has held one force for long: then the first short step is as those after it, by mode, or by row where these resolve it well.
	for (const double stiffness : {1e8, 1e6})
		for (const double force : {0., 1.})
		{
			StretchedSpring spring(stiffness, 1. / 60, {force, force, force});
			spring.begin(32);
			const double held = force * StretchedSpring::FORCE;
			EXPECT_NEAR(stiffness > 1e7 ? 0.4 : 0.255, spring.alpha(), 0.002);
			// The force at the end of the step has grown by all of its change, alpha of which is in the mean.
			EXPECT_NEAR(held + spring.alpha() * spring.change(), spring.applied(),
						1e-3 * spring.change() + 1e-4 * held);
			const std::pair<double, double> after = spring.commit(32);
			EXPECT_NEAR(1 / double(StretchedSpring::STEP), after.first, 0.01);
			EXPECT_NEAR(held, after.second, 0.01);
			spring.m_step->revert();
		}
}

TEST(JointStep, ASearchThatIsCutLeavesNumbers)
{
	// The bodies get energy from its impulses, and no row is at a bound: nothing flows, and there is nothing to flow from.
	for (const double impulse : {0., 1., -1.})
	{
		Pair pair(Solver::Direct, 12, 12);
		btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 1e4));
		run(pair.m_world, 2, btScalar(1) / 60);
		pair.m_a->setLinearVelocity(btVector3(btScalar(impulse), 0, 0));
		pair.m_a->setInterpolationLinearVelocity(pair.m_a->getLinearVelocity());
		btElasticPlastic::JointStep& step = btElasticPlastic::JointWorks::from(&joint->getConstraint())->m_step;
		btElasticPlastic::JointRows rows;
		ASSERT_EQ(6, step.prepare());
		ASSERT_TRUE(step.begin(btScalar(1) / 60, btScalar(0.2), {1, false}, rows));
		double impulses[BT_EP_DOF_COUNT];
		for (double& i : impulses)
			i = impulse;
		const signed char bounds[BT_EP_DOF_COUNT] = {};
		step.setSolution(impulses, bounds);
		step.setCut();
		EXPECT_EQ(0, step.commit(1, false));
		EXPECT_EQ(0, joint->getPlasticEnergy());
		EXPECT_FALSE(joint->hasYielded());
		EXPECT_TRUE(joint->setState(joint->getState()));
	}
}

/// Two rods that are one, turning freely, in steps of 1/60 s and then a shorter one. What a body leaves its circle by in a long step, of
/// which rigid rows close a fifth in each, is not closed in the shorter time.
TEST(RigidPlastic, AShorterStepOfWhatTurnsGivesNothing)
{
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (const double share : {0.5, 0.1, 0.01})
		{
			Pair pair(solver, 12);
			btElasticPlasticCapacity capacity;
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
				capacity.setRigidPlastic(i, btElasticPlasticCapacity::unlimited());
			pair.join(capacity);
			for (btRigidBody* body : {pair.m_a, pair.m_b})
			{
				body->setAngularVelocity(btVector3(0, 0, 10));
				body->setLinearVelocity(btVector3(0, body == pair.m_a ? -5 : 5, 0));
			}
			const double first = pair.m_world.kineticEnergy();
			for (int i = 0; i < 40; ++i)
			{
				pair.m_world.step(btScalar(i % 8 == 7 ? share * FRAME : FRAME));
				ASSERT_LE(pair.m_world.kineticEnergy(), 1.001 * first) << share << ", step " << i;
			}
		}
}

/// A bar that turns by 0.1 rad in each long step, and is stopped after a shorter one. What its long steps have left beside its joint has been taken
/// back by the force that held it on its circle, of which there is none any more. (What still turns gets up to 1.2e-3 of the start: its ends were
/// apart to the side, too.)
TEST(JointStep, WhatTurnsGivesNothingWhenItHasBeenStopped)
{
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (const bool hasShorter : {true, false})
			for (const double kept : {0., 0.5})
			{
				Pair pair(solver, 40, 40);
				pair.join(evenCapacity(1e9));
				for (btRigidBody* body : {pair.m_a, pair.m_b})
				{
					body->setAngularVelocity(btVector3(0, 0, 3));
					body->setLinearVelocity(btVector3(0, btScalar(body == pair.m_a ? -1.5 : 1.5), 0));
				}
				const double first = pair.m_world.kineticEnergy();
				run(pair.m_world, 20, btScalar(1) / 30);
				if (hasShorter)
					pair.m_world.step(btScalar(1) / 240);
				for (btRigidBody* body : {pair.m_a, pair.m_b})
				{
					body->setLinearVelocity(body->getLinearVelocity() * btScalar(kept));
					body->setAngularVelocity(body->getAngularVelocity() * btScalar(kept));
				}
				const double left = pair.m_world.kineticEnergy();
				for (int i = 0; i < 100; ++i)
				{
					pair.m_world.step(btScalar(1e-3));
					ASSERT_LE(pair.m_world.kineticEnergy(), left + 2e-3 * first)
						<< kept << hasShorter << ", step " << i;
				}
				run(pair.m_world, 20, btScalar(1) / 30);
				EXPECT_LE(pair.m_world.kineticEnergy(), left + 2e-3 * first) << kept << hasShorter;
			}
}

TEST(JointStep, WhatIsNoRowIsNone)
{
	Pair pair(Solver::Direct);
	const btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6));
	run(pair.m_world, 2);
	for (const int r : {-1, 6, 1000000000})
	{
		int dof = 7;
		btScalar before = 1, after = 1;
		joint->getCommittedRow(r, dof, before, after);
		EXPECT_EQ(0, dof);
		EXPECT_EQ(0, before);
		EXPECT_EQ(0, after);
	}
	const btScalar force[BT_EP_DOF_COUNT] = {1, 1, 1, 1, 1, 1};
	EXPECT_EQ(0, joint->getCapacity().elasticDeformation(force, -1));
	EXPECT_EQ(0, joint->getCapacity().elasticDeformation(force, 6));
	EXPECT_EQ(nullptr, pair.m_world.action().getJoint(-1));
	EXPECT_EQ(nullptr, pair.m_world.action().getJoint(1));
	EXPECT_EQ(joint, pair.m_world.action().getJoint(0));
	pair.m_world.action().debugDraw(nullptr);
}
}  // namespace testJointStep
