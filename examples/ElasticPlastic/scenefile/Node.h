// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_NODE_H
#define EP_NODE_H

#include <memory>
#include <string>
#include <vector>

namespace ep
{
class Complaints;

/// Where something stands.
struct Place
{
	std::shared_ptr<const std::string> file;
	int line = 0;

	std::string text() const;
};

/// A value of a JSON file that remembers where it stands: what a person is told of an error.
struct Node
{
	enum class Kind
	{
		Null,
		Flag,
		Number,
		Text,
		List,
		Object
	};

	Kind kind = Kind::Null;
	bool flag = false;
	double number = 0;
	std::string text;
	std::vector<Node> children;  ///< of a list or an object, in the file's order
	std::string key;             ///< by which it is a child of an object
	Place place;

	bool isList() const { return kind == Kind::List; }
	bool isObject() const { return kind == Kind::Object; }
	bool isText() const { return kind == Kind::Text; }

	/// \return null if it is no object or has no such child
	const Node* find(const std::string& name) const;
	Node* find(const std::string& name);

	/// By which a path through a list leads to it: the text of its key name, or that of its only child, as structures have it.
	/// Empty: it has none
	std::string name() const;

	/// What it is, for messages: a number or short text as it is, else its kind and size.
	std::string shown() const;

	/// As JSON without comments, a value a line where lists and objects are long.
	std::string json() const;
};

/// Bounds on what a file may hold: nobody writes more, and what is read stays in memory.
namespace limits
{
const size_t FileBytes = 4 << 20, Nodes = 400000;
}

/// Reads JSON with comments. What is wrong is added to the complaints: keys that come twice and what is no JSON.
/// \param name  of the file, for messages
Node parseJson(const std::string& text, const std::string& name, Complaints& complaints);

/// The same from a file.
Node readJsonFile(const std::string& file, Complaints& complaints);
}  // namespace ep

#endif  // EP_NODE_H
