// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_WINDOW_OPTIONS_H
#define EP_WINDOW_OPTIONS_H

#include <string>

namespace ep
{
class CommandLine;

/// The camera that a window begins with.
enum class WindowCamera
{
	Own,  ///< the scene's; if it has none Chase of what is driven, else Side
	Chase,
	Free,
	Side
};

/// What is asked of a program with a window.
struct WindowOptions
{
	int width = 1280, height = 720;
	WindowCamera camera = WindowCamera::Own;
	std::string screenshot;     ///< a PNG to save and then end; empty: run until the window is closed
	double screenshotTime = 9;  ///< simulated time to run before [s]
	std::string record;         ///< a film to make and then end, a picture every sixtieth of a second; empty: none
	double recordTime = 20;     ///< its length [s]
	double textSize = 0;        ///< of a line [pixels]; 0: by the screen's resolution
	bool noPanel = false;       ///< hidden at the beginning, where the scene has one
	bool isSilent = false;      ///< at the beginning
	bool filmPanel = false;     ///< shown in a film

	/// Is there a picture or a film to make, for which there must be a window?
	bool isFilmed() const { return !screenshot.empty() || !record.empty(); }
};

/// Adds all of them to a command line; what they are now are the defaults.
void addWindowOptions(CommandLine& line, WindowOptions& options);
}  // namespace ep

#endif  // EP_WINDOW_OPTIONS_H
