// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/SceneText.h"

#include <muParser.h>

#include <algorithm>
#include <cfloat>
#include <filesystem>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticFault.h"
#include "json/JsonFile.h"
#include "text/Format.h"

namespace ep
{
namespace
{
namespace fs = std::filesystem;

const size_t MOST_INCLUDES = 64;

std::vector<std::string> childNames(const Node& node)
{
	std::vector<std::string> names;
	for (const Node& child : node.children)
		if (node.isObject())
			names.push_back(child.key);
		else if (!child.name().empty())
			names.push_back(child.name());
	return names;
}

bool isIndex(const std::string& text)
{
	return !text.empty() && text.size() < 8 &&
		   std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// A child of a list or an object by the next part of a path; an object gets one that it has not. \return null if there is none
Node* childAt(Node& node, const std::string& part, const Place& place)
{
	if (node.isList())
	{
		for (Node& item : node.children)
			if (!part.empty() && item.name() == part)
				return &item;
		const size_t index = isIndex(part) ? std::stoul(part) : node.children.size();
		return index < node.children.size() ? &node.children[index] : nullptr;
	}
	if (node.kind == Node::Kind::Null)
		node.kind = Node::Kind::Object;
	if (!node.isObject())
		return nullptr;
	if (Node* const child = node.find(part))
		return child;
	node.children.emplace_back();
	node.children.back().key = part;
	node.children.back().place = place;
	return &node.children.back();
}

void put(Node& root, std::string path, Node value, const Place& place, Complaints& complaints)
{
	const Node* const parameters = root.find("parameters");
	if (parameters && parameters->find(path))
		path = "parameters." + path;
	Node* node = &root;
	size_t begin = 0;
	while (begin <= path.size())
	{
		const size_t end = std::min(path.find('.', begin), path.size());
		const std::string part = path.substr(begin, end - begin);
		// What is there by a name is changed, and not made: a new one that nothing refers to would be a slip that nobody sees.
		const bool isNamed =
			node->isObject() && (node->key == "materials" || node->key == "sections" || node->key == "parameters");
		Node* const next = part.empty() || (isNamed && !node->find(part)) ? nullptr : childAt(*node, part, place);
		if (!next)
			return complaints.add(place, "", "does not lead anywhere: " + unknownName(part, childNames(*node)));
		node = next;
		begin = end + 1;
	}
	// A parameter with a unit keeps it.
	if (path.rfind("parameters.", 0) == 0 && node->isObject() && !value.isObject())
		node = childAt(*node, "value", place);
	value.key = node->key;
	*node = std::move(value);
}

/// What one file says over what another one does: object by object the first, and lists one after another.
void mergeUnder(Node& own, Node&& included)
{
	if (own.isObject() && included.isObject())
	{
		std::map<std::string, size_t> index;
		for (size_t i = 0; i < own.children.size(); ++i)
			index[own.children[i].key] = i;
		for (Node& child : included.children)
		{
			const auto found = index.find(child.key);
			if (found == index.end())
				own.children.push_back(std::move(child));
			else
				mergeUnder(own.children[found->second], std::move(child));
		}
	}
	else if (own.isList() && included.isList())
		own.children.insert(own.children.begin(), std::make_move_iterator(included.children.begin()),
							std::make_move_iterator(included.children.end()));
}

class Includer
{
public:
	explicit Includer(Complaints& complaints) : m_complaints(complaints) {}

	const std::vector<std::string>& files() const { return m_files; }

	Node read(const fs::path& file)
	{
		m_files.push_back(file.string());
		Node root = readJsonFile(file.string(), m_complaints);
		return withIncludes(std::move(root), file.parent_path(), canonical(file));
	}

	/// \param self  empty: no file, it cannot be included
	Node withIncludes(Node root, const fs::path& folder, const std::string& self)
	{
		putUnder(folder, root);
		const auto found = std::find_if(root.children.begin(), root.children.end(),
										[](const Node& child) { return child.key == "include"; });
		if (!root.isObject() || found == root.children.end())
			return root;
		const Node list = std::move(*found);
		root.children.erase(found);
		if (!list.isList())
			m_complaints.add(list.place, "include", "is " + list.shown() + "; it must be a list of files");
		m_stack.push_back(self);
		// The last one is what the others are put over.
		for (size_t i = list.isList() ? list.children.size() : 0; i-- > 0;)
			include(root, list.children[i], "include." + std::to_string(i), folder);
		m_stack.pop_back();
		return root;
	}

private:
	/// Files that bodies name are under the folder of the file that names them.
	static void putUnder(const fs::path& folder, Node& root)
	{
		Node* const bodies = root.find("bodies");
		for (size_t i = 0; bodies && i < bodies->children.size(); ++i)
			if (Node* const file = bodies->children[i].find("mesh_file"))
				if (file->isText() && !file->text.empty())
					file->text = fs::absolute(folder / file->text).lexically_normal().string();
	}

	static std::string canonical(const fs::path& file)
	{
		std::error_code error;
		const fs::path path = fs::weakly_canonical(file, error);
		return error ? file.string() : path.string();
	}

	void include(Node& root, const Node& item, const std::string& path, const fs::path& folder)
	{
		const Node* const name = item.isObject() ? item.find("file") : &item;
		const Node* const settings = item.find("set");
		if (!name || !name->isText() || (settings && !settings->isObject()))
			return m_complaints.add(
				item.place, path,
				"is " + item.shown() +
					"; it must be a file, or an object with the keys file and set, which is an object");
		for (const Node& child : item.children)
			if (child.key != "file" && child.key != "set")
				m_complaints.add(child.place, path, "key " + unknownName(child.key, {"file", "set"}));
		const fs::path file = folder / name->text;
		const auto cycle = std::find(m_stack.begin(), m_stack.end(), canonical(file));
		if (cycle != m_stack.end())
			return m_complaints.add(
				item.place, path,
				"is " + shown(name->text) + ", which includes this file: files cannot include each other");
		if (++m_count > MOST_INCLUDES)
			return m_complaints.add(item.place, path,
									"is one of more than " + std::to_string(MOST_INCLUDES) + " files");
		Node included = read(file);
		if (settings)
			for (const Node& setting : settings->children)
				put(included, setting.key, setting, setting.place, m_complaints);
		mergeUnder(root, std::move(included));
	}

	std::vector<std::string> m_files, m_stack;  // that were read, and that are being read
	size_t m_count = 0;
	Complaints& m_complaints;
};

bool isIdentifier(const std::string& name)
{
	const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
	return !name.empty() && name.size() <= 40 && isLetter(name[0]) &&
		   std::all_of(name.begin(), name.end(), [&](char c) { return isLetter(c) || (c >= '0' && c <= '9'); });
}

class ParameterReader
{
public:
	ParameterReader(std::map<std::string, double>& values, Complaints& complaints)
		: m_values(values), m_complaints(complaints)
	{
	}

	void read(const Node& parameters)
	{
		if (!parameters.isObject())
			m_complaints.add(parameters.place, "parameters", "is " + parameters.shown() + "; it must be an object");
		else
			for (const Node& child : parameters.children)
				readOne(child, "parameters." + child.key);
	}

private:
	void readOne(const Node& parameter, const std::string& path)
	{
		const std::vector<std::string> known = {"value", "unit", "least", "most", "what"};
		if (!isIdentifier(parameter.key))
			return m_complaints.add(
				parameter.place, "parameters",
				"has the name " + shown(parameter.key) + "; it must be letters, digits and _, and begin with a letter");
		const Node* const value = parameter.isObject() ? parameter.find("value") : &parameter;
		if (!value)
			return m_complaints.add(parameter.place, path, "has no value");
		double number = 0, least = -DBL_MAX, most = DBL_MAX;
		if (!readNumber(*value, path, number))
			return;
		for (const Node& child : parameter.children)
			if (child.key == "least" || child.key == "most")
				readNumber(child, path + "." + child.key, child.key == "least" ? least : most);
			else if (std::find(known.begin(), known.end(), child.key) == known.end())
				m_complaints.add(child.place, path, "key " + unknownName(child.key, known));
			else if (child.key != "value" && !child.isText())
				m_complaints.add(child.place, path + "." + child.key, "is " + child.shown() + "; it must be a text");
		if (!(number >= least && number <= most))
			m_complaints.add(value->place, path, format("is %g; it must be from %g to %g", number, least, most));
		m_values[parameter.key] = number;
	}

	bool readNumber(const Node& node, const std::string& path, double& value)
	{
		std::string error = "is " + node.shown() + "; it must be a number, or an expression that begins with =";
		if (node.kind == Node::Kind::Number)
		{
			value = node.number;
			return true;
		}
		if (node.isText() && !node.text.empty() && node.text[0] == '=')
			error = evaluate(node.text.substr(1), m_values, value);
		if (!error.empty())
			m_complaints.add(node.place, path, error);
		return error.empty();
	}

	std::map<std::string, double>& m_values;
	Complaints& m_complaints;
};

SceneText finish(Node root, const std::vector<std::string>& files, const std::vector<Setting>& settings,
				 Complaints& complaints)
{
	complaints.check();
	SceneText scene;
	scene.files = files;
	scene.root = std::move(root);
	for (const Setting& setting : settings)
	{
		const std::string name = "--set " + setting.path + "=" + setting.value;
		Complaints noJson;
		Node value = parseJson(setting.value, name, noJson);
		if (noJson.any())
		{
			value = Node();
			value.kind = Node::Kind::Text;
			value.text = setting.value;
		}
		const Place place = {std::make_shared<std::string>(name), 0};
		value.place = place;
		put(scene.root, setting.path, std::move(value), place, complaints);
	}
	if (const Node* const parameters = scene.root.find("parameters"))
		ParameterReader(scene.parameters, complaints).read(*parameters);
	complaints.check();
	return scene;
}
}  // namespace

Setting Setting::from(const std::string& text)
{
	const size_t equals = text.find('=');
	if (equals == std::string::npos || equals == 0)
		throw SceneError("--set is " + shown(text) + "; it must be path=value, such as world.step=0.01");
	return {text.substr(0, equals), text.substr(equals + 1)};
}

SceneText SceneText::read(const std::string& file, const std::vector<Setting>& settings)
{
	Complaints complaints;
	Includer includer(complaints);
	Node root = includer.read(file);
	return finish(std::move(root), includer.files(), settings, complaints);
}

SceneText SceneText::parse(const std::string& text, const std::string& name, const std::vector<Setting>& settings,
						   const std::string& folder)
{
	Complaints complaints;
	Includer includer(complaints);
	Node root = includer.withIncludes(parseJson(text, name, complaints), folder, "");
	return finish(std::move(root), includer.files(), settings, complaints);
}

std::string evaluate(const std::string& expression, const std::map<std::string, double>& parameters, double& value)
{
	const size_t longest = 200;
	if (expression.size() > longest)
		return "is an expression of more than " + std::to_string(longest) + " characters";
	try
	{
		mu::Parser parser;
		for (const auto& [name, number] : parameters)
			parser.DefineConst(name, number);
		parser.SetExpr(expression);
		value = parser.Eval();
		if (btElasticPlasticIsFinite(value))
			return "";
		return "is the expression " + shown(expression) + ", which is no finite number";
	}
	catch (const mu::Parser::exception_type& error)
	{
		std::vector<std::string> names;
		for (const auto& parameter : parameters)
			names.push_back(parameter.first);
		if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
			return "is the expression " + shown(expression) + ", of which " + unknownName(error.GetToken(), names);
		return "is the expression " + shown(expression) + ": " + error.GetMsg();
	}
}
}  // namespace ep
