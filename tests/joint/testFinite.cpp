// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What a joint keeps is always a state that can be put back, whatever happens to its bodies.

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/JointWorks.h"
#include "support/DirectSolver.h"
#include "support/NotFinite.h"
#include "support/Pair.h"

namespace testFinite
{
using namespace ep;

const btScalar NOT_A_NUMBER = notANumber();

btElasticPlasticCapacity fibres()
{
	btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromRod(
		btElasticPlasticMaterial::steel(200e6),
		btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(16), 1);
	EXPECT_FALSE(capacity.fault());
	EXPECT_TRUE(capacity.hasFibres());
	return capacity;
}

struct Capacities : testing::TestWithParam<bool>
{
	btElasticPlasticCapacity capacity() const { return GetParam() ? fibres() : evenCapacity(1e6, 1e3); }
};

void expectUsable(btElasticPlasticJoint& joint, const char* when)
{
	EXPECT_TRUE(joint.setState(joint.getState())) << when;
}

TEST_P(Capacities, APlaceThatIsNoneIsNoReference)
{
	for (int how = 0; how < 4; ++how)
	{
		SCOPED_TRACE(how);
		Pair pair(Solver::Direct);
		btElasticPlasticJoint* joint = pair.join(capacity());
		run(pair.m_world, 2, btScalar(1) / 60);
		if (how == 2)
			pair.m_world.action().breakJoint(pair.m_world.bullet(), joint);
		const btTransform place = pair.m_b->getCenterOfMassTransform();
		pair.m_b->setWorldTransform(at(NOT_A_NUMBER));
		btElasticPlasticCapacity less = capacity();
		less.scaleYield(btScalar(0.5));
		switch (how)
		{
			case 0:
				EXPECT_TRUE(joint->setCapacity(less));
				break;
			case 1:
				joint->setReferenceToCurrentPose();
				break;
			case 2:
				pair.m_world.action().repair(joint);
				break;
			default:
				// It has been free so far.
				less.m_yield[BT_EP_TORSION] = 0;
				EXPECT_TRUE(joint->setCapacity(less));
				EXPECT_TRUE(joint->setCapacity(capacity()));
		}
		expectUsable(*joint, "with a body that is nowhere");
		pair.m_b->setWorldTransform(place);
		run(pair.m_world, 2, btScalar(1) / 60);
		expectUsable(*joint, "when it is back");
		EXPECT_NEAR(1, double(pair.m_b->getCenterOfMassPosition().x()), 1e-3);
	}
}

TEST(FiniteFibres, AStateOfFibresIsOneUnderAnotherScheme)
{
	// Much stronger when it is pressed than the joint's yield value says, as concrete is between weak bars.
	btElasticPlasticCapacity strong = fibres();
	strong.scaleYield(btScalar(1e-4));
	for (int i = 0; i < strong.m_fibres.size(); ++i)
		strong.m_fibres[i].m_compression *= 200;
	Pair pair(Solver::Direct, 12, 12);
	btElasticPlasticJoint* joint = pair.join(strong);
	for (int i = 0; i < 3; ++i)
	{
		pair.m_a->applyCentralForce(btVector3(btScalar(30e3), 0, 0));
		pair.m_b->applyCentralForce(btVector3(btScalar(-30e3), 0, 0));
		run(pair.m_world, 1, btScalar(1) / 60);
	}
	EXPECT_GT(double(btFabs(joint->getState().m_force[BT_EP_AXIAL])), 64 * double(strong.m_yield[BT_EP_AXIAL]));
	expectUsable(*joint, "by its own scheme");
	joint->setScheme(BT_EP_SCHEME_PAPER);
	expectUsable(*joint, "by the paper's");
}

TEST_P(Capacities, AStretchedBasisIsNoReference)
{
	// Between two bodies of the same basis there is no strain, whatever it is.
	Pair pair(Solver::Direct);
	btElasticPlasticJoint* joint = pair.join(capacity());
	run(pair.m_world, 2, btScalar(1) / 60);
	const btScalar huge = btPow(std::numeric_limits<btScalar>::max(), btScalar(0.6));
	btRigidBody* const bodies[] = {pair.m_a, pair.m_b};
	for (btRigidBody* body : bodies)
	{
		btTransform stretched = body->getCenterOfMassTransform();
		stretched.setBasis(btMatrix3x3(huge, 0, 0, 0, huge, 0, 0, 0, huge));
		body->setWorldTransform(stretched);
	}
	joint->setReferenceToCurrentPose();
	expectUsable(*joint, "with bodies of no basis");
}

TEST_P(Capacities, NoSpeedAndNoStepSpoilsAState)
{
	const double most = double(std::numeric_limits<btScalar>::max());
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (const double speed : {1e10, 1e17, 1e25, most / 1e5, most})
			for (const double dt : {1e-30, 1e-3, 1. / 60, 1.})
			{
				SCOPED_TRACE(testing::Message() << "solver " << int(solver) << ", " << speed << " m/s, " << dt << " s");
				Pair pair(solver, 12, 12);
				btElasticPlasticJoint* joint = pair.join(capacity());
				run(pair.m_world, 1, btScalar(1) / 60);
				for (int i = 0; i < 6; ++i)
				{
					btVector3 motion(0, 0, 0);
					motion[i % 3] = btScalar(i % 2 == 0 ? speed : -speed);
					pair.m_b->setLinearVelocity(motion);
					pair.m_b->setAngularVelocity(i < 3 ? btVector3(0, 0, 0) : motion);
					run(pair.m_world, 1, btScalar(dt));
					expectUsable(*joint, "after a step");
				}
			}
}

/// Calls visit(number) with each floating-point number of a state; those of fibres in the first and the last one.
template <class Visit>
void forEachNumber(btElasticPlasticState& state, const Visit& visit)
{
	const auto forAll = [&visit](auto& array)
	{
		for (auto& number : array)
			visit(number);
	};
	for (btQuaternion* turn : {&state.m_plasticRotation, &state.m_plasticMiddle})
		for (int i = 0; i < 4; ++i)
			visit((*turn)[i]);
	for (auto* array : {&state.m_force, &state.m_forceRate, &state.m_applied, &state.m_appliedBefore, &state.m_plastic,
						&state.m_plasticPath, &state.m_withheld, &state.m_watched, &state.m_load[0], &state.m_load[1],
						&state.m_branch[0], &state.m_branch[1], &state.m_branch[2]})
		forAll(*array);
	forAll(state.m_initial);
	forAll(state.m_fibreStrain);
	visit(state.m_lastStep);
	visit(state.m_withheldStep);
	for (double* energy :
		 {&state.m_work, &state.m_plasticEnergy, &state.m_dampingEnergy, &state.m_storedEnergy, &state.m_placeEnergy})
		visit(*energy);
	const int last = state.m_fibres.size() - 1;
	for (int i = 0; i <= last; i += btMax(last, 1))
	{
		btElasticPlasticFibreState& fibre = state.m_fibres[i];
		for (btScalar* number : {&fibre.m_force, &fibre.m_forceRate, &fibre.m_offset, &fibre.m_damage, &fibre.m_path,
								 &fibre.m_rate, &fibre.m_rateShare})
			visit(*number);
	}
}

/// A force may be beyond what a new capacity bears until the next step.
void expectFinite(const btElasticPlasticJoint& joint, const char* when)
{
	btElasticPlasticState state = joint.getState();
	int which = 0;
	forEachNumber(state, [&](auto& number)
				  { EXPECT_TRUE(btElasticPlasticIsFinite(double(number))) << "number " << which++ << ' ' << when; });
}

TEST_P(Capacities, NoNumberOfAStateSpoilsIt)
{
	const double most = double(std::numeric_limits<btScalar>::max());
	for (const btScalar damping : {btScalar(0), btScalar(0.05)})
		for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
			for (const double size : {1e15, 1e30, sqrt(most), most / 1e3, most, -most})
			{
				int count = 1;
				for (int which = 0; which < count; ++which)
				{
					SCOPED_TRACE(testing::Message() << "solver " << int(solver) << ", number " << which << " of "
													<< size << ", damping " << damping);
					Pair pair(solver, 12, 12);
					btElasticPlasticCapacity whole = capacity();
					whole.m_damping = damping;
					btElasticPlasticJoint* joint = pair.join(whole);
					pair.m_b->setLinearVelocity(btVector3(1, 2, 3));
					run(pair.m_world, 3, btScalar(1) / 60);
					btElasticPlasticState state = joint->getState();
					count = 0;
					forEachNumber(state,
								  [&](auto& number)
								  {
									  if (count++ == which)
										  number = size;
								  });
					if (!joint->setState(state))
						continue;
					expectFinite(*joint, "at once");
					btElasticPlasticCapacity soft = whole;
					for (btScalar& stiffness : soft.m_stiffness)
						stiffness *= btScalar(1e-3);
					EXPECT_TRUE(joint->setCapacity(soft));
					expectFinite(*joint, "with other springs");
					run(pair.m_world, 1, btScalar(1) / 60);
					expectUsable(*joint, "after a step");
					EXPECT_TRUE(joint->setCapacity(evenCapacity(1e6, 1e3)));
					expectFinite(*joint, "with another capacity");
					run(pair.m_world, 2, btScalar(1) / 30);
					expectFinite(*joint, "after longer steps");
				}
			}
}

INSTANTIATE_TEST_SUITE_P(Finite, Capacities, testing::Bool(),
						 [](const testing::TestParamInfo<bool>& info) { return info.param ? "Fibres" : "Springs"; });

TEST(Bodies, WhoseBasisIsNoRotationAreLeftOutAndTold)
{
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (const btScalar scale : {btScalar(0), btScalar(1e-10), btScalar(-1), btScalar(3)})
		{
			Pair pair(solver, 12);
			const btElasticPlasticJoint* joint = pair.join(evenCapacity(1e8, 1e6));
			run(pair.m_world, 2);
			btTransform pose = pair.m_a->getWorldTransform();
			const btMatrix3x3 basis = pose.getBasis() * btMatrix3x3(scale, 0, 0, 0, scale, 0, 0, 0, scale);
			pose.setBasis(basis);
			pair.m_a->setWorldTransform(pose);
			run(pair.m_world, 1);
			const std::string what = joint->fault().m_quantity ? joint->fault().m_quantity : "";
			EXPECT_NE(std::string::npos, what.find("basis of body A")) << what;
			EXPECT_EQ(0, pair.m_b->getLinearVelocity().length()) << scale;
			EXPECT_EQ(0, pair.m_b->getAngularVelocity().length()) << scale;
		}
}

/// Bullet gives such a body a place of its own in each island: threads that solved these at the same time wrote beyond their arrays.
TEST(Bodies, ThatAreStaticAndHaveAMassAreTold)
{
	for (const int threads : {1, 4})
		for (const bool isJoined : {true, false})
		{
			World world(Solver::Direct);
			solverOf(world).setNumThreads(threads);
			btCollisionShape* const cube = world.box(btVector3(1, 1, 1));
			btRigidBody* const support = world.body(500, world.box(btVector3(100, 1, 1)), at(0));
			support->setCollisionFlags(support->getCollisionFlags() | btCollisionObject::CF_STATIC_OBJECT);
			for (int i = 0; i < 16; ++i)
			{
				const btScalar x = btScalar(3 * i);
				btRigidBody *const low = world.body(100, cube, at(x, 1)), *const high = world.body(100, cube, at(x, 2));
				world.joint(*low, *high, at(x, btScalar(1.5)), evenCapacity(1e8, 1e6));
				if (isJoined)
					world.joint(*support, *low, at(x, btScalar(0.5)), evenCapacity(1e8, 1e6));
			}
			run(world, 30);
			int told = 0;
			for (const btElasticPlasticJoint* joint : world.joints())
				told += joint->fault().m_quantity &&
						std::string(joint->fault().m_quantity).find("a static one") != std::string::npos;
			EXPECT_EQ(isJoined ? 16 : 0, told) << threads;
			for (const auto& body : world.bodies())
				EXPECT_TRUE(isFinite(*body));
		}
}
}  // namespace testFinite
