// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FORMAT_H
#define EP_FORMAT_H

#include <cstdio>
#include <string>

namespace ep
{
/// As printf() writes it; no more than 255 characters.
template <class... Values>
std::string format(const char* pattern, Values... values)
{
	char text[256];
	std::snprintf(text, sizeof text, pattern, values...);
	return text;
}
}  // namespace ep

#endif  // EP_FORMAT_H
