// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Scenes exported as glTF, read back by the library that others read it with.

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "gltf/GltfFilm.h"
#include "gltf/Triangles.h"
#include "scenes/Scenes.h"
#include "support/Precision.h"

namespace testGltf
{
using namespace ep;

using ShapeKind = SceneDescription::ShapeKind;

tinygltf::Model readBack(const std::string& file)
{
	tinygltf::Model model;
	std::string error, warning;
	EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, file)) << error;
	EXPECT_EQ(error + warning, "");
	return model;
}

std::vector<float> numbersOf(const tinygltf::Model& model, int index)
{
	const tinygltf::Accessor& accessor = model.accessors[size_t(index)];
	const tinygltf::BufferView& view = model.bufferViews[size_t(accessor.bufferView)];
	std::vector<float> numbers(view.byteLength / sizeof(float));
	std::memcpy(numbers.data(), &model.buffers[0].data[view.byteOffset], view.byteLength);
	EXPECT_EQ(numbers.size(), accessor.count * size_t(tinygltf::GetNumComponentsInType(uint32_t(accessor.type))));
	return numbers;
}

/// Track of a node, empty: it has none.
std::vector<float> trackOf(const tinygltf::Model& model, int node, const std::string& path, std::string* how = nullptr)
{
	for (const tinygltf::AnimationChannel& channel : model.animations.at(0).channels)
		if (channel.target_node == node && channel.target_path == path)
		{
			const tinygltf::AnimationSampler& sampler = model.animations[0].samplers[size_t(channel.sampler)];
			if (how)
				*how = sampler.interpolation;
			return numbersOf(model, sampler.output);
		}
	return {};
}

/// By the divergence theorem: positive, if triangles are seen counter-clockwise from outside.
double volumeOf(const Triangles& t)
{
	double volume = 0;
	for (size_t i = 0; i + 2 < t.corners.size(); i += 3)
		volume += double(t.corners[i].dot(t.corners[i + 1].cross(t.corners[i + 2]))) / 6;
	return volume;
}

TEST(Triangles, EncloseTheirShapesFromOutside)
{
	SceneDescription::Shape shape;
	const double around = 24 * std::sin(2 * M_PI / 24) / 2;  // area of a circle's polygon
	shape.kind = ShapeKind::Box;
	shape.size.setValue(1, 2, 3);
	EXPECT_NEAR(volumeOf(trianglesOf(shape)), 6, 1e-5);
	EXPECT_EQ(trianglesOf(shape).corners.size(), 36u);
	shape.kind = ShapeKind::Cylinder;
	EXPECT_NEAR(volumeOf(trianglesOf(shape)), 2 * around, 1e-5);
	// A ball's triangles lie within it: of its volume they leave out some hundredths.
	shape.kind = ShapeKind::Sphere;
	const double ball = volumeOf(trianglesOf(shape));
	EXPECT_NEAR(ball, 4. / 3 * M_PI, .03 * 4. / 3 * M_PI);
	shape.kind = ShapeKind::Capsule;
	EXPECT_NEAR(volumeOf(trianglesOf(shape)), ball + 2 * around, 1e-4);
	shape.kind = ShapeKind::Hull;
	shape.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
	EXPECT_NEAR(volumeOf(trianglesOf(shape)), 1. / 6, 1e-6);
	for (const btVector3& normal : trianglesOf(shape).normals)
		EXPECT_NEAR(double(normal.length()), 1, 1e-5);
}

TEST(Gltf, TurnsAreUnitQuaternionsWithinOne)
{
	// Of a matrix in float some quaternions come out a little longer than 1, of a turn next to none with a number above 1.
	const TemporaryFolder folder;
	std::string bodies;
	for (int i = 0; i < 400; ++i)
		bodies += std::string(i > 0 ? "," : "") + R"({"name": "b)" + std::to_string(i) +
				  R"(", "box": [1, 1, 1], "at": [)" + std::to_string(2 * i) + R"(, 0, 0], "turn": [)" +
				  std::to_string(i % 7 - 3) + "," + std::to_string(i % 5) + ", 1," +
				  std::to_string(i < 200 ? 1e-3 * i : 0.9 * i) + "]}";
	Simulation s(sceneOf(R"("title": "turned", "end": {"time": 0.05}, "bodies": [)" + bodies + "]"));
	GltfFilm film(s);
	s.step();
	film.step();
	film.write(folder.path() + "/turned.glb");
	const tinygltf::Model model = readBack(folder.path() + "/turned.glb");
	for (const tinygltf::Node& node : model.nodes)
	{
		double square = 0;
		for (const double number : node.rotation)
		{
			EXPECT_LE(std::fabs(number), 1) << node.name;
			square += number * number;
		}
		if (!node.rotation.empty())
		{
			EXPECT_NEAR(square, 1, 4e-7) << node.name;
		}
	}
}

TEST(Gltf, TracksOfBodiesAreTheirPoses)
{
	const TemporaryFolder folder;
	const std::string file = folder.path() + "/film.glb";
	Simulation s(sceneOf(
		R"("title": "film", "end": {"time": 0.5}, "materials": {"m": {"yield_stress": 1e6, "ultimate_plastic_strain": 0.001}},
		"bodies": [{"name": "floor", "box": [9, 1, 9], "at": [0, -3, 0], "motion": "static"},
			{"name": "ball", "sphere": 0.5, "velocity": [1, 2, 3], "spin": [4, 5, 6], "at": [5, 5, 5]},
			{"name": "late", "hull": [0,0,0, 1,0,0, 0,1,0, 0,0,1], "appears": 0.25, "at": [-5, 5, 5]}],
		"structures": [{"beam": {"name": "beam", "material": "m", "section": {"rectangle": [0.01, 0.01]}, "from": [0, 0, 0], "to": [1, 0, 0], "parts": 2, "end": "free"}}])"));
	GltfFilm film(s);
	std::vector<btTransform> poses = {s.poseOf(1)};
	while (s.ending() == Ending::None)
	{
		s.step();
		film.step();
		poses.push_back(s.poseOf(1));
	}
	film.write(file);
	const tinygltf::Model model = readBack(file);
	ASSERT_GE(model.nodes.size(), 5u + 2) << "bodies and joints, and then what bends members";
	EXPECT_EQ(model.nodes[1].name, "ball");
	EXPECT_TRUE(trackOf(model, 0, "translation").empty());
	const std::vector<float> places = trackOf(model, 1, "translation"), turns = trackOf(model, 1, "rotation");
	ASSERT_EQ(places.size(), 3 * poses.size());
	for (size_t i = 0; i < poses.size(); ++i)
	{
		// Floats of some metres.
		for (int k = 0; k < 3; ++k)
			EXPECT_NEAR(double(places[3 * i + size_t(k)]), double(poses[i].getOrigin()[k]), 1e-6);
		const btQuaternion turn(turns[4 * i], turns[4 * i + 1], turns[4 * i + 2], turns[4 * i + 3]);
		EXPECT_NEAR(std::fabs(double(turn.dot(poses[i].getRotation()))), 1, 1e-6);
	}
	// What appears has no size before, and all of it at once.
	std::string how;
	const std::vector<float> sizes = trackOf(model, 2, "scale", &how);
	EXPECT_EQ(how, "STEP");
	EXPECT_EQ(sizes.front(), 0);
	EXPECT_EQ(sizes.back(), 1);
	// The beam of 1 cm cannot bear itself: its joint tells of it.
	const tinygltf::Value& joint = model.nodes[5].extras;
	EXPECT_EQ(joint.Get("joint").Get<std::string>(), "beam/0");
	EXPECT_EQ(joint.Get("utilisation").ArrayLen(), poses.size());
	EXPECT_TRUE(joint.Get("is_broken").Get<bool>());
	const tinygltf::Value& events = model.scenes[0].extras.Get("events");
	std::vector<std::string> told;
	for (int i = 0; i < int(events.ArrayLen()); ++i)
		told.push_back(events.Get(i).Get("event").Get<std::string>());
	ASSERT_GE(told.size(), 2u);
	EXPECT_EQ(told.front(), "yield");
	EXPECT_EQ(std::count(told.begin(), told.end(), "break"), 1);
}

btTransform poseAt(const tinygltf::Model& model, int node, size_t picture)
{
	const std::vector<float> place = trackOf(model, node, "translation"), turn = trackOf(model, node, "rotation");
	if (place.empty())
	{
		const tinygltf::Node& n = model.nodes[size_t(node)];
		return btTransform(
			btQuaternion(btScalar(n.rotation[0]), btScalar(n.rotation[1]), btScalar(n.rotation[2]),
						 btScalar(n.rotation[3])),
			btVector3(btScalar(n.translation[0]), btScalar(n.translation[1]), btScalar(n.translation[2])));
	}
	const float *const p = &place[3 * picture], *const q = &turn[4 * picture];
	return btTransform(btQuaternion(q[0], q[1], q[2], q[3]), btVector3(p[0], p[1], p[2]));
}

int nodeOf(const tinygltf::Model& model, const std::string& name)
{
	for (size_t i = 0; i < model.nodes.size(); ++i)
		if (model.nodes[i].name == name)
			return int(i);
	return -1;
}

/// The corners of a bent body's surface in the world, as a reader of the format computes them.
std::vector<btVector3> bentCorners(const tinygltf::Model& model, const std::string& body, size_t picture)
{
	const tinygltf::Node& node = model.nodes[size_t(nodeOf(model, body + "/bent"))];
	const tinygltf::Skin& skin = model.skins[size_t(node.skin)];
	const auto& attributes = model.meshes[size_t(node.mesh)].primitives[0].attributes;
	const std::vector<float> places = numbersOf(model, attributes.at("POSITION")),
							 weights = numbersOf(model, attributes.at("WEIGHTS_0")),
							 inverses = numbersOf(model, skin.inverseBindMatrices);
	const tinygltf::BufferView& joints =
		model.bufferViews[size_t(model.accessors[size_t(attributes.at("JOINTS_0"))].bufferView)];
	std::vector<btTransform> bones;
	for (size_t i = 0; i < skin.joints.size(); ++i)
	{
		btScalar matrix[16];
		std::copy_n(&inverses[16 * i], 16, matrix);
		btTransform inverse;
		inverse.setFromOpenGLMatrix(matrix);
		bones.push_back(poseAt(model, nodeOf(model, body), picture) * poseAt(model, skin.joints[i], picture) * inverse);
	}
	std::vector<btVector3> corners(places.size() / 3, btVector3(0, 0, 0));
	for (size_t i = 0; i < corners.size(); ++i)
		for (size_t k = 0; k < 4; ++k)
		{
			const unsigned char bone = model.buffers[0].data[joints.byteOffset + 4 * i + k];
			corners[i] += bones.at(bone) * btVector3(places[3 * i], places[3 * i + 1], places[3 * i + 2]) *
						  btScalar(weights[4 * i + k]);
		}
	return corners;
}

/// The furthest that one of the four corners at a's upper end is away from those at b's lower end.
double gapBetween(const std::vector<btVector3>& a, const std::vector<btVector3>& b)
{
	// The last two faces of a surface are its lower and its upper end.
	double furthest = 0;
	for (size_t i = a.size() - 6; i < a.size(); ++i)
	{
		btScalar nearest = SIMD_INFINITY;
		for (size_t k = b.size() - 12; k < b.size() - 6; ++k)
			nearest = btMin(nearest, a[i].distance(b[k]));
		furthest = std::max(furthest, double(nearest));
	}
	return furthest;
}

/// A beam that stands out from a wall. One of 5 cm is too weak for its weight.
std::string filmOfBeam(const TemporaryFolder& folder, double size, std::vector<double>& times)
{
	Simulation s(sceneOf(
		R"("parameters": {"size": 0}, "end": {"time": 0.5}, "materials": {"m": {"yield_stress": 20e6}},
		"bodies": [{"name": "floor", "box": [9, 1, 9], "at": [0, -9, 0], "motion": "static"}],
		"structures": [{"beam": {"name": "beam", "material": "m", "section": {"rectangle": ["=size", "=size"]}, "from": [0, 0, 0], "to": [3, 0, 0], "parts": 3, "end": "free"}}],
		"events": [{"time": 0.4, "cut": "beam/1"}])",
		{{"size", std::to_string(size)}}));
	GltfFilm film(s);
	times = {s.time()};
	while (s.ending() == Ending::None)
	{
		s.step();
		film.step();
		times.push_back(s.time());
	}
	const std::string file = folder.path() + "/film.glb";
	film.write(file);
	return file;
}

TEST(Gltf, MembersBendAndDoNotGapBeforeTheyTear)
{
	const TemporaryFolder folder;
	std::vector<double> times;
	const tinygltf::Model model = readBack(filmOfBeam(folder, .05, times));
	ASSERT_EQ(model.skins.size(), 2u) << "the third part hangs on the others and stays straight";
	EXPECT_EQ(model.nodes[1].name, "beam/1");
	EXPECT_EQ(model.nodes[1].mesh, -1) << "the surface is the skin's";
	const double rounding = 1e-5;
	double turned = 0;
	for (size_t i = 0; i < times.size(); ++i)
	{
		std::vector<btVector3> parts[2];
		for (int part = 0; part < 2; ++part)
			parts[part] = bentCorners(model, "beam/" + std::to_string(part + 1), i);
		// The wall's end stays in the wall.
		for (size_t k = parts[0].size() - 12; k < parts[0].size() - 6; ++k)
			EXPECT_NEAR(double(parts[0][k].x()), 0, rounding);
		const double gap = gapBetween(parts[0], parts[1]);
		if (times[i] < .4 - 1e-6)
		{
			EXPECT_LT(gap, rounding) << times[i];
		}
		if (times[i] > .45)
		{
			EXPECT_GT(gap, .01) << "it is cut, and falls";
		}
		turned = std::max(turned, double(poseAt(model, 1, i).getRotation().getAngle()));
	}
	EXPECT_GT(turned, .1) << "or there is nothing to be seen";
}

TEST(Gltf, WhatIsNotBentHasNoSkin)
{
	const TemporaryFolder folder;
	std::vector<double> times;
	const tinygltf::Model model = readBack(filmOfBeam(folder, .6, times));
	EXPECT_TRUE(model.skins.empty());
	EXPECT_GE(model.nodes[1].mesh, 0);
}

TEST(Gltf, CannotBeWrittenNowhere)
{
	Simulation s(sceneOf(""));
	EXPECT_THROW(GltfFilm(s).write("/dev/null/film.glb"), std::runtime_error);
}
}  // namespace testGltf
