// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "run/CaseTable.h"

#include <filesystem>
#include <stdexcept>

#include "json/JsonFile.h"
#include "text/Format.h"

namespace ep
{
namespace
{
namespace fs = std::filesystem;
using nlohmann::json;

const char* const COLUMNS[] = {"ending",           "time_s",           "joints_yielded",   "joints_broken",
							   "kinetic_energy_J", "elastic_energy_J", "plastic_energy_J", "energy_gained_share"};
const char* const OF_PROBE[] = {"last", "least", "most"};

std::string cell(const json& value)
{
	if (value.is_string())
		return value.get<std::string>();
	return value.is_null() ? "" : value.dump();
}
}  // namespace

std::string caseName(size_t index) { return format("case-%06zu", index + 1); }

std::string caseTable(const Variation& variation, const std::string& folder)
{
	std::string head, lines;
	for (size_t i = 0; i < variation.cases.size(); ++i)
	{
		const fs::path file = fs::path(folder) / caseName(i) / "summary.json";
		if (!fs::exists(file))
			continue;
		json summary;
		try
		{
			summary = readJson(file.string());
			std::string line = std::to_string(i + 1), titles = "case";
			for (size_t k = 0; k < variation.paths.size(); ++k)
			{
				line += "," + variation.cases[i][k];
				titles += "," + variation.paths[k];
			}
			for (const char* column : COLUMNS)
			{
				line += "," + cell(summary.at(column));
				titles += std::string(",") + column;
			}
			for (const auto& probe : summary.at("probes").items())
				for (const char* of : OF_PROBE)
				{
					line += "," + cell(probe.value().at(of));
					titles += "," + probe.key() + " " + of;
				}
			head = titles + "\n";
			lines += line + "\n";
		}
		catch (const std::exception& error)
		{
			throw std::runtime_error("'" + file.string() + "' is no summary (" + error.what() +
									 "): delete its folder, and it is computed again");
		}
	}
	return head + lines;
}
}  // namespace ep
