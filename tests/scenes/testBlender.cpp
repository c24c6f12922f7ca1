// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Films as Blender shows them: poses, bent surfaces, and a picture.

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "cases/CaseRunner.h"
#include "gltf/GltfFilm.h"
#include "scenes/Scenes.h"

namespace testBlender
{
using namespace ep;

nlohmann::json listOf(const btVector3& v) { return {double(v.x()), double(v.y()), double(v.z())}; }

nlohmann::json listOf(const btTransform& pose)
{
	nlohmann::json list = listOf(pose.getOrigin());
	const btQuaternion turn = pose.getRotation();
	for (btScalar number : {turn.x(), turn.y(), turn.z(), turn.w()})
		list.push_back(double(number));
	return list;
}

/// Where the joint between two parts of a beam has the corners of both.
nlohmann::json cornersAt(const Simulation& s, size_t joint)
{
	const SceneDescription::Joint& j = s.scene().joints[joint];
	btTransform frames[2];
	for (int i = 0; i < 2; ++i)
		frames[i] = s.poseOf(j.bodies[i]) * s.scene().bodies[size_t(j.bodies[i])].pose.inverse() * j.frame;
	const btQuaternion a = frames[0].getRotation(), b = frames[1].getRotation();
	const btTransform middle((a.dot(b) < 0 ? a - b : a + b).normalized(),
							 frames[0].getOrigin().lerp(frames[1].getOrigin(), btScalar(.5)));
	const btVector3 half = s.scene().bodies[size_t(j.bodies[0])].shape.size / 2;
	nlohmann::json list;
	for (btScalar y : {-half.y(), half.y()})
		for (btScalar z : {-half.z(), half.z()})
			list.push_back(listOf(middle * btVector3(0, y, z)));
	return list;
}

/// EP_BLENDER is empty where there is no Blender.
bool hasBlender() { return *EP_BLENDER != 0; }

/// What a script in Blender tells.
std::string inBlender(const std::string& script, const std::string& arguments, const TemporaryFolder& folder)
{
	const std::string log = folder.path() + "/log.txt";
	const std::string command = std::string(EP_BLENDER) +
								" -b --factory-startup --python-exit-code 1 --python " EP_SOURCE_DIR "/tests/scenes/" +
								script + " -- " + arguments + " >" + log + " 2>&1";
	const int status = std::system(command.c_str());
	std::ifstream stream(log);
	const std::string told((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
	EXPECT_EQ(status, 0) << told;
	return told;
}

/// Not a number: the text does not tell it.
double numberAfter(const std::string& words, const std::string& text)
{
	const size_t place = text.find(words);
	return place == std::string::npos ? std::nan("") : std::atof(text.c_str() + place + words.size());
}

TEST(Blender, ShowsPosesAndBentMembersAsTheyWere)
{
	if (!hasBlender())
		GTEST_SKIP() << "Blender is missing (Debian and Ubuntu: blender)";
	const TemporaryFolder folder;
	// A portal of which a ball bends a column; in the end the ball is back on the ground.
	Simulation s(sceneOf(
		R"("end": {"time": 1}, "world": {"ground": true, "step": 0.0166666667, "substeps": 8},
		"materials": {"steel": {"yield_stress": 235e6, "ultimate_plastic_strain": 1}},
		"bodies": [{"name": "ball", "sphere": 0.3, "mass": 900, "at": [-1, 1.5, 0], "velocity": [8, 0, 0], "spin": [0, 3, 1]}],
		"structures": [{"frame": {"name": "portal", "material": "steel", "column": {"rectangle": [0.1, 0.1]}, "beam": {"rectangle": [0.1, 0.1]},
			"storeys": 1, "bays_x": 1, "bays_z": 0, "parts": 6}}])"));
	GltfFilm film(s);
	nlohmann::json expected = {{"pictures", nlohmann::json::array()}};
	int number = 0;
	while (s.ending() == Ending::None)
	{
		s.step();
		film.step();
		if (++number % 6 != 0)
			continue;
		nlohmann::json picture = {{"number", number}};
		for (size_t i = 0; i < s.scene().bodies.size(); ++i)
			picture["poses"][s.scene().bodies[i].name] = listOf(s.poseOf(int(i)));
		for (size_t i = 0; i < s.scene().joints.size(); ++i)
			if (s.scene().joints[i].name == "portal/column-0-0-0/3")
				for (const char* side : {"portal/column-0-0-0/3/bent", "portal/column-0-0-0/4/bent"})
					picture["surfaces"][side] = cornersAt(s, i);
		expected["pictures"].push_back(picture);
	}
	ASSERT_EQ(expected["pictures"].size(), 10u);
	ASSERT_TRUE(expected["pictures"][9].contains("surfaces"));
	const std::string model = folder.path() + "/film.glb", picture = folder.path() + "/picture.png";
	film.write(model);
	const std::string told = inBlender(
		"lookInBlender.py", model + " " + picture + " " + folder.write("expected.json", expected.dump()), folder);
	EXPECT_LT(numberAfter("deviation of poses: ", told), 1e-5) << told;
	EXPECT_LT(numberAfter("deviation of surfaces: ", told), 1e-5) << told;
	// The portal and the ball are a small part of the picture, and not nothing.
	const double share = numberAfter("covered: ", told);
	EXPECT_GT(share, .02);
	EXPECT_LT(share, .4);
	if (const char* keep = std::getenv("EP_KEEP_PICTURE"))
		std::filesystem::copy_file(picture, keep, std::filesystem::copy_options::overwrite_existing);
}

TEST(Blender, ExportsModelsThatBecomeScenes)
{
	if (!hasBlender())
		GTEST_SKIP() << "Blender is missing (Debian and Ubuntu: blender)";
	const TemporaryFolder folder;
	const std::string model = folder.path() + "/model.glb", file = folder.path() + "/scene.json",
					  materials = folder.write(
						  "materials.json", R"({"version": 1, "materials": {"steel": {}, "oak": {"density": 700}}})");
	inBlender("modelInBlender.py", model, folder);
	const std::string build = std::string(EP_BUILD) + " " + model + " --materials " + materials + " --out " + file;
	ASSERT_EQ(std::system((build + " >/dev/null").c_str()), 0);
	const SceneDescription scene = describeScene(SceneText::read(file));
	ASSERT_EQ(scene.bodies.size(), 3u);
	std::map<std::string, SceneDescription::Body> bodies;
	for (const SceneDescription::Body& body : scene.bodies)
		bodies[body.name] = body;
	EXPECT_EQ(bodies.at("wall").motion, SceneDescription::Motion::Static);
	EXPECT_EQ(bodies.at("tip").mass, 100);
	EXPECT_EQ(bodies.at("tip").density, 700);
	// Blender's z is up: the arm is 0.5 m high.
	EXPECT_NEAR(double((bodies.at("arm").shape.size - btVector3(1, .5, btScalar(.4))).length()), 0, 1e-5);
	EXPECT_NEAR(double((bodies.at("tip").pose.getOrigin() - btVector3(2, 0, 0)).length()), 0, 1e-5);
	ASSERT_EQ(scene.joints.size(), 2u);
	for (const SceneDescription::Joint& joint : scene.joints)
	{
		EXPECT_NEAR(joint.height, .5, 1e-5);
		EXPECT_NEAR(joint.width, .4, 1e-5);
	}
}
}  // namespace testBlender
