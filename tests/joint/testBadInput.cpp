// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Bad input is refused with an error that names the joint, the value and the valid range; the world stays finite.

#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "world/World.h"

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

/// A body and a support, to be joined badly.
struct Scene
{
	World m_world;
	Refusals m_refusals;
	btRigidBody* m_support;
	btRigidBody* m_body;

	explicit Scene(btScalar mass = 1)
	{
		m_world.action().setListener(&m_refusals);
		m_support = m_world.body(0, m_world.box(btVector3(1, 1, 1)), btTransform::getIdentity(), false);
		m_body = m_world.body(mass, m_world.box(btVector3(1, 1, 1)),
							  btTransform(btQuaternion(0, 0, 0, 1), btVector3(1, 0, 0)), false);
	}

	/// \return the refusal; the world is stepped after it
	std::string join(const btElasticPlasticCapacity& capacity, btRigidBody* other = nullptr)
	{
		auto* constraint =
			new btElasticPlastic6DofSpring2Constraint(other ? *other : *m_support, *m_body, btTransform::getIdentity(),
													  btTransform(btQuaternion(0, 0, 0, 1), btVector3(-1, 0, 0)));
		m_world.add(constraint);
		constraint->setName("gate hinge");
		EXPECT_FALSE(constraint->setCapacity(capacity));
		EXPECT_FALSE(m_world.action().addJoint(constraint));
		EXPECT_TRUE(bool(constraint->fault()));
		EXPECT_EQ(0, m_world.action().getNumJoints());
		for (int i = 0; i < 10; ++i)
			m_world.step(btScalar(1) / 60);
		// It is out of the simulation: the body falls freely, and everything is a number.
		EXPECT_NEAR(m_body->getInvMass() > 0 ? -10. / 6 : 0, m_body->getLinearVelocity().y(), 1e-5);
		EXPECT_TRUE(btElasticPlasticIsFinite(m_body->getCenterOfMassPosition().length()));
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

TEST(BadInput, Stiffness)
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
			const std::string text = Scene().join(capacity);
			expectNames(text, "stiffness", c.m_printed, "finite");
			EXPECT_NE(std::string::npos, text.find(btElasticPlasticDofName(dof))) << text;
		}
	btElasticPlasticCapacity capacity = good();
	capacity.m_stiffness[BT_EP_SHEAR_Z] = 0;
	expectNames(Scene().join(capacity), "stiffness", "is 0", "greater than 0 where there is a yield value");
}

TEST(BadInput, YieldAndDuctility)
{
	for (btScalar value : {NOT_A_NUMBER, INFINITE, btScalar(-1)})
	{
		btElasticPlasticCapacity capacity = good();
		capacity.m_yield[BT_EP_TORSION] = value;
		expectNames(Scene().join(capacity), "yield moment",
					value < 0   ? "-1"
					: value > 0 ? "inf"
								: "nan",
					"finite and not negative");
		capacity = good();
		capacity.m_ductility[BT_EP_AXIAL] = value;
		expectNames(Scene().join(capacity), "ductility", "is", "finite and greater than 0");
	}
	btElasticPlasticCapacity capacity = good();
	capacity.m_ductility[BT_EP_AXIAL] = 0;
	expectNames(Scene().join(capacity), "ductility", "is 0", "greater than 0");
	capacity = good();
	capacity.scaleYield(NOT_A_NUMBER);
	expectNames(Scene().join(capacity), "yield", "nan", "finite");
}

TEST(BadInput, SectionsAndLengths)
{
	typedef btElasticPlasticSection Section;
	const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel();
	const auto from = [&](const Section& section)
	{ return btElasticPlasticCapacity::fromMember(steel, section, 1, 1); };
	for (btScalar bad : {NOT_A_NUMBER, INFINITE, btScalar(-1), btScalar(0)})
	{
		expectNames(Scene().join(from(Section::rectangle(bad, 1))), "section width", "is", "finite and greater than 0");
		expectNames(Scene().join(from(Section::rectangle(1, bad))), "section height", "is",
					"finite and greater than 0");
		expectNames(Scene().join(from(Section::circle(bad))), "section radius", "is", "finite and greater than 0");
		expectNames(Scene().join(from(Section::hollowCircle(1, bad))), "section wall", "is", "greater than 0");
		expectNames(Scene().join(from(Section::hollowRectangle(1, 1, bad))), "section wall", "is", "greater than 0");
		expectNames(Scene().join(from(Section::iSection(1, 1, bad, btScalar(0.1)))), "section web", "is",
					"greater than 0");
		expectNames(Scene().join(from(Section::iSection(1, 1, btScalar(0.1), bad))), "section flange", "is",
					"greater than 0");
	}
	// Two wrongs do not make a right: the product of negative sides is positive.
	expectNames(Scene().join(from(Section::rectangle(-1, -1))), "section width", "-1", "greater than 0");
	expectNames(Scene().join(from(Section::hollowCircle(1, 2))), "section wall", "is 2", "less than the radius");
	expectNames(Scene().join(from(Section::hollowRectangle(1, 2, btScalar(0.5)))), "section wall", "0.5",
				"less than half");
	expectNames(Scene().join(from(Section())), "section area", "is 0", "greater than 0");
	for (btScalar bad : {NOT_A_NUMBER, INFINITE, btScalar(-1)})
	{
		expectNames(Scene().join(btElasticPlasticCapacity::fromMember(steel, Section::circle(1), bad, 1)),
					"length of the first part", "is", "finite");
		expectNames(Scene().join(btElasticPlasticCapacity::fromMember(steel, Section::circle(1), 1, bad)),
					"length of the second part", "is", "finite");
		expectNames(Scene().join(btElasticPlasticCapacity::fromMember(steel, Section::circle(1), 1, 1, bad)),
					"gauge length", "is", "finite");
	}
	expectNames(Scene().join(btElasticPlasticCapacity::fromMember(steel, Section::circle(1), 0, 0)),
				"sum of the parts' lengths", "is 0", "greater than 0");
}

TEST(BadInput, Materials)
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
			expectNames(Scene().join(btElasticPlasticCapacity::fromMember(material, section, 1, 1)), field.m_name, "is",
						"greater than 0");
		}
	}
	for (btScalar bad : {NOT_A_NUMBER, INFINITE, btScalar(-1), btScalar(0.6)})
	{
		btElasticPlasticMaterial material = btElasticPlasticMaterial::steel();
		material.m_poissonsRatio = bad;
		expectNames(Scene().join(btElasticPlasticCapacity::fromMember(material, section, 1, 1)), "Poisson's ratio",
					"is", "greater than -1");
	}
}

TEST(BadInput, Bodies)
{
	expectNames(Scene(0).join(good()), "bodies with mass", "is 0", "two static bodies");
	Scene scene;
	scene.m_body->setMassProps(1, btVector3(0, 0, 0));
	scene.m_body->updateInertiaTensor();
	expectNames(scene.join(good()), "inertia of body B", "is 0", "calculateLocalInertia");
	// Without rotation there is nothing wrong with a mass point.
	btElasticPlasticCapacity linear = good();
	for (int i = 3; i < BT_EP_DOF_COUNT; ++i)
		linear.clear(i);
	auto* constraint = new btElasticPlastic6DofSpring2Constraint(
		*scene.m_support, *scene.m_body, btTransform::getIdentity(), btTransform::getIdentity());
	scene.m_world.add(constraint);
	EXPECT_TRUE(constraint->setCapacity(linear));
}

TEST(BadInput, ARefusedJointCanBeMadeGood)
{
	Scene scene;
	auto* constraint =
		new btElasticPlastic6DofSpring2Constraint(*scene.m_support, *scene.m_body, btTransform::getIdentity(),
												  btTransform(btQuaternion(0, 0, 0, 1), btVector3(-1, 0, 0)));
	scene.m_world.add(constraint);
	btElasticPlasticCapacity capacity = good();
	capacity.m_yield[0] = NOT_A_NUMBER;
	EXPECT_FALSE(constraint->setCapacity(capacity));
	EXPECT_TRUE(constraint->setCapacity(good()));
	EXPECT_TRUE(scene.m_world.action().addJoint(constraint));
	scene.m_world.step(btScalar(1) / 60);
	EXPECT_NE(0, constraint->getForce(BT_EP_SHEAR_Y));
}

TEST(BadInput, ANanBodyDoesNotTakeItsNeighboursAlong)
{
	World world(Solver::Iterative, btVector3(0, 0, 0));
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* bodies[4];
	for (int i = 0; i < 4; ++i)
	{
		bodies[i] = world.body(1, cube, btTransform(btQuaternion(0, 0, 0, 1), btVector3(btScalar(i), 0, 0)), false);
		if (i > 0)
			world.joint(*bodies[i - 1], *bodies[i],
						btTransform(btQuaternion(0, 0, 0, 1), btVector3(btScalar(i - 0.5), 0, 0)), good());
	}
	world.step(btScalar(1) / 60);
	btTransform broken = bodies[3]->getCenterOfMassTransform();
	broken.getOrigin().setX(NOT_A_NUMBER);
	bodies[3]->setCenterOfMassTransform(broken);
	for (int i = 0; i < 10; ++i)
		world.step(btScalar(1) / 60);
	for (int i = 0; i < 3; ++i)
		EXPECT_TRUE(btElasticPlasticIsFinite(bodies[i]->getCenterOfMassPosition().length())) << i;
}

TEST(BadInput, AJointWithoutBookkeepingIsRefused)
{
	for (bool known : {false, true})
	{
		Scene scene;
		scene.m_world.bullet().removeAction(&scene.m_world.action());
		auto* constraint =
			new btElasticPlastic6DofSpring2Constraint(*scene.m_support, *scene.m_body, btTransform::getIdentity(),
													  btTransform(btQuaternion(0, 0, 0, 1), btVector3(-1, 0, 0)));
		scene.m_world.add(constraint);
		constraint->setName("gate hinge");
		EXPECT_TRUE(constraint->setCapacity(good()));
		if (known)
		{
			EXPECT_TRUE(scene.m_world.action().addJoint(constraint));
		}
		testing::internal::CaptureStderr();
		for (int i = 0; i < 10; ++i)
			scene.m_world.step(btScalar(1) / 60);
		expectNames(testing::internal::GetCapturedStderr(), "number of", "is 0", known ? "addAction" : "addJoint");
		EXPECT_TRUE(bool(constraint->fault()));
		// Mended, it works.
		if (known)
			scene.m_world.bullet().addAction(&scene.m_world.action());
		EXPECT_TRUE(scene.m_world.action().addJoint(constraint));
		EXPECT_FALSE(constraint->fault());
		scene.m_world.bullet().removeAction(&scene.m_world.action());
	}
}

TEST(BadInput, IsPrintedWithoutAListener)
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
