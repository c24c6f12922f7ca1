// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_OUTPUT_FILES_H
#define EP_OUTPUT_FILES_H

#include <string>

namespace ep
{
// All throw std::runtime_error that names what could not be made.

void makeDirectory(const std::string& directory);

void writeText(const std::string& file, const std::string& text);

/// \return the file, directory/name
std::string writeFile(const std::string& directory, const std::string& name, const std::string& text);
/// Does nothing where there is no such file.
void removeFile(const std::string& directory, const std::string& name);
}  // namespace ep

#endif  // EP_OUTPUT_FILES_H
