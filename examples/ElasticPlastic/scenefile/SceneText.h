// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SCENE_TEXT_H
#define EP_SCENE_TEXT_H

#include <map>

#include "scenefile/Complaints.h"

namespace ep
{
/// A value that is put in place of what a file says: its path, such as bodies.ball.mass or the name of a parameter alone, and
/// what a JSON file would say there; what is no JSON is a text.
struct Setting
{
	std::string path, value;

	/// From "path=value". Throws a SceneError.
	static Setting from(const std::string& text);
};

/// A scene's file with those that it includes and with settings put in, and the values of its parameters.
struct SceneText
{
	Node root;
	std::map<std::string, double> parameters;
	std::vector<std::string> files;  ///< that were read

	/// Throws a SceneError with all that is wrong.
	static SceneText read(const std::string& file, const std::vector<Setting>& settings = {});

	/// From a text, which can include files by paths that begin at a folder.
	static SceneText parse(const std::string& text, const std::string& name, const std::vector<Setting>& settings = {},
						   const std::string& folder = ".");
};

/// Computes an expression of parameters, such as span / 2 + 0.1. \return what is wrong with it, empty: nothing
std::string evaluate(const std::string& expression, const std::map<std::string, double>& parameters, double& value);
}  // namespace ep

#endif  // EP_SCENE_TEXT_H
