// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Scene files: what a person is told of an error, and how files, settings and parameters come together.

#include <sys/stat.h>

#include "scenes/Scenes.h"

namespace testSceneFile
{
using namespace ep;

// ---- what is told: file, line, path, value, and what is allowed

TEST(SceneErrors, NameFileLinePathValueAndRange)
{
	expectParts(complaintOf(
					[]
					{
						describeScene(SceneText::parse(R"({
		"version": 1,
		"bodies": [
			{"name": "ball", "sphere": -2}
		]})",
													   "a.json"));
					}),
				{"a.json:4: ", "bodies.ball.sphere is -2", "from 0.0001 to 10000 [m]"});
}

TEST(SceneErrors, AreToldAllAtOnce)
{
	const std::string text =
		complaintOf(R"("world": {"step": 0, "gravity": [0, 1], "sleeps": 3}, "bodies": [{"name": "a", "box": "big"}])");
	expectParts(text,
				{"world.step is 0", "world.gravity is a list of 2", "world.sleeps is 3", "bodies.a.box is \"big\""});
	EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

TEST(SceneErrors, OfWhichThereAreManyAreCounted)
{
	std::string keys;
	for (int i = 0; i < 50; ++i)
		keys += (i > 0 ? ", " : "") + ("\"key" + std::to_string(i)) + "\": 1";
	expectParts(complaintOf(("\"world\": {" + keys + "}").c_str()), {"key0", "and 30 more"});
}

TEST(SceneErrors, SuggestTheNearestName)
{
	expectParts(complaintOf(R"("wrold": {})"), {"did you mean \"world\"?"});
	expectParts(complaintOf(R"("world": {"solver": "dierct"})"), {"\"dierct\" is not known; did you mean \"direct\"?"});
	expectParts(
		complaintOf(R"("materials": {"steel": {}}, "bodies": [{"name": "a", "box": [1, 1, 1], "material": "stele"}])"),
		{"bodies.a.material", "did you mean \"steel\"?"});
	expectParts(complaintOf(R"("probes": [{"name": "p", "of": "boxx", "measure": "velocity"}])"),
				{"probes.p.of", "did you mean \"box\"?"});
	expectParts(complaintOf(R"("bodies": [{"name": "a", "box": ["=sapn", 1, 1]}], "parameters": {"span": 3})"),
				{"bodies.a.box.0", "did you mean \"span\"?"});
}

TEST(SceneErrors, TellWhichFreedomsAJointHas)
{
	const auto joint = [](const std::string& inner)
	{
		return complaintOf(
			(R"("bodies": [{"name": "box", "box": [1, 1, 1]}], "joints": [{"name": "j", "from": "box", "at": [0, 0, 0], )" +
			 inner + "}]")
				.c_str());
	};
	expectParts(joint(R"("type": "hinge", "freedoms": {"axial": {}})"),
				{"joints.j.freedoms.axial is no freedom of this type of joint"});
	expectParts(joint(R"("type": "ball", "freedoms": {"torsion": {}})"), {"is no freedom of this type of joint"});
	expectParts(joint(R"("type": "hinge", "freedoms": {"torsion": {"from": 3}})"), {"must have both of from and to"});
	expectParts(joint(R"("type": "slider", "freedoms": {"axial": {"from": 3, "to": 2}})"), {"to is less than from"});
	expectParts(joint(R"("type": "hinge", "freedoms": {"torsion": {"stiffness": 3}})"), {"only in a six-dof joint"});
	expectParts(joint(R"("type": "cone-twist", "freedoms": {"torsion": {"from": -3, "to": 2}})"), {"from must be -to"});
	expectParts(complaintOf(R"("world": {"joints": "rigid", "scheme": "by-mode"})"),
				{"world.scheme is for the joints"});
}

TEST(SceneErrors, ListWhatIsKnownWhereNothingIsNear)
{
	expectParts(complaintOf(R"("world": {"contacts": "magic"})"), {"known are by-island, exact, swept"});
}

TEST(SceneErrors, OfSyntaxHaveTheirLine)
{
	expectParts(complaintOf([] { SceneText::parse("{\n\"version\": 1,\n\"bodies\": [}\n}", "b.json"); }),
				{"b.json:3: ", "is no JSON"});
	expectParts(complaintOf([] { SceneText::parse("", "b.json"); }), {"b.json:1: ", "is no JSON"});
	expectParts(complaintOf([] { SceneText::parse("{\"version\": NaN}", "b.json"); }), {"is no JSON"});
	expectParts(complaintOf([] { SceneText::parse("{\"version\": 1e999}", "b.json"); }), {"is no JSON"});
	expectParts(complaintOf(
					[]
					{
						SceneText::parse("[1, 2]", "b.json");
						describeScene(SceneText::parse("[1, 2]", "b.json"));
					}),
				{"is a list of 2; a scene is an object"});
}

TEST(SceneErrors, HaveTheLineOfTheirValueWhereverItEnds)
{
	// The parser reads a number's end together with what follows it.
	expectParts(complaintOf("\"world\": {\n\"step\": -1\n\n}"), {"test.json:2: world.step"});
	expectParts(complaintOf("\"world\": {\n\"solver\": \"x\"\n}"), {"test.json:2: world.solver"});
	expectParts(complaintOf("\"world\": {\n\"step\":\n\n-1}"), {"test.json:4: world.step"});
}

TEST(SceneErrors, AreNotToldOfTwice)
{
	// What a structure would have made is not missed, nor is a body whose name was refused; what nobody would have made is.
	const std::string told = complaintOf(
		R"("materials": {"m": {}}, "structures": [{"grid": {"name": "deck", "material": "m", "count_x": 0}}],
		"bodies": [{"name": "a", "sphere": 1}, {"name": "x,y", "sphere": 1, "at": [9, 0, 0]}],
		"joints": [{"name": "tie", "from": "deck/1-1-1", "to": "a", "capacity": {"axial": {"stiffness": 1e6, "yield": -1}}}],
		"loads": [{"on": "deck/*", "force": [1, 0, 0]}, {"on": "dock/1", "force": [1, 0, 0]}, {"on": "x,y", "force": [1, 0, 0]}],
		"events": [{"time": 1, "cut": ["tie"]}, {"time": 1, "remove": "*"}],
		"probes": [{"name": "p", "of": "deck/1", "measure": "position"}])");
	expectParts(told, {"deck.grid.count_x is 0", "of a body is \"x,y\"", "yield is -1",
					   "loads.1.on is no body: \"dock/1\"", "events.0.cut is a list"});
	EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 4) << told;
}

TEST(SceneErrors, OfKeysAndNamesThatComeTwice)
{
	expectParts(complaintOf("\"world\": {\"step\": 0.1,\n\"step\": 0.2}"),
				{"test.json:2: the key \"step\" stands in line 1"});
	expectParts(complaintOf(R"("bodies": [{"name": "a", "box": [1, 1, 1]}, {"name": "a", "sphere": 1}])"),
				{"bodies.a.name", "another body"});
}

TEST(SceneErrors, OfSizeAndDepthComeBeforeMemoryIsGone)
{
	EXPECT_NE(complaintOf([] { SceneText::parse(std::string(100000, '['), "deep.json"); }).find("levels deep"),
			  std::string::npos);
	EXPECT_NE(complaintOf([] { SceneText::parse(std::string(limits::FileBytes + 1, ' '), "long.json"); }).find("bytes"),
			  std::string::npos);
	std::string many = "[0";
	for (size_t i = 0; i < limits::Nodes + 1; ++i)
		many += ",0";
	EXPECT_NE(complaintOf([&] { SceneText::parse(many + "]", "many.json"); }).find("values"), std::string::npos);
	expectParts(
		complaintOf(
			R"("materials": {"m": {}}, "structures": [{"grid": {"name": "g", "material": "m", "count_x": 200, "count_y": 200, "count_z": 200}}])"),
		{"would make 8000000 bodies"});
}

TEST(SceneErrors, OfVersionsThatAreNotKnown)
{
	expectParts(complaintOf([] { describeScene(SceneText::parse("{\"version\": 7}", "v.json")); }),
				{"version is 7", "from 1 to 1"});
	expectParts(complaintOf([] { describeScene(SceneText::parse("{}", "v.json")); }), {"must have the key version"});
}

TEST(SceneErrors, OfWhatTheLibraryRefuses)
{
	expectParts(complaintOf(R"("sections": {"s": {"tube": [0.1, 0.2]}})"), {"sections.s is not possible"});
	expectParts(complaintOf(R"("sections": {"s": {"circle": 1, "rectangle": [1, 1]}})"),
				{"one of the keys", "has several"});
	expectParts(
		complaintOf(
			R"("joints": [{"name": "j", "from": "box", "at": [0, 0, 0], "capacity": {"axial": {"stiffness": 1e-30}}}])"),
		{"joints.j.capacity.axial.stiffness is 1e-30"});
	expectParts(complaintOf(R"("joints": [{"name": "j", "from": "box", "at": [0, 0, 0]}])"),
				{"either material and section, or capacity"});
}

TEST(SceneErrors, OfFibresAndFires)
{
	expectParts(complaintOf(R"("sections": {"s": {"rectangle": [1, 1], "fibres": 3}})"), {"number of fibres is 3"});
	expectParts(complaintOf(R"("sections": {"s": {"polygon": [0, 0, 1, 1, 1, 0, 0]}})"),
				{"sections.s.polygon has an odd number of numbers"});
	expectParts(complaintOf(R"("sections": {"s": {"polygon": [0, 0, 2, 2, 2, 0, 0, 1]}})"),
				{"outlines of a section meet"});
	expectParts(complaintOf(R"("sections": {"s": {"circle": 1, "holes": [{"corners": [0, 0, 1, 1, 1, 0]}]}})"),
				{"sections.s.holes are for a polygon"});
	expectParts(complaintOf(R"("sections": {"s": {"circle": 1, "bars": [{"at": [0, 0], "area": 1, "material": {}}]}})"),
				{"it must have the key fibres"});
	expectParts(complaintOf(R"("sections": {"s": {"bolts": {"at": [0, 0, 1], "area": 1e-4}}})"),
				{"sections.s.bolts.at has an odd number of numbers"});
	expectParts(complaintOf(R"("sections": {"s": {"bolts": {"at": [0, 0]}}})"), {"sections.s.bolts", "area"});
	expectParts(complaintOf(R"("sections": {"s": {"welds": {"lines": [0, 0, 0, 0.1, 1], "throat": 1e-3}}})"),
				{"sections.s.welds.lines has a number of numbers that is no multiple of 4"});
	expectParts(complaintOf(R"("sections": {"s": {"welds": {"lines": [0, 0, 0, 0.1], "throat": 0.2}}})"),
				{"sections.s is not possible", "length of a weld"});
	expectParts(complaintOf(R"("sections": {"s": {"circle": 1, "parts": [
					{"at": [0, 0], "section": {"circle": 1, "fibres": 0}, "material": {}}]}})"),
				{"it must have the key fibres"});
	expectParts(complaintOf(R"("sections": {"s": {"circle": 1, "fibres": 0, "parts": [
					{"at": [0, 0], "section": {"circle": 1}, "material": {}}]}})"),
				{"sections.s", "is not possible", "number of fibres"});
	expectParts(complaintOf(R"("sections": {"s": {"circle": 1, "fibres": 0, "parts": [
					{"at": [0, 0], "section": "s", "material": {}}]}})"),
				{"sections.s.parts.0.section", "s"});
	expectParts(complaintOf(R"("materials": {"m": {"hardening": [0.1, 3e8, 0.2]}})"),
				{"materials.m.hardening has an odd number of numbers; each strain has a stress"});
	expectParts(complaintOf(R"("materials": {"m": {"hardening": [0.1, 3e8, 0.1, 4e8]}})"),
				{"materials.m is not possible"});
	expectParts(complaintOf(R"("materials": {"m": {"rate": [40, 0.5]}})"), {"materials.m is not possible"});
	expectParts(complaintOf(R"("fires": [{"on": "nothing", "over": [0, 20, 1, 500]}])"), {"fires.0.on is no joint"});
	expectParts(complaintOf(R"("fires": [{"on": "nothing", "over": [0, 20, 1]}])"), {"each time has a temperature"});
}

TEST(SceneErrors, OfAFileThatIsNotThere)
{
	expectParts(complaintOf([] { SceneText::read("nowhere.json"); }), {"nowhere.json: ", "cannot be read"});
	expectParts(complaintOf([] { SceneText::read("."); }), {"cannot be read"});
	// Nobody writes to the pipe: whoever opened it would wait for ever.
	const TemporaryFolder folder;
	const std::string pipe = folder.path() + "/pipe";
	ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
	expectParts(complaintOf([&] { SceneText::read(pipe); }), {"cannot be read: is it there, a file,"});
	const std::string outer = folder.write("outer.json", R"({"version": 1, "include": ["pipe"]})");
	expectParts(complaintOf([&] { SceneText::read(outer); }), {"pipe: cannot be read: is it there, a file,"});
	expectParts(complaintOf([] { SceneText::read("/dev/zero"); }), {"cannot be read: is it there, a file,"});
}

// ---- comments, parameters, settings, files that include others

TEST(SceneText, HasCommentsParametersAndExpressions)
{
	const SceneDescription scene = sceneOf(R"(
		// a comment
		"parameters": {"span": {"value": 6, "unit": "m", "least": 1, "most": 9}, "half": "=span / 2"},
		"bodies": [{"name": "a", "box": ["=span", "=2 * half + 1", 1], /* another */ "at": ["=-half", 0, 0]}])");
	EXPECT_EQ(scene.bodies[0].shape.size, btVector3(6, 7, 1));
	EXPECT_EQ(scene.bodies[0].pose.getOrigin(), btVector3(-3, 0, 0));
}

TEST(SceneText, SettingsReachParametersKeysAndNamedThings)
{
	const std::string inner = R"("parameters": {"span": {"value": 6, "unit": "m", "most": 9}},
		"bodies": [{"name": "a", "box": ["=span", 1, 1]}, {"name": "b", "sphere": 1, "at": [9, 0, 0]}],
		"materials": {"m": {}},
		"structures": [{"grid": {"name": "g", "material": "m", "at": [20, 0, 0]}}])";
	const SceneDescription scene = sceneOf(inner, {{"span", "8"},
												   {"world.step", "0.01"},
												   {"bodies.b.sphere", "2"},
												   {"world.solver", "stock"},
												   {"structures.g.grid.count_x", "1"}});
	EXPECT_EQ(scene.bodies[0].shape.size.x(), 8);
	EXPECT_EQ(scene.world.step, 0.01);
	EXPECT_EQ(scene.bodies[1].shape.size.x(), 2);
	EXPECT_EQ(scene.world.solver, Solver::Stock);
	EXPECT_EQ(scene.bodies.size(), 2u + 16);
	expectParts(complaintOf(
					[&] {
						sceneOf(inner, {{"span", "10"}});
					}),
				{"--set span=10", "parameters.span is 10", "to 9"});
	expectParts(complaintOf(
					[&] {
						sceneOf(inner, {{"bodies.c.sphere", "2"}});
					}),
				{"does not lead anywhere", "known are a, b"});
	expectParts(complaintOf([&] { sceneOf(inner, {{"wolrd.step", "2"}}); }), {"did you mean \"world\"?"});
	const auto complaintOfSetting = [&](const std::string& path) {
		return complaintOf([&] { sceneOf(inner, {{path, "2"}}); });
	};
	expectParts(complaintOfSetting("spam"), {"--set spam=2", "did you mean \"span\"?"});
	expectParts(complaintOfSetting("parameters.spam"), {"did you mean \"span\"?"});
	expectParts(complaintOfSetting("materials.n.density"), {"\"n\" is not known; known are m"});
	expectParts(complaintOfSetting("structures.g.grid.count_w"), {"did you mean \"count_x\"?"});
	expectParts(complaintOf([] { Setting::from("span"); }), {"path=value"});
}

TEST(SceneText, IncludesAreUnderWhatTheFileSays)
{
	const TemporaryFolder folder;
	folder.write("base.json", R"({"version": 1, "parameters": {"size": 1}, "world": {"step": 0.5, "ramp": 2},
		"bodies": [{"name": "first", "box": ["=size", 1, 1]}]})");
	const std::string file =
		folder.write("own.json", R"({"version": 1, "include": [{"file": "base.json", "set": {"size": 3}}],
		"world": {"step": 0.25}, "bodies": [{"name": "second", "sphere": 1, "at": [9, 0, 0]}]})");
	const SceneDescription scene = describeScene(SceneText::read(file));
	EXPECT_EQ(scene.world.step, 0.25);
	EXPECT_EQ(scene.world.ramp, 2);
	ASSERT_EQ(scene.bodies.size(), 2u);
	EXPECT_EQ(scene.bodies[0].name, "first");
	EXPECT_EQ(scene.bodies[0].shape.size.x(), 3);
}

TEST(SceneText, FilesDoNotIncludeEachOther)
{
	const TemporaryFolder folder;
	const std::string a = folder.write("a.json", R"({"version": 1, "include": ["b.json"]})");
	folder.write("b.json", R"({"version": 1, "include": ["a.json"]})");
	expectParts(complaintOf([&] { SceneText::read(a); }), {"b.json:1: include.0", "cannot include each other"});
	expectParts(complaintOf([&] { SceneText::read(folder.write("c.json", R"({"include": ["none.json"]})")); }),
				{"none.json", "cannot be read"});
}

TEST(SceneText, PrintsWhatItReads)
{
	const SceneText text =
		SceneText::parse(R"({"version": 1, /* gone */ "bodies": [{"name": "a", "box": [1, 2, 3]}]})", "p.json");
	const SceneDescription again = describeScene(SceneText::parse(text.root.json(), "again.json"));
	EXPECT_EQ(again.bodies[0].shape.size, btVector3(1, 2, 3));
}

// ---- the schema that is documented is the one that is read

TEST(SceneSchema, IsTheOneInTheDocs)
{
	std::ifstream stream(std::string(EP_SOURCE_DIR) + "/docs/scene.schema.json");
	const std::string documented((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
	EXPECT_EQ(documented, sceneSchema()) << "ep-run --schema makes it anew";
}
}  // namespace testSceneFile
