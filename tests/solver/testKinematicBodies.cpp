// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Structures on kinematic bodies, moved as games move them: once for all substeps of a frame.

#include <algorithm>
#include <math.h>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/SupportWay.h"
#include "support/Pair.h"
#include "support/Precision.h"

namespace testKinematicBodies
{
using namespace ep;

/// A cantilever of steel, 80 mm square, of blocks of half a metre on a kinematic base.
struct Cantilever
{
	enum
	{
		BLOCKS = 4
	};
	World m_world;
	btRigidBody* m_base;
	btRigidBody* m_tip = nullptr;
	std::vector<btElasticPlasticJoint*> m_joints;

	explicit Cantilever(Solver solver, bool isBaseB = false, bool withFibres = false)
		: m_world(solver, btVector3(0, 0, 0))
	{
		const btScalar length = btScalar(0.5), height = btScalar(0.08);
		const btElasticPlasticSection section = btElasticPlasticSection::rectangle(height, height);
		const btElasticPlasticCapacity capacity =
			btElasticPlasticCapacity::fromMember(btElasticPlasticMaterial::steel(btScalar(235e6)),
												 withFibres ? section.withFibres() : section, length / 2, length / 2);
		btCollisionShape* const box = m_world.box(btVector3(length, height, height));
		btRigidBody* last = m_base = m_world.body(0, m_world.box(btVector3(length, 1, 1)), at(0), false);
		makeKinematic(*m_base);
		for (int i = 1; i <= BLOCKS; ++i)
		{
			m_tip = m_world.body(7850 * height * height * length, box, at(length * btScalar(i)), false);
			btRigidBody &a = isBaseB ? *m_tip : *last, &b = isBaseB ? *last : *m_tip;
			m_joints.push_back(m_world.joint(a, b, at(length * (btScalar(i) - btScalar(0.5))), capacity));
			last = m_tip;
		}
	}

	double utilisation() const
	{
		double most = 0;
		for (const btElasticPlasticJoint* joint : m_joints)
			most = std::max(most, double(joint->getUtilisation()));
		return most;
	}
};

/// How a base goes: it speeds up for a second, and keeps its speed.
struct Motion
{
	btVector3 m_velocity, m_spin;  // [m/s], [rad/s]

	btTransform placeAt(double time) const
	{
		const btScalar s = btScalar(time < 1 ? time * time / 2 : time - 0.5);
		const btScalar spin = m_spin.length();
		const btQuaternion turn = spin > 0 ? btQuaternion(m_spin / spin, spin * s) : btQuaternion::getIdentity();
		return btTransform(turn, m_velocity * s);
	}
};

/// Tells Bullet where the base is when it asks for it.
struct BaseMotion : btMotionState
{
	btTransform m_place = btTransform::getIdentity();

	void getWorldTransform(btTransform& place) const override { place = m_place; }
	void setWorldTransform(const btTransform&) override {}
};

enum class Moved
{
	InEachSubstep,
	OnceAFrame,
	ByMotionState
};

struct Outcome
{
	double m_utilisation, m_plastic, m_numerical;
	btVector3 m_tip;
	int m_numBroken;
};

/// Two seconds.
Outcome play(Cantilever& cantilever, const Motion& motion, Moved moved, double frame, int substeps)
{
	btDiscreteDynamicsWorld& world = cantilever.m_world.bullet();
	BaseMotion base;
	if (moved == Moved::ByMotionState)
		cantilever.m_base->setMotionState(&base);
	double utilisation = 0;
	for (int i = 0; i < int(2 / frame + 0.5); ++i)
	{
		const double begin = i * frame;
		const btScalar step = btScalar(frame / substeps);
		const btTransform from = motion.placeAt(begin), to = motion.placeAt(begin + frame);
		if (moved == Moved::InEachSubstep)
			for (int k = 1; k <= substeps; ++k)
			{
				const btScalar share = btScalar(k) / btScalar(substeps);
				cantilever.m_base->setWorldTransform(btTransform(from.getRotation().slerp(to.getRotation(), share),
																 from.getOrigin().lerp(to.getOrigin(), share)));
				world.stepSimulation(step, 0, step);
			}
		else
		{
			if (moved == Moved::OnceAFrame)
				cantilever.m_base->setWorldTransform(to);
			base.m_place = to;
			// A rounding more, or Bullet may take a substep less.
			world.stepSimulation(btScalar(frame) * (1 + SIMD_EPSILON), substeps, step);
		}
		utilisation = std::max(utilisation, cantilever.utilisation());
	}
	cantilever.m_base->setMotionState(nullptr);
	double plastic = 0, numerical = 0;
	for (const btElasticPlasticJoint* joint : cantilever.m_joints)
	{
		plastic += joint->getPlasticEnergy();
		numerical += joint->getNumericalEnergy();
	}
	return {utilisation, plastic, numerical, cantilever.m_tip->getCenterOfMassPosition(),
			cantilever.m_world.action().getNumBroken()};
}

TEST(KinematicBodies, MovedOnceForAllSubstepsMoveEvenly)
{
	// Bullet shows them at the frame's end in all of them. A bar of 80 mm whose end moved at 0.2 m/s in two substeps broke at 1/60 s, and told
	// 40 kJ; on one spun at 0.5 rad/s it flowed.
	const Motion motions[] = {{btVector3(0, 1, 0), btVector3(0, 0, 0)},
							  {btVector3(btScalar(0.2), 0, 0), btVector3(0, 0, 0)},
							  {btVector3(0, 0, 0), btVector3(0, btScalar(0.5), 0)},
							  {btVector3(1, btScalar(0.5), 0), btVector3(0, 0, btScalar(0.3))}};
	int index = 0;
	for (const Motion& motion : motions)
	{
		for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
			for (const int substeps : {2, 3, 8})
			{
				const bool isBaseB = index % 2 == 1, withFibres = solver == Solver::Direct && index == 3;
				Outcome ends[3];
				for (int run = 0; run < 3; ++run)
				{
					Cantilever cantilever(solver, isBaseB, withFibres);
					ends[run] = play(cantilever, motion, Moved(run), 1. / 30, substeps);
				}
				// In double the same to rounding. How far iterations get is a matter of rounding: they leave a joint at up to 1e-2 of its strength. In float
				// the speed of a base that turns by little in each substep is rounded, by 3e-5 rad/s, which strains joints more than once a frame.
				const bool isExact = solver == Solver::Direct && sizeof(btScalar) == sizeof(double);
				for (int run = 0; run < 3; ++run)
				{
					SCOPED_TRACE(testing::Message() << int(solver) << " " << substeps << " " << run << " " << index);
					EXPECT_EQ(0, ends[run].m_plastic);
					EXPECT_EQ(0, ends[run].m_numBroken);
					EXPECT_LT(ends[run].m_utilisation, ends[0].m_utilisation + (isExact ? 1e-6 : 0.01));
					EXPECT_LT(fabs(ends[run].m_numerical),
							  fabs(ends[0].m_numerical) + (isExact ? 0.005 : byPrecision(0.3, 1)));
					EXPECT_LT(ends[run].m_tip.distance(ends[0].m_tip), isExact ? 1e-6 : byPrecision(0.01, 0.02));
				}
			}
		++index;
	}
}

TEST(KinematicBodies, GoEvenlyThroughFramesOfAnyLength)
{
	// A game whose frames take now one substep and now five, or none: the base has gone the frame's way, in as many substeps as Bullet takes.
	Cantilever cantilever(Solver::Direct);
	const double lengths[] = {1, 3, 0.4, 2, 5, 0.2, 1.4, 2, 3};
	const double substep = 1. / 60;
	double time = 0, place = 0, most = 0;
	for (int i = 0; i < 180; ++i)
	{
		// A tenth of a substep more, or the number of substeps would be a matter of rounding.
		const double frame = (lengths[i % 9] + (i == 0 ? 0.1 : 0)) * substep;
		time += frame;
		// Nothing but a constant speed in each substep; what a frame's way beyond its last substep does to the speed is not looked at here.
		const double taken = floor(time / substep + 1e-6) * substep;
		place = taken < 1 ? taken * taken / 2 : taken - 0.5;
		cantilever.m_base->setWorldTransform(at(0, place));
		cantilever.m_world.bullet().stepSimulation(btScalar(frame), 10, btScalar(substep));
		most = std::max(most, cantilever.utilisation());
	}
	EXPECT_GT(cantilever.m_tip->getCenterOfMassPosition().y(), place - 0.01);
	// The speed of a frame changes by what the base gains in it, 1/12 m/s in five substeps.
	EXPECT_LT(most, 0.2);
}

/// A block of 100 kg on a platform, which moves by a motion state; both go at the same speed.
struct Platform
{
	World m_world;
	BaseMotion m_motion;
	btRigidBody* m_platform;
	btRigidBody* m_block;
	btElasticPlasticJoint* m_joint;
	btVector3 m_velocity;

	/// \param isKinematic  else it is free at first
	Platform(Solver solver, const btVector3& velocity, bool isKinematic = true)
		: m_world(solver, btVector3(0, 0, 0)), m_velocity(velocity)
	{
		btCollisionShape* const box = m_world.box(btVector3(1, btScalar(0.4), 1));
		m_platform = m_world.body(isKinematic ? btScalar(0) : btScalar(500), box, at(0), false);
		m_block = m_world.body(100, m_world.box(btVector3(btScalar(0.1), 1, btScalar(0.1))), at(0, 0.7), false);
		const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1));
		const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
			btElasticPlasticMaterial::steel(btScalar(235e6)), section, 0, 1, btScalar(0.1));
		const btTransform frame(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), btVector3(0, btScalar(0.2), 0));
		m_joint = m_world.joint(*m_platform, *m_block, frame, capacity);
		m_block->setLinearVelocity(velocity);
		if (isKinematic)
			becomeKinematic();
		else
			m_platform->setLinearVelocity(velocity);
	}
	~Platform() { m_platform->setMotionState(nullptr); }

	void becomeKinematic()
	{
		m_motion.m_place = m_platform->getCenterOfMassTransform();
		m_platform->setMotionState(&m_motion);
		makeKinematic(*m_platform);
	}

	void run(int frames, int substeps, double frame = 1. / 60)
	{
		for (int i = 0; i < frames; ++i)
		{
			m_motion.m_place.getOrigin() += m_velocity * btScalar(frame);
			m_world.bullet().stepSimulation(btScalar(frame) * (1 + SIMD_EPSILON), substeps + 1,
											btScalar(frame / substeps));
		}
	}
};

TEST(KinematicBodies, HoldWhatHoldsAgainWhileTheyMove)
{
	// The joint does not hold for some frames, or its support becomes kinematic. It knows nothing of how the platform has gone since: it was torn by way that the block had gone, too.
	enum Pause
	{
		RELEASED,
		OUT_OF_WORLD,
		BROKEN,
		OUT_OF_ACTION,
		DISABLED,
		DYNAMIC,
		NUM_PAUSES
	};
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
		for (const btVector3& velocity : {btVector3(0, btScalar(0.3), 0), btVector3(1, 0, btScalar(0.5))})
			for (const int substeps : {1, 4})
				for (int pause = 0; pause < NUM_PAUSES; ++pause)
				{
					Platform scene(solver, velocity, pause != DYNAMIC);
					btElasticPlasticAction& action = scene.m_world.action();
					btTypedConstraint& constraint = scene.m_joint->getConstraint();
					scene.run(20, substeps);
					const btElasticPlasticCapacity capacity = scene.m_joint->getCapacity();
					if (pause == RELEASED)
					{
						btElasticPlasticCapacity none = capacity;
						none.scaleYield(0);
						ASSERT_TRUE(scene.m_joint->setCapacity(none));
					}
					if (pause == OUT_OF_WORLD)
						scene.m_world.bullet().removeConstraint(&constraint);
					if (pause == BROKEN)
						action.breakJoint(scene.m_world.bullet(), scene.m_joint);
					if (pause == OUT_OF_ACTION)
						action.removeJoint(scene.m_joint);
					if (pause == DISABLED)
						constraint.setEnabled(false);
					scene.run(3, substeps);
					const btVector3 before =
						scene.m_block->getCenterOfMassPosition() - scene.m_platform->getCenterOfMassPosition();
					if (pause == RELEASED)
					{
						ASSERT_TRUE(scene.m_joint->setCapacity(capacity));
					}
					if (pause == OUT_OF_WORLD)
						scene.m_world.bullet().addConstraint(&constraint, true);
					if (pause == BROKEN)
					{
						ASSERT_TRUE(action.repair(scene.m_joint));
					}
					if (pause == OUT_OF_ACTION)
					{
						ASSERT_TRUE(action.addJoint(scene.m_joint));
					}
					if (pause == DISABLED)
						constraint.setEnabled(true);
					if (pause == DYNAMIC)
						scene.becomeKinematic();
					scene.run(30, substeps);
					const btVector3 after =
						scene.m_block->getCenterOfMassPosition() - scene.m_platform->getCenterOfMassPosition();
					SCOPED_TRACE(testing::Message() << int(solver) << " " << substeps << " " << pause);
					EXPECT_FALSE(scene.m_joint->isBroken());
					EXPECT_EQ(0, scene.m_joint->getPlasticEnergy());
					// In float the places that speeds are measured by are rounded.
					EXPECT_LT(after.distance(before), byPrecision(1e-6, 2e-4));
				}
}

TEST(KinematicBodies, MayBeMovedByACallbackInEachSubstep)
{
	// Bullet has looked at them before, and its velocity for them is that of the last frame: a lift shook what stood on it by 0.3 of its strength.
	for (const int substeps : {1, 4})
	{
		Cantilever cantilever(Solver::Direct);
		struct Lift
		{
			btRigidBody* m_base;
			double m_time;
		} lift = {cantilever.m_base, 0};
		btDiscreteDynamicsWorld& world = cantilever.m_world.bullet();
		world.setInternalTickCallback(
			[](btDynamicsWorld* of, btScalar step)
			{
				Lift& moved = *static_cast<Lift*>(of->getWorldUserInfo());
				moved.m_time += double(step);
				const double s = std::min(1., moved.m_time / 2);
				moved.m_base->setWorldTransform(at(0, 4 * s * s * (3 - 2 * s)));
			},
			&lift, true);
		double most = 0;
		for (int i = 0; i < 150; ++i)
		{
			world.stepSimulation(btScalar(1. / 60 * (1 + 1e-6)), substeps + 1, btScalar(1. / 60 / substeps));
			most = std::max(most, cantilever.utilisation());
		}
		// What it takes to speed up by 12 m/s^2: 0.09 in bending.
		EXPECT_LT(most, 0.12) << substeps;
		EXPECT_NEAR(4, cantilever.m_tip->getCenterOfMassPosition().y(), 0.01) << substeps;
	}
}

TEST(KinematicBodies, AreFollowedThroughFramesOfManySubsteps)
{
	Platform scene(Solver::Direct, btVector3(0, btScalar(0.5), 0));
	for (const int substeps : {1, 300, 2, 1000})
		scene.run(2, substeps, substeps / 1000.);
	EXPECT_EQ(0, scene.m_joint->getPlasticEnergy());
}

TEST(KinematicBodies, MayBePutElsewhereWithAllThatStandsOnThem)
{
	// Bullet takes it for a way of theirs, at any speed.
	for (const int substeps : {1, 2, 4})
		for (const double distance : {0.05, 5., 100.})
		{
			Platform scene(Solver::Direct, btVector3(0, 0, 0));
			scene.run(10, substeps);
			const btTransform motion(btQuaternion(btVector3(0, 1, 0), btScalar(0.4)),
									 btVector3(btScalar(distance), btScalar(distance / 5), 0));
			scene.m_motion.m_place = motion * scene.m_motion.m_place;
			const btTransform place = motion * scene.m_block->getCenterOfMassTransform();
			scene.m_block->setWorldTransform(place);
			scene.m_block->setInterpolationWorldTransform(place);
			scene.run(60, substeps);
			EXPECT_FALSE(scene.m_joint->isBroken()) << substeps << " " << distance;
			EXPECT_EQ(0, scene.m_joint->getPlasticEnergy()) << substeps << " " << distance;
			EXPECT_LT(scene.m_block->getCenterOfMassPosition().distance(place.getOrigin()), byPrecision(1e-6, 1e-3));
			// In float what rounding has strained it by does work at a speed of up to 6000 m/s.
			EXPECT_NEAR(0, scene.m_joint->getNumericalEnergy(), byPrecision(1e-3, 50)) << substeps << " " << distance;
		}
}

TEST(KinematicBodies, TakeAlongWhatSleepsOnThem)
{
	// It wakes as the first substep has ended, and was not to find the platform a step's way off: that tore it at 0.3 m/s.
	for (const int substeps : {1, 2, 8})
	{
		double most[2];
		for (const bool sleeps : {false, true})
		{
			Platform scene(Solver::Direct, btVector3(0, 0, 0));
			scene.m_world.allowSleep(btScalar(0.5));
			if (!sleeps)
				scene.m_block->setActivationState(DISABLE_DEACTIVATION);
			scene.run(240, substeps);
			EXPECT_EQ(!sleeps, scene.m_block->isActive());
			scene.m_platform->activate(true);
			scene.m_velocity = btVector3(0, btScalar(0.3), 0);
			most[sleeps] = 0;
			// Slower than what Bullet lets sleep, and for longer than two seconds: the platform is not to be left behind.
			for (int i = 0; i < 200; ++i)
			{
				scene.run(1, substeps);
				most[sleeps] = std::max(most[sleeps], double(scene.m_joint->getUtilisation()));
			}
			EXPECT_EQ(0, scene.m_joint->getPlasticEnergy()) << substeps << sleeps;
			EXPECT_NEAR(200 * 0.3 / 60, scene.m_platform->getCenterOfMassPosition().y(), 1e-4);
			EXPECT_NEAR(200 * 0.3 / 60 + 0.7, scene.m_block->getCenterOfMassPosition().y(), 2e-3);
		}
		// It catches up by a two hundredth of the way in each step.
		EXPECT_LT(most[1], most[0] + 0.05) << substeps;
	}
}

TEST(KinematicBodies, MayBecomeFreeOrStaticAsWhatSleepsOnThemWakes)
{
	for (const bool isFree : {true, false})
	{
		Platform scene(Solver::Direct, btVector3(0, 0, 0));
		scene.m_world.allowSleep(btScalar(0.5));
		scene.run(240, 1);
		ASSERT_FALSE(scene.m_block->isActive());
		scene.m_platform->activate(true);
		scene.m_velocity = btVector3(0, btScalar(0.3), 0);
		scene.run(1, 1);
		EXPECT_GT(scene.m_joint->getState().m_support.m_late, 0);
		scene.m_platform->setMotionState(nullptr);
		if (isFree)
			scene.m_platform->setMassProps(500, btVector3(50, 50, 50));
		scene.m_platform->setCollisionFlags(isFree ? 0 : int(btCollisionObject::CF_STATIC_OBJECT));
		for (int i = 0; i < 30; ++i)
			scene.m_world.bullet().stepSimulation(btScalar(1) / 60, 0);
		EXPECT_TRUE(isFinite(*scene.m_block));
		// Where it is now the block finds it a step's way off.
		EXPECT_LT(scene.m_block->getLinearVelocity().length(), 10);
	}
}

TEST(KinematicBodies, CountTheirSubsteps)
{
	Pair pair;
	makeKinematic(*pair.m_a);
	const btScalar step = btScalar(1) / 60;
	const auto count = [&](const btTransform& shown, const btVector3& velocity, const btVector3& spin)
	{
		pair.m_a->setInterpolationWorldTransform(shown);
		pair.m_a->setLinearVelocity(velocity);
		pair.m_a->setAngularVelocity(spin);
		return btElasticPlastic::countSubsteps(at(0), *pair.m_a, step);
	};
	const btVector3 none(0, 0, 0), along(1, 0, 0), about(0, 0, 1);
	const btScalar angle = 4 * step;
	EXPECT_EQ(1, count(at(step), along, none));
	EXPECT_EQ(4, count(at(4 * step), along, none));
	EXPECT_EQ(1000, count(at(1000 * step), along, none));
	EXPECT_EQ(4, count(btTransform(btQuaternion(about, angle)), none, about));
	EXPECT_EQ(4, count(btTransform(btQuaternion(about, angle), along * angle), along, about));
	// It has been put there.
	EXPECT_EQ(0, count(at(0, 4 * step), along, none));
	EXPECT_EQ(0, count(at(step * btScalar(4.4)), along, none));
	EXPECT_EQ(0, count(at(-4 * step), along, none));
	EXPECT_EQ(0, count(at(4 * step), none, none));
	EXPECT_EQ(0, count(btTransform(btQuaternion(about, angle), along * angle), along, -about));
}
}  // namespace testKinematicBodies
