#ifndef EP_OPTION_RANGE_H
#define EP_OPTION_RANGE_H

#include <CLI/CLI.hpp>
#include <cstdio>

namespace ep
{
/// A number from low to high. CLI::Range lets what is not a number pass.
inline CLI::Validator optionRange(double low, double high)
{
	char range[64];
	std::snprintf(range, sizeof range, "%g to %g", low, high);
	const auto check = [low, high, must = std::string("; it must be from ") + range](std::string& text)
	{
		double value = 0;
		if (!CLI::detail::lexical_cast(text, value))
			return "'" + text + "' is no number" + must;
		if (!(value >= low && value <= high))
			return "'" + text + "' is out of range" + must;
		return std::string();
	};
	return CLI::Validator(check, range);
}
}  // namespace ep

#endif  // EP_OPTION_RANGE_H
