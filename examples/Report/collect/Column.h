// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_COLUMN_H
#define EP_REPORT_COLUMN_H

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "text/Named.h"

namespace ep
{
/// A column of a list of records: its name in files, and how a record's field is written and read.
template <class Record>
struct Column
{
	const char* name;
	std::function<nlohmann::json(const Record&)> write;
	std::function<void(Record&, const nlohmann::json&)> read;
};

/// A field that is written as it is.
template <class Record, class Value>
Column<Record> column(const char* name, Value Record::*field)
{
	return {name, [field](const Record& record) { return nlohmann::json(record.*field); },
			[field](Record& record, const nlohmann::json& json) { record.*field = json.get<Value>(); }};
}

/// A number that may not be there, which is null in files. \param none  what stands for that in a record
template <class Record>
Column<Record> column(const char* name, double Record::*field, double none)
{
	return {name,
			[field, none](const Record& record)
			{
				const double value = record.*field;
				return std::isfinite(value) && value != none ? nlohmann::json(value) : nlohmann::json();
			},
			[field, none](Record& record, const nlohmann::json& json)
			{ record.*field = json.is_number() ? json.get<double>() : none; }};
}

/// One of several things that have names.
template <class Record, class Value>
Column<Record> column(const char* name, Value Record::*field, const std::vector<Named<Value>>& choices)
{
	return {name, [field, &choices](const Record& record) { return nlohmann::json(nameOf(choices, record.*field)); },
			[name, field, &choices](Record& record, const nlohmann::json& json)
			{
				const Value* const value = findNamed(choices, json.get<std::string>());
				if (!value)
					throw std::runtime_error("a record's " + std::string(name) + " is " + json.dump());
				record.*field = *value;
			}};
}

template <class Record>
nlohmann::json toJson(const std::vector<Column<Record>>& columns, const std::vector<Record>& records)
{
	nlohmann::json list = nlohmann::json::array();
	for (const Record& record : records)
	{
		nlohmann::json line;
		for (const Column<Record>& c : columns)
			line[c.name] = c.write(record);
		list.push_back(line);
	}
	return list;
}

template <class Record>
std::vector<Record> fromJson(const std::vector<Column<Record>>& columns, const nlohmann::json& list)
{
	std::vector<Record> records;
	for (const nlohmann::json& line : list)
	{
		records.emplace_back();
		for (const Column<Record>& c : columns)
			c.read(records.back(), line.at(c.name));
	}
	return records;
}

/// With the names as its first line.
template <class Record>
std::string toCsv(const std::vector<Column<Record>>& columns, const std::vector<Record>& records)
{
	std::string csv;
	for (const Column<Record>& c : columns)
		csv += (csv.empty() ? "" : ",") + std::string(c.name);
	for (const Record& record : records)
	{
		const char* before = "\n";
		for (const Column<Record>& c : columns)
		{
			csv += before + c.write(record).dump();
			before = ",";
		}
	}
	return csv + "\n";
}
}  // namespace ep

#endif  // EP_REPORT_COLUMN_H
