// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_NAMED_OPTION_H
#define EP_NAMED_OPTION_H

#include <CLI/CLI.hpp>

#include "text/Named.h"

namespace ep
{
/// An option that takes one of several things by its name; what the value is now is the default.
template <class Value>
CLI::Option* addNamedOption(CLI::App& app, const std::string& option, Value& value, const std::string& help,
							const std::vector<Named<Value>>& choices)
{
	const auto take = [&value, &choices](const std::string& name) { value = *findNamed(choices, name); };
	return app.add_option_function<std::string>(option, take, help)
		->default_str(nameOf(choices, value))
		->check(CLI::IsMember(namesOf(choices)));
}
}  // namespace ep

#endif  // EP_NAMED_OPTION_H
