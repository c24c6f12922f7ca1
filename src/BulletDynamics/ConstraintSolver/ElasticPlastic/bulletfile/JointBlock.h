// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_BLOCK_H
#define BT_ELASTIC_PLASTIC_JOINT_BLOCK_H

#include <vector>

#include "../../btElasticPlasticCapacity.h"
#include "../../btElasticPlasticEvent.h"
#include "../../btElasticPlasticState.h"
#include "../snapshot/WorldImage.h"
#include "FileChunks.h"
#include "LinearMath/btTransform.h"

namespace btElasticPlastic
{
class JointWorks;

/// What a file of Bullet's holds of a joint beside the constraint of Bullet's class.
struct JointBlock
{
	int m_type = 0;  ///< btTypedConstraintType
	btTransform m_frames[2];
	btElasticPlasticCapacity m_capacity;
	btElasticPlasticState m_state;
	btScalar m_levels[BT_EP_QUANTITY_COUNT] = {};
	bool m_isPaper = false, m_isByMode = false;
	signed char m_lastBounds[BT_EP_DOF_COUNT] = {};  ///< with which the next step's search begins, and those of fibres
	std::vector<signed char> m_lastFibreBounds;
	int m_userType = -1, m_userId = -1;
	char m_name[32] = {};

	static JointBlock of(const JointWorks& joint);

	/// Gives a new joint all of this but its type and its frames.
	/// \return a fault, and the joint is of no use, if it cannot be such a one
	btElasticPlasticFault give(JointWorks& joint) const;

	std::vector<unsigned char> write() const;

	/// Whether a chunk is such a block, whole or not.
	static bool isIn(const FileChunk& chunk);

	/// \return a fault if it is not whole or of another version
	btElasticPlasticFault read(const FileChunk& chunk);
};
template <class Archive>
void transfer(Archive& archive, JointBlock& block)
{
	archive(block.m_type);
	for (btTransform& frame : block.m_frames)
		transfer(archive, frame);
	transfer(archive, block.m_capacity);
	transfer(archive, block.m_state);
	transfer(archive, block.m_levels);
	archive(block.m_isPaper);
	archive(block.m_isByMode);
	transfer(archive, block.m_lastBounds);
	transferNumbers(archive, block.m_lastFibreBounds);
	archive(block.m_userType);
	archive(block.m_userId);
	transfer(archive, block.m_name);
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINT_BLOCK_H
