// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_NAMED_H
#define EP_NAMED_H

#include <string>
#include <vector>

namespace ep
{
/// What stands for one of several things is chosen by name.
template <class Value>
struct Named
{
	const char* name;
	Value value;
	const char* help = "";
};

template <class Value>
std::string nameOf(const std::vector<Named<Value>>& choices, const Value& value)
{
	for (const Named<Value>& choice : choices)
		if (choice.value == value)
			return choice.name;
	return "?";
}

template <class Value>
const Value* findNamed(const std::vector<Named<Value>>& choices, const std::string& name)
{
	for (const Named<Value>& choice : choices)
		if (name == choice.name)
			return &choice.value;
	return nullptr;
}

template <class Value>
std::vector<std::string> namesOf(const std::vector<Named<Value>>& choices)
{
	std::vector<std::string> names;
	for (const Named<Value>& choice : choices)
		names.push_back(choice.name);
	return names;
}
}  // namespace ep

#endif  // EP_NAMED_H
