// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/FieldSchema.h"

#include "text/Format.h"

namespace ep
{
namespace
{
using Json = nlohmann::ordered_json;

/// A number, or an expression of parameters.
Json numberType(const Range& range, bool isWhole)
{
	Json type = {{"type", isWhole ? "integer" : "number"}};
	if (range.low > -1e30)
		type[range.isAbove ? "exclusiveMinimum" : "minimum"] = range.low;
	if (range.high < 1e30)
		type["maximum"] = range.high;
	return {{"anyOf", {type, {{"$ref", "#/$defs/expression"}}}}};
}

/// As the author of a default wrote it: in float it has other digits further on.
double shortest(double value) { return std::stod(format("%.6g", value)); }

std::string withUnit(const char* help, const char* unit)
{
	return *unit ? std::string(help) + " [" + unit + "]" : help;
}
}  // namespace

nlohmann::ordered_json FieldSchema::schema() const
{
	Json schema = {{"type", "object"}, {"properties", m_properties}, {"additionalProperties", false}};
	if (!m_required.empty())
		schema["required"] = m_required;
	if (!m_oneOf.empty())
		schema["oneOf"] = m_oneOf;
	return schema;
}

Json FieldSchema::schemaOf(const ReadFields& read)
{
	FieldSchema fields(m_types);
	read(fields);
	return fields.schema();
}

bool FieldSchema::add(const char* key, Json type, const std::string& help, Need need)
{
	type["description"] = help;
	m_properties[key] = std::move(type);
	if (need == Need::Required)
		m_required.push_back(key);
	return false;
}

bool FieldSchema::number(const char* key, double& value, const Range& range, const char* unit, const char* help,
						 Need need)
{
	Json type = numberType(range, false);
	// What stands for never is not the same number in both precisions.
	const double never = 9e17;
	if (need == Need::Optional && value < never)
		type["default"] = shortest(value);
	return add(key, type, withUnit(help, unit), need);
}

bool FieldSchema::whole(const char* key, int& value, int low, int high, const char* help, Need need)
{
	Json type = numberType({double(low), double(high)}, true);
	if (need == Need::Optional)
		type["default"] = value;
	return add(key, type, help, need);
}

bool FieldSchema::flag(const char* key, bool& value, const char* help)
{
	return add(key, {{"type", "boolean"}, {"default", value}}, help, Need::Optional);
}

bool FieldSchema::text(const char* key, std::string&, const char* help, Need need)
{
	return add(key, {{"type", "string"}, {"minLength", 1}, {"maxLength", 200}}, help, need);
}

bool FieldSchema::file(const char* key, std::string&, const char* help)
{
	return add(key, {{"type", "string"}, {"minLength", 1}}, help, Need::Optional);
}

bool FieldSchema::choice(const char* key, size_t& index, const std::vector<std::string>& names, const char* help)
{
	return add(key, {{"enum", names}, {"default", names[index]}}, help, Need::Optional);
}

bool FieldSchema::numbers(const char* key, std::vector<double>&, size_t least, size_t most, const Range& range,
						  const char* unit, const char* help, Need need)
{
	return add(key, {{"type", "array"}, {"minItems", least}, {"maxItems", most}, {"items", numberType(range, false)}},
			   withUnit(help, unit), need);
}

bool FieldSchema::object(const char* key, const char* help, const ReadFields& read)
{
	return add(key, schemaOf(read), help, Need::Optional);
}

bool FieldSchema::list(const char* key, size_t most, const char* help, const ReadFields& read)
{
	return add(key, {{"type", "array"}, {"maxItems", most}, {"items", schemaOf(read)}}, help, Need::Optional);
}

bool FieldSchema::named(const char* key, const char* help, const ReadNamed& read)
{
	const Json inner = schemaOf([&](Fields& f) { read("name", f); });
	return add(key, {{"type", "object"}, {"additionalProperties", inner}}, help, Need::Optional);
}

bool FieldSchema::reference(const char* key, const char* type, const std::vector<std::string>&,
							const std::function<void(const std::string&)>&, const char* help, const ReadFields& read,
							Need need)
{
	if (!m_types.contains(type))
	{
		// An object may have others of its type.
		m_types[type] = Json::object();
		m_types[type] = schemaOf(read);
	}
	return add(key, {{"anyOf", {{{"type", "string"}}, {{"$ref", std::string("#/$defs/") + type}}}}}, help, need);
}

void FieldSchema::oneOf(const std::vector<std::string>& keys)
{
	for (const std::string& key : keys)
		m_oneOf.push_back({{"required", {key}}});
}
}  // namespace ep
