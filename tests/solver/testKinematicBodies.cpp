// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Structures on kinematic bodies, moved as games move them: once for all substeps of a frame.

#include <algorithm>
#include <math.h>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/KinematicLead.h"
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

TEST(KinematicBodies, MayBePutElsewhere)
{
	// What a game puts elsewhere with its velocity, as Bullet is told by the interpolation transform, has not gone there in many substeps.
	btElasticPlasticState::Support support;
	support.m_kind = btElasticPlasticState::Support::SEEN;
	support.m_place = at(0);
	Pair pair;
	makeKinematic(*pair.m_a);
	const btScalar step = btScalar(1) / 60;
	const auto leadOf = [&](const btTransform& shown, const btVector3& velocity, const btVector3& spin)
	{
		pair.m_a->setWorldTransform(shown);
		pair.m_a->setInterpolationWorldTransform(shown);
		pair.m_a->setLinearVelocity(velocity);
		pair.m_a->setAngularVelocity(spin);
		return double(btElasticPlastic::kinematicLead(support, *pair.m_a, step));
	};
	const btVector3 none(0, 0, 0), along(1, 0, 0), about(0, 0, 1);
	const btScalar angle = 4 * step;
	EXPECT_NEAR(3. / 60, leadOf(at(4 * step), along, none), 1e-6);
	EXPECT_NEAR(3. / 60, leadOf(btTransform(btQuaternion(about, angle)), none, about), 1e-6);
	EXPECT_NEAR(3. / 60, leadOf(btTransform(btQuaternion(about, angle), along * angle), along, about), 1e-6);
	EXPECT_EQ(0, leadOf(at(step), along, none));
	EXPECT_EQ(0, leadOf(at(0, 4 * step), along, none));
	EXPECT_EQ(0, leadOf(at(step * btScalar(4.4)), along, none));
	EXPECT_EQ(0, leadOf(at(1000 * step), along, none));
	EXPECT_EQ(0, leadOf(at(-4 * step), along, none));
	EXPECT_EQ(0, leadOf(at(4 * step), none, none));
	EXPECT_EQ(0, leadOf(btTransform(btQuaternion(about, angle), along * angle), along, -about));
	EXPECT_EQ(0, leadOf(at(0), along, none));
	support.m_lead = 2 * step;
	EXPECT_NEAR(1. / 60, leadOf(at(0), along, none), 1e-6);
	support.m_lead = step;
	EXPECT_EQ(0, leadOf(at(0), along, none));
	// One that sleeps has the velocity of long ago.
	pair.m_a->forceActivationState(ISLAND_SLEEPING);
	EXPECT_EQ(0, leadOf(at(4 * step), along, none));
	support.m_kind = btElasticPlasticState::Support::NOT_SEEN;
	pair.m_a->forceActivationState(ACTIVE_TAG);
	EXPECT_EQ(0, leadOf(at(4 * step), along, none));
}
}  // namespace testKinematicBodies
