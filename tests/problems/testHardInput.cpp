// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Bad input is refused with an error that names the joint, the value and the valid range; the world stays finite.

#include <math.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/DirectSolver.h"
#include "support/NotFinite.h"
#include "support/Pair.h"
#include "support/Precision.h"

namespace testHardInput
{
using namespace ep;

const btScalar NOT_A_NUMBER = notANumber(), INFINITE = infinite();

struct Refusals : btElasticPlasticListener
{
	std::string m_text;
	int m_count = 0;
	std::vector<btScalar> m_badSteps;

	void onRefused(btElasticPlasticJoint&, const char* text) override
	{
		m_text = text;
		++m_count;
	}
	void onBadStep(btScalar timeStep, const char*) override { m_badSteps.push_back(timeStep); }
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
	const struct
	{
		btScalar m_value;
		const char* m_text;
	} bads[] = {{NOT_A_NUMBER, "nan"}, {INFINITE, "inf"}, {-1, "-1"}};
	for (const auto& bad : bads)
	{
		btElasticPlasticCapacity capacity = good();
		capacity.m_yield[BT_EP_TORSION] = bad.m_value;
		expectNames(Scene().refusalOf(capacity), "yield moment", bad.m_text, "finite and not negative");
		capacity = good();
		capacity.m_ductility[BT_EP_AXIAL] = bad.m_value;
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
		expectNames(Scene().refusalOf(from(Section::tube(1, bad))), "section inner radius", "is", "greater than 0");
		expectNames(Scene().refusalOf(from(Section::hollowRectangle(1, 1, bad))), "section wall", "is",
					"greater than 0");
		expectNames(Scene().refusalOf(from(Section::iSection(1, 1, bad, btScalar(0.1)))), "section web", "is",
					"greater than 0");
		expectNames(Scene().refusalOf(from(Section::iSection(1, 1, btScalar(0.1), bad))), "section flange", "is",
					"greater than 0");
	}
	// Two wrongs do not make a right: the product of negative sides is positive.
	expectNames(Scene().refusalOf(from(Section::rectangle(-1, -1))), "section width", "-1", "greater than 0");
	// An inner radius in place of a wall.
	for (btScalar wall : {btScalar(2), btScalar(0.925)})
		expectNames(Scene().refusalOf(from(Section::hollowCircle(1, wall))), "section wall", "is",
					"at most half of the radius; with an inner radius use tube()");
	EXPECT_FALSE(from(Section::hollowCircle(1, btScalar(0.5))).fault());
	expectNames(Scene().refusalOf(from(Section::tube(1, 2))), "section inner radius", "is 2", "less than the outer");
	expectNames(Scene().refusalOf(from(Section::hollowRectangle(1, 2, btScalar(0.5)))), "section wall", "0.5",
				"less than half");
	expectNames(Scene().refusalOf(from(Section())), "section area", "is 0", "greater than 0");
	// What is made by hand.
	for (btScalar bad : {NOT_A_NUMBER, INFINITE, btScalar(-1), btScalar(0)})
	{
		Section section = Section::rectangle(1, 1).withFibres(16);
		section.m_outerFibre[1] = bad;
		expectNames(Scene().refusalOf(from(section)), "outer fibre from the axis along z", "is", "greater than 0");
		section = Section::rectangle(1, 1).withFibres(16);
		section.m_fibres[3].m_area = bad;
		expectNames(Scene().refusalOf(from(section)), "area of a fibre", "is", "greater than 0");
	}
	Section nowhere = Section::rectangle(1, 1).withFibres(16);
	nowhere.m_fibres[3].m_z = NOT_A_NUMBER;
	expectNames(Scene().refusalOf(from(nowhere)), "place of a fibre of the section", "nan", "finite");
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

TEST(HardInput, StepsThatAreNone)
{
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (btScalar bad : {btScalar(-1), NOT_A_NUMBER})
		{
			Refusals refusals;
			Pair pair(solver, 0, 12, btVector3(0, -10, 0));
			pair.m_world.action().setListener(&refusals);
			btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 1e5));
			run(pair.m_world, 5);
			const btElasticPlasticState before = joint->getState();
			const double time = pair.m_world.action().getTime();
			pair.m_world.bullet().stepSimulation(bad, 0);
			pair.m_world.bullet().stepSimulation(bad, 0);
			// Bullet may have moved the body, but the joint did nothing.
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			{
				EXPECT_EQ(before.m_force[i], joint->getForce(i));
				EXPECT_EQ(before.m_plastic[i], joint->getPlasticDeformation(i));
			}
			EXPECT_EQ(before.m_work, joint->getWork());
			EXPECT_EQ(time, pair.m_world.action().getTime());
			ASSERT_EQ(1u, refusals.m_badSteps.size());
			const bool isNumber = btElasticPlasticIsNumber(bad);
			EXPECT_EQ(isNumber, btElasticPlasticIsNumber(refusals.m_badSteps[0]));
			EXPECT_TRUE(!isNumber || refusals.m_badSteps[0] == bad);
			EXPECT_EQ(isNumber, isFinite(*pair.m_b)) << int(solver);
		}
}

TEST(HardInput, SolverSettings)
{
	btElasticPlasticConstraintSolver solver;
	EXPECT_TRUE(solver.setNumThreads(2));
	const auto expectRefused = [&](const char* quantity, const std::function<bool()>& set)
	{
		testing::internal::CaptureStderr();
		EXPECT_FALSE(set()) << quantity;
		const std::string text = testing::internal::GetCapturedStderr();
		EXPECT_NE(std::string::npos, text.find(quantity)) << text;
		const btElasticPlasticSolverSettings& s = solver.getSettings();
		const btElasticPlasticSolverSettings standard;
		EXPECT_EQ(2, s.m_numThreads);
		EXPECT_EQ(standard.m_form, s.m_form);
		EXPECT_EQ(standard.m_maxNewtonSteps, s.m_maxNewtonSteps);
		EXPECT_EQ(standard.m_maxContactLoops, s.m_maxContactLoops);
		EXPECT_EQ(standard.m_contactTolerance, s.m_contactTolerance);
		EXPECT_EQ(standard.m_maxIterations, s.m_maxIterations);
		EXPECT_EQ(standard.m_iterationTolerance, s.m_iterationTolerance);
		EXPECT_EQ(standard.m_maxVectorWidth, s.m_maxVectorWidth);
	};
	for (int threads : {100000, 65, 0, -1})
		expectRefused("threads", [&] { return solver.setNumThreads(threads); });
	const auto with = [&](const std::function<void(btElasticPlasticSolverSettings&)>& change)
	{
		return [&solver, change]
		{
			btElasticPlasticSolverSettings settings = solver.getSettings();
			change(settings);
			return solver.setSettings(settings);
		};
	};
	typedef btElasticPlasticSolverSettings& Settings;
	expectRefused("Newton", with([](Settings s) { s.m_maxNewtonSteps = -1; }));
	expectRefused("rounds", with([](Settings s) { s.m_maxContactLoops = -1; }));
	expectRefused("iterations", with([](Settings s) { s.m_maxIterations = -1; }));
	expectRefused("width", with([](Settings s) { s.m_maxVectorWidth = 3; }));
	for (double bad : {double(NOT_A_NUMBER), double(INFINITE), 0., -1.})
	{
		expectRefused("tolerance", with([bad](Settings s) { s.m_contactTolerance = bad; }));
		expectRefused("tolerance", with([bad](Settings s) { s.m_iterationTolerance = bad; }));
	}
	expectRefused("form", with([](Settings s) { s.m_form = btElasticPlasticForm(7); }));
}

TEST(HardInput, DegreesOfFreedomThatAreNone)
{
	for (int dof : {-1, 6, 7, 1000})
		for (int way = 0; way < 3; ++way)
		{
			btElasticPlasticCapacity capacity = good();
			if (way == 0)
				capacity.set(dof, 1, 2, 3);
			else if (way == 1)
				capacity.setRigidPlastic(dof, 2);
			else
				capacity.clear(dof);
			// Nothing beside the arrays was written.
			const btElasticPlasticCapacity before = good();
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			{
				EXPECT_EQ(before.m_stiffness[i], capacity.m_stiffness[i]);
				EXPECT_EQ(before.m_yield[i], capacity.m_yield[i]);
				EXPECT_EQ(before.m_ductility[i], capacity.m_ductility[i]);
			}
			EXPECT_EQ(0u, capacity.m_rigidPlastic);
			expectNames(Scene().refusalOf(capacity), "degree of freedom", std::to_string(dof).c_str(), "0 to 5");
		}
	Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
	const btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 100));
	run(pair.m_world, 10);
	ASSERT_TRUE(joint->hasYielded());
	for (int dof : {-1, 6, 1000})
	{
		EXPECT_EQ(0, joint->getForce(dof));
		EXPECT_EQ(0, joint->getAppliedForce(dof));
		EXPECT_EQ(0, joint->getElasticDeformation(dof));
		EXPECT_EQ(0, joint->getPlasticDeformation(dof));
		EXPECT_EQ(0, joint->getPlasticPath(dof));
		EXPECT_EQ(0, joint->getUtilisation(dof));
		EXPECT_EQ(0, joint->getDamage(dof));
		EXPECT_FALSE(joint->getCapacity().isElasticPlastic(dof));
		EXPECT_FALSE(joint->getCapacity().isRigidPlastic(dof));
	}
}

TEST(HardInput, StiffnessTooSmallToDivideBy)
{
	// Denormal, and the least that the compliance of a step of 1 ms is still a number of.
	for (btScalar value : {std::numeric_limits<btScalar>::denorm_min() * 1000, btScalar(1e-21)})
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			btElasticPlasticCapacity capacity = good();
			capacity.m_stiffness[dof] = value;
			expectNames(Scene().refusalOf(capacity), "stiffness", btElasticPlasticDofName(dof), "1e-20");
		}
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
	{
		Pair pair(solver, 0, 12, btVector3(0, -10, 0));
		pair.join(evenCapacity(double(btElasticPlasticCapacity::leastStiffness()), 1e5));
		run(pair.m_world, 10);
		EXPECT_NEAR(-10. / 6, pair.m_b->getLinearVelocity().y(), 1e-5);
	}
}

TEST(HardInput, StiffnessesThatAreCoupled)
{
	// Their force is read from the inverse of their compliance, whose determinant has to be a number: in float it was none at 2e-20 N/m, and 0
	// at 1e23, where forces that are no numbers were told.
	for (int exponents = 0; exponents < 2 * 46; ++exponents)
	{
		const double shear = 2 * pow(10., exponents % 46 - 20), bending = exponents < 46 ? shear : 1;
		SCOPED_TRACE(shear);
		Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
		btElasticPlasticCapacity capacity = evenCapacity(shear, 1e5);
		for (int dof : {BT_EP_BENDING_Y, BT_EP_BENDING_Z})
			capacity.m_stiffness[dof] = btScalar(bending);
		capacity.m_coupling[0] = capacity.m_coupling[1] = btScalar(0.7);
		if (capacity.fault())
		{
			EXPECT_TRUE(shear < 1e-17 || shear > 1e17);
			expectNames(Scene().refusalOf(capacity), "stiffness", "coupled", "1e-18 to 1e18");
			continue;
		}
		const btElasticPlasticJoint* joint = pair.join(capacity);
		run(pair.m_world, 10);
		EXPECT_TRUE(btElasticPlasticIsFinite(joint->getElasticEnergy()));
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			EXPECT_TRUE(btElasticPlasticIsFinite(double(joint->getForce(dof))));
			EXPECT_EQ(0, joint->getPlasticPath(dof));
		}
	}
}

TEST(HardInput, FramesThatAreNoFrames)
{
	const btScalar inf = INFINITE, nan = NOT_A_NUMBER;
	const btMatrix3x3 one = btMatrix3x3::getIdentity();
	const struct
	{
		btMatrix3x3 m_basis;
		btVector3 m_origin;
		const char* m_what;
	} cases[] = {{one, btVector3(nan, 0, 0), "origin"},
				 {one, btVector3(0, inf, 0), "origin"},
				 {btMatrix3x3(nan, 0, 0, 0, 1, 0, 0, 0, 1), btVector3(0, 0, 0), "right angles"},
				 {btMatrix3x3(1, btScalar(0.5), 0, 0, 1, 0, 0, 0, 1), btVector3(0, 0, 0), "right angles"},  // sheared
				 {btMatrix3x3(-1, 0, 0, 0, 1, 0, 0, 0, 1), btVector3(0, 0, 0), "right-handed"},             // mirrored
				 {btMatrix3x3(2, 0, 0, 0, 2, 0, 0, 0, 2), btVector3(0, 0, 0), "unit length"},               // scaled
				 {btMatrix3x3(0, 0, 0, 0, 0, 0, 0, 0, 0), btVector3(0, 0, 0), "unit length"}};
	for (const auto& c : cases)
		for (bool isInA : {true, false})
		{
			Scene scene;
			const btTransform frame(c.m_basis, c.m_origin);
			auto* constraint = new btElasticPlastic6DofSpring2Constraint(*scene.m_a, *scene.m_b, isInA ? frame : at(0),
																		 isInA ? at(-1) : frame);
			scene.m_world.add(constraint);
			constraint->setName("gate hinge");
			EXPECT_FALSE(constraint->setCapacity(good()));
			EXPECT_FALSE(scene.m_world.action().addJoint(constraint));
			expectNames(scene.m_refusals.m_text, isInA ? "frame in body A" : "frame in body B", "is", c.m_what);
			run(scene.m_world, 10);
			EXPECT_NEAR(-10. / 6, scene.m_b->getLinearVelocity().y(), 1e-5);
		}
}

TEST(HardInput, InertiaThatIsLostOnTheWay)
{
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
	{
		Refusals refusals;
		Pair pair(solver, 0, 12, btVector3(0, -10, 0));
		pair.m_world.action().setListener(&refusals);
		btElasticPlasticCapacity rigid;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			rigid.setRigidPlastic(i, btScalar(1e5));
		btElasticPlasticJoint* joint = pair.join(rigid);
		run(pair.m_world, 5);
		pair.m_b->setMassProps(12, btVector3(0, 0, 0));
		pair.m_b->updateInertiaTensor();
		run(pair.m_world, 10);
		EXPECT_EQ(1, refusals.m_count) << refusals.m_text;
		EXPECT_NE(std::string::npos, refusals.m_text.find("inertia of body B")) << refusals.m_text;
		EXPECT_TRUE(isFinite(*pair.m_b));
		EXPECT_EQ(0, joint->getNumCommittedRows());
		btVector3 inertia;
		pair.m_b->getCollisionShape()->calculateLocalInertia(12, inertia);
		pair.m_b->setMassProps(12, inertia);
		pair.m_b->updateInertiaTensor();
		run(pair.m_world, 1);
		EXPECT_EQ(6, joint->getNumCommittedRows());
	}
}

TEST(HardInput, StatesThatCannotBe)
{
	typedef btElasticPlasticState& State;
	const std::function<void(State, btScalar)> anyNumber[] = {
		[](State s, btScalar x) { s.m_force[2] = x; },
		[](State s, btScalar x) { s.m_forceRate[5] = x; },
		[](State s, btScalar x) { s.m_appliedBefore[5] = x; },
		[](State s, btScalar x) { s.m_applied[0] = x; },
		[](State s, btScalar x) { s.m_branch[1][4] = x; },
		[](State s, btScalar x) { s.m_plastic[4] = x; },
		[](State s, btScalar x) { s.m_plasticPath[3] = x; },
		[](State s, btScalar x) { s.m_initial[1] = x; },
		[](State s, btScalar x) { s.m_lastStep = x; },
		[](State s, btScalar x) { s.m_work = double(x); },
		[](State s, btScalar x) { s.m_plasticEnergy = double(x); },
		[](State s, btScalar x) { s.m_dampingEnergy = double(x); },
		[](State s, btScalar x) { s.m_storedEnergy = double(x); },
		[](State s, btScalar x) { s.m_placeEnergy = double(x); },
		[](State s, btScalar x) { s.m_plasticRotation.setX(x); },
		[](State s, btScalar x) { s.m_plasticMiddle.setW(x); },
	};
	std::vector<std::function<void(State)>> changes;
	for (const auto& set : anyNumber)
		for (btScalar x : {NOT_A_NUMBER, INFINITE, -INFINITE})
			changes.push_back([&set, x](State s) { set(s, x); });
	changes.push_back([](State s) { s.m_force[1] = btScalar(1e12); });
	changes.push_back([](State s) { s.m_force[1] = -6401; });
	changes.push_back([](State s) { s.m_plasticPath[0] = -1; });
	changes.push_back([](State s) { s.m_plasticEnergy = -1; });
	changes.push_back([](State s) { s.m_lastStep = -1; });
	changes.push_back([](State s) { s.m_plasticRotation = btQuaternion(0, 0, 0, 2); });
	changes.push_back([](State s) { s.m_plasticMiddle = btQuaternion(0, 0, 0, 0); });

	Refusals refusals;
	Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
	pair.m_world.action().setListener(&refusals);
	btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 100));
	run(pair.m_world, 10);
	ASSERT_TRUE(joint->hasYielded());
	const btElasticPlasticState before = joint->getState();
	for (size_t c = 0; c < changes.size(); ++c)
	{
		btElasticPlasticState state = before;
		changes[c](state);
		EXPECT_FALSE(joint->setState(state)) << c;
		const btElasticPlasticState& after = joint->getState();
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		{
			EXPECT_EQ(before.m_force[i], after.m_force[i]);
			EXPECT_EQ(before.m_forceRate[i], after.m_forceRate[i]);
			EXPECT_EQ(before.m_applied[i], after.m_applied[i]);
			EXPECT_EQ(before.m_plastic[i], after.m_plastic[i]);
			EXPECT_EQ(before.m_plasticPath[i], after.m_plasticPath[i]);
		}
		for (int i = 0; i < 3; ++i)
			EXPECT_EQ(before.m_initial[i], after.m_initial[i]);
		EXPECT_EQ(before.m_lastStep, after.m_lastStep);
		EXPECT_EQ(before.m_work, after.m_work);
		EXPECT_EQ(before.m_plasticEnergy, after.m_plasticEnergy);
		EXPECT_TRUE(before.m_plasticRotation == after.m_plasticRotation);
		EXPECT_TRUE(before.m_plasticMiddle == after.m_plasticMiddle);
	}
	EXPECT_TRUE(joint->setState(before));
	EXPECT_EQ(int(changes.size()), refusals.m_count);
}

TEST(HardInput, ACapacityIsTakenOnceWhatItWasRefusedForIsMended)
{
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (const bool hadAnother : {false, true})
		{
			Refusals refusals;
			Pair pair(solver, 0, 12, btVector3(0, -10, 0));
			pair.m_world.action().setListener(&refusals);
			btElasticPlasticCapacity axialOnly;
			axialOnly.set(BT_EP_AXIAL, btScalar(1e6), btScalar(1e4));
			btElasticPlasticJoint* joint = pair.join(hadAnother ? axialOnly : btElasticPlasticCapacity());
			pair.m_world.bullet().removeRigidBody(pair.m_b);
			pair.m_b->setMassProps(0, btVector3(0, 0, 0));
			pair.m_world.bullet().addRigidBody(pair.m_b);
			EXPECT_FALSE(joint->setCapacity(evenCapacity(1e6, 1e4)));
			EXPECT_EQ(1, refusals.m_count);
			btVector3 inertia;
			pair.m_b->getCollisionShape()->calculateLocalInertia(12, inertia);
			pair.m_world.bullet().removeRigidBody(pair.m_b);
			pair.m_b->setMassProps(12, inertia);
			pair.m_b->updateInertiaTensor();
			pair.m_world.bullet().addRigidBody(pair.m_b);
			ASSERT_TRUE(pair.m_world.action().addJoint(joint));
			run(pair.m_world, 60);
			EXPECT_EQ(6, joint->getNumCommittedRows());
			EXPECT_NEAR(0, double(pair.m_b->getCenterOfMassPosition().y()), 1e-3) << "it falls";
		}
}

/// A support and six cubes in a row; the last one is spoilt.
struct SpoiltChain
{
	Refusals m_refusals;
	World m_world;
	std::vector<btRigidBody*> m_bodies;
	std::vector<btElasticPlasticJoint*> m_joints;

	/// \param leavesOne  one degree of freedom of each joint is left to Bullet's class, which locks it
	SpoiltChain(Solver solver, bool leavesOne) : m_world(solver)
	{
		m_world.action().setListener(&m_refusals);
		btElasticPlasticCapacity capacity = good();
		if (leavesOne)
			capacity.clear(BT_EP_SHEAR_Z);
		btCollisionShape* cube = m_world.box(btVector3(1, 1, 1));
		for (int i = 0; i < 7; ++i)
		{
			m_bodies.push_back(m_world.body(i == 0 ? 0 : 100, cube, at(btScalar(i)), false));
			if (i > 0)
				m_joints.push_back(
					m_world.joint(*m_bodies[i - 1], *m_bodies[i], at(btScalar(i) - btScalar(0.5)), capacity));
		}
		run(m_world, 5);
	}
};

TEST(HardInput, ASpoiltBodyHarmsNobody)
{
	typedef std::function<void(btRigidBody&)> Spoil;
	const Spoil spoils[] = {
		[](btRigidBody& b) { b.getWorldTransform().setBasis(btMatrix3x3(NOT_A_NUMBER, 0, 0, 0, 1, 0, 0, 0, 1)); },
		[](btRigidBody& b) { b.getWorldTransform().setRotation(btQuaternion(NOT_A_NUMBER, 0, 0, 1)); },
		[](btRigidBody& b) { b.getWorldTransform().setRotation(btQuaternion(0, 0, 0, 0)); },
		[](btRigidBody& b) { b.setLinearVelocity(btVector3(NOT_A_NUMBER, 0, 0)); },
		[](btRigidBody& b) { b.setAngularVelocity(btVector3(0, INFINITE, 0)); },
		[](btRigidBody& b) { b.applyCentralForce(btVector3(0, NOT_A_NUMBER, 0)); },
		[](btRigidBody& b) { b.applyTorque(btVector3(0, 0, INFINITE)); },
		[](btRigidBody& b) { b.getWorldTransform().setOrigin(btVector3(0, 0, NOT_A_NUMBER)); },
	};
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (bool leavesOne : {false, true})
			for (int spoilt : {6, 3})
				for (size_t s = 0; s < sizeof spoils / sizeof *spoils; ++s)
				{
					const testing::Message which = testing::Message()
												   << "solver " << int(solver) << ", leaves one " << leavesOne
												   << ", body " << spoilt << ", way " << s;
					// The twin's body has lost its joints by a refused capacity, so that all constraints keep their order.
					SpoiltChain chain(solver, leavesOne), twin(solver, leavesOne);
					spoils[s](*chain.m_bodies[spoilt]);
					for (int j : {spoilt - 1, spoilt})
						if (j < 6)
						{
							btElasticPlasticCapacity refused;
							refused.set(0, -1, 1);
							EXPECT_FALSE(twin.m_joints[j]->setCapacity(refused));
						}
					for (int step = 0; step < 10; ++step)
					{
						run(chain.m_world, 1);
						run(twin.m_world, 1);
						for (int i = 0; i < 7; ++i)
						{
							if (i == spoilt)
								continue;
							EXPECT_TRUE(isFinite(*chain.m_bodies[i])) << which << ", neighbour " << i;
							EXPECT_TRUE(chain.m_bodies[i]->getCenterOfMassPosition() ==
										twin.m_bodies[i]->getCenterOfMassPosition())
								<< which << ", neighbour " << i;
							EXPECT_TRUE(chain.m_bodies[i]->getLinearVelocity() == twin.m_bodies[i]->getLinearVelocity())
								<< which << ", neighbour " << i;
						}
						if (testing::Test::HasFailure())
							break;
					}
					// Each of its joints was told of once.
					EXPECT_EQ(spoilt == 6 ? 1 : 2, chain.m_refusals.m_count) << which << chain.m_refusals.m_text;
				}
}

TEST(HardInput, AKinematicBodyMayHaveAMass)
{
	double shear[2];
	for (int i = 0; i < 2; ++i)
	{
		World world(Solver::Direct);
		btCollisionShape* cube = world.box(btVector3(1, 1, 1));
		btRigidBody *a = world.body(btScalar(100 * i), cube, at(0), false),
					*b = world.body(100, cube, at(btScalar(1.5)), false);
		world.bullet().removeRigidBody(a);
		a->setCollisionFlags((a->getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT) |
							 btCollisionObject::CF_KINEMATIC_OBJECT);
		world.bullet().addRigidBody(a, 0, 0);
		btElasticPlasticCapacity undamped = good();
		undamped.m_damping = 0;
		btElasticPlasticJoint* joint = world.joint(*a, *b, at(btScalar(0.75)), undamped);
		run(world, 120);
		EXPECT_EQ(0, a->getCenterOfMassPosition().length());
		EXPECT_NEAR(0, b->getCenterOfMassPosition().y(), 0.01);
		shear[i] = double(joint->getForce(BT_EP_SHEAR_Y));
	}
	// The weight, to the share that has not come to rest after 2 s; and both the same to rounding.
	EXPECT_NEAR(1000, fabs(shear[0]), 10);
	EXPECT_NEAR(shear[0], shear[1], 1000 * byPrecision(1e-9, 1e-4));
}
}  // namespace testHardInput
