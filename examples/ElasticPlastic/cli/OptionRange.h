// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_OPTION_RANGE_H
#define EP_OPTION_RANGE_H

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <type_traits>

namespace ep
{
/// What a number on the command line must be. CLI::Range lets what is not a number pass.
template <class Number = double>
CLI::Validator optionRange(double low, double high)
{
	char range[64];
	std::snprintf(range, sizeof range, "%g to %g", low, high);
	const auto check = [low, high, range = std::string(range)](std::string& text)
	{
		Number value = 0;
		if (!CLI::detail::lexical_cast(text, value))
			return "'" + text + "' is no " + (std::is_integral<Number>::value ? "whole " : "") +
				   "number; it must be from " + range;
		// In the number's own precision: .1f is more than .1.
		if (!(value >= Number(low) && value <= Number(high)))
			return "'" + text + "' is out of range; it must be from " + range;
		return std::string();
	};
	return CLI::Validator(check, range);
}
}  // namespace ep

#endif  // EP_OPTION_RANGE_H
