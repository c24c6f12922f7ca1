// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_OPTIONS_H
#define EP_CHARPY_OPTIONS_H

#include <CLI/CLI.hpp>
#include <functional>

#include "test/CharpySettings.h"

namespace ep
{
/// The command line's settings: those named win over those of the preset.
class CharpyOptions
{
public:
	explicit CharpyOptions(CLI::App& app);
	CharpySettings settings() const;

private:
	template <class Value>
	void addName(CLI::App& app, const char* name, const char* help, Value CharpySettings::*field,
				 const std::vector<Named<Value>>& names);

	std::string m_preset = "repeatable";
	std::vector<std::function<void(CharpySettings&)>> m_given;
};
}  // namespace ep

#endif  // EP_CHARPY_OPTIONS_H
