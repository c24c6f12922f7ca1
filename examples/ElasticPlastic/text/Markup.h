// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_MARKUP_H
#define EP_MARKUP_H

#include <string>

namespace ep
{
/// Any text as HTML or SVG show it, between tags and in attributes.
inline std::string escaped(const std::string& text)
{
	std::string out;
	for (const char c : text)
		switch (c)
		{
			case '&':
				out += "&amp;";
				break;
			case '<':
				out += "&lt;";
				break;
			case '>':
				out += "&gt;";
				break;
			case '"':
				out += "&quot;";
				break;
			default:
				out += c;
		}
	return out;
}
}  // namespace ep

#endif  // EP_MARKUP_H
