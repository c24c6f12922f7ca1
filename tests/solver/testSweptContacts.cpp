// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Contacts that are swept around the joints, compared with contacts that are solved exactly, and with what is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "scenes/destruction/Decks.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EnergyAudit.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testSweptContacts
{
using namespace ep;

void choose(btElasticPlasticConstraintSolver& solver, btElasticPlasticContacts contacts)
{
	btElasticPlasticSolverSettings settings = solver.getSettings();
	settings.m_contacts = contacts;
	ASSERT_TRUE(solver.setSettings(settings));
}

// ---- structures that bear loose bodies

/// A structure under load, with contacts solved in one of the two ways. Nothing sleeps.
class Loaded
{
public:
	Loaded(btElasticPlasticContacts contacts, const std::function<void(Stage& stage)>& build) : m_stage(awake())
	{
		choose(*m_stage.solver(), contacts);
		build(m_stage);
		for (const btRigidBody* body : m_stage.joined())
			m_heights.push_back(double(body->getCenterOfMassPosition().y()));
	}

	void run(int frames)
	{
		for (int i = 0; i < frames; ++i)
		{
			m_stage.playScript();
			m_stage.step();
			m_mostSag = std::max(m_mostSag, sag());
		}
	}

	/// How far its lowest part has sunk [m].
	double sag() const
	{
		double most = 0;
		for (size_t i = 0; i < m_heights.size(); ++i)
			most = std::max(most, m_heights[i] - double(m_stage.joined()[i]->getCenterOfMassPosition().y()));
		return most;
	}
	/// The most so far.
	double mostSag() const { return m_mostSag; }

	/// Of the joint that is nearest to its yield.
	double utilisation()
	{
		double most = 0;
		for (const btElasticPlasticJoint* joint : m_stage.world().joints())
			most = std::max(most, double(joint->getUtilisation()));
		return most;
	}

	Stage& stage() { return m_stage; }

private:
	static Stage::Settings awake()
	{
		Stage::Settings settings;
		settings.sleeps = false;
		return settings;
	}

	Stage m_stage;
	std::vector<double> m_heights;
	double m_mostSag = 0;
};

void standsAsExactly(const std::function<void(Stage& stage)>& build, int frames)
{
	Loaded exact(BT_EP_EXACT_CONTACTS, build), swept(BT_EP_SWEPT_CONTACTS, build);
	exact.run(frames);
	swept.run(frames);
	EXPECT_GT(exact.sag(), 1e-4);
	EXPECT_NEAR(1, swept.sag() / exact.sag(), 0.02);
	EXPECT_NEAR(1, swept.utilisation() / exact.utilisation(), 0.03);
}

TEST(SweptContacts, APlateSagsAsExactly)
{
	Plate plate;
	plate.side = 9;
	plate.boxes = 60;
	plate.isHit = false;
	standsAsExactly([plate](Stage& stage) { plate.build(stage); }, 120);
}

TEST(SweptContacts, ADeckBearsAPyramidAsExactly)
{
	for (double mass : {40., 150.})
	{
		PyramidOnDeck pyramid;
		pyramid.layers = 4;
		pyramid.boxMass = mass;
		standsAsExactly([pyramid](Stage& stage) { pyramid.build(stage); }, 120);
	}
}

Bridge shortBridge(bool drives)
{
	Bridge bridge;
	bridge.length = 20;
	bridge.width = 6;
	bridge.vehicles = 2;
	bridge.drives = drives;
	return bridge;
}

TEST(SweptContacts, ABridgeBearsVehiclesAsExactly)
{
	const Bridge bridge = shortBridge(false);
	standsAsExactly([bridge](Stage& stage) { bridge.build(stage); }, 90);
}

TEST(SweptContacts, ABridgeDoesNotShakeUnderVehiclesThatDrive)
{
	const Bridge bridge = shortBridge(true);
	const auto build = [bridge](Stage& stage) { bridge.build(stage); };
	double shaking[2];
	for (const btElasticPlasticContacts contacts : {BT_EP_EXACT_CONTACTS, BT_EP_SWEPT_CONTACTS})
	{
		Loaded loaded(contacts, build);
		loaded.run(30);
		double fastest = 0;
		for (int i = 0; i < 40; ++i)
		{
			loaded.run(1);
			for (const btRigidBody* body : loaded.stage().joined())
				fastest = std::max(fastest, std::fabs(double(body->getLinearVelocity().y())));
		}
		shaking[contacts == BT_EP_SWEPT_CONTACTS] = fastest;
	}
	// Of the vehicles' weight, a millimetre of sag within a tenth of a second; and no more than with exact contacts.
	EXPECT_LT(shaking[1], 0.01);
	EXPECT_LT(shaking[1], 1.5 * shaking[0]);
}

/// A beam of blocks of 200 kg between two ends, and a body above its middle.
struct BeamUnderBody
{
	double m_mass, m_drop, m_yieldStress;

	void operator()(Stage& stage) const
	{
		const int blocks = 9;
		const double length = 0.5, thickness = 0.4, height = 3, size = 0.8;
		const btElasticPlasticCapacity capacity =
			stage.rectangularMember(stage.concrete(m_yieldStress, 0.05), thickness, thickness, length, length);
		btCollisionShape* const shape =
			stage.world().box(btVector3(btScalar(length - 0.01), btScalar(thickness), btScalar(thickness)));
		const auto placeOf = [&](double i) { return btVector3(btScalar(i * length), btScalar(height), 0); };
		btRigidBody* last = &stage.ground();
		for (int i = 0; i < blocks; ++i)
		{
			btRigidBody& next = stage.body(200, shape, placeOf(i));
			stage.join(*last, next, placeOf(i - 0.5), Stage::Along::X, capacity);
			last = &next;
		}
		stage.join(*last, stage.ground(), placeOf(blocks - 0.5), Stage::Along::X, capacity);
		stage.body(m_mass, stage.world().box(btVector3(btScalar(size), btScalar(size), btScalar(size))),
				   placeOf((blocks - 1) / 2.) + btVector3(0, btScalar((thickness + size) / 2 + m_drop), 0));
	}
};

TEST(SweptContacts, ABeamTakesADroppedMassAsExactly)
{
	const BeamUnderBody drops[] = {{200, 1, 10e6}, {2000, 1, 30e6}, {20000, 1, 60e6}, {100, 3, 10e6}};
	for (const BeamUnderBody& drop : drops)
	{
		Loaded exact(BT_EP_EXACT_CONTACTS, drop), swept(BT_EP_SWEPT_CONTACTS, drop);
		exact.run(120);
		swept.run(120);
		EXPECT_NEAR(1, swept.mostSag() / exact.mostSag(), 0.05) << drop.m_mass;
	}
}

TEST(SweptContacts, AHeavyBodyRestsOnLightBlocksAsExactly)
{
	for (double mass : {500., 2000., 20000.})
	{
		const BeamUnderBody rest = {mass, 0.002, 60e6};
		Loaded exact(BT_EP_EXACT_CONTACTS, rest), swept(BT_EP_SWEPT_CONTACTS, rest);
		exact.run(120);
		swept.run(120);
		EXPECT_NEAR(1, swept.sag() / exact.sag(), 0.05) << mass;
	}
}

// ---- structures that lie on the ground

/// A row of joined blocks on the ground, under a heavy body.
struct BlocksUnderBody
{
	World m_world{Solver::Direct};
	std::vector<btRigidBody*> m_blocks;
	btRigidBody* m_body;

	/// \param height  of the body's underside above the blocks
	BlocksUnderBody(int blocks, double blockMass, btCollisionShape* shape, double mass, double size, double height)
	{
		m_world.body(0, m_world.box(btVector3(100, 1, 100)), at(0, -0.5));
		btCollisionShape* const block = m_world.box(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
		for (int i = 0; i < blocks; ++i)
		{
			m_blocks.push_back(m_world.body(btScalar(blockMass), block, at(btScalar(0.5 * i), btScalar(0.25))));
			if (i > 0)
				m_world.joint(*m_blocks[size_t(i - 1)], *m_blocks.back(), at(btScalar(0.5 * i - 0.25), btScalar(0.25)),
							  evenCapacity(1e7));
		}
		m_body = m_world.body(btScalar(mass), m_world.keep(shape),
							  at(btScalar(0.25 * (blocks - 1)), btScalar(0.5 + height + size / 2)));
	}
};

TEST(SweptContacts, AHeavyBodyRestsOnJoinedBlocksOnTheGround)
{
	// The ground's contacts with the blocks bear what lies on these: swept, they let 20 t sink by 19 cm within 4 s.
	for (double mass : {6000., 20000.})
	{
		const btScalar half = btScalar(0.75);
		BlocksUnderBody rest(8, 200, new btBoxShape(btVector3(half, half, half)), mass, 1.5, 0);
		choose(solverOf(rest.m_world), BT_EP_SWEPT_CONTACTS);
		const double before = double(rest.m_body->getCenterOfMassPosition().y());
		run(rest.m_world, 240);
		// Bullet's margins, and the tenth of a millimetre that is not worth recovery.
		EXPECT_NEAR(before, double(rest.m_body->getCenterOfMassPosition().y()), 3e-3) << mass;
	}
}

TEST(SweptContacts, TheStepAfterABlowMakesNoEnergy)
{
	// The blow is solved exactly; from the next step on contacts are swept, as where the 25th point of contact appears. Bullet's warm
	// start then gives the blocks the blow's impulse again: they took 183 kJ from nowhere.
	for (const bool isBall : {true, false})
	{
		const btScalar half = btScalar(0.5);
		btCollisionShape* const shape =
			isBall ? (btCollisionShape*)new btSphereShape(half) : new btBoxShape(btVector3(half, half, half));
		BlocksUnderBody blow(4, 25, shape, 5000, 1, 0.3);
		choose(solverOf(blow.m_world), BT_EP_EXACT_CONTACTS);
		blow.m_body->setLinearVelocity(btVector3(0, -10, 0));
		EnergyAudit audit(blow.m_world);
		double gain = 0;
		for (int i = 0; i < 60; ++i)
		{
			audit.begin();
			blow.m_world.step(FRAME);
			audit.end(FRAME);
			gain = std::max(gain, audit.gain());
			if (blow.m_body->getLinearVelocity().y() > -5)
				choose(solverOf(blow.m_world), BT_EP_SWEPT_CONTACTS);
		}
		// Of 250 kJ; in float by the rounding of places under 50 kN s.
		EXPECT_LE(gain, byPrecision(0.25, 2.)) << isBall;
	}
}

// ---- what contacts do by themselves, on a platform that a joint holds

/// A platform whose top is at height 0, held to the world by a stiff joint: what lies on it is in the joint's island. With Bullet's own
/// solver a fixed body takes its place.
struct Platform
{
	World m_world;
	btRigidBody* m_platform;

	/// \param slope  tangent of the inclination
	explicit Platform(bool isSwept, double slope = 0)
		: m_world(isSwept ? Solver::Direct : Solver::Stock,
				  btVector3(btScalar(10 * slope / sqrt(1 + slope * slope)), btScalar(-10 / sqrt(1 + slope * slope)), 0))
	{
		btCollisionShape* const shape = m_world.box(btVector3(60, 1, 20));
		m_platform = m_world.body(isSwept ? 100000 : 0, shape, at(0, -0.5));
		m_platform->setFriction(1);
		m_platform->setRestitution(1);
		if (!isSwept)
			return;
		btRigidBody* const support = m_world.body(0, shape, at(0, -2), false);
		m_world.joint(*support, *m_platform, at(0, -1), evenCapacity(1e11));
		choose(solverOf(m_world), BT_EP_SWEPT_CONTACTS);
	}
};

TEST(SweptContacts, FrictionHoldsUpToItsAngleAndSlidesBeyond)
{
	for (double tangent : {0.4, 0.49, 0.7})
	{
		Platform slope(true, tangent);
		// With one direction Bullet turns friction along what still slips, be it noise. In double a swept box then creeps.
		slope.m_world.bullet().getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
		btRigidBody* const box =
			slope.m_world.body(500, slope.m_world.box(btVector3(1, btScalar(0.4), 1)), at(-20, 0.2));
		box->setFriction(btScalar(0.5));
		run(slope.m_world, 120);
		const double speed = 2 * std::max(0., 10 * (tangent - 0.5) / sqrt(1 + tangent * tangent));
		// As for exact contacts: 1 % of what gravity gives, and a millimetre a second.
		EXPECT_NEAR(speed, double(box->getLinearVelocity().x()), 0.01 * 2 * 5) << tangent;
		if (speed == 0)
		{
			EXPECT_NEAR(-20, double(box->getCenterOfMassPosition().x()), 2e-3) << tangent;
		}
	}
}

TEST(SweptContacts, ABoxBouncesAsItsRestitutionSays)
{
	for (double restitution : {0., 0.5, 0.9})
	{
		double heights[2];
		for (const bool isSwept : {false, true})
		{
			Platform floor(isSwept);
			// Penetration is taken back without a velocity, or the bounce would begin with it.
			floor.m_world.bullet().getSolverInfo().m_splitImpulsePenetrationThreshold = 0;
			btRigidBody* const box = floor.m_world.body(100, floor.m_world.box(btVector3(1, 1, 1)), at(0, 1.5));
			box->setRestitution(btScalar(restitution));
			double& highest = heights[isSwept] = 0;
			bool isRising = false;
			for (int i = 0; i < 240; ++i)
			{
				floor.m_world.step(btScalar(1) / 240);
				isRising |= box->getLinearVelocity().y() > 0.1;
				if (isRising)
					highest = std::max(highest, double(box->getCenterOfMassPosition().y()) - 0.5);
			}
		}
		// A step's motion at 1/240 s.
		EXPECT_NEAR(restitution * restitution, heights[1], 0.03) << restitution;
		EXPECT_NEAR(heights[0], heights[1], 0.01) << restitution;
	}
}

TEST(SweptContacts, RollingFrictionStopsABallAsWithTheStockSolver)
{
	for (double friction : {0., 0.1})
	{
		double ways[2];
		for (const bool isSwept : {false, true})
		{
			Platform floor(isSwept);
			btRigidBody* const ball =
				floor.m_world.body(100, floor.m_world.keep(new btSphereShape(btScalar(0.5))), at(0, 0.5));
			ball->setRollingFriction(btScalar(friction));
			ball->setLinearVelocity(btVector3(2, 0, 0));
			ball->setAngularVelocity(btVector3(0, 0, -4));
			run(floor.m_world, 180);
			ways[isSwept] = double(ball->getCenterOfMassPosition().x());
		}
		EXPECT_NEAR(ways[0], ways[1], 0.02 * ways[0]) << friction;
	}
}

TEST(SweptContacts, AStackOfTwentyLeansAsWithTheStockSolver)
{
	double leaning[2], sunk[2];
	for (const bool isSwept : {false, true})
	{
		Platform floor(isSwept);
		btCollisionShape* const cube = floor.m_world.box(btVector3(1, 1, 1));
		std::vector<btRigidBody*> boxes;
		for (int i = 0; i < 20; ++i)
			boxes.push_back(floor.m_world.body(100, cube, at(0, i + 0.5)));
		// Ten iterations hold no stack of twenty for long: both topple in the sixth second.
		run(floor.m_world, 60);
		const btVector3 top = boxes.back()->getCenterOfMassPosition();
		leaning[isSwept] = std::hypot(double(top.x()), double(top.z()));
		sunk[isSwept] = 19.5 - double(top.y());
	}
	// Which way it leans is rounding's: 0.115 m, and 0.10 to 0.12 with Bullet's.
	EXPECT_LE(leaning[1], 1.3 * leaning[0]);
	EXPECT_LE(sunk[1], 1.5 * sunk[0]);
}
}  // namespace testSweptContacts
