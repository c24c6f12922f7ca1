// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/Complaints.h"

#include <algorithm>

#include "json/JsonFile.h"

namespace ep
{
namespace
{
const size_t MOST_LINES = 20, MOST_NAMES = 30;

/// How many letters have to be changed, added, left out or swapped with their neighbour to make one name from another
/// (optimal string alignment).
size_t distance(const std::string& a, const std::string& b)
{
	std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
	for (size_t i = 0; i <= a.size(); ++i)
		for (size_t j = 0; j <= b.size(); ++j)
		{
			d[i][j] = i == 0   ? j
					  : j == 0 ? i
							   : std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
			if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
				d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
		}
	return d[a.size()][b.size()];
}
}  // namespace

void Complaints::add(const Place& place, const std::string& path, const std::string& what)
{
	if (m_lines.size() < MOST_LINES)
		m_lines.push_back(place.text() + ": " + path + (path.empty() ? "" : " ") + what);
	++m_count;
}

void Complaints::check() const
{
	if (!any())
		return;
	std::string text;
	for (const std::string& line : m_lines)
		text += (text.empty() ? "" : "\n") + line;
	if (m_count > m_lines.size())
		text += "\nand " + std::to_string(m_count - m_lines.size()) + " more";
	throw SceneError(text);
}

std::string nearestName(const std::string& written, const std::vector<std::string>& known)
{
	const size_t longest = 64;
	std::string nearest;
	// A third of its letters may be wrong; what is shorter than three is like anything.
	size_t least = written.size() / 3 + 1;
	for (const std::string& name : known)
		if (written.size() <= longest && name.size() <= longest && distance(written, name) < least)
		{
			least = distance(written, name);
			nearest = name;
		}
	return nearest;
}

std::string unknownName(const std::string& written, const std::vector<std::string>& known)
{
	std::string text = shown(written) + " is not known";
	const std::string nearest = nearestName(written, known);
	if (!nearest.empty())
		text += "; did you mean " + shown(nearest) + "?";
	else if (known.empty())
		text += ": there are none";
	else
	{
		text += "; known are ";
		for (size_t i = 0; i < std::min(known.size(), MOST_NAMES); ++i)
			text += (i > 0 ? ", " : "") + known[i];
		if (known.size() > MOST_NAMES)
			text += " and " + std::to_string(known.size() - MOST_NAMES) + " more";
	}
	return text;
}
}  // namespace ep
