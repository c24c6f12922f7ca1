// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FILE_CHUNKS_H
#define BT_ELASTIC_PLASTIC_FILE_CHUNKS_H

#include <stddef.h>

#include <vector>

#include "../../btElasticPlasticFault.h"

namespace btElasticPlastic
{
/// A part of a file of Bullet's.
struct FileChunk
{
	int m_code;  ///< BT_CONSTRAINT_CODE and others of btSerializer.h
	const unsigned char* m_data;
	size_t m_size;
	const void* m_id;  ///< by which other chunks name it
};

/// Finds the chunks of a file of Bullet's that this kind of machine has written, in their order.
/// \return a fault if it is none, or not whole
btElasticPlasticFault findChunks(const unsigned char* file, size_t size, std::vector<FileChunk>& chunks);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_FILE_CHUNKS_H
