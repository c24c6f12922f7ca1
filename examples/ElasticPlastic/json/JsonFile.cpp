// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "json/JsonFile.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace ep
{
namespace
{
using nlohmann::json;

const size_t LONGEST = 40;  ///< text in a message [bytes]

/// The first bytes of a text, whole letters of UTF-8 only.
std::string beginningOf(const std::string& text, size_t bytes)
{
	while (bytes > 0 && bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xc0) == 0x80)
		--bytes;
	return text.substr(0, bytes);
}

bool checkDepth(int depth, json::parse_event_t, json&)
{
	if (depth > DEEPEST)
		throw std::runtime_error("it has lists and objects within each other more than " + std::to_string(DEEPEST) +
								 " levels deep");
	return true;
}
}  // namespace

std::string shown(const std::string& text)
{
	// Control characters are escaped, so that a message is a line.
	return json(text.size() > LONGEST ? beginningOf(text, LONGEST) + "..." : text).dump();
}

std::string shown(const json& value)
{
	if (value.is_string())
		return shown(value.get_ref<const std::string&>());
	if (value.is_array())
		return "a list of " + std::to_string(value.size());
	if (value.is_object())
		return "an object with " + std::to_string(value.size()) + " keys";
	return value.dump();
}

bool isRegularFile(const std::string& file)
{
	std::error_code unknown;
	return std::filesystem::is_regular_file(file, unknown);
}

json readJson(const std::string& file)
{
	std::ifstream stream;
	if (isRegularFile(file))
		stream.open(file);
	if (!stream.is_open())
		throw std::runtime_error("it cannot be read: is it there, a file, and may you read it?");
	try
	{
		return json::parse(stream, checkDepth);
	}
	// A syntax error, or a number without bounds. The message repeats what was read last, however long that is.
	catch (const json::exception& error)
	{
		throw std::runtime_error("it is no JSON: " + beginningOf(error.what(), 200));
	}
}
}  // namespace ep
