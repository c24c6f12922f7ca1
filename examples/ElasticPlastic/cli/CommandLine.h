// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_COMMAND_LINE_H
#define EP_COMMAND_LINE_H

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "text/Named.h"

namespace CLI
{
class App;
class Option;
}  // namespace CLI

namespace ep
{
/// An option that has been added to a command line, for what else there is to tell of it.
class CommandOption
{
public:
	CommandOption required() const;
	CommandOption showDefault() const;  ///< what the variable holds now
	CommandOption showDefault(const std::string& text) const;
	/// The number, or each of several, must be in this range. What is not a number, or not finite, is in none.
	CommandOption within(double low, double high) const;
	CommandOption oneOf(const std::vector<std::string>& names) const;
	CommandOption existingFile() const;
	CommandOption existingFolder() const;
	CommandOption excludes(const CommandOption& other) const;

private:
	friend class CommandLine;
	/// \return what is wrong with the text of a number; empty: it is in the range
	typedef std::string (*Check)(const std::string& text, double low, double high);
	CommandOption(CLI::Option* option, Check check) : m_option(option), m_check(check) {}

	CLI::Option* m_option;
	Check m_check;
};

/// The options of a program. CLI11 reads them, whose headers take seconds to compile: only CommandLine.cpp includes them. An option's name
/// begins with dashes; without them the option goes by its place.
class CommandLine
{
public:
	/// \param about  what the program does, for --help
	explicit CommandLine(const std::string& about);
	~CommandLine();

	/// For an int, unsigned, float, double, std::string or std::vector<std::string>.
	template <class Value>
	CommandOption add(const std::string& name, Value& value, const std::string& help);
	void addFlag(const std::string& name, bool& flag, const std::string& help);
	/// Two whole numbers, both of which must be given.
	CommandOption addPair(const std::string& name, int& first, int& second, const std::string& help);
	/// What is given, an int, double, std::string or std::vector<std::string>, is handed to a function.
	template <class Value>
	CommandOption addFunction(const std::string& name, const std::function<void(const Value&)>& take,
							  const std::string& help);
	/// Takes one of several things by its name; what the value is now is the default. The choices must outlive the command line.
	template <class Value>
	CommandOption addNamed(const std::string& name, Value& value, const std::string& help,
						   const std::vector<Named<Value>>& choices)
	{
		const auto take = [&value, &choices](const std::string& text) { value = *findNamed(choices, text); };
		return addFunction<std::string>(name, take, help).oneOf(namesOf(choices)).showDefault(nameOf(choices, value));
	}
	/// Replaces the help of an option that is there already.
	void describe(const std::string& name, const std::string& help);

	/// \return the program's status, if it is to end: help has been printed, or what is wrong
	std::optional<int> parse(int argc, char** argv);

private:
	const std::unique_ptr<CLI::App> m_app;
};
}  // namespace ep

#endif  // EP_COMMAND_LINE_H
