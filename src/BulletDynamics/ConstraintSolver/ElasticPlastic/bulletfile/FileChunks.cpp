// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "FileChunks.h"

#include <string.h>

#include "LinearMath/btSerializer.h"

namespace btElasticPlastic
{
namespace
{
/// "BULLETf-v324": precision, size of pointers, order of bytes, version.
const size_t HEADER_SIZE = 12;

bool hasOwnHeader(const unsigned char* file, size_t size)
{
	const unsigned one = 1;
	unsigned char first;
	memcpy(&first, &one, 1);
	return size >= HEADER_SIZE && memcmp(file, "BULLET", 6) == 0 && (file[6] == 'f' || file[6] == 'd') &&
		   file[7] == (sizeof(void*) == 8 ? '-' : '_') && file[8] == (first == 1 ? 'v' : 'V');
}
}  // namespace

btElasticPlasticFault findChunks(const unsigned char* file, size_t size, std::vector<FileChunk>& chunks)
{
	chunks.clear();
	if (!hasOwnHeader(file, size))
		return btElasticPlasticFault("size of the file's header", btScalar(size < HEADER_SIZE ? size : HEADER_SIZE),
									 "12, of a file of Bullet's written by a machine of this kind");
	size_t place = HEADER_SIZE;
	while (size - place >= sizeof(btChunk))
	{
		btChunk header;
		memcpy(&header, file + place, sizeof header);
		place += sizeof header;
		if (header.m_length < 0 || size_t(header.m_length) > size - place)
			break;
		chunks.push_back({header.m_chunkCode, file + place, size_t(header.m_length), header.m_oldPtr});
		place += size_t(header.m_length);
		// The description of all types comes last.
		if (header.m_chunkCode == BT_DNA_CODE)
			return btElasticPlasticFault();
	}
	return btElasticPlasticFault("number of whole chunks in the file", btScalar(chunks.size()),
								 "all, to the one with the types' description");
}
}  // namespace btElasticPlastic
