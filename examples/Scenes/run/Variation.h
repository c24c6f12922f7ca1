// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VARIATION_H
#define EP_VARIATION_H

#include <string>
#include <vector>

namespace ep
{
/// Cases of a scene in which values differ: each is a list of "path=value", in the order of the paths.
struct Variation
{
	std::vector<std::string> paths;
	std::vector<std::vector<std::string>> cases;  ///< values, one for each path

	/// \param sweeps  "path=from:to:count", all combinations of them
	/// \param random  how many cases of each combination; 0: one, and nothing is drawn
	/// \param vary    "path=normal(mean, deviation)", uniform(from, to) or lognormal(median, deviation of the logarithm)
	/// The same seed draws the same values, on the same machine. Throws a std::runtime_error that names what is wrong.
	static Variation make(const std::vector<std::string>& sweeps, int random, const std::vector<std::string>& vary,
						  unsigned seed);

	/// The same cases read and written: a folder with results is for one variation.
	std::string text() const;
};
}  // namespace ep

#endif  // EP_VARIATION_H
