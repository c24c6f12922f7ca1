// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_PREFETCH_H
#define BT_ELASTIC_PLASTIC_PREFETCH_H

#include <stddef.h>

namespace btElasticPlastic
{
/// With more joints than this their data no longer fits the second level of a processor's cache.
const int MANY_JOINTS = 400;

/// The number of joints ahead of the present one whose data is prefetched.
const int PREFETCH_AHEAD = 4;

/// Has the processor load all of an object into its cache before it is used: the joints of a large structure do not fit there.
template <class T>
inline void prefetch(const T& object)
{
#if defined(__GNUC__)
	const size_t cacheLine = 64;
	const char* const begin = reinterpret_cast<const char*>(&object);
	for (size_t i = 0; i < sizeof object; i += cacheLine)
		__builtin_prefetch(begin + i);
#else
	(void)object;
#endif
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_PREFETCH_H
