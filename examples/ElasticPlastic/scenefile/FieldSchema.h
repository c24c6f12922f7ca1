// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FIELD_SCHEMA_H
#define EP_FIELD_SCHEMA_H

#include <nlohmann/json.hpp>

#include "scenefile/Fields.h"

namespace ep
{
/// Describes an object of a file as JSON Schema (draft 2020-12) does.
class FieldSchema : public Fields
{
public:
	/// \param types  what objects that have a type are like, to be added to
	explicit FieldSchema(nlohmann::ordered_json& types) : m_types(types) {}

	/// \return {"type": "object", "properties": ...}
	nlohmann::ordered_json schema() const;

	bool number(const char* key, double& value, const Range& range, const char* unit, const char* help,
				Need need) override;
	bool whole(const char* key, int& value, int low, int high, const char* help, Need need) override;
	bool flag(const char* key, bool& value, const char* help) override;
	bool text(const char* key, std::string& value, const char* help, Need need) override;
	bool file(const char* key, std::string& name, const char* help) override;
	bool choice(const char* key, size_t& index, const std::vector<std::string>& names, const char* help) override;
	bool numbers(const char* key, std::vector<double>& values, size_t least, size_t most, const Range& range,
				 const char* unit, const char* help, Need need) override;
	bool object(const char* key, const char* help, const ReadFields& read) override;
	bool list(const char* key, size_t most, const char* help, const ReadFields& read) override;
	bool named(const char* key, const char* help, const ReadNamed& read) override;
	using Fields::named;
	bool reference(const char* key, const char* type, const std::vector<std::string>& known,
				   const std::function<void(const std::string&)>& take, const char* help, const ReadFields& read,
				   Need need) override;
	void known(const char* key) override { m_properties[key] = {{"$ref", std::string("#/$defs/") + key}}; }
	void oneOf(const std::vector<std::string>& keys) override;
	void refuse(const std::string&, const std::string&) override {}
	/// What is read by the way is nothing.
	bool hasFailed() const override { return true; }

private:
	using Json = nlohmann::ordered_json;

	Json schemaOf(const ReadFields& read);
	bool add(const char* key, Json type, const std::string& help, Need need);

	Json& m_types;
	Json m_properties = Json::object(), m_required = Json::array(), m_oneOf = Json::array();
};
}  // namespace ep

#endif  // EP_FIELD_SCHEMA_H
