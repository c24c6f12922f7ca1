// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "collect/Records.h"

#include <algorithm>
#include <filesystem>

namespace ep
{
namespace fs = std::filesystem;
using nlohmann::json;

Records readRecords(const std::string& folder)
{
	std::vector<fs::path> files;
	for (const auto& entry : fs::directory_iterator(folder))
		if (entry.path().extension() == ".json")
			files.push_back(entry.path());
	std::sort(files.begin(), files.end());
	Records all;
	for (const fs::path& file : files)
		try
		{
			const json list = readJson(file.string());
			if (!list.is_array())
				throw std::runtime_error("it is " + shown(list));
			const bool ofTrials = !list.empty() && list[0].is_object() && list[0].contains("trial");
			for (const Record& record : ofTrials ? std::vector<Record>() : fromJson(Record::columns(), list))
				all.ofProblems.push_back(record);
			for (const TrialRecord& record :
				 ofTrials ? fromJson(TrialRecord::columns(), list) : std::vector<TrialRecord>())
				all.ofTrials.push_back(record);
		}
		catch (const std::exception& error)
		{
			throw std::runtime_error("'" + file.string() + "' is no list of records (" + error.what() +
									 "): delete it, and it is computed again");
		}
	return all;
}
}  // namespace ep
