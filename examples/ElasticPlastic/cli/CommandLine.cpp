// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "cli/CommandLine.h"

#include <CLI/CLI.hpp>
#include <type_traits>

#include "text/Format.h"

namespace ep
{
namespace
{
std::string rangeText(double low, double high) { return format("%.10g to %.10g", low, high); }

/// What is wrong with a number's text, or nothing. CLI::Range lets nan pass.
template <class Number>
std::string checkNumber(const std::string& text, double low, double high)
{
	const std::string range = "it must be from " + rangeText(low, high);
	Number value = 0;
	if (!CLI::detail::lexical_cast(text, value))
		return "'" + text + "' is no " + (std::is_integral_v<Number> ? "whole " : "") + "number; " + range;
	// In the number's own precision: .1f is more than .1.
	if (!(value >= Number(low) && value <= Number(high)))
		return "'" + text + "' is out of range; " + range;
	return "";
}

template <class Value>
using NumberOf = std::conditional_t<std::is_arithmetic_v<Value>, Value, double>;
}  // namespace

CommandOption CommandOption::required() const { return {m_option->required(), m_check}; }
CommandOption CommandOption::showDefault() const { return {m_option->capture_default_str(), m_check}; }
CommandOption CommandOption::showDefault(const std::string& text) const
{
	return {m_option->default_str(text), m_check};
}
CommandOption CommandOption::oneOf(const std::vector<std::string>& names) const
{
	return {m_option->check(CLI::IsMember(names)), m_check};
}
CommandOption CommandOption::existingFile() const { return {m_option->check(CLI::ExistingFile), m_check}; }
CommandOption CommandOption::existingFolder() const { return {m_option->check(CLI::ExistingDirectory), m_check}; }
CommandOption CommandOption::excludes(const CommandOption& other) const
{
	return {m_option->excludes(other.m_option), m_check};
}

CommandOption CommandOption::within(double low, double high) const
{
	const auto check = [check = m_check, low, high](const std::string& text) { return check(text, low, high); };
	return {m_option->check(check, rangeText(low, high)), m_check};
}

CommandLine::CommandLine(const std::string& about) : m_app(std::make_unique<CLI::App>(about)) {}

CommandLine::~CommandLine() = default;

template <class Value>
CommandOption CommandLine::add(const std::string& name, Value& value, const std::string& help)
{
	return {m_app->add_option(name, value, help), checkNumber<NumberOf<Value>>};
}
template CommandOption CommandLine::add(const std::string&, int&, const std::string&);
template CommandOption CommandLine::add(const std::string&, unsigned&, const std::string&);
template CommandOption CommandLine::add(const std::string&, float&, const std::string&);
template CommandOption CommandLine::add(const std::string&, double&, const std::string&);
template CommandOption CommandLine::add(const std::string&, std::string&, const std::string&);
template CommandOption CommandLine::add(const std::string&, std::vector<std::string>&, const std::string&);

void CommandLine::addFlag(const std::string& name, bool& flag, const std::string& help)
{
	m_app->add_flag(name, flag, help);
}

CommandOption CommandLine::addPair(const std::string& name, int& first, int& second, const std::string& help)
{
	const auto take = [&first, &second](const std::vector<int>& pair)
	{
		first = pair[0];
		second = pair[1];
	};
	CLI::Option* const option = m_app->add_option_function<std::vector<int>>(name, take, help);
	return {option->expected(2)->allow_extra_args(false), checkNumber<int>};
}

template <class Value>
CommandOption CommandLine::addFunction(const std::string& name, const std::function<void(const Value&)>& take,
									   const std::string& help)
{
	return {m_app->add_option_function<Value>(name, take, help), checkNumber<NumberOf<Value>>};
}
template CommandOption CommandLine::addFunction(const std::string&, const std::function<void(const int&)>&,
												const std::string&);
template CommandOption CommandLine::addFunction(const std::string&, const std::function<void(const double&)>&,
												const std::string&);
template CommandOption CommandLine::addFunction(const std::string&, const std::function<void(const std::string&)>&,
												const std::string&);
template CommandOption CommandLine::addFunction(const std::string&,
												const std::function<void(const std::vector<std::string>&)>&,
												const std::string&);

void CommandLine::describe(const std::string& name, const std::string& help)
{
	m_app->get_option(name)->description(help);
}

std::optional<int> CommandLine::parse(int argc, char** argv)
{
	try
	{
		m_app->parse(argc, argv);
		return {};
	}
	catch (const CLI::ParseError& error)
	{
		return m_app->exit(error);
	}
}
}  // namespace ep
