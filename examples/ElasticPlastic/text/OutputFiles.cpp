// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "text/OutputFiles.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace ep
{
void makeDirectory(const std::string& directory)
{
	std::error_code error;
	std::filesystem::create_directories(directory, error);
	if (error)
		throw std::runtime_error("cannot make the directory '" + directory + "' (--out): " + error.message());
}

void writeText(const std::string& file, const std::string& text)
{
	std::ofstream out(file);
	out << text;
	out.close();
	if (!out)
		throw std::runtime_error("cannot write '" + file + "': is its folder there, and may it be written to?");
}

std::string writeFile(const std::string& directory, const std::string& name, const std::string& text)
{
	const std::string file = (std::filesystem::path(directory) / name).string();
	writeText(file, text);
	return file;
}

void removeFile(const std::string& directory, const std::string& name)
{
	const std::filesystem::path file = std::filesystem::path(directory) / name;
	std::error_code error;
	std::filesystem::remove(file, error);
	if (error)
		throw std::runtime_error("cannot remove '" + file.string() + "': " + error.message());
}
}  // namespace ep
