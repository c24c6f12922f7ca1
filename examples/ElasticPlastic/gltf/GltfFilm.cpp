// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "gltf/GltfFilm.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>

#include "gltf/Triangles.h"
#include "world/JointReading.h"

namespace ep
{
namespace
{
using Value = tinygltf::Value;

/// Numbers in the file's one buffer, in groups of some components.
class Writer
{
public:
	explicit Writer(tinygltf::Model& model) : m_model(model) { m_model.buffers.emplace_back(); }

	/// \return the accessor
	int add(const std::vector<float>& numbers, int components, int target = 0)
	{
		static const std::map<int, int> types = {
			{1, TINYGLTF_TYPE_SCALAR}, {3, TINYGLTF_TYPE_VEC3}, {4, TINYGLTF_TYPE_VEC4}};
		std::vector<unsigned char>& data = m_model.buffers[0].data;
		tinygltf::BufferView view;
		view.buffer = 0;
		view.byteOffset = data.size();
		view.byteLength = numbers.size() * sizeof(float);
		view.target = target;
		data.resize(data.size() + view.byteLength);
		if (!numbers.empty())
			std::memcpy(&data[view.byteOffset], numbers.data(), view.byteLength);
		m_model.bufferViews.push_back(view);
		tinygltf::Accessor accessor;
		accessor.bufferView = int(m_model.bufferViews.size()) - 1;
		accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
		accessor.type = types.at(components);
		accessor.count = numbers.size() / size_t(components);
		// The format asks for the range of places and times.
		for (int i = 0; i < components && accessor.count > 0; ++i)
		{
			float low = numbers[size_t(i)], high = low;
			for (size_t k = size_t(i); k < numbers.size(); k += size_t(components))
			{
				low = std::min(low, numbers[k]);
				high = std::max(high, numbers[k]);
			}
			accessor.minValues.push_back(double(low));
			accessor.maxValues.push_back(double(high));
		}
		m_model.accessors.push_back(accessor);
		return int(m_model.accessors.size()) - 1;
	}

private:
	tinygltf::Model& m_model;
};

void append(std::vector<float>& numbers, const btVector3& v)
{
	for (int i = 0; i < 3; ++i)
		numbers.push_back(float(v[i]));
}

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

int addMesh(tinygltf::Model& model, Writer& writer, const SceneDescription::Body& body)
{
	const Triangles triangles = trianglesOf(body.shape);
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
	const btQuaternion turn = pose.getRotation();
	const btVector3& place = pose.getOrigin();
	node.translation = {double(place.x()), double(place.y()), double(place.z())};
	node.rotation = {double(turn.x()), double(turn.y()), double(turn.z()), double(turn.w())};
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
	Frame frame = {s.time(), {}, {}, {}};
	for (size_t i = 0; i < s.scene().bodies.size(); ++i)
	{
		frame.poses.push_back(s.poseOf(int(i)));
		frame.areThere.push_back(s.isThere(int(i)));
	}
	for (size_t i = 0; i < s.scene().joints.size(); ++i)
		frame.utilisations.push_back(
			s.joint(int(i)) && !s.isCut(int(i)) ? float(readJoint(s.world(), *s.joint(int(i))).utilisation) : 0);
	m_frames.push_back(frame);
}

/// Makes the file's model: bodies are the first nodes, in their order.
class GltfFilm::Model
{
public:
	Model(const Simulation& simulation, const std::vector<Frame>& frames)
		: m_simulation(simulation), m_frames(frames), m_writer(m_model)
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
	const SceneDescription& scene() const { return m_simulation.scene(); }

	void addBody(size_t i)
	{
		tinygltf::Node node;
		node.name = scene().bodies[i].name;
		node.mesh = addMesh(m_model, m_writer, scene().bodies[i]);
		setPose(node, m_frames.front().poses[i]);
		m_model.nodes.push_back(node);
		if (scene().bodies[i].motion != SceneDescription::Motion::Static)
			addTracks(i);
	}

	void addTracks(size_t i)
	{
		std::vector<float> places, turns, scales;
		btQuaternion last = m_frames.front().poses[i].getRotation();
		bool isAlwaysThere = true;
		for (const Frame& frame : m_frames)
		{
			append(places, frame.poses[i].getOrigin());
			// The nearer one of the two that are the same turn: between pictures it
			// is turned the short way.
			btQuaternion turn = frame.poses[i].getRotation();
			turn = turn.dot(last) < 0 ? -turn : turn;
			last = turn;
			append(turns, btVector3(turn.x(), turn.y(), turn.z()));
			turns.push_back(float(turn.w()));
			const btScalar scale = frame.areThere[i] ? btScalar(1) : btScalar(0);
			append(scales, btVector3(scale, scale, scale));
			isAlwaysThere &= frame.areThere[i];
		}
		addTrack(m_animation, int(i), "translation", "LINEAR", m_times, m_writer.add(places, 3));
		addTrack(m_animation, int(i), "rotation", "LINEAR", m_times, m_writer.add(turns, 4));
		// What is not in the world has no size: it comes and goes at once.
		if (!isAlwaysThere)
			addTrack(m_animation, int(i), "scale", "STEP", m_times, m_writer.add(scales, 3));
	}

	void addJoint(size_t i)
	{
		const SceneDescription::Joint& joint = scene().joints[i];
		const size_t body = size_t(joint.bodies[joint.bodies[1] == SceneDescription::WORLD ? 0 : 1]);
		tinygltf::Node node;
		node.name = joint.name;
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
	tinygltf::Model m_model;
	Writer m_writer;
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
