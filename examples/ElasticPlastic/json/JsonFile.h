// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_JSON_FILE_H
#define EP_JSON_FILE_H

#include <nlohmann/json.hpp>
#include <string>

namespace ep
{
const int DEEPEST = 16;

/// Whether a name leads to a file that ends, links included: opening a pipe that nobody writes to waits for ever.
bool isRegularFile(const std::string& file);

/// Reads a file that anybody may have written. Lists and objects may be within each other up to DEEPEST levels: many of the
/// library's functions call themselves once per level.
/// Throws std::runtime_error that tells what is wrong, but not in which file: the caller knows what it is for.
nlohmann::json readJson(const std::string& file);

/// What a value is, for messages: a number or short text as it is, else its kind and size.
std::string shown(const nlohmann::json& value);
std::string shown(const std::string& text);
}  // namespace ep

#endif  // EP_JSON_FILE_H
