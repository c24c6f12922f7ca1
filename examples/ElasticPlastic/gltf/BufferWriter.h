// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BUFFER_WRITER_H
#define EP_BUFFER_WRITER_H

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <vector>

namespace ep
{
/// Numbers in the file's one buffer, in groups of some components.
class BufferWriter
{
public:
	explicit BufferWriter(tinygltf::Model& model) : m_model(model) { m_model.buffers.emplace_back(); }

	/// \return the accessor
	int add(const std::vector<float>& numbers, int components, int target = 0)
	{
		static const std::map<int, int> types = {
			{1, TINYGLTF_TYPE_SCALAR}, {3, TINYGLTF_TYPE_VEC3}, {4, TINYGLTF_TYPE_VEC4}, {16, TINYGLTF_TYPE_MAT4}};
		tinygltf::Accessor& accessor =
			add(numbers.data(), numbers.size() * sizeof(float), numbers.size() / size_t(components),
				TINYGLTF_COMPONENT_TYPE_FLOAT, types.at(components), target);
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
		return int(m_model.accessors.size()) - 1;
	}

	/// The joints of a skin that a corner follows, four of each.
	int addJoints(const std::vector<unsigned char>& joints)
	{
		add(joints.data(), joints.size(), joints.size() / 4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4,
			TINYGLTF_TARGET_ARRAY_BUFFER);
		return int(m_model.accessors.size()) - 1;
	}

	/// The corners of triangles, by their numbers.
	int addCorners(const std::vector<unsigned short>& corners)
	{
		add(corners.data(), corners.size() * sizeof corners[0], corners.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
			TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
		return int(m_model.accessors.size()) - 1;
	}

private:
	tinygltf::Accessor& add(const void* values, size_t bytes, size_t count, int component, int type, int target)
	{
		std::vector<unsigned char>& data = m_model.buffers[0].data;
		tinygltf::BufferView view;
		view.buffer = 0;
		view.byteOffset = data.size();
		view.byteLength = bytes;
		view.target = target;
		// The next one begins at a whole number of its components.
		data.resize((data.size() + bytes + 3) / 4 * 4);
		if (bytes > 0)
			std::memcpy(&data[view.byteOffset], values, bytes);
		m_model.bufferViews.push_back(view);
		tinygltf::Accessor accessor;
		accessor.bufferView = int(m_model.bufferViews.size()) - 1;
		accessor.componentType = component;
		accessor.type = type;
		accessor.count = count;
		m_model.accessors.push_back(accessor);
		return m_model.accessors.back();
	}

	tinygltf::Model& m_model;
};
}  // namespace ep

#endif  // EP_BUFFER_WRITER_H
