// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_COMPLAINTS_H
#define EP_COMPLAINTS_H

#include <stdexcept>
#include <string>
#include <vector>

#include "scenefile/Node.h"

namespace ep
{
/// What is wrong with a scene; the text has a line for each complaint.
class SceneError : public std::runtime_error
{
public:
	using std::runtime_error::runtime_error;
};

/// All that is wrong with a file, so that a person is told of it at once.
class Complaints
{
public:
	/// \param path  in the file, such as bodies.ball.mass; empty: the file itself
	void add(const Place& place, const std::string& path, const std::string& what);

	bool any() const { return m_count > 0; }

	/// Throws a SceneError if there is any.
	void check() const;

private:
	std::vector<std::string> m_lines;  ///< the first ones
	size_t m_count = 0;
};

/// Of several names the one that is nearest to what was written. \return empty if none is near
std::string nearestName(const std::string& written, const std::vector<std::string>& known);

/// "'spam' is not known; did you mean 'span'? Known are ..."
std::string unknownName(const std::string& written, const std::vector<std::string>& known);
}  // namespace ep

#endif  // EP_COMPLAINTS_H
