// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_PREFETCH_H
#define BT_ELASTIC_PLASTIC_PREFETCH_H

#include <stddef.h>

namespace btElasticPlastic
{
/// The number of joints ahead of the present one whose data is prefetched: those of a world do not fit the processor's cache, be they
/// one structure's or many's.
const int PREFETCH_AHEAD = 2;

/// Has the processor load what is between two places of an object into its cache before it is used.
inline void prefetch(const void* from, const void* to)
{
#if defined(__GNUC__)
	const size_t cacheLine = 64;
	for (const char* line = static_cast<const char*>(from); line < to; line += cacheLine)
		__builtin_prefetch(line);
	// Else GCC takes what does nothing but this for a function without effect, and leaves out its calls.
	__asm__ volatile("");
#else
	(void)from;
	(void)to;
#endif
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_PREFETCH_H
