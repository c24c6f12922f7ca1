// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Bad input is refused with an error that names the joint, the value and the valid range; the world stays finite.

#include <limits>
#include <memory>
#include <string>

#include <algorithm>

#include <gtest/gtest.h>

#include "support/Pair.h"

namespace
{
using namespace ep;

const btScalar NOT_A_NUMBER = std::numeric_limits<btScalar>::quiet_NaN(),
			   INFINITE = std::numeric_limits<btScalar>::infinity();

struct Refusals : btElasticPlasticListener
{
	std::string m_text;

	void onRefused(btElasticPlasticJoint&, const char* text) override { m_text = text; }
};

/// A support and a body, to be joined badly.
struct Scene : Pair
{
	Refusals m_refusals;

	explicit Scene(btScalar mass = 1) : Pair(Solver::Iterative, 0, mass, btVector3(0, -10, 0))
	{
		m_world.action().setListener(&m_refusals);
	}

	/// A joint about the support's centre, in the world but not in the action's books.
	btElasticPlastic6DofSpring2Constraint* hinge()
	{
		auto* constraint = new btElasticPlastic6DofSpring2Constraint(*m_a, *m_b, at(0), at(-1));
		m_world.add(constraint);
		constraint->setName("gate hinge");
		return constraint;
	}

	/// \return the refusal of a joint of this capacity; the world is stepped after it
	std::string refusalOf(const btElasticPlasticCapacity& capacity)
	{
		btElasticPlastic6DofSpring2Constraint* constraint = hinge();
		EXPECT_FALSE(constraint->setCapacity(capacity));
		EXPECT_FALSE(m_world.action().addJoint(constraint));
		EXPECT_TRUE(bool(constraint->fault()));
		EXPECT_EQ(0, m_world.action().getNumJoints());
		run(m_world, 10);
		// It is out of the simulation: the body falls freely, and everything is a number.
		EXPECT_NEAR(m_b->getInvMass() > 0 ? -10. / 6 : 0, m_b->getLinearVelocity().y(), 1e-5);
		EXPECT_TRUE(btElasticPlasticIsFinite(m_b->getCenterOfMassPosition().length()));
		return m_refusals.m_text;
	}
};

btElasticPlasticCapacity good()
{
	return btElasticPlasticCapacity::fromMember(btElasticPlasticMaterial::steel(),
												btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)), 1, 1);
}

void expectNames(const std::string& text, const char* quantity, const char* value, const char* range)
{
	EXPECT_NE(std::string::npos, text.find("gate hinge")) << text;
	EXPECT_NE(std::string::npos, text.find(quantity)) << text;
	EXPECT_NE(std::string::npos, text.find(value)) << text;
	EXPECT_NE(std::string::npos, text.find(range)) << text;
}

TEST(HardInput, Stiffness)
{
	const struct
	{
		btScalar m_value;
		const char* m_printed;
	} cases[] = {{NOT_A_NUMBER, "nan"}, {INFINITE, "inf"}, {-3, "-3"}};
	for (const auto& c : cases)
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			btElasticPlasticCapacity capacity = good();
			capacity.m_stiffness[dof] = c.m_value;
			const std::string text = Scene().refusalOf(capacity);
			expectNames(text, "stiffness", c.m_printed, "finite");
			EXPECT_NE(std::string::npos, text.find(btElasticPlasticDofName(dof))) << text;
		}
	btElasticPlasticCapacity capacity = good();
	capacity.m_stiffness[BT_EP_SHEAR_Z] = 0;
	expectNames(Scene().refusalOf(capacity), "stiffness", "is 0", "greater than 0 where there is a yield value");
}

TEST(HardInput, YieldAndDuctility)
{
	for (btScalar value : {NOT_A_NUMBER, INFINITE, btScalar(-1)})
	{
		btElasticPlasticCapacity capacity = good();
		capacity.m_yield[BT_EP_TORSION] = value;
		expectNames(Scene().refusalOf(capacity), "yield moment",
					value < 0   ? "-1"
					: value > 0 ? "inf"
								: "nan",
					"finite and not negative");
		capacity = good();
		capacity.m_ductility[BT_EP_AXIAL] = value;
		expectNames(Scene().refusalOf(capacity), "ductility", "is", "finite and greater than 0");
	}
	btElasticPlasticCapacity capacity = good();
	capacity.m_ductility[BT_EP_AXIAL] = 0;
	expectNames(Scene().refusalOf(capacity), "ductility", "is 0", "greater than 0");
	capacity = good();
	capacity.scaleYield(NOT_A_NUMBER);
	expectNames(Scene().refusalOf(capacity), "yield", "nan", "finite");
}

TEST(HardInput, SectionsAndLengths)
{
	typedef btElasticPlasticSection Section;
	const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel();
	const auto from = [&](const Section& section)
	{ return btElasticPlasticCapacity::fromMember(steel, section, 1, 1); };
	for (btScalar bad : {NOT_A_NUMBER, INFINITE, btScalar(-1), btScalar(0)})
	{
		expectNames(Scene().refusalOf(from(Section::rectangle(bad, 1))), "section width", "is",
					"finite and greater than 0");
		expectNames(Scene().refusalOf(from(Section::rectangle(1, bad))), "section height", "is",
					"finite and greater than 0");
		expectNames(Scene().refusalOf(from(Section::circle(bad))), "section radius", "is", "finite and greater than 0");
		expectNames(Scene().refusalOf(from(Section::hollowCircle(1, bad))), "section wall", "is", "greater than 0");
		expectNames(Scene().refusalOf(from(Section::hollowRectangle(1, 1, bad))), "section wall", "is",
					"greater than 0");
		expectNames(Scene().refusalOf(from(Section::iSection(1, 1, bad, btScalar(0.1)))), "section web", "is",
					"greater than 0");
		expectNames(Scene().refusalOf(from(Section::iSection(1, 1, btScalar(0.1), bad))), "section flange", "is",
					"greater than 0");
	}
	// Two wrongs do not make a right: the product of negative sides is positive.
	expectNames(Scene().refusalOf(from(Section::rectangle(-1, -1))), "section width", "-1", "greater than 0");
	expectNames(Scene().refusalOf(from(Section::hollowCircle(1, 2))), "section wall", "is 2", "less than the radius");
	expectNames(Scene().refusalOf(from(Section::hollowRectangle(1, 2, btScalar(0.5)))), "section wall", "0.5",
				"less than half");
	expectNames(Scene().refusalOf(from(Section())), "section area", "is 0", "greater than 0");
	for (btScalar bad : {NOT_A_NUMBER, INFINITE, btScalar(-1)})
	{
		expectNames(Scene().refusalOf(btElasticPlasticCapacity::fromMember(steel, Section::circle(1), bad, 1)),
					"length of the first part", "is", "finite");
		expectNames(Scene().refusalOf(btElasticPlasticCapacity::fromMember(steel, Section::circle(1), 1, bad)),
					"length of the second part", "is", "finite");
		expectNames(Scene().refusalOf(btElasticPlasticCapacity::fromMember(steel, Section::circle(1), 1, 1, bad)),
					"gauge length", "is", "finite");
	}
	expectNames(Scene().refusalOf(btElasticPlasticCapacity::fromMember(steel, Section::circle(1), 0, 0)),
				"sum of the parts' lengths", "is 0", "greater than 0");
}

TEST(HardInput, Materials)
{
	const btElasticPlasticSection section = btElasticPlasticSection::circle(1);
	for (btScalar bad : {NOT_A_NUMBER, INFINITE, btScalar(-1), btScalar(0)})
	{
		const struct
		{
			btScalar btElasticPlasticMaterial::*m_field;
			const char* m_name;
		} fields[] = {{&btElasticPlasticMaterial::m_youngsModulus, "Young's modulus"},
					  {&btElasticPlasticMaterial::m_yieldStress, "yield stress"},
					  {&btElasticPlasticMaterial::m_density, "density"},
					  {&btElasticPlasticMaterial::m_ultimatePlasticStrain, "ultimate plastic strain"},
					  {&btElasticPlasticMaterial::m_loadBearingShare, "load-bearing share"}};
		for (const auto& field : fields)
		{
			btElasticPlasticMaterial material = btElasticPlasticMaterial::steel();
			material.*field.m_field = bad;
			expectNames(Scene().refusalOf(btElasticPlasticCapacity::fromMember(material, section, 1, 1)), field.m_name,
						"is", "greater than 0");
		}
	}
	for (btScalar bad : {NOT_A_NUMBER, INFINITE, btScalar(-1), btScalar(0.6)})
	{
		btElasticPlasticMaterial material = btElasticPlasticMaterial::steel();
		material.m_poissonsRatio = bad;
		expectNames(Scene().refusalOf(btElasticPlasticCapacity::fromMember(material, section, 1, 1)), "Poisson's ratio",
					"is", "greater than -1");
	}
}

TEST(HardInput, Bodies)
{
	expectNames(Scene(0).refusalOf(good()), "bodies with mass", "is 0", "two static bodies");
	Scene scene;
	scene.m_b->setMassProps(1, btVector3(0, 0, 0));
	scene.m_b->updateInertiaTensor();
	expectNames(scene.refusalOf(good()), "inertia of body B", "is 0", "calculateLocalInertia");
	// Without rotation there is nothing wrong with a mass point.
	btElasticPlasticCapacity linear = good();
	for (int i = 3; i < BT_EP_DOF_COUNT; ++i)
		linear.clear(i);
	EXPECT_TRUE(scene.hinge()->setCapacity(linear));
}

TEST(HardInput, ARefusedJointCanBeMadeGood)
{
	Scene scene;
	btElasticPlastic6DofSpring2Constraint* constraint = scene.hinge();
	btElasticPlasticCapacity capacity = good();
	capacity.m_yield[0] = NOT_A_NUMBER;
	EXPECT_FALSE(constraint->setCapacity(capacity));
	EXPECT_TRUE(constraint->setCapacity(good()));
	EXPECT_TRUE(scene.m_world.action().addJoint(constraint));
	scene.m_world.step(btScalar(1) / 60);
	EXPECT_NE(0, constraint->getForce(BT_EP_SHEAR_Y));
}

TEST(HardInput, ANanBodyDoesNotTakeItsNeighboursAlong)
{
	World world(Solver::Iterative, btVector3(0, 0, 0));
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* bodies[4];
	for (int i = 0; i < 4; ++i)
	{
		bodies[i] = world.body(1, cube, at(i), false);
		if (i > 0)
			world.joint(*bodies[i - 1], *bodies[i], at(i - 0.5), good());
	}
	world.step(btScalar(1) / 60);
	btTransform broken = bodies[3]->getCenterOfMassTransform();
	broken.getOrigin().setX(NOT_A_NUMBER);
	bodies[3]->setCenterOfMassTransform(broken);
	run(world, 10);
	for (int i = 0; i < 3; ++i)
		EXPECT_TRUE(btElasticPlasticIsFinite(bodies[i]->getCenterOfMassPosition().length())) << i;
}

TEST(HardInput, AJointWithoutBookkeepingIsRefused)
{
	for (bool known : {false, true})
	{
		Scene scene;
		scene.m_world.bullet().removeAction(&scene.m_world.action());
		btElasticPlastic6DofSpring2Constraint* constraint = scene.hinge();
		EXPECT_TRUE(constraint->setCapacity(good()));
		if (known)
		{
			EXPECT_TRUE(scene.m_world.action().addJoint(constraint));
		}
		testing::internal::CaptureStderr();
		run(scene.m_world, 10);
		// The action that knows it has a listener; without one it is told on the standard error output, once.
		const std::string printed = testing::internal::GetCapturedStderr();
		const std::string& told = known ? scene.m_refusals.m_text : printed;
		expectNames(told, "number of", "is 0", known ? "addAction" : "addJoint");
		EXPECT_EQ(known ? 0 : 1, std::count(printed.begin(), printed.end(), '\n'));
		EXPECT_TRUE(bool(constraint->fault()));
		// Mended, it works.
		if (known)
			scene.m_world.bullet().addAction(&scene.m_world.action());
		EXPECT_TRUE(scene.m_world.action().addJoint(constraint));
		EXPECT_FALSE(constraint->fault());
		scene.m_world.bullet().removeAction(&scene.m_world.action());
	}
}

TEST(HardInput, IsPrintedWithoutAListener)
{
	World world;
	btRigidBody* body = world.body(1, world.box(btVector3(1, 1, 1)), btTransform::getIdentity(), false);
	auto* constraint = new btElasticPlastic6DofSpringConstraint(*body, btTransform::getIdentity());
	world.add(constraint);
	btElasticPlasticCapacity capacity = good();
	capacity.m_stiffness[BT_EP_AXIAL] = -1;
	constraint->setCapacity(capacity);
	testing::internal::CaptureStderr();
	EXPECT_FALSE(world.action().addJoint(constraint));
	EXPECT_NE(std::string::npos,
			  testing::internal::GetCapturedStderr().find("stiffness [N/m] of degree of freedom 0 (axial) is -1"));
}
}  // namespace
