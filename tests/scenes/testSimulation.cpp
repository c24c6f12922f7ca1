// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What is built from a scene file: bodies, joints and generators against exact answers.

#include <algorithm>
#include <cmath>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticMaterials.h"
#include "scenes/Scenes.h"
#include "simulation/Course.h"
#include "simulation/Probes.h"
#include "support/Precision.h"

namespace testSimulation
{
using namespace ep;

/// Rounding of coordinates of some metres, in a sum of some terms.
const double ROUNDING = byPrecision(1e-12, 1e-5);

const btRigidBody& builtBody(Simulation& s, size_t index = 0) { return *s.body(int(index)); }

double inertiaAbout(const btRigidBody& body, const btVector3& axis)
{
	const btVector3 world = body.getInvInertiaTensorWorld().inverse() * axis;
	return double(world.dot(axis));
}

void run(Simulation& s)
{
	while (s.ending() == Ending::None)
		s.step();
}

double probe(Simulation& s, size_t index = 0) { return readProbe(s, s.scene().probes[index]); }

// ---- bodies

TEST(SceneBodies, HaveTheMassAndInertiaOfTheirForm)
{
	// Radius 1, length 2, density 3: textbook formulas for solid bodies.
	Simulation s(sceneOf(R"("bodies": [
		{"name": "box", "box": [1, 2, 3], "density": 3},
		{"name": "sphere", "sphere": 1, "density": 3, "at": [10, 0, 0]},
		{"name": "cylinder", "cylinder": [1, 2], "density": 3, "at": [20, 0, 0]}])"));
	EXPECT_NEAR(1 / double(builtBody(s, 0).getInvMass()), 18, 18 * ROUNDING);
	EXPECT_NEAR(inertiaAbout(builtBody(s, 0), btVector3(1, 0, 0)), 18. / 12 * (4 + 9), 30 * ROUNDING);
	const double sphere = 4 * M_PI;
	EXPECT_NEAR(1 / double(builtBody(s, 1).getInvMass()), sphere, sphere * ROUNDING);
	EXPECT_NEAR(inertiaAbout(builtBody(s, 1), btVector3(0, 1, 0)), .4 * sphere, sphere * ROUNDING);
	const double cylinder = 6 * M_PI;
	EXPECT_NEAR(inertiaAbout(builtBody(s, 2), btVector3(0, 1, 0)), cylinder / 2, cylinder * ROUNDING);
	EXPECT_NEAR(inertiaAbout(builtBody(s, 2), btVector3(1, 0, 0)), cylinder * (1. / 4 + 4. / 12), cylinder * ROUNDING);
}

TEST(SceneBodies, HullsAndCompoundsOfABoxAreTheBox)
{
	// The same box of 2 x 1 x 1 beside its file's origin: by its corners, and by two halves.
	Simulation s(sceneOf(R"("bodies": [
		{"name": "hull", "density": 1, "hull": [1,0,0, 3,0,0, 1,1,0, 3,1,0, 1,0,1, 3,0,1, 1,1,1, 3,1,1]},
		{"name": "compound", "density": 1, "at": [20, 0, 0], "compound": [
			{"box": [1, 1, 1], "at": [1.5, 0.5, 0.5]}, {"box": [1, 1, 1], "at": [2.5, 0.5, 0.5], "turn": [1, 0, 0, 90]}]}])"));
	for (size_t i = 0; i < 2; ++i)
	{
		SCOPED_TRACE(i);
		const btRigidBody& body = builtBody(s, i);
		const btVector3 centre = body.getCenterOfMassPosition() - s.scene().bodies[i].pose.getOrigin();
		EXPECT_NEAR(double((centre - btVector3(2, btScalar(.5), btScalar(.5))).length()), 0, 10 * ROUNDING);
		EXPECT_NEAR(1 / double(body.getInvMass()), 2, 10 * ROUNDING);
		EXPECT_NEAR(inertiaAbout(body, btVector3(1, 0, 0)), 2. / 12 * 2, 10 * ROUNDING);
		EXPECT_NEAR(inertiaAbout(body, btVector3(0, 1, 0)), 2. / 12 * 5, 10 * ROUNDING);
		EXPECT_NEAR(inertiaAbout(body, btVector3(0, 0, 1)), 2. / 12 * 5, 10 * ROUNDING);
		// The pose that is read is the file's, wherever the centre of mass is.
		EXPECT_NEAR(double((s.poseOf(int(i)).getOrigin() - s.scene().bodies[i].pose.getOrigin()).length()), 0,
					10 * ROUNDING);
	}
}

TEST(SceneBodies, AreNoLargerThanTheirHullsPoints)
{
	// A small one lies on the ground: Bullet's own margin would hold it 4 cm above.
	Simulation s(
		sceneOf(R"("world": {"ground": true}, "end": {"time": 1}, "bodies": [{"name": "hull", "at": [0, 0.06, 0],
		"hull": [-0.05,-0.05,-0.05, 0.05,-0.05,-0.05, -0.05,0.05,-0.05, 0.05,0.05,-0.05, -0.05,-0.05,0.05, 0.05,-0.05,0.05, -0.05,0.05,0.05, 0.05,0.05,0.05]}],
		"probes": [{"name": "y", "of": "hull", "measure": "position"}])"));
	run(s);
	EXPECT_NEAR(probe(s), .05, .01 * .1);
}

TEST(SceneBodies, WithoutVolumeOrInEachOtherAreRefused)
{
	expectParts(
		complaintOf([]
					{ Simulation(sceneOf(R"("bodies": [{"name": "flat", "hull": [0,0,0, 1,0,0, 0,1,0, 1,1,0]}])")); }),
		{"bodies.flat has no volume"});
	expectParts(
		complaintOf(
			[]
			{
				Simulation(sceneOf(
					R"("bodies": [{"name": "a", "box": [1, 1, 1]}, {"name": "b", "box": [1, 1, 1], "at": [0.5, 0, 0]}])"));
			}),
		{"m deep in", "move one, or join them"});
	// Touching is no overlap, and what is joined may be.
	Simulation(
		sceneOf(R"("bodies": [{"name": "a", "box": [1, 1, 1]}, {"name": "b", "box": [1, 1, 1], "at": [1, 0, 0]}])"));
	Simulation(
		sceneOf(R"("bodies": [{"name": "a", "box": [1, 1, 1]}, {"name": "b", "box": [1, 1, 1], "at": [0.5, 0, 0]}],
		"joints": [{"name": "j", "from": "a", "to": "b", "type": "fixed"}])"));
}

TEST(SceneBodies, MoveByLoadsAsNewtonSays)
{
	// 2 kg; the force grows to 6 N in 1 s, which gives 3/2 m/s, and a moment of 1 N m turns 1/3 kg m^2 to 3 rad/s.
	Simulation s(sceneOf(R"("world": {"gravity": [0, 0, 0], "step": 0.01}, "end": {"time": 1},
		"bodies": [{"name": "box", "box": [1, 1, 1], "mass": 2}],
		"loads": [{"on": "box", "force": [6, 0, 0], "over": [0, 0, 1, 1]}, {"on": "box", "moment": [0, 0, 1]}],
		"probes": [{"name": "v", "of": "box", "measure": "velocity", "axis": "x"}, {"name": "w", "of": "box", "measure": "spin", "axis": "z"}])"));
	run(s);
	// Loads are taken at the middle of each step: exact for what grows evenly.
	EXPECT_NEAR(probe(s, 0), 1.5, 100 * ROUNDING);
	EXPECT_NEAR(probe(s, 1), 3, 300 * ROUNDING);
}

TEST(SceneBodies, GetABlastsWholeImpulse)
{
	// At 2 m a pressure of 1e5 / 4 Pa on 1 m^2, half of it over 0.01 s: 125 N s on 10 kg.
	const std::string scene = R"("world": {"gravity": [0, 0, 0], "step": STEP}, "end": {"time": 0.1},
		"bodies": [{"name": "box", "box": [1, 1, 1], "mass": 10, "at": [2, 0, 0]}],
		"blasts": [{"at": [0, 0, 0], "time": 0.013, "pressure": 1e5, "duration": 0.01, "speed": 1e5}],
		"probes": [{"name": "v", "of": "box", "measure": "velocity", "axis": "x"}])";
	for (const char* step : {"0.001", "0.05"})
	{
		std::string text = scene;
		text.replace(text.find("STEP"), 4, step);
		Simulation s(sceneOf(text));
		run(s);
		// The body has gone up to 4 cm further away meanwhile, which takes up to 4 % of the pressure.
		EXPECT_NEAR(probe(s), 12.5, .04 * 12.5) << step;
	}
	EXPECT_NEAR(meanOfPulse(1, .5, 0, 2) * 2, .25, 1e-12);
	EXPECT_NEAR(meanOfPulse(1, .5, 1.25, 2) * 2, .0625, 1e-12);
	EXPECT_EQ(meanOfPulse(1, .5, 1.6, 2), 0);
}

TEST(SceneBodies, FollowTheirPathsAndCourses)
{
	SceneDescription::Course course;
	course.table = {{1, 2}, {3, 4}};
	EXPECT_EQ(factorAt(course, 0), 2);
	EXPECT_EQ(factorAt(course, 2), 3);
	EXPECT_EQ(factorAt(course, 9), 4);
	course.frequency = .25;
	EXPECT_NEAR(factorAt(course, 1), 2, 1e-12);
	EXPECT_NEAR(factorAt(course, 2), 0, 1e-12);
	// A box on a plate that moves sideways evenly goes with it, by friction of 1 after 1 / g s.
	Simulation s(sceneOf(R"("end": {"time": 2},
		"bodies": [{"name": "plate", "box": [20, 1, 2], "motion": "kinematic", "at": [0, -0.5, 0], "friction": 1,
			"path": [{"time": 0, "at": [0, -0.5, 0]}, {"time": 9, "at": [9, -0.5, 0]}]},
			{"name": "box", "box": [1, 1, 1], "at": [0, 0.5, 0], "friction": 1}],
		"probes": [{"name": "plate", "of": "plate", "measure": "position", "axis": "x"}, {"name": "box", "of": "box", "measure": "velocity", "axis": "x"}])"));
	run(s);
	EXPECT_NEAR(probe(s, 0), 2, 1e-4);
	EXPECT_NEAR(probe(s, 1), 1, 1e-3);
	EXPECT_FALSE(s.energies().isAudited);
}

TEST(SceneBodies, ComeAndGoAtTheirTimes)
{
	Simulation s(sceneOf(R"("end": {"time": 1}, "bodies": [
		{"name": "late", "sphere": 1, "appears": 0.5, "velocity": [3, 0, 0]}, {"name": "early", "sphere": 1, "at": [9, 0, 0]}],
		"events": [{"time": 0.25, "remove": "early"}, {"time": 0.75, "push": "late", "velocity": [0, 0, 7]}])"));
	while (s.time() < .4)
		s.step();
	EXPECT_FALSE(s.isThere(0));
	EXPECT_FALSE(s.isThere(1));
	while (s.time() < .6)
		s.step();
	EXPECT_EQ(s.body(0)->getLinearVelocity().x(), 3);
	run(s);
	EXPECT_EQ(s.body(0)->getLinearVelocity().z(), 7);
	ASSERT_EQ(s.events().size(), 2u);
	EXPECT_NEAR(s.events()[0].time, .25, 1. / 60);
}

// ---- joints

TEST(SceneJoints, BearAWeightAsTheirStiffnessSays)
{
	// 100 kg on a spring of 1e5 N/m, damped to rest by ramped gravity: m g / k.
	const char* const kinds[] = {"elastic-plastic", "elastic-plastic-spring"};
	for (const char* kind : kinds)
	{
		Simulation s(
			sceneOf(std::string(R"("world": {"gravity": [0, -10, 0], "ramp": 1, "damping": 0.99}, "end": {"time": 4},
			"bodies": [{"name": "box", "box": [1, 1, 1], "mass": 100, "at": [0, -1, 0]}],
			"joints": [{"name": "j", "from": "world", "to": "box", "at": [0, 0, 0], "along": [0, -1, 0], "type": ")") +
					kind + R"(",
				"capacity": {"axial": {"stiffness": 1e5}, "shear_y": {"yield": 1e6}, "shear_z": {"yield": 1e6},
					"torsion": {"yield": 1e6}, "bending_y": {"yield": 1e6}, "bending_z": {"yield": 1e6}}}],
			"probes": [{"name": "down", "of": "box", "measure": "displacement"}, {"name": "force", "of": "j", "measure": "force"}])"));
		run(s);
		// What swings after the ramp is damped by 0.99 in a second, for 3 s.
		EXPECT_NEAR(probe(s, 0), -.01, 1e-4) << kind;
		EXPECT_NEAR(probe(s, 1), 1000, 10) << kind;
	}
}

TEST(SceneJoints, AreFreeWhereTheyHaveNoCapacity)
{
	for (const char* kind : {"elastic-plastic", "elastic-plastic-spring"})
	{
		Simulation s(sceneOf(std::string(R"("world": {"gravity": [0, 0, 0]}, "end": {"time": 0.5},
			"bodies": [{"name": "box", "box": [1, 1, 1], "mass": 100, "velocity": [1, 2, 0], "spin": [3, 0, 0]}],
			"joints": [{"name": "j", "from": "world", "to": "box", "at": [0, 0, 0], "along": [1, 0, 0], "type": ")") +
							 kind + R"(", "capacity": {"axial": {"stiffness": 1e9}}}],
			"probes": [{"name": "along", "of": "box", "measure": "displacement", "axis": "x"},
				{"name": "across", "of": "box", "measure": "displacement", "axis": "y"}, {"name": "spin", "of": "box", "measure": "spin", "axis": "x"}])"));
		run(s);
		EXPECT_NEAR(probe(s, 0), 0, 1e-3) << kind;
		EXPECT_NEAR(probe(s, 1), 1, 1e-3) << kind;
		EXPECT_NEAR(probe(s, 2), 3, 1e-3) << kind;
	}
}

TEST(SceneJoints, TearAtTheirYieldAndAreTold)
{
	// 0.01 m^2 of 200 MPa bear 2 MN; the force grows by 1 MN in a second.
	Simulation s(sceneOf(R"("world": {"gravity": [0, 0, 0], "step": 0.001}, "end": {"time": 5, "first_break": true},
		"materials": {"m": {"yield_stress": 200e6, "ultimate_plastic_strain": 0.01}},
		"bodies": [{"name": "box", "box": [1, 0.1, 0.1], "mass": 1e4, "at": [0.5, 0, 0]}],
		"joints": [{"name": "j", "from": "world", "to": "box", "at": [0, 0, 0], "material": "m", "section": {"rectangle": [0.1, 0.1]}}],
		"loads": [{"on": "box", "force": [1e6, 0, 0], "over": [0, 0, 10, 10]}])"));
	run(s);
	EXPECT_EQ(s.ending(), Ending::FirstBreak);
	ASSERT_EQ(s.events().size(), 2u);
	EXPECT_EQ(s.events()[0].type, SceneEvent::Type::Yield);
	EXPECT_NEAR(s.events()[0].time, 2, .002);
	EXPECT_EQ(s.events()[1].type, SceneEvent::Type::Break);
	EXPECT_EQ(s.events()[1].dof, BT_EP_AXIAL);
	// The last step goes a little too far. Force times elongation, e_u l with l of half the box, and what the spring still holds, f^2 / 2k.
	const double plastic = 2e6 * .01 * .5, elastic = 2e6 * 2e6 / (2 * 200e9 * .01 / .5);
	EXPECT_NEAR(s.events()[1].energy, plastic + elastic, .05 * plastic);
}

TEST(SceneJoints, OfSteelYieldInAFireWhenTheirStrengthHasFallenToTheirLoad)
{
	// A rod of 1 cm^2 and 200 MPa bears 12 kN, 0.6 of what it can. By the table's 0.78 at 500 and 0.47 at 600 degrees it yields at 558, which a
	// table from 400 degrees at 0 s to 600 at 4 s reaches after 3.16 s; heat goes by whole degrees, of 0.02 s, is
	// read at a step's beginning, and yield is told at its end: two steps of a sixtieth.
	// Of fibres the first one yields up to 4 % earlier: their stiffnesses are chosen for E I as well as E A, so not all have the same stress.
	for (const char* fibres : {"", ", \"fibres\": 16"})
	{
		Simulation s(sceneOf((std::string(R"("world": {"gravity": [0, 0, 0]},
			"materials": {"m": {"yield_stress": 200e6}},
			"bodies": [{"name": "load", "box": [1, 1, 1], "at": [0, -1, 0], "mass": 1000}],
			"joints": [{"name": "rod", "from": "world", "to": "load", "at": [0, 0, 0], "along": [0, -1, 0], "lengths": [0, 2],
				"material": "m", "section": {"rectangle": [0.01, 0.01])") +
							  fibres + R"(}}],
			"loads": [{"on": "load", "force": [0, -12e3, 0], "over": [0, 0, 1, 1]}],
			"fires": [{"on": "ro*", "over": [0, 400, 4, 600]}],
			"end": {"time": 4})")
								 .c_str()));
		run(s);
		ASSERT_FALSE(s.events().empty());
		EXPECT_EQ(SceneEvent::Type::Yield, s.events()[0].type);
		EXPECT_LT(s.events()[0].time, 3.16 + 0.02 + 2. / 60) << fibres;
		EXPECT_GT(s.events()[0].time, 3.16 - (*fibres ? 0.04 * 0.6 / 0.31 * 2 : 0.04)) << fibres;
	}
}

TEST(SceneRun, FiresHeatConcreteAndItsBarsEachByItself)
{
	// A rod of 300 x 300 mm of concrete on two bars, which hang the load in it: bars have 0.47 of their strength at 600 degrees, 3 s after they have
	// begun to get hot, and the heat of the concrete does nothing to that. With 0.9 of the load the rod holds at 600 degrees.
	for (const double share : {0.9, 1.1})
	{
		Simulation s(sceneOf((std::string(R"("world": {"gravity": [0, 0, 0], "substeps": 8},
			"materials": {"concrete": {"yield_stress": 30e6, "youngs_modulus": 33e9, "tensile_share": 0},
				"bars": {"yield_stress": 500e6}},
			"bodies": [{"name": "load", "box": [1, 1, 1], "at": [0, -1, 0], "mass": 1000}],
			"joints": [{"name": "rod", "from": "world", "to": "load", "at": [0, 0, 0], "along": [0, -1, 0], "material": "concrete",
				"lengths": [0, 2], "section": {"rectangle": [0.3, 0.3], "fibres": 36, "bars": [
					{"at": [0.1, 0], "area": 314e-6, "material": "bars"}, {"at": [-0.1, 0], "area": 314e-6, "material": "bars"}]}}],
			"loads": [{"on": "load", "force": [0, -)") +
							  std::to_string(share * 0.47 * 628e-6 * 500e6) + R"(, 0], "over": [0, 0, 1, 1]}],
			"fires": [{"on": "rod", "over": [0, 20, 0.5, 800], "law": "siliceous-concrete", "parts": [0]},
				{"on": "rod", "over": [2, 20, 5, 600], "law": "hot-rolled-bars", "parts": [1, 2]}],
			"end": {"time": 6})")
								 .c_str()));
		run(s);
		EXPECT_EQ(share > 1, !s.events().empty()) << share;
	}
}

TEST(SceneJoints, OfNewSectionsHaveTheirCapacity)
{
	// Turned as the section's principal axes are.
	const SceneDescription scene = sceneOf(R"("materials": {
			"concrete": {"yield_stress": 30e6, "tensile_share": 0, "crushing_strain": 0.0035},
			"steel": {"yield_stress": 355e6, "hardening": [0.05, 450e6, 0.15, 510e6], "kinematic_share": 0.5, "rate": [40.4, 5]}},
		"bodies": [{"name": "a", "box": [1, 1, 1]}, {"name": "b", "box": [1, 1, 1], "at": [1, 0, 0]}],
		"joints": [
			{"name": "tee", "from": "a", "to": "b", "material": "steel", "section": {"t": [0.15, 0.15, 0.01, 0.015]}},
			{"name": "angle", "from": "a", "to": "b", "material": "steel", "section": {"angle": [0.075, 0.15, 0.01]}},
			{"name": "polygon", "from": "a", "to": "b", "material": "steel", "section": {
				"polygon": [0, 0, 0, 3, 2, 2.5, 2, 0.5], "holes": [{"corners": [0.4, 0.7, 1.6, 0.8, 1.6, 2.2, 0.4, 2.3]}], "fibres": 50}},
			{"name": "bars", "from": "a", "to": "b", "material": "concrete", "section": {"rectangle": [0.3, 0.5], "fibres": 36,
				"bars": [{"at": [-0.21, 0.1], "area": 314e-6, "material": "steel"}]}}])");
	ASSERT_EQ(size_t(4), scene.joints.size());
	const double tee = 0.15 * 0.015 + 0.135 * 0.01;
	EXPECT_NEAR(tee * 355e6, double(scene.joints[0].capacity.m_yield[BT_EP_AXIAL]), tee * 355e6 * ROUNDING);
	const btElasticPlasticSection angle = btElasticPlasticSection::angle(btScalar(.075), btScalar(.15), btScalar(.01));
	const btVector3 y = scene.joints[1].frame.getBasis().getColumn(1);
	EXPECT_NEAR(double(btSin(angle.m_turn)), double(y.z()), ROUNDING);
	// Hardening of 2 points, half of it kinematic, makes a bundle of 3 at each place.
	EXPECT_EQ(150, scene.joints[2].capacity.m_fibres.size());
	const auto& fibres = scene.joints[3].capacity.m_fibres;
	ASSERT_EQ(39, fibres.size());
	EXPECT_EQ(0, fibres[0].m_tension);
	EXPECT_GT(fibres[38].m_tension, 0);
	EXPECT_GT(fibres[36].m_rateReference, 0);
}

TEST(SceneJoints, LeaveShearToItselfWhereASectionSaysSo)
{
	const SceneDescription scene = sceneOf(R"("materials": {"steel": {"yield_stress": 355e6}},
		"bodies": [{"name": "a", "box": [1, 1, 1]}, {"name": "b", "box": [1, 1, 1], "at": [1, 0, 0]}],
		"joints": [
			{"name": "whole", "from": "a", "to": "b", "material": "steel", "section": {"rectangle": [0.1, 0.1], "fibres": 16}},
			{"name": "apart", "from": "a", "to": "b", "material": "steel", "section": {"rectangle": [0.1, 0.1], "fibres": 16, "shear": false}}])");
	for (int joint = 0; joint < 2; ++joint)
		for (int i = 0; i < 16; ++i)
			EXPECT_EQ(joint == 0, scene.joints[size_t(joint)].capacity.m_fibres[i].m_bearsShear);
}

TEST(SceneJoints, OfConnectionsAndCompositeSectionsHaveTheirCapacity)
{
	const SceneDescription scene = sceneOf(R"("materials": {
			"contact": {"yield_stress": 235e6, "tensile_share": 0},
			"weld": {"yield_stress": 230e6}},
		"sections": {
			"plate": {"rectangle": [0.1, 0.3], "fibres": 36},
			"end plate": {"bolts": {"at": [0.1, 0.03, 0.1, -0.03, -0.1, 0.03, -0.1, -0.03], "area": 245e-6}, "fibres": 0,
				"parts": [{"at": [0, 0], "section": "plate", "material": "contact"}]}},
		"bodies": [{"name": "a", "box": [1, 1, 1]}, {"name": "b", "box": [1, 1, 1], "at": [1, 0, 0]}],
		"joints": [
			{"name": "bolted", "from": "a", "to": "b", "material": {"ready": "bolt 8.8"}, "section": "end plate", "lengths": [0.05, 0.05]},
			{"name": "welded", "from": "a", "to": "b", "material": "weld", "section":
				{"welds": {"lines": [-0.1, 0.05, 0.1, 0.05, -0.1, -0.05, 0.1, -0.05], "throat": 0.005}}},
			{"name": "composite", "from": "a", "to": "b", "material": {"ready": "S355"}, "section":
				{"i": [0.2, 0.4, 0.01, 0.016], "fibres": 0, "parts": [
					{"at": [0.26, 0], "section": {"rectangle": [2, 0.12], "fibres": 36}, "material": {"ready": "C30/37"}}]}}])");
	ASSERT_EQ(size_t(3), scene.joints.size());
	const btElasticPlasticCapacity &bolted = scene.joints[0].capacity, &welded = scene.joints[1].capacity,
								   &composite = scene.joints[2].capacity;
	EXPECT_EQ(4 + 36, bolted.m_fibres.size());
	const double bolt = 245e-6 * 640e6;
	double tension = 0;
	for (int i = 0; i < bolted.m_fibres.size(); ++i)
		tension += double(bolted.m_fibres[i].m_tension);
	EXPECT_NEAR(4 * bolt, tension, 4 * bolt * ROUNDING);
	EXPECT_NEAR(200e9 * 0.03 / 0.05, double(bolted.m_stiffness[BT_EP_AXIAL]) - 210e9 * 4 * 245e-6 / 0.05,
				1e-4 * 1.2e11);
	EXPECT_NEAR(2 * 0.2 * 0.005 * 230e6, double(welded.m_yield[BT_EP_AXIAL]), 460e3 * 10 * ROUNDING);
	EXPECT_NEAR(0.3, scene.joints[0].height, 0.1);
	EXPECT_NEAR(0.205, scene.joints[1].height, 1e-6);
	// As by hand: the slab bears pressure only, and shear stays the girder's.
	btElasticPlasticSection girder =
		btElasticPlasticSection::iSection(btScalar(.2), btScalar(.4), btScalar(.01), btScalar(.016)).withFibres();
	girder.addPart(btElasticPlasticSection::rectangle(2, btScalar(.12)).withFibres(36), btScalar(.26), 0,
				   btElasticPlasticReadyMaterial::find("C30/37"));
	const btElasticPlasticCapacity byHand =
		btElasticPlasticCapacity::fromMember(btElasticPlasticReadyMaterial::find("S355"), girder, 1, 1);
	ASSERT_EQ(byHand.m_fibres.size(), composite.m_fibres.size());
	for (const int dof : {BT_EP_AXIAL, BT_EP_SHEAR_Y, BT_EP_BENDING_Z})
		EXPECT_NEAR(double(byHand.m_yield[dof]), double(composite.m_yield[dof]), double(byHand.m_yield[dof]) * ROUNDING)
			<< dof;
}

TEST(SceneJoints, OfBulletsOwnMoveAsFarAsTheirFreedomsSay)
{
	// A box on the world is driven by forces and moments in each direction, without gravity; the second body is the box.
	struct Case
	{
		const char *type, *freedoms, *load, *measure;
		int axis;
		double from, to;
	};
	const double degree = M_PI / 180;
	for (const Case& c : {
			 Case{"hinge", R"("torsion": {"from": -10, "to": 30})", R"("moment": [40, 0, 0])", "turn", 0, -10 * degree,
				  30 * degree},
			 Case{"slider", R"("axial": {"from": -0.1, "to": 0.4})", R"("force": [100, 0, 0])", "displacement", 0, -.1,
				  .4},
			 Case{"cone-twist", R"("torsion": {"from": -20, "to": 20}, "bending_z": {"from": -40, "to": 40})",
				  R"("moment": [0, 0, 40])", "turn", 2, -40 * degree, 40 * degree},
			 Case{"six-dof", R"("shear_y": {"from": -0.2, "to": 0.3})", R"("force": [0, 100, 0])", "displacement", 1,
				  -.2, .3},
			 Case{"six-dof", R"("torsion": {"from": -15, "to": 25})", R"("moment": [40, 0, 0])", "turn", 0,
				  -15 * degree, 25 * degree},
			 Case{"six-dof", R"("bending_y": {"from": -15, "to": 25})", R"("moment": [0, 40, 0])", "turn", 1,
				  -15 * degree, 25 * degree},
			 Case{"six-dof", R"("bending_z": {"from": -15, "to": 25})", R"("moment": [0, 0, 40])", "turn", 2,
				  -15 * degree, 25 * degree},
		 })
		for (int sign : {1, -1})
		{
			SCOPED_TRACE(std::string(c.type) + " " + c.freedoms + (sign < 0 ? " backwards" : ""));
			const std::string axis(1, char('x' + c.axis));
			Simulation s(sceneOf(
				std::string(
					R"("world": {"gravity": [0, 0, 0], "step": 0.004, "iterations": 50}, "bodies": [{"name": "box", "box": [1, 1, 1], "mass": 100}],
				"joints": [{"name": "j", "from": "world", "to": "box", "type": ")") +
				c.type + R"(", "at": [0, 0, 0], "along": [1, 0, 0], "freedoms": {)" + c.freedoms +
				R"(}}], "loads": [{"on": "box", )" + c.load + R"(, "over": [0, )" + std::to_string(sign) + ", 1, " +
				std::to_string(sign) + R"(]}],
				"probes": [{"name": "p", "of": "box", "measure": ")" +
				c.measure + R"(", "axis": ")" + axis + R"("}, {"name": "l", "of": "box", "measure": ")" + c.measure +
				R"(", "axis": "length"}], "end": {"time": 8})"));
			run(s);
			// Bullet's limits give a little under the load.
			EXPECT_NEAR(probe(s), sign > 0 ? c.to : c.from, .02);
			// And in no other direction.
			EXPECT_NEAR(probe(s, 1), std::abs(probe(s)), .01);
		}
}

TEST(SceneJoints, OfSixDegreesSpring)
{
	Simulation s(sceneOf(
		R"("world": {"gravity": [0, -10, 0], "step": 0.004}, "bodies": [{"name": "box", "box": [1, 1, 1], "mass": 100}],
		"joints": [{"name": "j", "from": "world", "to": "box", "type": "six-dof", "at": [0, 0, 0], "along": [1, 0, 0],
			"freedoms": {"shear_y": {"stiffness": 1e4, "damping": 2e3}}}],
		"probes": [{"name": "p", "of": "box", "measure": "displacement", "axis": "y"}], "end": {"time": 4})"));
	run(s);
	EXPECT_NEAR(probe(s), -100 * 10 / 1e4, 1e-3);
	EXPECT_FALSE(s.energies().isAudited);
}

TEST(SceneMaterials, BeginWithTheLibrarysReadyOnes)
{
	const char* const beam =
		R"("structures": [{"beam": {"name": "b", "material": {"ready": "S355", "ultimate_plastic_strain": 0.1}, "section": {"circle": 0.1},
		"from": [0, 1, 0], "to": [2, 1, 0], "parts": 2}}])";
	Simulation s(sceneOf(beam));
	btElasticPlasticMaterial steel = btElasticPlasticReadyMaterial::find("S355");
	steel.m_ultimatePlasticStrain = btScalar(.1);
	// From the middle of one part of a metre to that of the next.
	const auto expected =
		btElasticPlasticCapacity::fromMember(steel, btElasticPlasticSection::circle(btScalar(.1)), 1, 1);
	const btElasticPlasticCapacity& capacity = s.joint(1)->getCapacity();
	EXPECT_FLOAT_EQ(float(capacity.m_yield[0]), float(expected.m_yield[0]));
	EXPECT_FLOAT_EQ(float(capacity.m_ductility[0]), float(expected.m_ductility[0]));
	expectParts(complaintOf(R"("materials": {"m": {"ready": "S356"}})"), {"materials.m.ready", "did you mean \"S35"});
}

TEST(SceneMaterials, AreAsFastAsTheLibraryKnowsWhereTheyAreRated)
{
	const btElasticPlasticReadyMaterial ready = btElasticPlasticReadyMaterial::at(0);
	ASSERT_EQ(ready.m_name, std::string("S235"));
	btElasticPlasticMaterial steel = ready.m_material;
	steel.m_rate = ready.m_rate;
	const auto expected =
		btElasticPlasticCapacity::fromMember(steel, btElasticPlasticSection::circle(btScalar(.1)).withFibres(), 1, 1);
	ASSERT_GT(expected.m_fibres[0].m_rateReference, 0);
	for (const bool isRated : {false, true})
	{
		const std::string material = isRated ? R"({"ready": "S235", "rated": true})" : R"({"ready": "S235"})";
		Simulation s(
			sceneOf(R"("structures": [{"beam": {"name": "b", "material": )" + material +
					R"(, "section": {"circle": 0.1, "fibres": 0}, "from": [0, 1, 0], "to": [2, 1, 0], "parts": 2}}])"));
		const btElasticPlasticFibre& fibre = s.joint(1)->getCapacity().m_fibres[0];
		EXPECT_EQ(isRated ? expected.m_fibres[0].m_rateReference : btScalar(0), fibre.m_rateReference);
		EXPECT_EQ(expected.m_fibres[0].m_rateExponent, fibre.m_rateExponent);
	}
	expectParts(complaintOf(R"("materials": {"m": {"rated": true}})"), {"materials.m.rated", "name it by ready"});
	expectParts(complaintOf(R"("materials": {"m": {"ready": "GJL-250", "rated": true}})"),
				{"materials.m.rated", "give it by rate"});
}

TEST(SceneJoints, TakeTheWorldsScheme)
{
	const char* const beam =
		R"("structures": [{"beam": {"name": "b", "material": {}, "section": {"circle": 0.1}, "from": [0, 1, 0], "to": [2, 1, 0], "parts": 2}}])";
	for (const auto& [scheme, expected] :
		 {std::pair("implicit", BT_EP_SCHEME_IMPLICIT), std::pair("by-mode", BT_EP_SCHEME_BY_MODE)})
	{
		Simulation s(sceneOf(std::string(R"("world": {"scheme": ")") + scheme + "\"}, " + beam));
		EXPECT_EQ(s.joint(0)->getScheme(), expected);
	}
}

TEST(SceneJoints, ByHandHaveAllThatACapacityHas)
{
	Simulation s(sceneOf(
		R"("bodies": [{"name": "box", "box": [1, 1, 1]}], "joints": [{"name": "j", "from": "box", "at": [0, 0, 0],
		"capacity": {"damping_ratio": 0.03, "bow": 2, "coupling": [0.5, -0.25], "shear_y": {"stiffness": 1e6}, "shear_z": {"stiffness": 1e6},
			"bending_y": {"stiffness": 1e6}, "bending_z": {"stiffness": 1e6}}}])"));
	const btElasticPlasticCapacity& capacity = s.joint(0)->getCapacity();
	EXPECT_FLOAT_EQ(float(capacity.m_damping), .03f);
	EXPECT_FLOAT_EQ(float(capacity.m_length), 2);
	EXPECT_FLOAT_EQ(float(capacity.m_coupling[0]), .5f);
	EXPECT_FLOAT_EQ(float(capacity.m_coupling[1]), -.25f);
}

TEST(SceneJoints, OfBulletsOwnHoldWhatTheyHold)
{
	const auto drop = [](const char* type)
	{
		Simulation s(sceneOf(
			std::string(R"("end": {"time": 0.5},
			"bodies": [{"name": "box", "box": [1, 0.2, 0.2], "at": [0.6, 0, 0]}],
			"joints": [{"name": "j", "from": "world", "to": "box", "at": [0, 0, 0], "along": [0, 0, 1], "type": ")") +
			type + R"("}], "probes": [{"name": "x", "of": "box", "measure": "displacement", "axis": "length"}])"));
		run(s);
		return probe(s);
	};
	// Bullet's ten iterations leave something open.
	EXPECT_LT(drop("fixed"), 1e-2);
	EXPECT_LT(drop("slider"), 1e-2);  // along z, where nothing pulls
	EXPECT_GT(drop("hinge"), .5);
	EXPECT_GT(drop("ball"), .5);
}

TEST(SceneJoints, AreCutByEvents)
{
	Simulation s(sceneOf(R"("end": {"time": 1}, "bodies": [{"name": "box", "box": [1, 1, 1]}],
		"joints": [{"name": "j", "from": "world", "to": "box", "at": [0, 0, 0], "type": "fixed"}],
		"events": [{"time": 0.5, "cut": "j"}],
		"probes": [{"name": "y", "of": "box", "measure": "displacement"}])"));
	while (s.time() < .45)
		s.step();
	EXPECT_NEAR(probe(s), 0, 1e-3);
	run(s);
	// It falls freely for half a second; half a step more by Bullet's integration.
	EXPECT_NEAR(probe(s), -.5 * 9.81 * .25, .05);
	EXPECT_EQ(s.numBroken(), 0);
}

// ---- generators

SceneDescription structure(const std::string& generator, const std::string& more = "")
{
	return sceneOf(R"("materials": {"m": {"youngs_modulus": 200e9, "density": 1000, "yield_stress": 1e12}},
		"sections": {"s": {"rectangle": [0.1, 0.2]}}, "structures": [)" +
				   generator + "], \"bodies\": []" + more);
}

double massOf(const SceneDescription& scene)
{
	double mass = 0;
	for (const auto& body : scene.bodies)
		mass += body.mass;
	return mass;
}

TEST(SceneGenerators, MakeTheMassThatTheySay)
{
	const auto mass = [](const char* generator) { return massOf(structure(generator)); };
	// Volume times 1000 kg/m^3.
	EXPECT_NEAR(mass(R"({"beam": {"name": "a", "material": "m", "section": "s", "from": [0, 0, 0], "to": [0, 3, 4]}})"),
				100, 1e-3);
	EXPECT_NEAR(mass(R"({"wall": {"name": "a", "material": "m", "length": 4, "height": 2, "thickness": 0.5}})"), 4000,
				1e-2);
	EXPECT_NEAR(mass(R"({"slab": {"name": "a", "material": "m", "length": 4, "width": 2, "thickness": 0.5}})"), 4000,
				1e-2);
	EXPECT_NEAR(mass(R"({"grid": {"name": "a", "material": "m", "size": [0.5, 1, 2]}})"), 64000, 1e-1);
}

TEST(SceneGenerators, JoinAllNeighbours)
{
	const auto joints = [](const char* generator) { return structure(generator).joints.size(); };
	EXPECT_EQ(
		joints(
			R"({"beam": {"name": "a", "material": "m", "section": "s", "from": [0, 0, 0], "to": [1, 0, 0], "parts": 5, "end": "free"}})"),
		5u + 1 - 1);
	EXPECT_EQ(
		joints(
			R"({"chain": {"name": "a", "material": "m", "section": "s", "from": [0, 0, 0], "to": [1, 0, 0], "parts": 5, "start": "pinned", "end": "pinned"}})"),
		6u);
	// 3 x 3 x 3 cubes have 3 times 18 faces between them, and 9 stand.
	EXPECT_EQ(joints(R"({"grid": {"name": "a", "material": "m", "count_x": 3, "count_y": 3, "count_z": 3}})"), 54u + 9);
	// 4 x 3 pieces have 9 + 8 between them, and 14 at edges.
	EXPECT_EQ(
		joints(
			R"({"slab": {"name": "a", "material": "m", "length": 4, "width": 3, "thickness": 0.1, "parts_x": 4, "parts_z": 3}})"),
		17u + 14);
	// Rows of 4 and 5: 3 + 4 sides, 4 at the foot, and 8 beds.
	EXPECT_EQ(joints(R"({"wall": {"name": "a", "material": "m", "length": 2, "height": 0.5, "thickness": 0.2}})"),
			  7u + 4 + 8);
	// One bay: 4 columns and 4 beams of 1 part have 2 joints each, and the slab 4.
	EXPECT_EQ(
		joints(
			R"({"frame": {"name": "a", "material": "m", "column": "s", "beam": "s", "storeys": 1, "bays_x": 1, "bays_z": 1, "parts": 1, "slab": 0.2}})"),
		20u);
	// A panel: 4 legs, 4 horizontals and 4 diagonals of one part.
	EXPECT_EQ(
		joints(
			R"({"mast": {"name": "a", "material": "m", "leg": {"circle": 0.02}, "brace": {"circle": 0.01}, "length": 9, "width": 1, "panels": 3}})"),
		3u * 24);
}

TEST(SceneGenerators, BeamsBendAsBeams)
{
	// A cantilever of 2 m under 1 kN at its end, without weight: F L^3 / 3 E I, and shear 6/5 F L / G A is 1/500 of that.
	Simulation s(structure(
		R"({"beam": {"name": "a", "material": "m", "section": "s", "from": [0, 0, 0], "to": [2, 0, 0], "parts": 8, "end": "free"}})",
		R"(, "world": {"gravity": [0, 0, 0], "damping": 0.999}, "end": {"time": 2},
		"loads": [{"on": "a/8", "force": [0, -1000, 0], "at": [0.125, 0, 0], "over": [0, 0, 1, 1]}],
		"probes": [{"name": "y", "of": "a/8", "measure": "displacement"}, {"name": "m", "of": "a/0", "measure": "force", "dof": "bending_z"}])"));
	run(s);
	const double e = 200e9, i = .1 * .2 * .2 * .2 / 12, g = e / 2.6, shear = 1.2 * 1000 * 2 / (g * .02);
	// The last part's centre is 1/16 of the length before the end: w(x) = F x^2 (3 L - x) / 6 E I.
	const double x = 1.875, expected = 1000 * x * x * (6 - x) / (6 * e * i) + shear * x / 2;
	EXPECT_NEAR(probe(s, 0), -expected, byPrecision(.01, .02) * expected);
	EXPECT_NEAR(std::fabs(probe(s, 1)), 2000, 20);
}

TEST(SceneGenerators, RefuseMembersThatLeaveNoLength)
{
	expectParts(
		complaintOf(
			[]
			{
				structure(
					R"({"frame": {"name": "f", "material": "m", "column": {"rectangle": [3, 3]}, "beam": "s", "storeys": 1, "bays_x": 1, "bays_z": 0}})");
			}),
		{"structures.f.frame", "members as thick as 3 m"});
}
}  // namespace testSimulation
