// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Vehicles of scene files: what they stand on feels them, and they drive their routes.

#include "scenes/Scenes.h"
#include "simulation/Probes.h"
#include "simulation/StateFile.h"
#include "support/Precision.h"

namespace testVehicles
{
using namespace ep;

double probe(Simulation& s, size_t index = 0) { return readProbe(s, s.scene().probes[index]); }

void stepTo(Simulation& s, double time)
{
	while (s.time() < time)
		s.step();
}

const char* const PLACES =
	R"("probes": [{"name": "x", "of": "truck", "measure": "position", "axis": "x"}, {"name": "y", "of": "truck", "measure": "position", "axis": "y"},
		{"name": "z", "of": "truck", "measure": "position", "axis": "z"}, {"name": "speed", "of": "truck", "measure": "velocity", "axis": "length"},
		{"name": "turn", "of": "truck", "measure": "turn", "axis": "y"}])";

TEST(SceneVehicles, StandOnWhatFeelsTheirWeight)
{
	// A plate on one spring, which bears both; the vehicle's own springs are 50 m g a metre each.
	Simulation s(sceneOf(
		R"("world": {"gravity": [0, -10, 0]}, "bodies": [{"name": "plate", "box": [12, 0.2, 6], "mass": 10000, "at": [0, -0.1, 0]}],
		"vehicles": [{"name": "truck"}],
		"joints": [{"name": "spring", "from": "plate", "at": [0, -0.1, 0], "along": [0, 1, 0], "capacity": {"axial": {"stiffness": 1e8}, "shear_y": {"stiffness": 1e9},
			"shear_z": {"stiffness": 1e9}, "torsion": {"stiffness": 1e10}, "bending_y": {"stiffness": 1e10}, "bending_z": {"stiffness": 1e10}}}],
		"probes": [{"name": "force", "of": "spring", "measure": "force", "dof": "axial"}, {"name": "plate", "of": "plate", "measure": "displacement"},
			{"name": "truck", "of": "truck", "measure": "position"}], "end": {"time": 8})"));
	stepTo(s, 8);
	const double weight = 60000 * 10;
	EXPECT_NEAR(std::abs(probe(s, 0)), weight, byPrecision(1e-3, 1e-2) * weight);
	EXPECT_NEAR(probe(s, 1), -weight / 1e8, 1e-4);
	// Unloaded wheels touch the ground with the middle of the body 1.5 m above it.
	EXPECT_NEAR(probe(s, 2), 1.5 - 10. / (4 * 50) - weight / 1e8, 1e-3);
	EXPECT_LE(s.energies().gained, 1e-3 * s.energies().turnover);
}

TEST(SceneVehicles, ThrowNoLightGroundAbout)
{
	// Four dampers of 225 kN s/m each would stop a plate of 2 t 7.5 times in a step: by themselves they would throw it.
	Simulation s(sceneOf(
		R"("world": {"gravity": [0, -10, 0]}, "bodies": [{"name": "plate", "box": [12, 0.2, 6], "mass": 2000, "at": [0, -0.1, 0]}],
		"vehicles": [{"name": "truck"}],
		"joints": [{"name": "spring", "from": "plate", "at": [0, -0.1, 0], "along": [0, 1, 0], "capacity": {"axial": {"stiffness": 1e7}, "shear_y": {"stiffness": 1e9},
			"shear_z": {"stiffness": 1e9}, "torsion": {"stiffness": 1e10}, "bending_y": {"stiffness": 1e10}, "bending_z": {"stiffness": 1e10}}}],
		"probes": [{"name": "plate", "of": "plate", "measure": "displacement"}], "end": {"time": 30})"));
	double lowest = 0, highest = 0;
	while (s.ending() == Ending::None)
	{
		s.step();
		lowest = std::min(lowest, probe(s));
		highest = std::max(highest, probe(s));
	}
	const double atRest = -52000 * 10 / 1e7;
	EXPECT_NEAR(probe(s), atRest, 1e-3);
	// Put on at once, a weight goes down by twice that at most.
	EXPECT_GT(lowest, 2 * atRest);
	EXPECT_LT(highest, .01);
	EXPECT_LE(s.energies().gained, .01 * s.energies().turnover);
}

TEST(SceneVehicles, RollAgainstTheirResistanceWithoutARoute)
{
	Simulation s(sceneOf(std::string(R"("world": {"ground": true}, "bodies": [],
		"vehicles": [{"name": "truck", "kind": "car", "velocity": 10, "rolling_resistance": 700, "air_drag": 0, "turn": [0, 1, 0, 90]}], )") +
						 PLACES));
	stepTo(s, 4);
	// 700 N on 1400 kg; x forward is turned to -z. A step more or less is 10 / 60 m; wheels brake one after the other, by which it
	// turns by a thousandth.
	EXPECT_NEAR(probe(s, 3), 10 - .5 * 4, .02);
	EXPECT_NEAR(probe(s, 2), -(10 * 4 - .25 * 16), .2);
	EXPECT_NEAR(probe(s, 0), 0, .1);
}

TEST(SceneVehicles, PushOffWithTheirDriveForce)
{
	Simulation s(sceneOf(std::string(R"("world": {"ground": true, "ramp": 1}, "bodies": [],
		"vehicles": [{"name": "truck", "air_drag": 0, "power": 1e9, "rolling_resistance": 20e3, "route": [{"to": [1000, 0], "speed": 20}]}], )") +
						 PLACES));
	// It waits for gravity.
	stepTo(s, 1);
	EXPECT_NEAR(probe(s, 0), 0, 1e-3);
	stepTo(s, 1.5);
	const double before = probe(s, 3);
	stepTo(s, 2.5);
	// 220 - 20 kN on 50 t.
	EXPECT_NEAR(probe(s, 3) - before, 4, .02);
}

TEST(SceneVehicles, DriveTheirRouteRoundACornerAndBack)
{
	Simulation s(
		sceneOf(std::string(R"("world": {"ground": true}, "bodies": [], "end": {"time": 80, "standstill": 0.01},
		"vehicles": [{"name": "truck", "at": [-30, 0, 0], "route": [{"to": [20, 0], "speed": 8, "stop": false},
			{"to": [20, 40], "speed": 4, "wait": 2}, {"to": [20, 15], "speed": 4}]}], )") +
				PLACES));
	double furthest = 0, passed = 1e9, waited = 0;
	while (s.ending() == Ending::None)
	{
		s.step();
		furthest = std::max(furthest, probe(s, 2));
		passed = std::min(passed, std::hypot(probe(s, 0) - 20, probe(s, 2)));
		if (probe(s, 2) > 30 && probe(s, 3) < .1)
			waited += s.scene().world.step;
	}
	// It ends where it has arrived, not where it waits.
	EXPECT_EQ(s.ending(), Ending::Standstill);
	EXPECT_LT(passed, .2);
	EXPECT_GT(waited, 2);
	// A leg is done less than 3 m before its place.
	EXPECT_GT(furthest, 37);
	EXPECT_LT(furthest, 40.5);
	EXPECT_NEAR(probe(s, 0), 20, 1.5);
	EXPECT_NEAR(probe(s, 2), 15, 3);
	// It came back in reverse: x forward still looks along z.
	EXPECT_NEAR(probe(s, 4), -M_PI / 2, .1);
}

TEST(SceneVehicles, GoOnFromAStateWithTheSameBits)
{
	const SceneDescription scene = sceneOf(std::string(R"("world": {"ground": true, "error": 0.02, "sleeps": true},
		"vehicles": [{"name": "truck", "at": [-12, 0, 0], "route": [{"to": [4, 1], "speed": 6, "stop": false}, {"to": [12, 8], "speed": 5}]}],
		"bodies": [{"name": "plate", "box": [3, 0.1, 4], "at": [-6, 0.05, 0]}], )") +
										   PLACES);
	const auto readings = [](Simulation& s)
	{
		std::vector<double> all = {s.time(), s.energies().kinetic};
		for (size_t i = 0; i < s.scene().probes.size(); ++i)
			all.push_back(probe(s, i));
		for (const Simulation::Wheel& wheel : s.wheels())
			for (int i = 0; i < 3; ++i)
				all.push_back(double(wheel.pose.getOrigin()[i]));
		return all;
	};
	Simulation first(scene);
	for (double time : {0., .5, 1.5, 2.5, 3.5, 6.})
	{
		SCOPED_TRACE(time);
		stepTo(first, time);
		const nlohmann::json packed = packState(first.save());
		Simulation second(scene, unpackState(nlohmann::json::from_cbor(nlohmann::json::to_cbor(packed))));
		EXPECT_EQ(readings(second), readings(first));
		for (int i = 0; i < 10; ++i)
		{
			first.step();
			second.step();
		}
		EXPECT_EQ(readings(second), readings(first));
	}
	SimulationState other = first.save();
	other.vehicles[0].progress.leg = 7;
	EXPECT_NE(complaintOf([&] { Simulation(scene, other); }).find("of another scene"), std::string::npos);
}

TEST(SceneVehicles, AreRefusedWithAMessage)
{
	const auto expect = [](const char* vehicle, const std::vector<std::string>& parts)
	{ expectParts(complaintOf((std::string(R"("vehicles": [{"name": "truck", )") + vehicle + "}]").c_str()), parts); };
	expect(R"("kind": "cart")", {"vehicles.truck.kind", "cart", "car"});
	expect(R"("mass": 0)", {"vehicles.truck.mass is 0; it must be a number from 1"});
	expect(R"("wheels": 6)", {"vehicles.truck key \"wheels\" is not known"});
	expect(R"("route": [{"speed": 5}])", {"vehicles.truck.route.0 must have to, to drive, or wait"});
	expect(R"("route": [{"to": [0, 0]}])", {"vehicles.truck.route.0.to is where it is already"});
	expect(R"("route": [{"to": [5, 0], "stop": false, "wait": 1}])", {"route.0.wait is for a place where it stops"});
	expect(R"("route": [{"to": [5, 0, 0]}])", {"route.0.to is a list of 3; it must be a list of 2 numbers"});
	expectParts(complaintOf(R"("bodies": [{"name": "a", "box": [1, 1, 1]}], "vehicles": [{"name": "a"}])"),
				{"is that of another body"});
	// A wall in the middle of it.
	expectParts(complaintOf(
					[]
					{
						Simulation(sceneOf(R"("bodies": [{"name": "wall", "box": [1, 3, 5], "at": [0, 1.5, 0]}],
							"vehicles": [{"name": "truck"}])"));
					}),
				{"truck", "wall", "deep"});
}
}  // namespace testVehicles
