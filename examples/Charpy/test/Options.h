// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_OPTIONS_H
#define EP_CHARPY_OPTIONS_H

#include <functional>

#include "test/Settings.h"

namespace ep
{
class CommandLine;
}

namespace ep::charpy
{
/// The command line's settings: those named win over those of the preset.
class Options
{
public:
	explicit Options(CommandLine& line);
	Settings settings() const;

private:
	typedef Settings (*Preset)();
	static const std::vector<Named<Preset>>& presets();
	template <class Value>
	void addName(CommandLine& line, const char* name, const char* help, Value Settings::*field,
				 const std::vector<Named<Value>>& names);

	Preset m_preset = presets().front().value;
	std::vector<std::function<void(Settings&)>> m_given;
};
}  // namespace ep::charpy

#endif  // EP_CHARPY_OPTIONS_H
