// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What the fibres of a section tell: events of which went, and in which order, and readings.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "BulletCollision/BroadphaseCollision/btDbvtBroadphase.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticSnapshot.h"
#include "support/Close.h"
#include "support/DirectSolver.h"
#include "support/Run.h"
#include "world/Place.h"

namespace testFibreEvents
{
using namespace ep;

const btElasticPlasticEventType CRACK = BT_EP_EVENT_CRACK, RUPTURE = BT_EP_EVENT_RUPTURE, BREAK = BT_EP_EVENT_BREAK;

struct Diary : btElasticPlasticListener
{
	std::vector<btElasticPlasticEvent> m_events;

	void onYield(const btElasticPlasticEvent&) override {}
	void onBreak(const btElasticPlasticEvent& e) override { m_events.push_back(e); }
	void onCrack(const btElasticPlasticEvent& e) override { m_events.push_back(e); }
	void onRupture(const btElasticPlasticEvent& e) override { m_events.push_back(e); }

	/// Numbers of the parts that events of a kind are about, in the order in which they were told.
	std::vector<int> partsOf(btElasticPlasticEventType type) const
	{
		std::vector<int> parts;
		for (const btElasticPlasticEvent& e : m_events)
			if (e.m_type == type)
				parts.push_back(e.m_part);
		return parts;
	}
};

/// A heavy body that goes its way, whatever its joint with the ground does.
struct Puller
{
	World m_world;
	Diary m_diary;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;

	explicit Puller(const btElasticPlasticCapacity& capacity, bool isHeard = true)
		: m_world(Solver::Direct, btVector3(0, 0, 0))
	{
		btCollisionShape* const box = m_world.box(btVector3(1, 1, 1));
		btRigidBody* const ground = m_world.body(0, box, at(btScalar(-0.5)), false);
		m_body = m_world.body(btScalar(1e9), box, at(btScalar(0.5)), false);
		m_joint = m_world.joint(*ground, *m_body, at(0), capacity);
		if (isHeard)
			m_world.action().addListener(&m_diary);
	}

	/// One step of 1/480 s. \param speed, spin  of the body about the joint, along x and about z [m/s], [rad/s]
	void move(double speed, double spin)
	{
		const btVector3 turn(0, 0, btScalar(spin)), arm = m_body->getCenterOfMassPosition() - btVector3(0, 0, 0);
		m_body->setAngularVelocity(turn);
		m_body->setLinearVelocity(btVector3(btScalar(speed), 0, 0) + turn.cross(arm));
		m_world.step(btScalar(1) / 480);
	}
};

btElasticPlasticMaterial steel(double ultimateStrain)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(500e6));
	steel.m_ultimatePlasticStrain = btScalar(ultimateStrain);
	return steel;
}

btElasticPlasticMaterial concrete(double tensileShare)
{
	btElasticPlasticMaterial concrete;
	concrete.m_youngsModulus = btScalar(30e9);
	concrete.m_yieldStress = btScalar(30e6);
	concrete.m_tensileShare = btScalar(tensileShare);
	concrete.m_ultimatePlasticStrain = btScalar(1e-4);
	concrete.m_crushingStrain = btScalar(1);
	return concrete;
}

TEST(FibreEvents, BarsOfAConcreteSectionRuptureInTurn)
{
	// Turned about its axis at an even rate, so that the bar at height y is stretched by -y a: each ruptures when that is 2 % of the member's metre
	// and what is elastic, the outermost first. The two in the middle are not stretched.
	const double heights[] = {-0.1, -0.2, 0, -0.15}, limit = 0.02, elastic = 500e6 / 200e9, rate = 0.1;
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.3), btScalar(0.5)).withFibres();
	for (const double y : heights)
		for (const double z : {-0.1, 0.1})
			section.addBar(btScalar(y), btScalar(z), btScalar(5e-4), steel(limit));
	btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(concrete(0), section, 1, 1);
	capacity.m_length = 0;  // what bows would be less long by it
	Puller puller(capacity);
	for (int i = 0; i < 1200; ++i)
		puller.move(0, rate);
	// Two of a height go in the same step, whichever is first by rounding.
	std::vector<int> rows;
	for (const int part : puller.m_diary.partsOf(RUPTURE))
		rows.push_back((part - 1) / 2);
	EXPECT_EQ((std::vector<int>{1, 1, 3, 3, 0, 0}), rows);
	for (const btElasticPlasticEvent& e : puller.m_diary.m_events)
	{
		ASSERT_EQ(RUPTURE, e.m_type);
		const btElasticPlasticFibre& fibre = puller.m_joint->getCapacity().m_fibres[e.m_fibre];
		EXPECT_EQ(e.m_part, fibre.m_part);
		const double y = heights[(e.m_part - 1) / 2], turn = rate * e.m_time;
		EXPECT_EQ(btScalar(y), fibre.m_y);
		// Known to a step. The axis turns by half of what the section does.
		EXPECT_NEAR((limit + elastic) / -y, turn, 1.5 * rate / 480) << e.m_part;
		EXPECT_NEAR(y * cos(turn / 2), double(e.m_position.y()), 1e-4);
		EXPECT_NEAR(e.m_part % 2 ? -0.1 : 0.1, double(e.m_position.z()), 1e-4);
	}
	EXPECT_FALSE(puller.m_joint->isBroken());
}

TEST(FibreEvents, TheLessDuctileOfTwoBarsGoesFirst)
{
	// Side by side, and pulled alike: 3 % against 1 %, both of which a single step reaches.
	for (const double speed : {0.05, 50.})
		for (const bool isSecondWeaker : {true, false})
		{
			btElasticPlasticSection section =
				btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(4);
			section.m_fibres.resize(0);
			section.m_fibres.push_back({btScalar(-0.05), btScalar(-0.05), btScalar(2e-4), 0});
			section.addBar(btScalar(0.05), btScalar(0.05), btScalar(1e-4), steel(isSecondWeaker ? 0.01 : 0.03));
			Puller puller(btElasticPlasticCapacity::fromMember(steel(isSecondWeaker ? 0.03 : 0.01), section, 1, 1));
			for (int i = 0; i < 480 && !puller.m_joint->isBroken(); ++i)
				puller.move(speed, 0);
			const std::vector<btElasticPlasticEvent>& events = puller.m_diary.m_events;
			ASSERT_EQ(3u, events.size()) << speed;
			EXPECT_EQ((std::vector<int>{isSecondWeaker, !isSecondWeaker}), puller.m_diary.partsOf(RUPTURE)) << speed;
			EXPECT_EQ(BREAK, events[2].m_type);
			EXPECT_EQ(-1, events[2].m_fibre);
			EXPECT_EQ(-1, events[2].m_part);
		}
}

TEST(FibreEvents, CracksAreToldBeforeWhatIsCrushed)
{
	btElasticPlasticMaterial brick = concrete(0.05);
	brick.m_crushingStrain = btScalar(0.01);
	Puller puller(btElasticPlasticCapacity::fromMember(
		brick, btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(16), 1, 1));
	// They crack at 0.15 mm, a third of it elastic, close at 0.1 mm, and the joint would break where they gape by 0.1 mm.
	for (int i = 0; i < 84; ++i)
		puller.move(0.001, 0);
	EXPECT_EQ(std::vector<int>(16, 0), puller.m_diary.partsOf(CRACK));
	EXPECT_EQ(16u, puller.m_diary.m_events.size());
	for (int i = 0; i < 480 && !puller.m_joint->isBroken(); ++i)
		puller.move(-0.03, 0);
	EXPECT_EQ(std::vector<int>(16, 0), puller.m_diary.partsOf(RUPTURE));
	EXPECT_EQ(1u, puller.m_diary.partsOf(BREAK).size());
}

TEST(FibreEvents, ABarOfSeveralLayersRupturesOnce)
{
	btElasticPlasticMaterial hardening = steel(0.02);
	hardening.m_hardening.push_back({btScalar(0.005), btScalar(560e6)});
	hardening.m_hardening.push_back({btScalar(0.02), btScalar(600e6)});
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(16);
	section.addBar(0, btScalar(0.02), btScalar(1e-4), hardening);
	const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(steel(0.05), section, 1, 1);
	ASSERT_EQ(16 + 3, capacity.m_fibres.size());
	Puller puller(capacity);
	for (int i = 0; i < 480 && !puller.m_joint->isBroken(); ++i)
		puller.move(0.1, 0);
	std::vector<int> parts(17, 0);
	parts[0] = 1;
	EXPECT_EQ(parts, puller.m_diary.partsOf(RUPTURE));
}

TEST(FibreEvents, TheQueueHoldsTheNewestOfEachFibre)
{
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(16);
	Puller puller(btElasticPlasticCapacity::fromMember(steel(0.01), section, 1, 1), false);
	for (int k = 0; k < 20; ++k)
	{
		for (int i = 0; i < 480 && !puller.m_joint->isBroken(); ++i)
			puller.move(0.1, 0);
		ASSERT_TRUE(puller.m_joint->isBroken());
		ASSERT_TRUE(puller.m_world.action().repair(puller.m_joint));
	}
	btElasticPlasticEvent e;
	int count = 0;
	for (double time = 0; puller.m_world.action().popEvent(e); ++count, time = e.m_time)
		EXPECT_GE(e.m_time, time);
	EXPECT_EQ(1 + 16 + 1, count);
}

TEST(FibreEvents, AreToldOnceByAnIslandInInnerSteps)
{
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(16);
	section.addBar(btScalar(0.05), 0, btScalar(1e-4), steel(0.01));
	Puller puller(btElasticPlasticCapacity::fromMember(steel(0.05), section, 1, 1));
	btElasticPlasticSolverSettings settings = solverOf(puller.m_world).getSettings();
	settings.m_innerError = 1e-4;
	ASSERT_TRUE(solverOf(puller.m_world).setSettings(settings));
	// What goes its way is light enough to be stopped a little: else nothing is open.
	puller.m_body->setMassProps(btScalar(2e5), btVector3(1e5, 1e5, 1e5));
	puller.m_body->updateInertiaTensor();
	puller.m_body->setLinearVelocity(btVector3(10, 0, 0));
	for (int i = 0; i < 60 && !puller.m_joint->isBroken(); ++i)
		puller.m_world.step(btScalar(1) / 60);
	EXPECT_GT(solverOf(puller.m_world).getStatistics().m_innerSteps, 0);
	std::vector<int> parts(17, 0);
	parts[0] = 1;
	EXPECT_EQ(parts, puller.m_diary.partsOf(RUPTURE));
	EXPECT_EQ(1u, puller.m_diary.partsOf(BREAK).size());
}

TEST(FibreEvents, GoIntoSnapshotsUnread)
{
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(4);
	section.addBar(btScalar(0.05), btScalar(0.02), btScalar(1e-4), steel(0.01));
	const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(steel(0.05), section, 1, 1);
	Puller from(capacity, false), to(capacity, false);
	for (int i = 0; i < 80; ++i)
		from.move(0.1, 0);
	const auto broadphaseOf = [](World& world) -> btDbvtBroadphase&
	{ return static_cast<btDbvtBroadphase&>(*world.bullet().getBroadphase()); };
	const auto save = [&](void* buffer, size_t size)
	{
		return btElasticPlasticSave(from.m_world.bullet(), broadphaseOf(from.m_world), from.m_world.action(), buffer,
									int(size));
	};
	std::vector<unsigned char> bytes(size_t(save(nullptr, 0)));
	save(bytes.data(), bytes.size());
	ASSERT_FALSE(btElasticPlasticRestore(to.m_world.bullet(), broadphaseOf(to.m_world), to.m_world.action(),
										 bytes.data(), int(bytes.size())));
	btElasticPlasticEvent a, b;
	int ruptures = 0;
	while (from.m_world.action().popEvent(a))
	{
		ASSERT_TRUE(to.m_world.action().popEvent(b));
		EXPECT_EQ(a.m_type, b.m_type);
		EXPECT_EQ(a.m_fibre, b.m_fibre);
		EXPECT_EQ(a.m_part, b.m_part);
		ruptures += a.m_type == RUPTURE;
	}
	EXPECT_EQ(1, ruptures);
	EXPECT_FALSE(to.m_world.action().popEvent(b));
}
TEST(FibreReadings, AreTheElongationAtTheirPlace)
{
	// Stretched and turned, elastic and plastic, back and forth: e - y a of each fibre, less F / k of it to stay.
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(16);
	section.addBar(btScalar(-0.045), 0, btScalar(1e-4), steel(0.1));
	btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(steel(0.2), section, 1, 1);
	capacity.m_length = 0;  // what bows would be less long by it
	Puller puller(capacity);
	const btElasticPlasticJoint& joint = *puller.m_joint;
	EXPECT_EQ(-1, joint.getRulingFibre());
	double stretch = 0, turn = 0;
	for (int i = 0; i < 300; ++i)
	{
		const double way = i < 200 ? 1 : -0.3;
		puller.move(0.01 * way, 0.1 * way);
		stretch += 0.01 * way / 480;
		turn += 0.1 * way / 480;
	}
	double force = 0;
	for (int k = 0; k < joint.getCapacity().m_fibres.size(); ++k)
	{
		const btElasticPlasticFibre& fibre = joint.getCapacity().m_fibres[k];
		const btElasticPlasticFibreReading reading = joint.getFibre(k);
		// The middle of the joint goes along with half of the turn.
		EXPECT_NEAR(stretch - double(fibre.m_y) * turn, double(reading.m_elongation), 2e-5) << k;
		EXPECT_NEAR(double(reading.m_elongation - joint.getState().m_fibres[k].m_force / fibre.m_stiffness),
					double(reading.m_plastic), 1e-7)
			<< k;
		EXPECT_LE(reading.m_utilisation, btScalar(1.001));
		force += double(reading.m_force);
	}
	expectClose(force, double(joint.getForce(BT_EP_AXIAL)), byPrecision(1e-9, 1e-4));
	// The bar is the farthest and the less ductile.
	ASSERT_GE(joint.getRulingFibre(), 0);
	EXPECT_EQ(1, joint.getCapacity().m_fibres[joint.getRulingFibre()].m_part);
	EXPECT_GT(joint.getFibre(joint.getRulingFibre()).m_damage, 0);
	EXPECT_EQ(0, joint.getFibre(-1).m_elongation);
	EXPECT_EQ(0, joint.getFibre(17).m_elongation);
}
}  // namespace testFibreEvents
