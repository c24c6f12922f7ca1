// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JointBlock.h"

#include <stdio.h>
#include <string.h>

#include <algorithm>

#include "../../btElasticPlasticJoint.h"
#include "../joint/JointWorks.h"
#include "LinearMath/btSerializer.h"

namespace btElasticPlastic
{
namespace
{
const char BLOCK_MARK[8] = {'b', 't', 'E', 'P', 'j', 'o', 'i', 'n'};
const uint32_t BLOCK_VERSION = 12;

/// Before what a block holds.
struct BlockHeader
{
	char m_mark[sizeof BLOCK_MARK];
	uint32_t m_version, m_size;  ///< of what follows, without what fills the chunk up
	uint64_t m_checksum;
};

/// Puts numbers of Bullet's precision in double, so that a program of the other one can read them.
template <class Archive>
struct InDouble
{
	Archive& m_archive;

	void operator()(btScalar& value)
	{
		double number = double(value);
		m_archive(number);
		value = btScalar(number);
	}
	template <size_t N>
	void operator()(btScalar (&values)[N])
	{
		for (btScalar& value : values)
			(*this)(value);
	}
	template <class T>
	void operator()(T& value)
	{
		m_archive(value);
	}
	template <class List>
	size_t list(List& elements)
	{
		return m_archive.list(elements);
	}
};

/// \return how long it is
size_t writeBody(JointBlock& block, unsigned char* buffer, size_t capacity)
{
	Writer writer(buffer, capacity);
	InDouble<Writer> archive = {writer};
	transfer(archive, block);
	return writer.getSize();
}
}  // namespace

JointBlock JointBlock::of(const JointWorks& joint)
{
	const JointModel& model = joint.m_model;
	JointBlock block;
	block.m_type = model.m_constraint.getConstraintType();
	block.m_frames[0] = model.m_frameInA;
	block.m_frames[1] = model.m_frameInB;
	block.m_capacity = model.m_capacity;
	block.m_state = model.m_state;
	for (int q = 0; q < BT_EP_QUANTITY_COUNT; ++q)
		block.m_levels[q] = joint.m_levels.get(btElasticPlasticQuantity(q));
	block.m_isPaper = model.m_isPaper;
	block.m_isByMode = model.m_isByMode;
	std::copy_n(joint.m_step.getLastBounds(), int(BT_EP_DOF_COUNT), block.m_lastBounds);
	block.m_lastFibreBounds = joint.m_step.getLastFibreBounds();
	block.m_userType = model.m_constraint.getUserConstraintType();
	block.m_userId = model.m_constraint.getUserConstraintId();
	snprintf(block.m_name, sizeof block.m_name, "%s", joint.m_joint.getName());
	return block;
}

btElasticPlasticFault JointBlock::give(JointWorks& joint) const
{
	btElasticPlasticJoint& face = joint.m_joint;
	joint.m_model.m_isPaper = m_isPaper;
	joint.m_model.m_isByMode = m_isByMode;
	if (!face.setCapacity(m_capacity))
		return joint.m_model.m_fault;
	if (const btElasticPlasticFault fault = joint.m_model.findStateFault(m_state))
		return fault;
	joint.m_model.m_state = m_state;
	for (int q = 0; q < BT_EP_QUANTITY_COUNT; ++q)
	{
		// What is unlimited in double is more than that in float.
		const bool isMore =
			btElasticPlasticIsNumber(m_levels[q]) && m_levels[q] > btElasticPlasticCapacity::unlimited();
		if (!face.setLevel(btElasticPlasticQuantity(q), isMore ? btElasticPlasticCapacity::unlimited() : m_levels[q]))
			return btElasticPlasticFault("level of a quantity", m_levels[q], "greater than 0");
	}
	if (!areBounds(m_lastBounds, m_lastFibreBounds, m_capacity))
		return btElasticPlasticFault("number of bounds of fibres", btScalar(m_lastFibreBounds.size()),
									 "not above that of fibres, each of them -1, 0 or 1");
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		joint.m_step.setLastBound(dof, m_lastBounds[dof]);
	joint.m_step.setLastFibreBounds(m_lastFibreBounds);
	face.setName(m_name);
	joint.m_model.m_constraint.setUserConstraintType(m_userType);
	joint.m_model.m_constraint.setUserConstraintId(m_userId);
	return btElasticPlasticFault();
}

std::vector<unsigned char> JointBlock::write() const
{
	JointBlock block = *this;
	BlockHeader header;
	memcpy(header.m_mark, BLOCK_MARK, sizeof BLOCK_MARK);
	header.m_version = BLOCK_VERSION;
	header.m_size = uint32_t(writeBody(block, nullptr, 0));
	// Bullet's chunks begin where numbers may.
	std::vector<unsigned char> bytes((sizeof header + header.m_size + 15) / 16 * 16);
	writeBody(block, bytes.data() + sizeof header, header.m_size);
	header.m_checksum = checksumOf(bytes.data() + sizeof header, header.m_size);
	memcpy(bytes.data(), &header, sizeof header);
	return bytes;
}

bool JointBlock::isIn(const FileChunk& chunk)
{
	return chunk.m_code == BT_ARRAY_CODE && chunk.m_size >= sizeof BLOCK_MARK &&
		   memcmp(chunk.m_data, BLOCK_MARK, sizeof BLOCK_MARK) == 0;
}

btElasticPlasticFault JointBlock::read(const FileChunk& chunk)
{
	BlockHeader header = {};
	if (chunk.m_size >= sizeof header)
		memcpy(&header, chunk.m_data, sizeof header);
	if (header.m_version != BLOCK_VERSION)
		return btElasticPlasticFault("version of a joint in the file", btScalar(header.m_version),
									 "the one that this library writes");
	const unsigned char* const body = chunk.m_data + sizeof header;
	if (header.m_size > chunk.m_size - sizeof header || checksumOf(body, header.m_size) != header.m_checksum)
		return btElasticPlasticFault("length of a joint in the file [bytes]", btScalar(header.m_size),
									 "that of what was written, and what was written");
	Reader reader(body, header.m_size);
	InDouble<Reader> archive = {reader};
	transfer(archive, *this);
	m_name[sizeof m_name - 1] = 0;
	if (!reader.isComplete())
		return btElasticPlasticFault("length of a joint in the file [bytes]", btScalar(header.m_size),
									 "that of what it holds");
	return btElasticPlasticFault();
}
}  // namespace btElasticPlastic
