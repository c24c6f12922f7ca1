// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "collect/Records.h"

#include <algorithm>
#include <filesystem>

namespace ep
{
namespace fs = std::filesystem;
using nlohmann::json;

Records readRecords(const std::string& file)
{
	try
	{
		const json list = readJson(file);
		if (!list.is_array())
			throw std::runtime_error("it is " + shown(list));
		const bool ofTrials = !list.empty() && list[0].is_object() && list[0].contains("trial");
		if (ofTrials)
			return {{}, fromJson(TrialRecord::columns(), list)};
		return {fromJson(Record::columns(), list), {}};
	}
	catch (const std::exception& error)
	{
		throw std::runtime_error("'" + file + "' is no list of records (" + error.what() +
								 "): delete it, and it is computed again");
	}
}

Records readAllRecords(const std::string& folder)
{
	std::vector<fs::path> files;
	for (const auto& entry : fs::directory_iterator(folder))
		if (entry.path().extension() == ".json")
			files.push_back(entry.path());
	std::sort(files.begin(), files.end());
	Records all;
	for (const fs::path& file : files)
	{
		const Records own = readRecords(file.string());
		all.ofProblems.insert(all.ofProblems.end(), own.ofProblems.begin(), own.ofProblems.end());
		all.ofTrials.insert(all.ofTrials.end(), own.ofTrials.begin(), own.ofTrials.end());
	}
	return all;
}
}  // namespace ep
