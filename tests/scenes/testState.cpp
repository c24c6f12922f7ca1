// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Simulations that go on from a saved state, and what is done to them from outside.

#include "scenes/Scenes.h"
#include "simulation/Probes.h"
#include "simulation/StateFile.h"
#include "support/Precision.h"

namespace testState
{
using namespace ep;

/// A beam that is bent until it breaks off and falls onto the ground, while a ball comes, a block leaves, and a joint of it and
/// one of Bullet's own are cut.
const char* const HAPPENINGS = R"("world": {"ground": true, "ramp": 0.2, "error": 0.02, "sleeps": true},
	"structures": [{"beam": {"name": "beam", "material": {"ultimate_plastic_strain": 0.02}, "section": {"rectangle": [0.05, 0.05]},
		"from": [0, 1, 0], "to": [1.2, 1, 0], "parts": 6, "end": "free"}}],
	"bodies": [{"name": "ball", "sphere": 0.1, "at": [1, 1.3, 0], "mass": 300, "appears": 0.3, "velocity": [0, -3, 0]},
		{"name": "plate", "box": [1, 0.1, 1], "at": [3, 1, 0], "motion": "static"},
		{"name": "block", "box": [0.2, 0.2, 0.2], "at": [3, 1.15, 0]},
		{"name": "hung", "box": [0.2, 0.2, 0.2], "at": [5, 2, 0]}, {"name": "lost", "box": [0.2, 0.2, 0.2], "at": [7, 2, 0]}],
	"joints": [{"name": "hook", "from": "hung", "type": "ball", "at": [5, 2.2, 0]},
		{"name": "weak", "from": "lost", "type": "fixed", "at": [7, 2.2, 0], "breaks_at": 100}],
	"events": [{"time": 0, "push": "block", "velocity": [0.5, 0, 0]}, {"time": 0.4, "cut": "hook"}, {"time": 0.5, "remove": "plate"},
		{"time": 0.6, "cut": "beam/1"}, {"time": 0.7, "remove": "lost"}],
	"probes": [{"name": "ball", "of": "ball", "measure": "position"}, {"name": "block", "of": "block", "measure": "position"},
		{"name": "tip", "of": "beam/6", "measure": "position"}, {"name": "flow", "of": "beam/*", "measure": "plastic_energy"},
		{"name": "hung", "of": "hung", "measure": "position"}, {"name": "broken", "of": "weak", "measure": "broken"}],
	"end": {"time": 1.2})";

std::vector<double> readingsOf(Simulation& s)
{
	std::vector<double> all = {s.time(),
							   s.energies().kinetic,
							   s.energies().plastic,
							   s.energies().gained,
							   s.energies().turnover,
							   double(s.numBroken()),
							   double(s.events().size()),
							   double(s.ending())};
	for (const auto& probe : s.scene().probes)
	{
		const double value = readProbe(s, probe);
		all.push_back(value == value ? value : -1);  // what is not there yet
	}
	return all;
}

void stepTo(Simulation& s, double time)
{
	while (s.time() < time)
		s.step();
}

/// HAPPENINGS as it is, or with a beam whose section is cut into fibres.
class SceneStates : public testing::TestWithParam<bool>
{
protected:
	static std::string text()
	{
		std::string text = HAPPENINGS;
		const std::string section = "\"rectangle\": [0.05, 0.05]";
		if (GetParam())
			text.insert(
				text.find(section) + section.size(),
				R"(, "fibres": 12, "bars": [{"at": [0.02, 0], "area": 1e-4, "material": {"ultimate_plastic_strain": 0.01}}])");
		return text;
	}
};

INSTANTIATE_TEST_SUITE_P(AsABeam, SceneStates, testing::Bool(),
						 [](const auto& info) { return info.param ? "WithFibres" : "WithoutFibres"; });

TEST_P(SceneStates, GoOnInAnotherSimulationWithTheSameBits)
{
	const SceneDescription scene = sceneOf(text());
	Simulation first(scene);
	// Before, between and after what happens; each time the first one goes on as the others do.
	for (double time : {0., 0.1, 0.35, 0.45, 0.65, 0.8, 1.})
	{
		SCOPED_TRACE(time);
		stepTo(first, time);
		const nlohmann::json packed = packState(first.save());
		Simulation second(scene, unpackState(nlohmann::json::from_cbor(nlohmann::json::to_cbor(packed))));
		EXPECT_EQ(readingsOf(second), readingsOf(first));
		for (int i = 0; i < 4; ++i)
		{
			first.step();
			second.step();
		}
		EXPECT_EQ(readingsOf(second), readingsOf(first));
	}
	// What is cut is in no world: its state is kept by itself.
	const Simulation last(scene, first.save());
	int numCut = 0;
	for (int i = 0; i < int(scene.joints.size()); ++i)
	{
		if (!first.joint(i))
			continue;
		numCut += first.isCut(i);
		EXPECT_EQ(last.joint(i)->getPlasticEnergy(), first.joint(i)->getPlasticEnergy());
		EXPECT_EQ(last.joint(i)->getDamage(), first.joint(i)->getDamage());
	}
	EXPECT_EQ(1, numCut);
	const auto ruptures = [](const Simulation& s)
	{
		std::vector<int> parts;
		for (const SceneEvent& event : s.events())
			if (event.type == SceneEvent::Type::Rupture)
				parts.push_back(event.part);
		return parts;
	};
	EXPECT_EQ(ruptures(last), ruptures(first));
	if (GetParam())
	{
		ASSERT_GT(ruptures(first).size(), 1u);
		EXPECT_EQ(1, ruptures(first)[0]);
	}
	// All of it has happened: the beam is off, or hangs by its last fibres, and what was lost is off.
	EXPECT_GE(first.numBroken(), GetParam() ? 1 : 2);
	EXPECT_TRUE(first.isBroken(int(first.scene().joints.size()) - 1));
}

TEST(SceneState, OfAnotherSceneOrOfNoneIsRefused)
{
	Simulation s(sceneOf(HAPPENINGS));
	stepTo(s, 0.8);
	const SimulationState state = s.save();
	expectParts(complaintOf([&] { Simulation(sceneOf(""), state); }), {"of another scene"});
	SimulationState wrong = state;
	wrong.changes.push_back({SimulationState::Change::Type::Remove, 1000});
	expectParts(complaintOf([&] { Simulation(s.scene(), wrong); }), {"of another scene"});
	wrong = state;
	wrong.world.resize(wrong.world.size() / 2);
	expectParts(complaintOf([&] { Simulation(s.scene(), wrong); }), {"of another scene"});
	nlohmann::json packed = packState(state);
	for (const char* key : {"version", "precision", "ending", "energies", "events", "world", "cut"})
	{
		nlohmann::json spoilt = packed;
		spoilt[key] = "nothing";
		expectParts(complaintOf([&] { unpackState(spoilt); }), {"no state that can be read"});
		spoilt.erase(key);
		expectParts(complaintOf([&] { unpackState(spoilt); }), {"no state that can be read", key});
	}
}

TEST(SceneState, OfAnotherVersionOrPrecisionIsRefused)
{
	Simulation s(sceneOf(HAPPENINGS));
	const nlohmann::json packed = packState(s.save());
	const int version = packed["version"];
	const std::string own = sizeof(btScalar) == sizeof(double) ? "double" : "float",
					  other = own == "double" ? "float" : "double";
	for (const int before : {0, version - 1, version + 1})
	{
		nlohmann::json foreign = packed;
		foreign["version"] = before;
		expectParts(complaintOf([&] { unpackState(foreign); }),
					{"no state that can be read", "of version " + std::to_string(before) + " in " + own,
					 "not of version " + std::to_string(version) + " in " + own});
	}
	nlohmann::json foreign = packed;
	foreign["precision"] = other;
	expectParts(complaintOf([&] { unpackState(foreign); }),
				{"no state that can be read", "of version " + std::to_string(version) + " in " + other});
	unpackState(packed);
}

/// States of before are refused by their version alone. So who changes what one holds raises STATE_VERSION in StateFile.cpp, and then
/// writes both down here. The world in it is a snapshot with a version of its own.
TEST(SceneState, HasANewVersionForANewLayout)
{
	SimulationState s;
	s.events.emplace_back();
	s.changes.emplace_back();
	s.played = {true};
	s.brokenBulletsOwn = {1};
	s.cut.emplace_back();
	s.cut[0].second.m_fibres.resize(1);
	s.vehicles.emplace_back();
	s.vehicles[0].wheels.emplace_back();
	nlohmann::json packed = packState(s);
	// The numbers of a joint and of a fibre are many.
	nlohmann::json& joint = packed["cut"][0][1];
	EXPECT_EQ(123u, joint["numbers"].size());
	EXPECT_EQ(8u, joint["fibres"].size());
	joint["numbers"] = joint["fibres"] = nlohmann::json::array();
	packed.erase("precision");
	EXPECT_EQ(
		R"({"broken_bullets_own":[1],"calm":0.0,"changes":[[0,0]],"cut":[[0,{"fibres":[],"numbers":[]}]],"ending":0,)"
		R"("energies":[0.0,0.0,0.0,0.0,0.0,0.0,0.0,true],"events":[[0.0,0,0,0,0.0,0.0,0.0,0.0,-1]],"last_substep":1.0,"played":[true],)"
		R"("time":0.0,"vehicles":[[[[0.0,0.0,0.0,0.0,0]],0.0,0,0.0,0.0,0.0]],"version":7,"world":{"bytes":[],"subtype":null}})",
		packed.dump());
}

TEST(SceneState, CannotBeSavedWhereBulletDoesNotTellIt)
{
	std::string text = HAPPENINGS;
	text.replace(text.find("\"ground\""), 0, "\"joints\": \"rigid\", ");
	Simulation s(sceneOf(text));
	expectParts(complaintOf([&] { s.save(); }), {"cannot be saved", "world.joints"});
}

TEST(SceneLoads, MayBeAddedAndChangeInASubstep)
{
	// 2 kg under a force of 6 N that grows in 1 s gains 3/2 m/s, as the scene's own load does; half of it then is half.
	const std::string scene = R"("world": {"gravity": [0, 0, 0], "step": 0.01, "substeps": 4}, "end": {"time": 1},
		"bodies": [{"name": "box", "box": [1, 1, 1], "mass": 2}])";
	Simulation s(sceneOf(scene));
	s.addedLoads().resize(1);
	s.addedLoads()[0].bodies = {0};
	int substeps = 0;
	s.beforeSubsteps(
		[&](double time)
		{
			++substeps;
			s.addedLoads()[0].force.setX(btScalar(6 * time));
		});
	stepTo(s, .999);
	EXPECT_EQ(substeps, 400);
	EXPECT_NEAR(double(s.body(0)->getLinearVelocity().x()), 1.5, byPrecision(1e-12, 1e-4));
	s.addedLoads().clear();
	s.step();
	EXPECT_NEAR(double(s.body(0)->getLinearVelocity().x()), 1.5, byPrecision(1e-12, 1e-4));
}
}  // namespace testState
