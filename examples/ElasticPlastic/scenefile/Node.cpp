// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/Node.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include "json/JsonFile.h"
#include "scenefile/Complaints.h"

namespace ep
{
namespace
{
using nlohmann::json;

/// The bytes of a text for the parser, which reads on until it knows that a token has ended: it tells how far.
struct Bytes
{
	using iterator_category = std::input_iterator_tag;
	using value_type = char;
	using difference_type = std::ptrdiff_t;
	using pointer = const char*;
	using reference = const char&;

	const char* at;
	const char** read;

	reference operator*() const { return *at; }
	Bytes& operator++()
	{
		*read = ++at;
		return *this;
	}
	bool operator==(const Bytes& other) const { return at == other.at; }
	bool operator!=(const Bytes& other) const { return at != other.at; }
};

/// Makes nodes of what the parser finds.
class TreeBuilder : public json::json_sax_t
{
public:
	TreeBuilder(const std::string& text, const std::string& file, Complaints& complaints)
		: m_file(std::make_shared<std::string>(file)),
		  m_counted(text.data()),
		  m_read(text.data()),
		  m_complaints(complaints)
	{
	}

	const char** position() { return &m_read; }
	Node take() { return std::move(m_root); }

	bool null() override
	{
		add(Node::Kind::Null);
		return goesOn();
	}
	bool boolean(bool value) override
	{
		add(Node::Kind::Flag).flag = value;
		return goesOn();
	}
	bool number_integer(number_integer_t value) override { return addNumber(double(value)); }
	bool number_unsigned(number_unsigned_t value) override { return addNumber(double(value)); }
	bool number_float(number_float_t value, const string_t&) override { return addNumber(value); }
	bool string(string_t& value) override
	{
		add(Node::Kind::Text).text = value;
		return goesOn();
	}
	bool binary(binary_t&) override { return false; }
	bool start_object(size_t) override { return open(Node::Kind::Object); }
	bool start_array(size_t) override { return open(Node::Kind::List); }
	bool end_object() override { return close(); }
	bool end_array() override { return close(); }
	bool key(string_t& name) override
	{
		const auto added = m_keys.back().emplace(name, place().line);
		if (!added.second)
			m_complaints.add(
				place(), "",
				"the key " + shown(name) + " stands in line " + std::to_string(added.first->second) + " already");
		m_key = name;
		return true;
	}
	bool parse_error(size_t, const std::string&, const json::exception& error) override
	{
		// After the library's own prefix; what was read last may be long.
		const std::string text = error.what();
		const size_t colon = text.find(": ");
		m_complaints.add(place(), "", "is no JSON: " + text.substr(colon == std::string::npos ? 0 : colon + 2, 160));
		return false;
	}

private:
	/// What the parser has read last may belong to what comes next: it reads a number's end so.
	Place place()
	{
		for (; m_counted + 1 < m_read; ++m_counted)
			m_line += *m_counted == '\n';
		return {m_file, m_line};
	}

	Node& add(Node::Kind kind)
	{
		Node* node = &m_root;
		if (!m_open.empty())
		{
			m_open.back()->children.emplace_back();
			node = &m_open.back()->children.back();
		}
		node->kind = kind;
		node->place = place();
		node->key = std::move(m_key);
		m_key.clear();
		++m_nodes;
		return *node;
	}
	bool goesOn()
	{
		if (m_nodes > limits::Nodes)
			m_complaints.add(place(), "", "has more than " + std::to_string(limits::Nodes) + " values");
		return m_nodes <= limits::Nodes;
	}
	bool addNumber(double value)
	{
		add(Node::Kind::Number).number = value;
		return goesOn();
	}
	bool open(Node::Kind kind)
	{
		Node& node = add(kind);
		m_open.push_back(&node);
		m_keys.emplace_back();
		if (m_open.size() > size_t(DEEPEST))
		{
			m_complaints.add(
				node.place, "",
				"has lists and objects within each other more than " + std::to_string(DEEPEST) + " levels deep");
			return false;
		}
		return goesOn();
	}
	bool close()
	{
		m_open.pop_back();
		m_keys.pop_back();
		return true;
	}

	std::shared_ptr<const std::string> m_file;
	Node m_root;
	std::vector<Node*> m_open;  // from the root to where the parser is: a node moves only when it is complete
	std::vector<std::map<std::string, int>> m_keys;  // of these, with their lines
	std::string m_key;
	const char *m_counted, *m_read;
	int m_line = 1;
	size_t m_nodes = 0;
	Complaints& m_complaints;
};

json jsonOf(const Node& node)
{
	json list = json::array();
	switch (node.kind)
	{
		case Node::Kind::Null:
			break;
		case Node::Kind::Flag:
			return node.flag;
		case Node::Kind::Number:
			// What is whole is written so.
			if (std::fabs(node.number) < 1e15 && node.number == std::floor(node.number))
				return (long long)(node.number);
			return node.number;
		case Node::Kind::Text:
			return node.text;
		case Node::Kind::List:
			for (const Node& child : node.children)
				list.push_back(jsonOf(child));
			return list;
		case Node::Kind::Object:
			json object = json::object();
			for (const Node& child : node.children)
				object[child.key] = jsonOf(child);
			return object;
	}
	return nullptr;
}
}  // namespace

std::string Place::text() const
{
	return (file ? *file : std::string("scene")) + (line > 0 ? ":" + std::to_string(line) : "");
}

const Node* Node::find(const std::string& name) const
{
	if (isObject())
		for (const Node& child : children)
			if (child.key == name)
				return &child;
	return nullptr;
}

Node* Node::find(const std::string& name) { return const_cast<Node*>(static_cast<const Node*>(this)->find(name)); }

std::string Node::name() const
{
	const Node* own = find("name");
	if (!own && isObject() && children.size() == 1)
		own = children[0].find("name");
	return own && own->isText() ? own->text : "";
}

std::string Node::shown() const
{
	if (isList())
		return "a list of " + std::to_string(children.size());
	if (isObject())
		return "an object with " + std::to_string(children.size()) + " keys";
	return ep::shown(jsonOf(*this));
}

std::string Node::json() const { return jsonOf(*this).dump(2, ' ', false, nlohmann::json::error_handler_t::replace); }

Node parseJson(const std::string& text, const std::string& name, Complaints& complaints)
{
	TreeBuilder builder(text, name, complaints);
	const char* const end = text.data() + text.size();
	const Bytes first = {text.data(), builder.position()}, last = {end, builder.position()};
	if (text.size() > limits::FileBytes)
		complaints.add(
			{std::make_shared<std::string>(name), 0}, "",
			"has " + std::to_string(text.size()) + " bytes; a scene may have " + std::to_string(limits::FileBytes));
	else
		json::sax_parse(first, last, &builder, json::input_format_t::json, true, true);
	return builder.take();
}

Node readJsonFile(const std::string& file, Complaints& complaints)
{
	std::ifstream stream;
	if (isRegularFile(file))
		stream.open(file, std::ios::binary);
	std::string text;
	char block[1 << 16];
	while (stream.read(block, sizeof block) || stream.gcount() > 0)
	{
		text.append(block, size_t(stream.gcount()));
		if (text.size() > limits::FileBytes)
			break;
	}
	if (!stream.is_open() || (stream.bad() && text.empty()))
	{
		complaints.add({std::make_shared<std::string>(file), 0}, "",
					   "cannot be read: is it there, a file, and may you read it?");
		return Node();
	}
	return parseJson(text, file, complaints);
}
}  // namespace ep
