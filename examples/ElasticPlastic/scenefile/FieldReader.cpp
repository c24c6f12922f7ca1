// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/FieldReader.h"

#include <algorithm>
#include <cmath>

#include "scenefile/SceneText.h"
#include "text/Format.h"

namespace ep
{
namespace
{
/// An item of a list is named where it has a name: a person counts no items.
std::string partOf(const Node& item, size_t index)
{
	const std::string name = item.name();
	return name.empty() || name.size() > 40 ? std::to_string(index) : name;
}

std::string rangeText(const Range& range, const char* unit)
{
	std::string text = range.high < 1e30
						   ? format(range.isAbove ? "above %g and at most %g" : "from %g to %g", range.low, range.high)
					   : range.low > -1e30 ? format(range.isAbove ? "above %g" : "of at least %g", range.low)
										   : std::string();
	if (*unit)
		text += std::string(text.empty() ? "" : " ") + "[" + unit + "]";
	return text.empty() ? text : " " + text;
}
}  // namespace

void FieldReader::finish()
{
	for (const Node& child : m_object.children)
		if (std::find(m_asked.begin(), m_asked.end(), child.key) == m_asked.end())
		{
			std::vector<std::string> known = m_asked;
			// A setting may have been meant for a parameter.
			if (m_path.empty() && !child.isObject() && !child.isList())
				for (const auto& parameter : m_parameters)
					known.push_back(parameter.first);
			m_complaints.add(child.place, m_path, "key " + unknownName(child.key, known));
		}
}

const Node* FieldReader::find(const char* key, Need need)
{
	m_asked.push_back(key);
	const Node* const node = m_object.find(key);
	if (!node && need == Need::Required)
		m_complaints.add(m_object.place, m_path, std::string("must have the key ") + key);
	return node;
}

void FieldReader::complain(const Node& node, const std::string& path, const std::string& mustBe)
{
	m_complaints.add(node.place, path, "is " + node.shown() + "; it must be " + mustBe);
}

bool FieldReader::toNumber(const Node& node, const std::string& path, const Range& range, const char* unit,
						   bool isWhole, double& value)
{
	double number = node.number;
	if (node.isText() && !node.text.empty() && node.text[0] == '=')
	{
		const std::string error = evaluate(node.text.substr(1), m_parameters, number);
		if (!error.empty())
		{
			m_complaints.add(node.place, path, error);
			return false;
		}
	}
	else if (node.kind != Node::Kind::Number)
	{
		complain(node, path, std::string("a ") + (isWhole ? "whole " : "") + "number" + rangeText(range, unit));
		return false;
	}
	const bool isRight = number <= range.high && (range.isAbove ? number > range.low : number >= range.low) &&
						 (!isWhole || number == std::floor(number));
	if (isRight)
		value = number;
	else
		m_complaints.add(node.place, path,
						 "is " + node.shown() + (node.isText() ? format(", that is %g", number) : "") +
							 "; it must be a " + (isWhole ? "whole " : "") + "number" + rangeText(range, unit));
	return isRight;
}

bool FieldReader::number(const char* key, double& value, const Range& range, const char* unit, const char*, Need need)
{
	const Node* const node = find(key, need);
	if (node)
		toNumber(*node, pathOf(key), range, unit, false, value);
	return node;
}

bool FieldReader::whole(const char* key, int& value, int low, int high, const char*, Need need)
{
	const Node* const node = find(key, need);
	double number = value;
	if (node && toNumber(*node, pathOf(key), {double(low), double(high)}, "", true, number))
		value = int(number);
	return node;
}

bool FieldReader::flag(const char* key, bool& value, const char*)
{
	const Node* const node = find(key, Need::Optional);
	if (node && node->kind == Node::Kind::Flag)
		value = node->flag;
	else if (node)
		complain(*node, pathOf(key), "true or false");
	return node;
}

bool FieldReader::text(const char* key, std::string& value, const char*, Need need)
{
	const size_t longest = 200;
	const Node* const node = find(key, need);
	if (node && node->isText() && !node->text.empty() && node->text.size() <= longest)
		value = node->text;
	else if (node)
		complain(*node, pathOf(key), "a text of 1 to " + std::to_string(longest) + " characters");
	return node;
}

bool FieldReader::file(const char* key, std::string& name, const char*)
{
	const Node* const node = find(key, Need::Optional);
	if (node && node->isText() && !node->text.empty())
		name = node->text;
	else if (node)
		complain(*node, pathOf(key), "the name of a file");
	return node;
}

bool FieldReader::choice(const char* key, size_t& index, const std::vector<std::string>& names, const char*)
{
	const Node* const node = find(key, Need::Optional);
	if (!node)
		return false;
	const auto found = node->isText() ? std::find(names.begin(), names.end(), node->text) : names.end();
	if (found != names.end())
		index = size_t(found - names.begin());
	else
		m_complaints.add(
			node->place, pathOf(key),
			node->isText() ? unknownName(node->text, names) : "is " + node->shown() + "; it must be a name");
	return true;
}

bool FieldReader::numbers(const char* key, std::vector<double>& values, size_t least, size_t most, const Range& range,
						  const char* unit, const char*, Need need)
{
	const Node* const node = find(key, need);
	if (!node)
		return false;
	if (!node->isList() || node->children.size() < least || node->children.size() > most)
	{
		complain(*node, pathOf(key),
				 "a list of " +
					 (least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most)) +
					 " numbers" + rangeText(range, unit));
		return true;
	}
	std::vector<double> read(node->children.size());
	bool isRight = true;
	for (size_t i = 0; i < read.size(); ++i)
		isRight &= toNumber(node->children[i], pathOf(key) + "." + std::to_string(i), range, unit, false, read[i]);
	if (isRight)
		values = read;
	return true;
}

void FieldReader::readObject(const Node& node, const std::string& path, const ReadFields& read)
{
	if (!node.isObject())
		return complain(node, path, "an object");
	FieldReader reader(node, path, m_parameters, m_complaints);
	read(reader);
	reader.finish();
}

bool FieldReader::object(const char* key, const char*, const ReadFields& read)
{
	const Node* const node = find(key, Need::Optional);
	if (node)
		readObject(*node, pathOf(key), read);
	return node;
}

bool FieldReader::list(const char* key, size_t most, const char*, const ReadFields& read)
{
	const Node* const node = find(key, Need::Optional);
	if (node && (!node->isList() || node->children.size() > most))
		complain(*node, pathOf(key), "a list of at most " + std::to_string(most) + " objects");
	else if (node)
		for (size_t i = 0; i < node->children.size(); ++i)
			readObject(node->children[i], pathOf(key) + "." + partOf(node->children[i], i), read);
	return node;
}

bool FieldReader::named(const char* key, const char*, const ReadNamed& read)
{
	const Node* const node = find(key, Need::Optional);
	if (node && !node->isObject())
		complain(*node, pathOf(key), "an object of objects, each by its name");
	else if (node)
		for (const Node& child : node->children)
			readObject(child, pathOf(key) + "." + child.key, [&](Fields& f) { read(child.key, f); });
	return node;
}

bool FieldReader::reference(const char* key, const char* type, const std::vector<std::string>& known,
							const std::function<void(const std::string&)>& take, const char*, const ReadFields& read,
							Need need)
{
	const Node* const node = find(key, need);
	if (!node)
		return false;
	if (node->isObject())
		readObject(*node, pathOf(key), read);
	else if (!node->isText())
		complain(*node, pathOf(key), std::string("the name of a ") + type + ", or one as an object");
	else if (std::find(known.begin(), known.end(), node->text) != known.end())
		take(node->text);
	else
		m_complaints.add(node->place, pathOf(key), unknownName(node->text, known));
	return true;
}

void FieldReader::oneOf(const std::vector<std::string>& keys)
{
	size_t count = 0;
	std::string all;
	for (const std::string& key : keys)
	{
		count += m_object.find(key) != nullptr;
		all += (all.empty() ? "" : ", ") + key;
	}
	if (count != 1)
		m_complaints.add(m_object.place, m_path,
						 "must have one of the keys " + all + (count == 0 ? ", and has none" : ", and has several"));
}

void FieldReader::refuse(const std::string& key, const std::string& what)
{
	const Node* const node = m_object.find(key);
	m_complaints.add(node ? node->place : m_object.place, key.empty() ? m_path : pathOf(key), what);
}
}  // namespace ep
