// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FIELD_READER_H
#define EP_FIELD_READER_H

#include <map>

#include "scenefile/Complaints.h"
#include "scenefile/Fields.h"

namespace ep
{
/// Reads an object of a file, and complains of what is not allowed and of keys that nobody has asked for.
class FieldReader : public Fields
{
public:
	/// \param path        of the object in the file, empty: the root
	/// \param parameters  for expressions: texts that begin with =
	FieldReader(const Node& object, const std::string& path, const std::map<std::string, double>& parameters,
				Complaints& complaints)
		: m_object(object), m_path(path), m_parameters(parameters), m_complaints(complaints)
	{
	}

	/// All keys have been asked for: what else there is, is not known.
	void finish();

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
	void known(const char* key) override { m_asked.push_back(key); }
	void oneOf(const std::vector<std::string>& keys) override;
	void refuse(const std::string& key, const std::string& what) override;
	bool hasFailed() const override { return m_complaints.any(); }

private:
	const Node* find(const char* key, Need need);
	std::string pathOf(const std::string& key) const { return m_path.empty() ? key : m_path + "." + key; }
	void complain(const Node& node, const std::string& path, const std::string& mustBe);
	bool toNumber(const Node& node, const std::string& path, const Range& range, const char* unit, bool isWhole,
				  double& value);
	void readObject(const Node& node, const std::string& path, const ReadFields& read);

	const Node& m_object;
	std::string m_path;
	const std::map<std::string, double>& m_parameters;
	Complaints& m_complaints;
	std::vector<std::string> m_asked;
};
}  // namespace ep

#endif  // EP_FIELD_READER_H
