// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_COLUMN_H
#define EP_REPORT_COLUMN_H

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "json/JsonFile.h"
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

/// A text that is written as it is.
template <class Record>
Column<Record> column(const char* name, std::string Record::*field)
{
	return {name, [field](const Record& record) { return nlohmann::json(record.*field); },
			[field](Record& record, const nlohmann::json& json)
			{
				if (!json.is_string())
					throw std::runtime_error("is " + shown(json) + "; it must be a text");
				record.*field = json.get<std::string>();
			}};
}

/// A text that also names files: it cannot lead to another folder.
template <class Record>
Column<Record> fileName(const char* name, std::string Record::*field)
{
	Column<Record> text = column(name, field);
	text.read = [field, read = text.read](Record& record, const nlohmann::json& json)
	{
		read(record, json);
		const std::string& given = record.*field;
		const auto isPlain = [](char c)
		{ return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-'; };
		if (given.empty() || given.size() > 64 || !std::all_of(given.begin(), given.end(), isPlain))
			throw std::runtime_error("is " + shown(given) + "; it must be 1 to 64 letters, digits and hyphens");
	};
	return text;
}

/// A number from low to high.
template <class Record, class Number>
Column<Record> column(const char* name, Number Record::*field, Number low, Number high)
{
	return {name, [field](const Record& record) { return nlohmann::json(record.*field); },
			[field, low, high](Record& record, const nlohmann::json& json)
			{
				const bool isRight = std::is_integral<Number>::value ? json.is_number_integer() : json.is_number();
				if (!isRight || !(json.get<double>() >= double(low) && json.get<double>() <= double(high)))
					throw std::runtime_error("is " + shown(json) + "; it must be a " +
											 (std::is_integral<Number>::value ? "whole " : "") + "number from " +
											 nlohmann::json(low).dump() + " to " + nlohmann::json(high).dump());
				record.*field = json.get<Number>();
			}};
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
			{
				if (!json.is_number() && !json.is_null())
					throw std::runtime_error("is " + shown(json) + "; it must be a number or null");
				record.*field = json.is_number() ? json.get<double>() : none;
			}};
}

/// One of several things that have names.
template <class Record, class Value>
Column<Record> column(const char* name, Value Record::*field, const std::vector<Named<Value>>& choices)
{
	return {name, [field, &choices](const Record& record) { return nlohmann::json(nameOf(choices, record.*field)); },
			[field, &choices](Record& record, const nlohmann::json& json)
			{
				const Value* const value = json.is_string() ? findNamed(choices, json.get<std::string>()) : nullptr;
				if (!value)
				{
					std::string all;
					for (const Named<Value>& choice : choices)
						all += (all.empty() ? "" : ", ") + std::string(choice.name);
					throw std::runtime_error("is " + shown(json) + "; it must be one of " + all);
				}
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

/// Throws std::runtime_error naming record, column and what would be right.
template <class Record>
std::vector<Record> fromJson(const std::vector<Column<Record>>& columns, const nlohmann::json& list)
{
	std::vector<Record> records;
	for (const nlohmann::json& line : list)
	{
		records.emplace_back();
		const std::string where = "record " + std::to_string(records.size());
		if (!line.is_object())
			throw std::runtime_error(where + " is " + shown(line) + "; it must be an object");
		for (const Column<Record>& c : columns)
			try
			{
				if (!line.contains(c.name))
					throw std::runtime_error("is missing");
				c.read(records.back(), line.at(c.name));
			}
			catch (const std::exception& error)
			{
				throw std::runtime_error(where + ": " + c.name + " " + error.what());
			}
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
