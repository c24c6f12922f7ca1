// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// A world that is restored goes on with the same bits, and what is no snapshot of it is refused.

#include <string.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/snapshot/WorldImage.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticSnapshot.h"
#include "support/DirectSolver.h"
#include "support/Layout.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testSnapshot
{
using namespace ep;

typedef std::vector<unsigned char> Bytes;

btDbvtBroadphase& broadphaseOf(World& world) { return static_cast<btDbvtBroadphase&>(*world.bullet().getBroadphase()); }

Bytes save(World& world)
{
	Bytes bytes(size_t(btElasticPlasticSave(world.bullet(), broadphaseOf(world), world.action(), nullptr, 0)));
	EXPECT_EQ(int(bytes.size()), btElasticPlasticSave(world.bullet(), broadphaseOf(world), world.action(), bytes.data(),
													  int(bytes.size())));
	return bytes;
}

btElasticPlasticFault restore(World& world, const Bytes& bytes)
{
	return btElasticPlasticRestore(world.bullet(), broadphaseOf(world), world.action(), bytes.data(),
								   int(bytes.size()));
}

/// The bits of all bodies and joints.
uint64_t hash(World& world)
{
	uint64_t sum = 0;
	const auto add = [&sum](double value)
	{
		uint64_t bits;
		memcpy(&bits, &value, sizeof bits);
		sum = (sum ^ bits) * 0x100000001B3ull;
		sum ^= sum >> 29;
	};
	const btCollisionObjectArray& objects = world.bullet().getCollisionObjectArray();
	for (int i = 0; i < objects.size(); ++i)
		if (const btRigidBody* const body = btRigidBody::upcast(objects[i]))
		{
			for (int k = 0; k < 3; ++k)
			{
				add(double(body->getCenterOfMassPosition()[k]));
				add(double(body->getLinearVelocity()[k]));
				add(double(body->getAngularVelocity()[k]));
				for (int c = 0; c < 3; ++c)
					add(double(body->getWorldTransform().getBasis()[k][c]));
			}
			add(body->getActivationState());
		}
	for (btElasticPlasticJoint* joint : world.joints())
	{
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			add(double(joint->getForce(dof)));
			add(double(joint->getPlasticPath(dof)));
		}
		add(joint->getWork());
		add(joint->isBroken());
	}
	add(world.action().getNumBroken());
	add(world.bullet().getNumConstraints());
	return sum;
}

/// Two weak cantilevers above a ground, a stack, boxes that fall on all of it, and one of Bullet's own constraints. Joints break and are
/// repaired, bodies fall asleep and are woken.
struct Collapse
{
	World m_world;
	std::vector<btRigidBody*> m_bodies;
	int m_step = 0, m_numBreaks = 0;

	explicit Collapse(Solver solver) : m_world(solver)
	{
		btCollisionShape* const cube = m_world.box(btVector3(1, 1, 1));
		m_world.body(0, m_world.box(btVector3(100, 1, 100)), at(0, -1));
		for (int c = 0; c < 2; ++c)
		{
			btRigidBody* last = m_world.body(0, cube, at(0, 4, 3 * c));
			for (int i = 1; i <= 4; ++i)
			{
				btRigidBody* const next = body(100, cube, at(btScalar(1.02 * i), 4, 3 * c));
				btElasticPlasticCapacity capacity;
				for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
					capacity.set(dof, btScalar(1e6), btScalar(dof < 3 ? 2e4 : 7e3), btScalar(0.02));
				m_world.joint(*last, *next, at(btScalar(1.02 * i - 0.51), 4, 3 * c), capacity);
				last = next;
			}
		}
		for (int i = 0; i < 4; ++i)
			body(50, cube, at(3, btScalar(0.1 + 1.01 * i), 8));
		for (int i = 0; i < 6; ++i)
			body(20, cube, at(btScalar(0.7 * i), btScalar(6 + 1.3 * i), btScalar(0.5 * i)));
		btRigidBody &a = *body(30, cube, at(-3, 2, 0)), &b = *body(30, cube, at(-4, 2, 0));
		m_world.add(new btPoint2PointConstraint(a, b, btVector3(btScalar(-0.5), 0, 0), btVector3(btScalar(0.5), 0, 0)));
		m_world.allowSleep(btScalar(0.8));
	}

	btRigidBody* body(btScalar mass, btCollisionShape* shape, const btTransform& pose)
	{
		m_bodies.push_back(m_world.body(mass, shape, pose));
		return m_bodies.back();
	}

	void step()
	{
		++m_step;
		const std::vector<btElasticPlasticJoint*> joints = m_world.joints();
		if (m_step == 70 || m_step == 110)
			for (btElasticPlasticJoint* joint : joints)
				m_numBreaks += m_world.action().repair(joint);
		if (m_step == 90)
			m_bodies[0]->applyCentralImpulse(btVector3(300, 200, 0));
		if (m_step == 100)
		{
			btElasticPlasticCapacity weaker = joints[5]->getCapacity();
			weaker.scaleYield(btScalar(0.5));
			joints[5]->setCapacity(weaker);
		}
		if (m_step % 2 == 0)
			m_world.bullet().stepSimulation(FRAME, 0);
		else
			// It leaves a part of a step for the next time.
			m_world.bullet().stepSimulation(FRAME, 3, btScalar(1) / 84);
	}

	std::vector<uint64_t> run(int last)
	{
		std::vector<uint64_t> hashes;
		while (m_step < last)
		{
			step();
			hashes.push_back(hash(m_world));
		}
		return hashes;
	}
};

/// \return the first step after the snapshot in which the bits differ, -1: none
int firstDifference(const std::vector<uint64_t>& expected, const std::vector<uint64_t>& actual)
{
	for (size_t i = 0; i < expected.size(); ++i)
		if (i >= actual.size() || expected[i] != actual[i])
			return int(i);
	return -1;
}

TEST(Snapshot, GoesOnWithTheSameBits)
{
	const int END = 180;
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (int first : {0, 3, 40, 75, 105, 140})
		{
			const std::string which = "solver " + std::to_string(int(solver)) + ", saved at " + std::to_string(first);
			Collapse scene(solver), untouched(solver), other(solver), elsewhere(solver);
			untouched.run(first);
			const std::vector<uint64_t> expected = untouched.run(END);
			EXPECT_GT(untouched.m_numBreaks, 3) << which;
			scene.run(first);
			const Bytes snapshot = save(scene.m_world);
			EXPECT_EQ(-1, firstDifference(expected, scene.run(END))) << which;
			ASSERT_FALSE(restore(scene.m_world, snapshot)) << which;
			EXPECT_EQ(snapshot, save(scene.m_world)) << which;
			scene.m_step = first;
			EXPECT_EQ(-1, firstDifference(expected, scene.run(END))) << which << ", in the same world";
			ASSERT_FALSE(restore(other.m_world, snapshot)) << which;
			other.m_step = first;
			EXPECT_EQ(-1, firstDifference(expected, other.run(END))) << which << ", in a new world";
			elsewhere.run(120);
			ASSERT_FALSE(restore(elsewhere.m_world, snapshot)) << which;
			elsewhere.m_step = first;
			EXPECT_EQ(-1, firstDifference(expected, elsewhere.run(END))) << which << ", in a world at another time";
		}
}

/// In the same world and in a new one, from some steps on.
TEST(Snapshot, InnerStepsGoOnWithTheSameBits)
{
	const auto takeInnerSteps = [](Collapse& scene)
	{
		btElasticPlasticSolverSettings settings = solverOf(scene.m_world).getSettings();
		settings.m_innerError = 0.05;
		EXPECT_TRUE(solverOf(scene.m_world).setSettings(settings));
	};
	long long numInner = 0;
	for (int first = 0; first < 100; first += 5)
	{
		Collapse scene(Solver::Direct), other(Solver::Direct);
		takeInnerSteps(scene);
		takeInnerSteps(other);
		scene.run(first);
		const Bytes snapshot = save(scene.m_world);
		const std::vector<uint64_t> expected = scene.run(first + 12);
		ASSERT_FALSE(restore(scene.m_world, snapshot));
		EXPECT_EQ(snapshot, save(scene.m_world));
		scene.m_step = first;
		EXPECT_EQ(-1, firstDifference(expected, scene.run(first + 12)))
			<< "saved at " << first << ", in the same world";
		ASSERT_FALSE(restore(other.m_world, snapshot));
		other.m_step = first;
		EXPECT_EQ(-1, firstDifference(expected, other.run(first + 12))) << "saved at " << first << ", in a new world";
		numInner += statisticsOf(scene.m_world).m_innerSteps;
	}
	EXPECT_GT(numInner, 1000);
}

/// Dumb-bells tumble on a box: each of their parts touches and leaves it by itself.
TEST(Snapshot, CompoundsGoOnWithTheSameBits)
{
	const auto fill = [](World& world)
	{
		world.body(0, world.box(btVector3(100, 1, 100)), at(0, btScalar(-0.5)));
		for (int i = 0; i < 3; ++i)
		{
			btCompoundShape* const bell = new btCompoundShape(i != 1);
			for (const double x : {-0.5, 0., 0.5})
				bell->addChildShape(at(x), world.box(btVector3(1, 1, 1) * btScalar(x == 0 ? 0.2 : 0.4)));
			world.body(10, world.keep(bell), at(0, 1, 3 * i))->setAngularVelocity(btVector3(1, 2, btScalar(3 + i)));
		}
	};
	World scene, other;
	fill(scene);
	fill(other);
	for (int step = 0; step < 120; ++step)
	{
		const Bytes snapshot = save(scene);
		ASSERT_FALSE(restore(other, snapshot)) << "saved at " << step;
		EXPECT_EQ(snapshot, save(other)) << "saved at " << step;
		std::vector<uint64_t> expected, again;
		for (int i = 0; i < 4; ++i)
		{
			run(scene, 1);
			expected.push_back(hash(scene));
			run(other, 1);
			again.push_back(hash(other));
		}
		EXPECT_EQ(-1, firstDifference(expected, again)) << "saved at " << step << ", in another world";
		again.clear();
		ASSERT_FALSE(restore(scene, snapshot)) << "saved at " << step;
		for (int i = 0; i < 4; ++i)
		{
			run(scene, 1);
			again.push_back(hash(scene));
		}
		EXPECT_EQ(-1, firstDifference(expected, again)) << "saved at " << step << ", in the same world";
		ASSERT_FALSE(restore(scene, snapshot));
		run(scene, 1);
	}
}

TEST(Snapshot, KeepsUnreadEvents)
{
	Collapse scene(Solver::Direct), other(Solver::Direct);
	for (btElasticPlasticJoint* joint : scene.m_world.joints())
		joint->setLevel(BT_EP_QUANTITY_UTILISATION, btScalar(0.5));
	scene.run(60);
	const Bytes snapshot = save(scene.m_world);
	ASSERT_FALSE(restore(other.m_world, snapshot));
	EXPECT_EQ(scene.m_world.action().getTime(), other.m_world.action().getTime());
	const std::vector<btElasticPlasticJoint*> joints[2] = {scene.m_world.joints(), other.m_world.joints()};
	btElasticPlasticEvent a, b;
	int count = 0, numLevels = 0;
	for (; scene.m_world.action().popEvent(a); ++count)
	{
		ASSERT_TRUE(other.m_world.action().popEvent(b));
		EXPECT_EQ(std::find(joints[0].begin(), joints[0].end(), a.m_joint) - joints[0].begin(),
				  std::find(joints[1].begin(), joints[1].end(), b.m_joint) - joints[1].begin());
		EXPECT_EQ(a.m_type, b.m_type);
		EXPECT_EQ(a.m_dof, b.m_dof);
		EXPECT_EQ(a.m_time, b.m_time);
		EXPECT_EQ(a.m_energy, b.m_energy);
		EXPECT_EQ(a.m_position, b.m_position);
		EXPECT_EQ(a.m_impulse, b.m_impulse);
		EXPECT_EQ(a.m_velocity, b.m_velocity);
		EXPECT_EQ(a.m_quantity, b.m_quantity);
		EXPECT_EQ(a.m_value, b.m_value);
		numLevels += a.m_type == BT_EP_EVENT_LEVEL;
		EXPECT_EQ(&b.m_joint->getConstraint().getRigidBodyA(), b.m_bodyA);
	}
	EXPECT_GT(count, numLevels);
	EXPECT_GT(numLevels, 0);
	for (size_t i = 0; i < joints[0].size(); ++i)
	{
		EXPECT_EQ(btScalar(0.5), joints[1][i]->getLevel(BT_EP_QUANTITY_UTILISATION));
		EXPECT_EQ(joints[0][i]->getState().m_passedLevels, joints[1][i]->getState().m_passedLevels);
		EXPECT_EQ(joints[0][i]->getState().m_support.m_place, joints[1][i]->getState().m_support.m_place);
	}
	EXPECT_FALSE(other.m_world.action().popEvent(b));
}

/// Bodies tell games where they are between the world's fixed steps, by motion states.
struct ShownCollapse : Collapse
{
	std::vector<btDefaultMotionState> m_states;

	ShownCollapse() : Collapse(Solver::Direct), m_states(m_bodies.size())
	{
		for (size_t i = 0; i < m_bodies.size(); ++i)
		{
			m_states[i].setWorldTransform(m_bodies[i]->getWorldTransform());
			m_bodies[i]->setMotionState(&m_states[i]);
		}
	}
	~ShownCollapse()
	{
		for (btRigidBody* body : m_bodies)
			body->setMotionState(nullptr);
	}
	void fixedSteps() { m_world.bullet().stepSimulation(FRAME, 3, FIXED); }

	static constexpr btScalar FIXED = btScalar(1) / 84;
};

constexpr btScalar ShownCollapse::FIXED;

TEST(Snapshot, KeepsThatACapacityWasRefused)
{
	Collapse scene(Solver::Direct);
	btElasticPlasticJoint* const joint = scene.m_world.joints()[1];
	btElasticPlasticCapacity bad = joint->getCapacity();
	// Whose numbers alone are in order, and of which not all degrees of freedom are elastic-plastic.
	bad.set(BT_EP_DOF_COUNT, 1, 1);
	bad.m_yield[BT_EP_AXIAL] = 0;
	EXPECT_FALSE(joint->setCapacity(bad));
	run(scene.m_world, 5);
	const Bytes snapshot = save(scene.m_world);
	run(scene.m_world, 5);
	EXPECT_FALSE(restore(scene.m_world, snapshot));
	EXPECT_TRUE(bool(joint->fault()));
	EXPECT_EQ(snapshot, save(scene.m_world));
	run(scene.m_world, 5);
	EXPECT_EQ(0, joint->getNumCommittedRows());
	EXPECT_TRUE(joint->setState(joint->getState()));
}

TEST(Snapshot, ShowsBodiesWhereTheyWere)
{
	ShownCollapse scene;
	int numAsleep = 0;
	for (int frame = 0; frame < 200; ++frame)
	{
		SCOPED_TRACE(frame);
		ShownCollapse other;
		ASSERT_FALSE(restore(other.m_world, save(scene.m_world)));
		for (int i = 0; i < 2; ++i)
		{
			for (size_t b = 0; b < scene.m_bodies.size(); ++b)
			{
				const btRigidBody& body = *scene.m_bodies[b];
				btTransform expected, actual;
				scene.m_states[b].getWorldTransform(expected);
				other.m_states[b].getWorldTransform(actual);
				if (body.isActive())
				{
					EXPECT_TRUE(expected == actual) << "body " << b;
					continue;
				}
				// The last that it has told in the step in which it fell asleep was between two of the world's steps. What rings has moved by another velocity in
				// its inner steps than it has at their end.
				++numAsleep;
				EXPECT_LE((expected.getOrigin() - actual.getOrigin()).length(),
						  2 * body.getInterpolationLinearVelocity().length() * ShownCollapse::FIXED +
							  byPrecision(1e-14, 1e-6))
					<< "body " << b;
			}
			EXPECT_EQ(hash(scene.m_world), hash(other.m_world));
			if (i == 0)
			{
				scene.fixedSteps();
				other.fixedSteps();
			}
		}
	}
	EXPECT_GT(numAsleep, 100);
}

TEST(Snapshot, RefusesWhatIsNone)
{
	Collapse scene(Solver::Direct);
	scene.run(60);
	const Bytes snapshot = save(scene.m_world);
	scene.run(80);
	const Bytes now = save(scene.m_world);
	const auto mustRefuse = [&](const Bytes& bytes, const std::string& what)
	{
		EXPECT_TRUE(restore(scene.m_world, bytes)) << what;
		EXPECT_EQ(now, save(scene.m_world)) << what;
	};
	for (size_t size = 0; size < snapshot.size(); size += 1 + snapshot.size() / 100)
		mustRefuse(Bytes(snapshot.begin(), snapshot.begin() + long(size)), std::to_string(size) + " bytes of it");
	Bytes longer = snapshot;
	longer.push_back(0);
	mustRefuse(longer, "a byte too many");
	std::mt19937 random(1);
	for (int i = 0; i < 200; ++i)
	{
		Bytes broken = snapshot;
		const size_t place = i < 16 ? size_t(i) : random() % broken.size();
		broken[place] = static_cast<unsigned char>(broken[place] ^ (1u << random() % 8));
		mustRefuse(broken, "a bit changed in byte " + std::to_string(place));
	}
	const auto mustNotFit = [&](World& world, const char* what)
	{
		const btElasticPlasticFault fault = restore(world, snapshot);
		ASSERT_TRUE(fault);
		EXPECT_STREQ(what, fault.m_quantity);
	};
	Collapse more(Solver::Direct), heavier(Solver::Direct), joined(Solver::Direct);
	more.body(1, more.m_world.box(btVector3(1, 1, 1)), at(50, 50));
	mustNotFit(more.m_world, "number of collision objects in the world");
	heavier.m_bodies[3]->setMassProps(7, btVector3(1, 1, 1));
	mustNotFit(heavier.m_world, "inverse mass of a body [1/kg]");
	joined.m_world.joint(*joined.m_bodies[8], *joined.m_bodies[9], at(0), evenCapacity(1e6));
	mustNotFit(joined.m_world, "number of joints that the action knows");
	// A buffer that is too small gets none.
	Bytes small(snapshot.size() - 1, 7);
	EXPECT_EQ(int(now.size()), btElasticPlasticSave(scene.m_world.bullet(), broadphaseOf(scene.m_world),
													scene.m_world.action(), small.data(), int(small.size())));
	EXPECT_TRUE(restore(scene.m_world, small));
	EXPECT_EQ(0, btElasticPlasticSave(scene.m_world.bullet(), broadphaseOf(more.m_world), scene.m_world.action(),
									  nullptr, 0));
}

/// Where a snapshot's version and the size of its numbers stand, both in two bytes.
const size_t VERSION_AT = 4, PRECISION_AT = 6;

uint16_t numberAt(const Bytes& bytes, size_t place)
{
	uint16_t number;
	memcpy(&number, bytes.data() + place, sizeof number);
	return number;
}

/// Saves and restores while it is being told of a break.
struct Impatient : btElasticPlasticListener
{
	World& m_world;
	const Bytes m_bytes;
	int m_numTold = 0;

	explicit Impatient(World& world) : m_world(world), m_bytes(save(world)) {}

	void onBreak(const btElasticPlasticEvent&) override
	{
		++m_numTold;
		Bytes room(2 * m_bytes.size() + 10000);
		EXPECT_EQ(0, btElasticPlasticSave(m_world.bullet(), broadphaseOf(m_world), m_world.action(), room.data(),
										  int(room.size())));
		EXPECT_EQ(1, restore(m_world, m_bytes).m_value);
	}
};

TEST(Snapshot, IsRefusedWithinAStep)
{
	Collapse scene(Solver::Direct), twin(Solver::Direct);
	scene.run(3);
	twin.run(3);
	Impatient listener(scene.m_world);
	scene.m_world.action().addListener(&listener);
	EXPECT_EQ(-1, firstDifference(twin.run(60), scene.run(60)));
	EXPECT_LT(0, listener.m_numTold);
	// Between steps breakJoint() tells listeners at once.
	const int before = listener.m_numTold;
	for (btElasticPlasticJoint* joint : scene.m_world.joints())
		if (!joint->isBroken())
		{
			scene.m_world.action().breakJoint(scene.m_world.bullet(), joint);
			break;
		}
	EXPECT_EQ(before + 1, listener.m_numTold);
	EXPECT_FALSE(restore(scene.m_world, save(scene.m_world)));
	scene.m_world.action().removeListener(&listener);
}

/// A world that has been saved, with somebody else's proxy in its broadphase.
struct WithForeignProxy
{
	Collapse m_scene{Solver::Direct};
	Bytes m_bytes;
	btDbvtBroadphase& m_broadphase = broadphaseOf(m_scene.m_world);
	btDispatcher* const m_dispatcher = m_scene.m_world.bullet().getDispatcher();
	btBroadphaseProxy* m_foreign;

	WithForeignProxy()
	{
		m_scene.run(3);
		m_bytes = save(m_scene.m_world);
		const btVector3 corner(1, 1, 1);
		m_foreign = m_broadphase.createProxy(-corner, corner, BOX_SHAPE_PROXYTYPE, nullptr, 0, 0, m_dispatcher);
	}
	int sizeOfSnapshot()
	{
		return btElasticPlasticSave(m_scene.m_world.bullet(), m_broadphase, m_scene.m_world.action(), nullptr, 0);
	}
	btElasticPlasticFault restoreAgain() { return restore(m_scene.m_world, m_bytes); }
};

TEST(Snapshot, IsRefusedWhereTheBroadphaseHoldsWhatIsNoObjectOfTheWorld)
{
	WithForeignProxy world;
	EXPECT_EQ(0, world.sizeOfSnapshot());
	EXPECT_EQ(1, world.restoreAgain().m_value);
	world.m_broadphase.destroyProxy(world.m_foreign, world.m_dispatcher);
	EXPECT_FALSE(world.restoreAgain());
}

TEST(Snapshot, IsRefusedWhereAForeignProxyStandsInAnObjectsPlace)
{
	WithForeignProxy world;
	// Their number is right.
	btCollisionObject& object = *world.m_scene.m_world.bullet().getCollisionObjectArray()[2];
	world.m_broadphase.destroyProxy(object.getBroadphaseHandle(), world.m_dispatcher);
	object.setBroadphaseHandle(nullptr);
	EXPECT_EQ(0, world.sizeOfSnapshot());
	EXPECT_EQ(2, world.restoreAgain().m_value);
	// Without either there is still an object that has none; with its own all is well again, though in another order.
	world.m_broadphase.destroyProxy(world.m_foreign, world.m_dispatcher);
	EXPECT_EQ(1, world.restoreAgain().m_value);
	btVector3 low, high;
	object.getCollisionShape()->getAabb(object.getWorldTransform(), low, high);
	object.setBroadphaseHandle(world.m_broadphase.createProxy(low, high, object.getCollisionShape()->getShapeType(),
															  &object, btBroadphaseProxy::DefaultFilter,
															  btBroadphaseProxy::AllFilter, world.m_dispatcher));
	EXPECT_LT(0, world.sizeOfSnapshot());
}

TEST(Snapshot, OfAnotherVersionOrPrecisionIsRefused)
{
	Collapse scene(Solver::Direct);
	scene.run(60);
	const Bytes snapshot = save(scene.m_world);
	scene.run(80);
	const Bytes now = save(scene.m_world);
	const auto mustRefuse = [&](size_t place, int number, const char* what)
	{
		Bytes other = snapshot;
		const uint16_t written = uint16_t(number);
		memcpy(other.data() + place, &written, sizeof written);
		const btElasticPlasticFault fault = restore(scene.m_world, other);
		ASSERT_TRUE(fault);
		EXPECT_STREQ(what, fault.m_quantity);
		EXPECT_EQ(number, int(fault.m_value));
		EXPECT_STREQ("that of a whole snapshot of this version and precision", fault.m_range);
		EXPECT_EQ(now, save(scene.m_world)) << what;
	};
	const int version = numberAt(snapshot, VERSION_AT);
	for (const int other : {0, version - 1, version + 1})
		mustRefuse(VERSION_AT, other, "version");
	EXPECT_EQ(sizeof(btScalar), numberAt(snapshot, PRECISION_AT));
	mustRefuse(PRECISION_AT, 12 - int(sizeof(btScalar)), "size of a number [bytes]");
	EXPECT_FALSE(restore(scene.m_world, snapshot));
}

/// Snapshots of before are refused by their version alone. So who changes what one holds raises the version in
/// btElasticPlasticSnapshot.cpp, and then writes both down here.
TEST(Snapshot, HasANewVersionForANewLayout)
{
	Collapse scene(Solver::Direct);
	EXPECT_EQ(16, numberAt(save(scene.m_world), VERSION_AT));
	const uint64_t layout = sizeof(btScalar) == sizeof(double) ? 9676218684594595259u : 3029120946264830259u;
	EXPECT_EQ(layout, btElasticPlastic::layoutOf<btElasticPlastic::WorldImage>());
}

/// A wall of joined blocks that stands on a static beam: 500 joints.
struct Wall
{
	World m_world;

	Wall() : m_world(Solver::Direct)
	{
		const int width = 20, height = 13;
		btCollisionShape* const cube = m_world.box(btVector3(1, 1, 1));
		std::vector<btRigidBody*> below(width, nullptr), row(width, nullptr);
		for (int y = 0; y < height; ++y, below = row)
			for (int x = 0; x < width; ++x)
			{
				row[size_t(x)] = m_world.body(y == 0 ? 0 : 100, cube, at(x, y), false);
				if (y > 0)
					m_world.joint(*below[size_t(x)], *row[size_t(x)], at(x, y - 0.5), evenCapacity(1e8, 3e4));
				if (x > 0 && y > 0)
					m_world.joint(*row[size_t(x - 1)], *row[size_t(x)], at(x - 0.5, y), evenCapacity(1e8, 3e4));
			}
		row[0]->applyCentralImpulse(btVector3(3000, 0, 2000));
	}
};

TEST(Snapshot, LargeStructuresGoOnWithTheSameBits)
{
	Wall wall, other;
	run(wall.m_world, 10);
	const Bytes snapshot = save(wall.m_world);
	// Poses, velocities, state and capacity, the broadphase's nodes, and where inner steps have ended: for each block with its two joints.
	EXPECT_LT(snapshot.size(), 468 * byPrecision(1400, 800));
	std::vector<uint64_t> expected, again, elsewhere;
	for (int i = 0; i < 20; ++i)
	{
		run(wall.m_world, 1);
		expected.push_back(hash(wall.m_world));
	}
	ASSERT_FALSE(restore(wall.m_world, snapshot));
	ASSERT_FALSE(restore(other.m_world, snapshot));
	for (int i = 0; i < 20; ++i)
	{
		run(wall.m_world, 1);
		again.push_back(hash(wall.m_world));
		run(other.m_world, 1);
		elsewhere.push_back(hash(other.m_world));
	}
	EXPECT_EQ(-1, firstDifference(expected, again));
	EXPECT_EQ(-1, firstDifference(expected, elsewhere));
}

/// A cantilever of fibres that flow while it falls.
struct FibreBeam
{
	World m_world;

	FibreBeam() : m_world(Solver::Direct)
	{
		const btScalar side = btScalar(0.02), length = btScalar(0.25);
		btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(250e6));
		steel.m_ultimatePlasticStrain = btScalar(0.01);
		const btElasticPlasticSection section = btElasticPlasticSection::rectangle(side, side).withFibres();
		btCollisionShape* const box = m_world.box(btVector3(length, side, side));
		btRigidBody* last = m_world.body(0, box, at(0, 0), false);
		for (int i = 1; i <= 4; ++i)
		{
			btRigidBody* const next = m_world.body(20, box, at(length * btScalar(i), 0), false);
			m_world.joint(*last, *next, at(length * (btScalar(i) - btScalar(0.5)), 0),
						  btElasticPlasticCapacity::fromMember(steel, section, length, length));
			last = next;
		}
	}

	std::vector<uint64_t> run(int steps)
	{
		std::vector<uint64_t> hashes;
		for (int i = 0; i < steps; ++i)
		{
			::run(m_world, 1);
			hashes.push_back(hash(m_world));
		}
		return hashes;
	}

	/// \return whether a fibre of the joint that holds the beam has flowed
	bool hasFlowed()
	{
		const btElasticPlasticState state = m_world.joints()[0]->getState();
		bool hasFlowed = false;
		for (int i = 0; i < state.m_fibres.size(); ++i)
			hasFlowed |= state.m_fibres[i].m_damage > 0;
		return hasFlowed;
	}
};

TEST(Snapshot, FibresGoOnWithTheSameBits)
{
	for (const int first : {0, 4, 12})
	{
		FibreBeam beam, other;
		beam.run(first);
		const Bytes snapshot = save(beam.m_world);
		const std::vector<uint64_t> expected = beam.run(40);
		EXPECT_TRUE(beam.hasFlowed());
		ASSERT_FALSE(restore(beam.m_world, snapshot));
		EXPECT_EQ(snapshot, save(beam.m_world));
		EXPECT_EQ(-1, firstDifference(expected, beam.run(40))) << "saved at " << first << ", in the same world";
		ASSERT_FALSE(restore(other.m_world, snapshot));
		EXPECT_EQ(-1, firstDifference(expected, other.run(40))) << "saved at " << first << ", in a new world";
	}
}

TEST(Snapshot, FibresThatAreLetGoGoOnWithTheSameBits)
{
	// What the solver remembered of fibres that there were no more made the world's own snapshot a foreign one.
	FibreBeam beam;
	beam.run(10);
	btElasticPlasticJoint* const joint = beam.m_world.joints()[0];
	const btElasticPlasticCapacity whole = joint->getCapacity();
	btElasticPlasticCapacity none = whole;
	none.scaleYield(0);
	ASSERT_TRUE(joint->setCapacity(none));
	const Bytes snapshot = save(beam.m_world);
	ASSERT_FALSE(restore(beam.m_world, snapshot));
	beam.run(5);
	ASSERT_TRUE(joint->setCapacity(whole));
	const Bytes held = save(beam.m_world);
	const std::vector<uint64_t> expected = beam.run(20);
	ASSERT_FALSE(restore(beam.m_world, held));
	EXPECT_EQ(-1, firstDifference(expected, beam.run(20)));
}

/// What bodies still owe for what a joint has taken is of the direct form, too.
TEST(Snapshot, HoldsWhatBodiesOwe)
{
	for (const bool isExact : {true, false})
	{
		FibreBeam beam;
		beam.run(10);
		btElasticPlasticJoint* const joint = beam.m_world.joints()[0];
		btElasticPlasticState state = joint->getState();
		state.m_solvedExactly = isExact;
		state.m_storedEnergy = -3;
		ASSERT_TRUE(joint->setState(state));
		const double plastic = joint->getPlasticEnergy();
		const Bytes snapshot = save(beam.m_world);
		beam.run(3);
		ASSERT_FALSE(restore(beam.m_world, snapshot));
		EXPECT_EQ(-3, joint->getState().m_storedEnergy);
		EXPECT_EQ(plastic, joint->getPlasticEnergy());
	}
}

/// A snapshot as someone would forge it: another image, with the right checksum.
Bytes forged(const Bytes& snapshot, const std::function<void(btElasticPlastic::WorldImage&)>& change)
{
	const size_t header = 16, checksumAt = 8;
	btElasticPlastic::Reader reader(snapshot.data() + header, snapshot.size() - header);
	btElasticPlastic::WorldImage image;
	transfer(reader, image);
	EXPECT_TRUE(reader.isComplete());
	change(image);
	btElasticPlastic::Writer counter(nullptr, 0);
	transfer(counter, image);
	Bytes bytes(header + counter.getSize());
	std::copy_n(snapshot.begin(), header, bytes.begin());
	btElasticPlastic::Writer writer(bytes.data() + header, counter.getSize());
	transfer(writer, image);
	const uint64_t checksum = btElasticPlastic::checksumOf(bytes.data() + header, counter.getSize());
	memcpy(bytes.data() + checksumAt, &checksum, sizeof checksum);
	return bytes;
}

TEST(Snapshot, WhatNoJointCanBeIsRefused)
{
	typedef btElasticPlastic::JointImage JointImage;
	FibreBeam beam;
	beam.run(10);
	const Bytes snapshot = save(beam.m_world);
	beam.run(3);
	const Bytes now = save(beam.m_world);
	EXPECT_EQ(snapshot, forged(snapshot, [](btElasticPlastic::WorldImage&) {}));
	const btScalar bad = std::numeric_limits<btScalar>::quiet_NaN();
	const std::vector<std::function<void(JointImage&)>> changes = {
		[&](JointImage& j) { j.m_capacity.m_stiffness[2] = bad; },
		[&](JointImage& j) { j.m_capacity.m_yield[0] = -1; },
		[&](JointImage& j) { j.m_capacity.m_fibres[1].m_numPoints = 1000000; },
		[&](JointImage& j) { j.m_capacity.m_fibres[1].m_firstPoint = -7; },
		[&](JointImage& j) { j.m_dofs ^= 1u << 4; },
		[&](JointImage& j) { j.m_dofs |= 1u << 31; },
		[&](JointImage& j) { j.m_state.m_force[1] = bad; },
		[&](JointImage& j) { j.m_state.m_watched[5] = std::numeric_limits<btScalar>::max(); },
		[&](JointImage& j) { j.m_state.m_plasticRotation = btQuaternion(0, 0, 0, 0); },
		[&](JointImage& j) { j.m_state.m_plasticPath[0] = -1; },
		[&](JointImage& j) { j.m_state.m_plasticEnergy = -1; },
		[&](JointImage& j) { j.m_state.m_lastStep = -1; },
		[&](JointImage& j) { j.m_state.m_fibres[0].m_damage = -1; },
		[&](JointImage& j) { j.m_state.m_fibres.pop_back(); },
		[&](JointImage& j) { j.m_levels[0] = bad; },
		[&](JointImage& j) { j.m_levels[3] = 0; },
		[&](JointImage& j) { j.m_lastBounds[0] = 2; },
		[&](JointImage& j) { j.m_lastFibreBounds.assign(1000, 0); },
		[&](JointImage& j) { j.m_lastFibreBounds.assign(1, -2); },
		[&](JointImage& j) { j.m_state.m_innerRhythm.m_level = 200; },
		[&](JointImage& j) { j.m_state.m_innerRhythm.m_ringing = std::numeric_limits<float>::quiet_NaN(); },
		[&](JointImage& j) { j.m_numUncommitted = std::numeric_limits<int>::max(); },
		[&](JointImage& j) { j.m_nextRequest = 3; }};
	for (size_t i = 0; i < changes.size(); ++i)
	{
		EXPECT_TRUE(restore(beam.m_world, forged(snapshot, [&](btElasticPlastic::WorldImage& image)
												 { changes[i](image.m_joints[1]); })))
			<< "change " << i;
		EXPECT_EQ(now, save(beam.m_world)) << "change " << i;
	}
}

TEST(Snapshot, CountsThatAreSpoiltAskForLittleMemory)
{
	// The first number is that of collision objects.
	Bytes values(4000, 0);
	values[2] = 1;
	btElasticPlastic::Reader reader(values.data(), values.size());
	btElasticPlastic::WorldImage image;
	transfer(reader, image);
	EXPECT_FALSE(reader.isComplete());
	EXPECT_LT(image.m_objects.capacity() * sizeof(image.m_objects[0]), 20 * values.size());
}

TEST(Snapshot, OfAnActionWhoseJointsSeparateInAnotherWorldIsRefused)
{
	// Two worlds with one action; in the larger one the bodies of a broken joint overlap.
	World here(Solver::Direct), there(Solver::Direct);
	here.bullet().addAction(&there.action());
	btCollisionShape* const cube = here.box(btVector3(1, 1, 1));
	btRigidBody* last = nullptr;
	for (int i = 0; i < 5; ++i)
	{
		btRigidBody* const next = there.body(20, cube, at(btScalar(i) / 2, 0));
		if (last)
			there.joint(*last, *next, at(btScalar(i) / 2 - btScalar(.25), 0), evenCapacity(1e6, 1e4));
		last = next;
	}
	here.body(20, cube, at(0));
	run(there, 1);
	ASSERT_TRUE(there.action().breakJoint(there.bullet(), there.joints()[3]));
	Bytes bytes(10000);
	EXPECT_EQ(0,
			  btElasticPlasticSave(here.bullet(), broadphaseOf(here), there.action(), bytes.data(), int(bytes.size())));
	here.bullet().removeAction(&there.action());
	// The world that it is in is saved as before.
	EXPECT_FALSE(restore(there, save(there)));
}
}  // namespace testSnapshot
