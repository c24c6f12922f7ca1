// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "gltf/GltfFilm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

#include "gltf/BufferWriter.h"
#include "gltf/Members.h"
#include "world/JointReading.h"

namespace ep
{
namespace
{
using Value = tinygltf::Value;

const btScalar BENT = btScalar(.001);  // [rad], or of its length: a member that is bent less is drawn as it is

void append(std::vector<float>& numbers, const btVector3& v)
{
	for (int i = 0; i < 3; ++i)
		numbers.push_back(float(v[i]));
}

/// A turn as the format has it: no number may be above 1, not even by rounding.
std::array<float, 4> numbersOf(const btQuaternion& turn)
{
	std::array<float, 4> numbers;
	const double length = std::sqrt(double(turn.length2()));
	for (int i = 0; i < 4; ++i)
		numbers[size_t(i)] = float(std::min(std::max(double(turn[i]) / length, -1.), 1.));
	return numbers;
}

/// A pose over time.
struct Track
{
	std::vector<float> places, turns;
	btQuaternion last = btQuaternion(0, 0, 0, 1);

	void add(const btTransform& pose)
	{
		append(places, pose.getOrigin());
		// The nearer one of the two that are the same turn: between pictures it is turned the short way.
		const btQuaternion turn = pose.getRotation();
		last = turn.dot(last) < 0 ? -turn : turn;
		const std::array<float, 4> numbers = numbersOf(last);
		turns.insert(turns.end(), numbers.begin(), numbers.end());
	}
};

int addMaterial(tinygltf::Model& model, const SceneDescription::Body& body)
{
	tinygltf::Material material;
	material.name = body.name;
	for (int i = 0; i < 3; ++i)
		material.pbrMetallicRoughness.baseColorFactor[size_t(i)] = double(body.colour[i]);
	material.pbrMetallicRoughness.metallicFactor = 0;
	material.pbrMetallicRoughness.roughnessFactor = .7;
	model.materials.push_back(material);
	return int(model.materials.size()) - 1;
}

int addMesh(tinygltf::Model& model, BufferWriter& writer, const SceneDescription::Body& body,
			const Triangles& triangles)
{
	std::vector<float> places, normals;
	for (size_t i = 0; i < triangles.corners.size(); ++i)
	{
		append(places, triangles.corners[i]);
		append(normals, triangles.normals[i]);
	}
	tinygltf::Primitive primitive;
	primitive.attributes["POSITION"] = writer.add(places, 3, TINYGLTF_TARGET_ARRAY_BUFFER);
	primitive.attributes["NORMAL"] = writer.add(normals, 3, TINYGLTF_TARGET_ARRAY_BUFFER);
	primitive.material = addMaterial(model, body);
	primitive.mode = TINYGLTF_MODE_TRIANGLES;
	tinygltf::Mesh mesh;
	mesh.name = body.name;
	mesh.primitives.push_back(primitive);
	model.meshes.push_back(mesh);
	return int(model.meshes.size()) - 1;
}

void setPose(tinygltf::Node& node, const btTransform& pose)
{
	const std::array<float, 4> turn = numbersOf(pose.getRotation());
	const btVector3& place = pose.getOrigin();
	node.translation = {double(place.x()), double(place.y()), double(place.z())};
	node.rotation.assign(turn.begin(), turn.end());
}

void addTrack(tinygltf::Animation& animation, int node, const char* path, const char* interpolation, int times,
			  int values)
{
	tinygltf::AnimationSampler sampler;
	sampler.input = times;
	sampler.output = values;
	sampler.interpolation = interpolation;
	animation.samplers.push_back(sampler);
	tinygltf::AnimationChannel channel;
	channel.sampler = int(animation.samplers.size()) - 1;
	channel.target_node = node;
	channel.target_path = path;
	animation.channels.push_back(channel);
}

Value listOf(const std::vector<double>& numbers)
{
	Value::Array list;
	for (double number : numbers)
		list.emplace_back(number);
	return Value(list);
}

Value eventsOf(const Simulation& s)
{
	Value::Array events;
	for (const SceneEvent& e : s.events())
	{
		const bool isBody = e.type == SceneEvent::Type::Remove || e.type == SceneEvent::Type::Push;
		Value::Object event;
		event["time_s"] = Value(e.time);
		event["event"] = Value(nameOf(sceneEventTypes(), e.type));
		event["name"] = Value(isBody ? s.scene().bodies[size_t(e.index)].name : s.scene().joints[size_t(e.index)].name);
		event["place_m"] = listOf({double(e.place.x()), double(e.place.y()), double(e.place.z())});
		events.emplace_back(event);
	}
	return Value(events);
}
}  // namespace

GltfFilm::GltfFilm(const Simulation& simulation, double interval) : m_simulation(simulation), m_interval(interval)
{
	record();
}

void GltfFilm::step()
{
	const double rounding = 1e-9;
	// The last picture is always there.
	if (m_simulation.time() + rounding >= m_frames.back().time + m_interval || m_simulation.ending() != Ending::None)
		record();
}

void GltfFilm::record()
{
	const Simulation& s = m_simulation;
	Frame frame = {s.time(), {}, {}, {}, {}, {}};
	for (size_t i = 0; i < s.scene().bodies.size(); ++i)
	{
		frame.poses.push_back(s.poseOf(int(i)));
		frame.areThere.push_back(s.isThere(int(i)));
	}
	for (const Simulation::Wheel& wheel : s.wheels())
		frame.wheels.push_back(wheel.pose);
	for (size_t i = 0; i < s.scene().joints.size(); ++i)
	{
		const auto& bodies = s.scene().joints[i].bodies;
		const bool isHeld = s.joint(int(i)) && !s.isCut(int(i));
		frame.utilisations.push_back(isHeld ? float(readJoint(s.world(), *s.joint(int(i))).utilisation) : 0);
		frame.areWhole.push_back(isHeld && !s.isBroken(int(i)) &&
								 std::all_of(bodies, bodies + 2,
											 [&](int body)
											 { return body == SceneDescription::WORLD || s.isThere(body); }));
	}
	m_frames.push_back(frame);
}

/// Makes the file's model: bodies are the first nodes, in their order, then come joints, then what bends members, then wheels.
class GltfFilm::Model
{
public:
	Model(const Simulation& simulation, const std::vector<Frame>& frames)
		: m_simulation(simulation), m_frames(frames), m_bends(bendsIn(simulation, frames)), m_writer(m_model)
	{
		m_model.asset.version = "2.0";
		m_model.asset.generator = "Bullet Elastic-Plastic";
		std::vector<float> times;
		for (const Frame& frame : frames)
			times.push_back(float(frame.time));
		m_times = m_writer.add(times, 1);
		for (size_t i = 0; i < frames.front().poses.size(); ++i)
			addBody(i);
		for (size_t i = 0; i < frames.front().utilisations.size(); ++i)
			addJoint(i);
		for (const Bend& bend : m_bends)
			addBend(bend);
		for (size_t i = 0; i < frames.front().wheels.size(); ++i)
			addWheel(i);
		addScene();
	}

	bool write(const std::string& file)
	{
		// Its function for files does not tell whether it could write.
		std::ofstream stream(file, std::ios::binary);
		tinygltf::TinyGLTF().WriteGltfSceneToStream(&m_model, stream, false, true);
		stream.close();
		return bool(stream);
	}

private:
	/// How a member is bent: its ends in the frame of its body, picture by picture; none: the end goes with the body.
	struct Bend
	{
		Member member;
		std::vector<btTransform> ends[2];
	};

	/// Members come in the order of their bodies.
	struct Order
	{
		bool operator()(const Bend& bend, int body) const { return bend.member.body < body; }
		bool operator()(int body, const Bend& bend) const { return body < bend.member.body; }
	};

	const SceneDescription& scene() const { return m_simulation.scene(); }

	/// Of those members that are bent at all.
	static std::vector<Bend> bendsIn(const Simulation& simulation, const std::vector<Frame>& frames)
	{
		const SceneDescription& scene = simulation.scene();
		const std::vector<Member> members = membersOf(scene);
		std::vector<bool> areMembers(scene.bodies.size());
		for (const Member& member : members)
			areMembers[size_t(member.body)] = true;
		std::vector<Bend> bends;
		for (const Member& member : members)
		{
			Bend bend = {member, {}};
			for (int end = 0; end < 2; ++end)
				if (member.joints[end] != Member::NONE)
				{
					const int other = otherBodyOf(scene, member, end);
					bend.ends[end] = endsOver(scene, member, end,
											  other != SceneDescription::WORLD && areMembers[size_t(other)], frames);
				}
			if (!bend.ends[0].empty() || !bend.ends[1].empty())
				bends.push_back(bend);
		}
		return bends;
	}

	/// \return empty: it never goes far from where it is without load; a turn is measured over the member's length
	static std::vector<btTransform> endsOver(const SceneDescription& scene, const Member& member, int end,
											 bool isOtherMember, const std::vector<Frame>& frames)
	{
		const btVector3& size = scene.bodies[size_t(member.body)].shape.size;
		const btTransform straight = straightEndOf(scene, member, end);
		std::vector<btTransform> ends;
		btTransform last = straight;
		btScalar furthest = 0;
		for (const Frame& frame : frames)
		{
			// What has torn stays bent.
			if (frame.areWhole[size_t(member.joints[end])])
				last = endOf(scene, member, end, isOtherMember, frame.poses);
			ends.push_back(last);
			const btTransform moved = last * straight.inverse();
			for (int corner = 0; corner < 8; ++corner)
			{
				const btVector3 place =
					size / 2 * btVector3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
				furthest = btMax(furthest, (moved * place).distance(place));
			}
		}
		if (furthest < BENT * size[member.axis])
			ends.clear();
		return ends;
	}

	void addBody(size_t i)
	{
		tinygltf::Node node;
		node.name = scene().bodies[i].name;
		if (!std::binary_search(m_bends.begin(), m_bends.end(), int(i), Order()))
			node.mesh = addMesh(m_model, m_writer, scene().bodies[i], trianglesOf(scene().bodies[i].shape));
		setPose(node, m_frames.front().poses[i]);
		m_model.nodes.push_back(node);
		if (scene().bodies[i].motion != SceneDescription::Motion::Static)
			addTracks(int(i), i, [i](const Frame& frame) { return frame.poses[i]; });
	}

	void addWheel(size_t i)
	{
		const Simulation::Wheel wheel = m_simulation.wheels()[i];
		SceneDescription::Body body;
		body.name = wheel.name;
		body.colour.setValue(btScalar(.028), btScalar(.028), btScalar(.03));
		tinygltf::Node node;
		node.name = wheel.name;
		node.mesh = addMesh(m_model, m_writer, body, trianglesOf(wheel.shape));
		setPose(node, m_frames.front().wheels[i]);
		m_rootNodes.push_back(int(m_model.nodes.size()));
		m_model.nodes.push_back(node);
		addTracks(m_rootNodes.back(), size_t(wheel.body), [i](const Frame& frame) { return frame.wheels[i]; });
	}

	/// \param body    with which it comes and goes
	/// \param poseIn  a frame
	template <class PoseIn>
	void addTracks(int node, size_t body, PoseIn poseIn)
	{
		Track track;
		std::vector<float> scales;
		bool isAlwaysThere = true;
		for (const Frame& frame : m_frames)
		{
			track.add(poseIn(frame));
			const btScalar scale = frame.areThere[body] ? btScalar(1) : btScalar(0);
			append(scales, btVector3(scale, scale, scale));
			isAlwaysThere &= frame.areThere[body];
		}
		addPoses(node, track);
		// What is not in the world has no size: it comes and goes at once.
		if (!isAlwaysThere)
			addTrack(m_animation, node, "scale", "STEP", m_times, m_writer.add(scales, 3));
	}

	void addPoses(int node, const Track& track)
	{
		addTrack(m_animation, node, "translation", "LINEAR", m_times, m_writer.add(track.places, 3));
		addTrack(m_animation, node, "rotation", "LINEAR", m_times, m_writer.add(track.turns, 4));
	}

	/// A skin between bones: one that stays with the body, and one at each end that is bent.
	void addBend(const Bend& bend)
	{
		const SceneDescription::Body& body = scene().bodies[size_t(bend.member.body)];
		tinygltf::Skin skin;
		skin.name = body.name;
		std::vector<float> inverses;
		unsigned char bones[2] = {0, 0};
		addBone(skin, inverses, bend.member.body, btTransform::getIdentity());
		for (int end = 0; end < 2; ++end)
			if (!bend.ends[end].empty())
			{
				bones[end] = (unsigned char)(skin.joints.size());
				addBone(skin, inverses, bend.member.body, straightEndOf(scene(), bend.member, end));
				Track track;
				for (const btTransform& pose : bend.ends[end])
					track.add(pose);
				addPoses(skin.joints.back(), track);
			}
		skin.inverseBindMatrices = m_writer.add(inverses, 16);
		m_model.skins.push_back(skin);
		tinygltf::Node node;
		node.name = body.name + "/bent";
		node.mesh = addBentMesh(bend.member, bones);
		node.skin = int(m_model.skins.size()) - 1;
		m_model.nodes.push_back(node);
		m_rootNodes.push_back(int(m_model.nodes.size()) - 1);
	}

	void addBone(tinygltf::Skin& skin, std::vector<float>& inverses, int body, const btTransform& pose)
	{
		tinygltf::Node node;
		node.name = scene().bodies[size_t(body)].name + "/bone-" + std::to_string(skin.joints.size());
		setPose(node, pose);
		btScalar inverse[16];
		pose.inverse().getOpenGLMatrix(inverse);
		inverses.insert(inverses.end(), inverse, inverse + 16);
		skin.joints.push_back(int(m_model.nodes.size()));
		m_model.nodes[size_t(body)].children.push_back(int(m_model.nodes.size()));
		m_model.nodes.push_back(node);
	}

	/// \param bones  of the ends; 0: the body's
	int addBentMesh(const Member& member, const unsigned char (&bones)[2])
	{
		const SceneDescription::Body& body = scene().bodies[size_t(member.body)];
		const MemberSurface surface = surfaceOf(member, body.shape.size);
		std::vector<unsigned char> joints;
		std::vector<float> weights;
		for (btScalar share : surface.shares)
		{
			const unsigned char bone = bones[share > 0];
			const float weight = bone > 0 ? std::fabs(float(share)) : 0;
			joints.insert(joints.end(), {0, (unsigned char)(weight > 0 ? bone : 0), 0, 0});
			weights.insert(weights.end(), {1 - weight, weight, 0, 0});
		}
		const int mesh = addMesh(m_model, m_writer, body, surface.triangles);
		auto& attributes = m_model.meshes[size_t(mesh)].primitives[0].attributes;
		attributes["JOINTS_0"] = m_writer.addJoints(joints);
		attributes["WEIGHTS_0"] = m_writer.add(weights, 4, TINYGLTF_TARGET_ARRAY_BUFFER);
		return mesh;
	}

	void addJoint(size_t i)
	{
		const SceneDescription::Joint& joint = scene().joints[i];
		const size_t body = size_t(joint.bodies[joint.bodies[1] == SceneDescription::WORLD ? 0 : 1]);
		tinygltf::Node node;
		// A joint may have the name of a body, which then has it in Blender, too.
		node.name = joint.name + "/joint";
		setPose(node, scene().bodies[body].pose.inverse() * joint.frame);
		std::vector<double> used;
		for (const Frame& frame : m_frames)
			used.push_back(double(frame.utilisations[i]));
		Value::Object extras;
		extras["joint"] = Value(joint.name);
		extras["utilisation"] = listOf(used);
		extras["is_broken"] = Value(m_simulation.isBroken(int(i)));
		node.extras = Value(extras);
		m_model.nodes[body].children.push_back(int(m_model.nodes.size()));
		m_model.nodes.push_back(node);
	}

	void addScene()
	{
		tinygltf::Scene root;
		root.name = m_animation.name = scene().title;
		for (size_t i = 0; i < m_frames.front().poses.size(); ++i)
			root.nodes.push_back(int(i));
		root.nodes.insert(root.nodes.end(), m_rootNodes.begin(), m_rootNodes.end());
		std::vector<double> times;
		for (const Frame& frame : m_frames)
			times.push_back(frame.time);
		Value::Object extras;
		extras["times_s"] = listOf(times);
		extras["events"] = eventsOf(m_simulation);
		root.extras = Value(extras);
		m_model.scenes.push_back(root);
		m_model.defaultScene = 0;
		if (!m_animation.channels.empty())
			m_model.animations.push_back(m_animation);
	}

	const Simulation& m_simulation;
	const std::vector<Frame>& m_frames;
	const std::vector<Bend> m_bends;
	std::vector<int> m_rootNodes;  // beside bodies: meshes with a skin, and wheels
	tinygltf::Model m_model;
	BufferWriter m_writer;
	tinygltf::Animation m_animation;
	int m_times;  // accessor
};

void GltfFilm::write(const std::string& file) const
{
	if (!Model(m_simulation, m_frames).write(file))
		throw std::runtime_error("cannot write '" + file +
								 "' (--export): is its folder there, and may it be written to?");
}
}  // namespace ep
