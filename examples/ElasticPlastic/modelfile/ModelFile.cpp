// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "modelfile/ModelFile.h"

#include <tiny_gltf.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "LinearMath/btTransform.h"
#include "json/JsonFile.h"
#include "text/Format.h"

namespace ep
{
namespace
{
const size_t MOST_BYTES = 100 << 20;  // of a file
const size_t MOST_CORNERS = 3000000;  // of all triangles

typedef std::vector<double> Matrix;  // 4 x 4, column by column, as glTF has it

Matrix product(const Matrix& a, const Matrix& b)
{
	Matrix c(16, 0.);
	for (size_t column = 0; column < 4; ++column)
		for (size_t row = 0; row < 4; ++row)
			for (size_t k = 0; k < 4; ++k)
				c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
	return c;
}

Matrix matrixOf(const tinygltf::Node& node)
{
	if (node.matrix.size() == 16)
		return node.matrix;
	const auto orElse = [](const std::vector<double>& given, const std::vector<double>& none)
	{ return given.size() == none.size() ? given : none; };
	const auto place = orElse(node.translation, {0, 0, 0}), scale = orElse(node.scale, {1, 1, 1}),
			   turn = orElse(node.rotation, {0, 0, 0, 1});
	const btMatrix3x3 basis{btQuaternion(btScalar(turn[0]), btScalar(turn[1]), btScalar(turn[2]), btScalar(turn[3]))};
	Matrix m(16, 0.);
	for (int column = 0; column < 3; ++column)
		for (int row = 0; row < 3; ++row)
			m[size_t(4 * column + row)] = double(basis[row][column]) * scale[size_t(column)];
	std::copy(place.begin(), place.end(), m.begin() + 12);
	m[15] = 1;
	return m;
}

btVector3 placed(const Matrix& m, const float* p)
{
	btVector3 v(0, 0, 0);
	for (size_t row = 0; row < 3; ++row)
		v[int(row)] =
			btScalar(m[row] * double(p[0]) + m[4 + row] * double(p[1]) + m[8 + row] * double(p[2]) + m[12 + row]);
	return v;
}

/// The bytes of an accessor's first value, with all others behind it; null if it is not plain. \param stride  from one value to the next
const unsigned char* bytesOf(const tinygltf::Model& model, int index, size_t& count, size_t& stride)
{
	if (index < 0 || size_t(index) >= model.accessors.size())
		return nullptr;
	const tinygltf::Accessor& accessor = model.accessors[size_t(index)];
	if (accessor.sparse.isSparse || accessor.bufferView < 0 || size_t(accessor.bufferView) >= model.bufferViews.size())
		return nullptr;
	const tinygltf::BufferView& view = model.bufferViews[size_t(accessor.bufferView)];
	const int step = accessor.ByteStride(view);
	if (step <= 0 || view.buffer < 0 || size_t(view.buffer) >= model.buffers.size() || accessor.count == 0)
		return nullptr;
	count = accessor.count;
	stride = size_t(step);
	const auto& data = model.buffers[size_t(view.buffer)].data;
	const size_t size = size_t(tinygltf::GetComponentSizeInBytes(uint32_t(accessor.componentType)) *
							   tinygltf::GetNumComponentsInType(uint32_t(accessor.type))),
				 begin = view.byteOffset + accessor.byteOffset;
	if (begin > data.size() || count > (data.size() - begin) / stride + 1 ||
		begin + (count - 1) * stride + size > data.size())
		return nullptr;
	return &data[begin];
}

/// A corner's number of each corner of triangles. \return false if it is not plain
bool indicesOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive, size_t numCorners,
			   std::vector<size_t>& indices)
{
	if (primitive.indices < 0)
	{
		for (size_t i = 0; i < numCorners; ++i)
			indices.push_back(i);
		return true;
	}
	size_t count = 0, stride = 0;
	const unsigned char* const bytes = bytesOf(model, primitive.indices, count, stride);
	const size_t size = bytes ? size_t(tinygltf::GetComponentSizeInBytes(
									uint32_t(model.accessors[size_t(primitive.indices)].componentType)))
							  : 0;
	if (!bytes || size > 4)
		return false;
	for (size_t i = 0; i < count; ++i)
	{
		uint32_t index = 0;
		std::memcpy(&index, bytes + i * stride, size);  // little-endian, as glTF is
		if (index >= numCorners)
			return false;
		indices.push_back(index);
	}
	return true;
}

/// Corners of a mesh's triangles, three each. \return what is wrong, empty: nothing
std::string trianglesOf(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const Matrix& matrix,
						std::vector<btVector3>& triangles)
{
	for (const tinygltf::Primitive& primitive : mesh.primitives)
	{
		const auto position = primitive.attributes.find("POSITION");
		size_t count = 0, stride = 0;
		const unsigned char* const bytes =
			position == primitive.attributes.end() ? nullptr : bytesOf(model, position->second, count, stride);
		std::vector<size_t> indices;
		if (!bytes || model.accessors[size_t(position->second)].componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
			model.accessors[size_t(position->second)].type != TINYGLTF_TYPE_VEC3 ||
			(primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) ||
			!indicesOf(model, primitive, count, indices))
			return "is not made of plain triangles: export it without compression";
		for (size_t index : indices)
		{
			float place[3];
			std::memcpy(place, bytes + index * stride, sizeof place);
			triangles.push_back(placed(matrix, place));
			for (int i = 0; i < 3; ++i)
				if (!(btFabs(triangles.back()[i]) < btScalar(1e6)))
					return "has a corner that is not within 1000 km";
		}
	}
	return triangles.size() < 3 ? "has no triangles" : "";
}

std::string jsonOf(const tinygltf::Value& value)
{
	if (value.IsString())
		return nlohmann::json(value.Get<std::string>()).dump();
	return value.IsNumber() ? format("%.9g", value.GetNumberAsDouble()) : "";
}

class Reader
{
public:
	explicit Reader(const tinygltf::Model& model) : m_model(model) {}

	std::vector<ModelNode> read()
	{
		std::set<int> inner;
		for (const tinygltf::Node& node : m_model.nodes)
			inner.insert(node.children.begin(), node.children.end());
		Matrix one(16, 0.);
		one[0] = one[5] = one[10] = one[15] = 1;
		for (int i = 0; i < int(m_model.nodes.size()); ++i)
			if (inner.count(i) == 0)
				visit(i, one, 0);
		return std::move(m_nodes);
	}

private:
	void visit(int index, const Matrix& parent, int depth)
	{
		const int deepest = 100;
		if (index < 0 || size_t(index) >= m_model.nodes.size() || depth > deepest || ++m_visits > m_model.nodes.size())
			throw std::runtime_error("has nodes that are no tree");
		const tinygltf::Node& node = m_model.nodes[size_t(index)];
		const Matrix matrix = product(parent, matrixOf(node));
		if (node.mesh >= 0 && size_t(node.mesh) < m_model.meshes.size())
			add(node, m_model.meshes[size_t(node.mesh)], matrix);
		for (int child : node.children)
			visit(child, matrix, depth + 1);
	}

	void add(const tinygltf::Node& node, const tinygltf::Mesh& mesh, const Matrix& matrix)
	{
		ModelNode made;
		made.name = node.name.empty() ? mesh.name : node.name;
		made.fault = trianglesOf(m_model, mesh, matrix, made.triangles);
		m_numCorners += made.triangles.size();
		if (m_numCorners > MOST_CORNERS)
			throw std::runtime_error(format("has more than %zu triangles", MOST_CORNERS / 3));
		const int material = mesh.primitives.empty() ? -1 : mesh.primitives[0].material;
		if (material >= 0 && size_t(material) < m_model.materials.size())
			made.surface = m_model.materials[size_t(material)].name;
		if (node.extras.IsObject())
			for (const std::string& key : node.extras.Keys())
				if (!jsonOf(node.extras.Get(key)).empty())
					made.properties[key] = jsonOf(node.extras.Get(key));
		m_nodes.push_back(std::move(made));
	}

	const tinygltf::Model& m_model;
	std::vector<ModelNode> m_nodes;
	size_t m_visits = 0, m_numCorners = 0;
};

/// What the reader does with files by itself, but for what it takes for one.
tinygltf::FsCallbacks filesThatEnd()
{
	tinygltf::FsCallbacks files{};
	files.FileExists = [](const std::string& file, void*) { return isRegularFile(file); };
	files.ExpandFilePath = &tinygltf::ExpandFilePath;
	files.ReadWholeFile = &tinygltf::ReadWholeFile;
	files.WriteWholeFile = &tinygltf::WriteWholeFile;
	return files;
}
}  // namespace

std::vector<ModelNode> readModelFile(const std::string& file)
{
	std::error_code unknown;
	const auto size = std::filesystem::file_size(file, unknown);
	if (unknown || !isRegularFile(file) || size > MOST_BYTES)
		throw std::runtime_error(unknown || !isRegularFile(file) ? "cannot be read as glTF: is it there, and a file?"
																 : format("is larger than %zu MB", MOST_BYTES >> 20));
	tinygltf::Model model;
	tinygltf::TinyGLTF reader;
	// Pictures of surfaces are of no use here.
	reader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
							 int, void*) { return true; },
						  nullptr);
	// Files that a model names for its points, too.
	reader.SetFsCallbacks(filesThatEnd());
	std::string error, warning;
	const bool isText = file.size() > 5 && file.compare(file.size() - 5, 5, ".gltf") == 0;
	if (!(isText ? reader.LoadASCIIFromFile(&model, &error, &warning, file)
				 : reader.LoadBinaryFromFile(&model, &error, &warning, file)))
	{
		while (!error.empty() && error.back() == '\n')
			error.pop_back();
		throw std::runtime_error("cannot be read as glTF: " + error);
	}
	return Reader(model).read();
}
}  // namespace ep
