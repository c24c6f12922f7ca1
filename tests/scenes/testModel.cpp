// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-build from outside: models that are written here become scenes. Models as meshes of bodies.

#include <sys/stat.h>
#include <sys/wait.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "cases/CaseRunner.h"
#include "gltf/BufferWriter.h"
#include "scenes/Scenes.h"
#include "simulation/Simulation.h"

namespace testModel
{
using namespace ep;

typedef std::vector<float> Points;  // x, y, z of one after another

/// A model as Blender exports it: a node for each piece, with its mesh, its place and its custom properties.
class ModelFile
{
public:
	tinygltf::Node& add(const std::string& name, const Points& points, const std::vector<unsigned short>& corners,
						const std::vector<double>& at)
	{
		tinygltf::Primitive primitive;
		primitive.mode = TINYGLTF_MODE_TRIANGLES;
		primitive.attributes["POSITION"] = m_buffer.add(points, 3, TINYGLTF_TARGET_ARRAY_BUFFER);
		primitive.indices = m_buffer.addCorners(corners);
		tinygltf::Mesh mesh;
		mesh.primitives.push_back(primitive);
		m_model.meshes.push_back(mesh);
		tinygltf::Node node;
		node.name = name;
		node.mesh = int(m_model.meshes.size()) - 1;
		node.translation = at;
		m_model.nodes.push_back(node);
		return m_model.nodes.back();
	}

	tinygltf::Node& box(const std::string& name, const std::vector<double>& at,
						const std::vector<double>& size = {1, 1, 1})
	{
		Points points;
		for (int i = 0; i < 8; ++i)
			for (int axis = 0; axis < 3; ++axis)
				points.push_back(i >> axis & 1 ? .5f : -.5f);
		tinygltf::Node& node = add(name, points, {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
												  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5},
								   at);
		node.scale = size;
		return node;
	}

	/// A third of its corners is missing of a box: a prism with a slope from (1, 0) to (0, 1).
	tinygltf::Node& wedge(const std::string& name, const std::vector<double>& at)
	{
		return add(name, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1},
				   {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 0, 3, 5, 0, 5, 2}, at);
	}

	int surface(const std::string& name)
	{
		m_model.materials.emplace_back();
		m_model.materials.back().name = name;
		return int(m_model.materials.size()) - 1;
	}
	tinygltf::Mesh& meshOf(const tinygltf::Node& node) { return m_model.meshes[size_t(node.mesh)]; }

	std::string write(const TemporaryFolder& folder)
	{
		tinygltf::Scene scene;
		for (size_t i = 0; i < m_model.nodes.size(); ++i)
			scene.nodes.push_back(int(i));
		m_model.scenes = {scene};
		m_model.asset.version = "2.0";
		const std::string file = folder.path() + "/model.glb";
		EXPECT_TRUE(tinygltf::TinyGLTF().WriteGltfSceneToFile(&m_model, file, true, true, false, true));
		return file;
	}

private:
	tinygltf::Model m_model;
	BufferWriter m_buffer{m_model};
};

tinygltf::Value properties(const std::string& key, const std::string& value)
{
	return tinygltf::Value(tinygltf::Value::Object{{key, tinygltf::Value(value)}});
}

/// What it says. \param status  that it is to end with
std::string epBuild(const std::string& arguments, int status = 0)
{
	const std::string log = std::filesystem::temp_directory_path() / ("ep-build-" + std::to_string(getpid()) + ".log");
	const int ended = std::system((shellWord(EP_BUILD) + " " + arguments + " >" + log + " 2>&1").c_str());
	std::ifstream stream(log);
	const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
	std::filesystem::remove(log);
	EXPECT_EQ(WIFEXITED(ended) ? WEXITSTATUS(ended) : -1, status) << text;
	return text;
}

SceneDescription sceneIn(const std::string& file) { return describeScene(SceneText::read(file)); }

TEST(EpBuild, MakesBodiesAndJointsThatBear)
{
	// A beam of two blocks stands out from a wall: the joint in the wall bears their weight on its lever.
	const TemporaryFolder folder;
	ModelFile model;
	model.box("wall", {0, 0, 0}, {1, 2, 2}).extras = properties("motion", "static");
	model.box("arm", {1, 0, 0}, {1, .5, .4});
	model.box("tip", {2, 0, 0}, {1, .5, .4});
	const std::string out = folder.path() + "/scene.json";
	expectParts(epBuild(model.write(folder) + " --out " + out), {"3 bodies and 2 joints"});
	Simulation s(sceneIn(out));
	const auto& joints = s.scene().joints;
	ASSERT_EQ(joints.size(), 2u);
	EXPECT_EQ(joints[0].name, "wall--arm");
	EXPECT_NEAR(joints[0].height, .5, 1e-5);
	EXPECT_NEAR(joints[0].width, .4, 1e-5);
	EXPECT_NEAR(double((joints[1].frame.getOrigin() - btVector3(btScalar(1.5), 0, 0)).length()), 0, 1e-5);
	while (s.ending() == Ending::None)
		s.step();
	const double weight = 2 * .5 * .4 * double(btElasticPlasticMaterial().m_density) * 9.81;
	EXPECT_NEAR(std::fabs(double(s.joint(0)->getForce(BT_EP_SHEAR_Y))), weight, .01 * weight);
	EXPECT_NEAR(std::fabs(double(s.joint(0)->getForce(BT_EP_BENDING_Z))), weight, .02 * weight);  // at 1 m
	EXPECT_EQ(s.numBroken(), 0);
}

TEST(EpBuild, TakesHullsTurnsAndMaterials)
{
	const TemporaryFolder folder;
	const std::string out = folder.path() + "/scene.json",
					  materials = folder.write(
						  "materials.json", R"({"version": 1, "materials": {"steel": {}, "oak": {"density": 700}}})");
	ModelFile model;
	const int oak = model.surface("oak"), paint = model.surface("paint");
	tinygltf::Node& turned = model.box("turned", {0, 5, 0}, {1, 2, 3});
	turned.rotation = {0, std::sin(.3), 0, std::cos(.3)};
	model.meshOf(turned).primitives[0].material = oak;
	tinygltf::Node& wedge = model.wedge("wedge", {5, 0, 0});
	model.meshOf(wedge).primitives[0].material = paint;
	model.box("own", {5.5, -.5, .5}).extras = properties("material", "oak");
	model.box("own", {9, 0, 0});
	expectParts(epBuild(model.write(folder) + " --materials " + materials + " --static 'own-*' --out " + out),
				{"4 bodies and 1 joints"});
	Simulation s(sceneIn(out));
	const auto mass = [&](int body) { return 1 / double(s.body(body)->getInvMass()); };
	EXPECT_NEAR(mass(0), 700 * 6, 1);
	EXPECT_NEAR(mass(1), 7800 * .5, 1) << "steel, for paint is no material";
	EXPECT_NEAR(mass(2), 700, 1);
	EXPECT_EQ(s.scene().bodies[3].name, "own-2");
	EXPECT_EQ(s.body(3)->getInvMass(), 0);
	// A corner of the turned box is where it was in the model.
	const btVector3 corner = quatRotate(btQuaternion(btVector3(0, 1, 0), btScalar(.6)), btVector3(.5, 1, 1.5));
	const btVector3 inBody = s.poseOf(0).getBasis().transpose() * corner, half = s.scene().bodies[0].shape.size / 2;
	EXPECT_NEAR(double((inBody.absolute() - half).length()), 0, 1e-5);
	// The whole of the wedge's square foot is a face.
	EXPECT_EQ(s.scene().joints[0].name, "wedge--own");
	EXPECT_NEAR(s.scene().joints[0].height * s.scene().joints[0].width, 1, 1e-5);
}

TEST(EpBuild, JoinsByTheWeakerMaterial)
{
	const TemporaryFolder folder;
	const std::string out = folder.path() + "/scene.json",
					  materials = folder.write("materials.json", R"({"version": 1, "parameters": {"soft": 20e6},
		"materials": {"steel": {}, "oak": {"yield_stress": "=soft"}, "iron": {"yield_stress": 100e6}}})");
	ModelFile model;
	model.meshOf(model.box("a", {0, 0, 0})).primitives[0].material = model.surface("iron");
	model.meshOf(model.box("b", {1, 0, 0})).primitives[0].material = model.surface("oak");
	model.box("c", {2, 0, 0});
	model.meshOf(model.box("d", {3, 0, 0})).primitives[0].material = model.surface("iron");
	epBuild(model.write(folder) + " --materials " + materials + " --out " + out);
	const SceneDescription scene = sceneIn(out);
	ASSERT_EQ(scene.joints.size(), 3u);
	const std::map<std::string, double> stresses = {{"a--b", 20e6}, {"b--c", 20e6}, {"c--d", 100e6}};
	for (const auto& joint : scene.joints)
		EXPECT_NEAR(double(joint.capacity.m_yield[BT_EP_AXIAL]) / stresses.at(joint.name), 1, 1e-4) << "of 1 m^2";
}

TEST(EpBuild, TellsWhatIsNotJoined)
{
	const TemporaryFolder folder;
	const std::string out = " --out " + folder.path() + "/scene.json";
	ModelFile model;
	model.box("a", {0, 0, 0});
	model.box("apart", {1.004, 0, 0});
	model.box("edge", {-1, 1, 0});
	model.box("strip", {0, -1, .9995});
	const std::string text = epBuild(model.write(folder) + out);
	expectParts(text,
				{"'a' and 'apart' are 0.004 m apart: no joint; --gap is 0.001", "'a' and 'strip' touch in a strip of",
				 "'a' and 'edge' touch in an edge, a corner or at an angle only: no joint", "4 bodies and 0 joints"});
	expectParts(epBuild(model.write(folder) + out + " --gap 0.005"), {"4 bodies and 1 joints"});
	ModelFile deep;
	deep.box("a", {0, 0, 0});
	deep.box("b", {.9, 0, 0});
	expectParts(epBuild(deep.write(folder) + out, 1),
				{"'a' and 'b' stand 0.1 m deep in each other: no joint", "move one, or join them"});
}

TEST(EpBuild, RefusesWhatIsNoPieceAndNamesIt)
{
	const TemporaryFolder folder;
	ModelFile model;
	model.add("flat", {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, {0, 0, 0});
	// An L: the corner inside is not on its hull.
	Points points;
	for (float z : {0.f, 1.f})
		for (float p : {0.f, 0.f, 2.f, 0.f, 2.f, 1.f, 1.f, 1.f, 1.f, 2.f, 0.f, 2.f})
		{
			points.push_back(p);
			if (points.size() % 3 == 2)
				points.push_back(z);
		}
	std::vector<unsigned short> corners = {0, 2, 1, 0, 3, 2, 0, 4, 3, 0, 5, 4, 6, 7, 8, 6, 8, 9, 6, 9, 10, 6, 10, 11};
	for (unsigned short i = 0; i < 6; ++i)
		for (int corner : {int(i), (i + 1) % 6, (i + 1) % 6 + 6, int(i), (i + 1) % 6 + 6, i + 6})
			corners.push_back((unsigned short)(corner));
	model.add("bent", points, corners, {5, 0, 0});
	model.box("good", {9, 0, 0});
	const std::string file = model.write(folder);
	expectParts(epBuild(file, 1), {"\"flat\" has no volume", "\"bent\" is not convex", "cut it into convex pieces"});
	expectParts(epBuild(folder.path() + "/nowhere.glb", 1), {"nowhere.glb: cannot be read as glTF"});
	ModelFile good;
	good.box("good", {0, 0, 0});
	const std::string out = " --out " + folder.path() + "/scene.json";
	expectParts(epBuild(good.write(folder) + out + " --material wood", 1),
				{"bodies.good.material \"wood\" is not known; known are steel"});
	expectParts(epBuild(good.write(folder) + out + " --gap nan", 105),
				{"--gap", "'nan' is out of range; it must be from 1e-06 to 10"});
	expectParts(epBuild(good.write(folder) + out + " --static god", 1),
				{"--static is no piece", "did you mean \"good\""});
	EXPECT_FALSE(std::filesystem::exists(folder.path() + "/scene.json"));
	// Each of a file's first lengths is an error or a model, and nothing else.
	std::ifstream stream(good.write(folder), std::ios::binary);
	const std::string whole((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
	for (size_t length = 0; length < whole.size(); length += whole.size() / 10)
		epBuild(folder.write("cut.glb", whole.substr(0, length)) + out, 1);
}

/// A scene in which a ball falls on what a file holds.
std::string slopeScene(const TemporaryFolder& folder, const std::string& mesh)
{
	return folder.write("scene.json", R"({"version": 1, "end": {"time": 2},
		"bodies": [{"name": "slope", "mesh_file": ")" +
										  mesh + R"(", "motion": "static", "at": [0, -1, 0]},
			{"name": "ball", "sphere": 0.2, "at": [0.3, 1, 0.5]}]})");
}

TEST(MeshFile, IsWhatBodiesStandOn)
{
	const TemporaryFolder folder;
	ModelFile model;
	// Two nodes of one file: a floor of 8 m with a step of 1 m on it.
	model.box("floor", {0, -.5, 0}, {8, 1, 8});
	model.box("step", {0, .5, 0}, {2, 1, 2});
	model.write(folder);
	const std::string file = slopeScene(folder, "model.glb");
	Simulation s(describeScene(SceneText::read(file)));
	EXPECT_EQ(s.scene().bodies[0].shape.points.size(), 72u);
	while (s.ending() == Ending::None)
		s.step();
	// The body is 1 m lower than the file's origin.
	EXPECT_NEAR(double(s.poseOf(1).getOrigin().y()), .2, .01);
	// The file is found from the folder of the scene, wherever that is included.
	std::filesystem::create_directory(folder.path() + "/inner");
	const std::string outer = folder.write("inner/outer.json", R"({"version": 1, "include": ["../scene.json"]})");
	EXPECT_EQ(describeScene(SceneText::read(outer)).bodies[0].shape.points.size(), 72u);
}

TEST(MeshFile, IsRefusedWithAMessage)
{
	const TemporaryFolder folder;
	const auto complaint = [&](const std::string& mesh)
	{ return complaintOf([&] { describeScene(SceneText::read(slopeScene(folder, mesh))); }); };
	expectParts(complaint("nowhere.glb"), {"scene.json:2: bodies.slope.mesh_file", "nowhere.glb", "is it there"});
	// Nobody writes to the pipe: whoever opened it would wait for ever.
	ASSERT_EQ(mkfifo((folder.path() + "/pipe.glb").c_str(), 0600), 0);
	expectParts(complaint("pipe.glb"), {"pipe.glb", "is it there, and a file?"});
	folder.write("points.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "pipe.glb"}]})");
	expectParts(complaint("points.gltf"), {"points.gltf", "cannot be read as glTF", "pipe.glb"});
	folder.write("text.glb", "this is no model");
	expectParts(complaint("text.glb"), {"text.glb", "cannot be read as glTF"});
	ModelFile model;
	model.box("floor", {0, 0, 0});
	model.write(folder);
	expectParts(
		complaintOf((R"("bodies": [{"name": "a", "mesh_file": ")" + folder.path() + R"(/model.glb"}])").c_str()),
		{"bodies.a has a mesh, which is for a body whose motion is static"});
}

TEST(MeshFile, SpoiltOnesAreReadOrRefusedWithAMessage)
{
	const int cases = 400;
	const TemporaryFolder folder;
	ModelFile model;
	model.box("floor", {0, 0, 0}, {8, 1, 8});
	model.wedge("wedge", {0, .5, 0});
	std::ifstream stream(model.write(folder), std::ios::binary);
	const std::string whole((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
	const std::string file = slopeScene(folder, "model.glb");
	int refused = 0;
	for (unsigned seed = 0; seed < unsigned(cases); ++seed)
	{
		SCOPED_TRACE(seed);
		std::mt19937 random(seed);
		std::string spoilt = whole;
		for (unsigned times = 1 + random() % 3; times > 0; --times)
		{
			const size_t at = random() % spoilt.size();
			// Digits are places, counts and numbers of what is elsewhere in the file.
			const size_t digit = spoilt.find_first_of("0123456789", at);
			switch (random() % 4)
			{
				case 0:
					spoilt.resize(at + 1);
					break;
				case 1:
					spoilt[at] = char(random());
					break;
				default:
					if (digit != std::string::npos)
						spoilt[digit] = char('0' + random() % 10);
			}
		}
		folder.write("model.glb", spoilt);
		refused += !complaintOf([&] { Simulation(describeScene(SceneText::read(file))).step(); }).empty();
	}
	EXPECT_GT(refused, cases / 10);
	EXPECT_LT(refused, cases);
}
}  // namespace testModel
