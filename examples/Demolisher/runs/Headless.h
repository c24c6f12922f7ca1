// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_HEADLESS_H
#define EP_HEADLESS_H

#include <string>

#include "view/DemolisherScene.h"

namespace ep
{
struct HeadlessSettings
{
	std::string out = "demo-output";  ///< directory for what is left, made if it is not there
	double seconds = 60;              ///< simulated at most; it ends when the vehicle has arrived [s]
	int width = 1280, height = 720;   ///< of the pictures
};

/// Lets the autopilot drive, tells of it on the terminal, and leaves summary.json, joints.csv and pictures.
/// Throws std::runtime_error if a file cannot be written.
DemolisherSummary runHeadless(const DemolisherSettings& settings, const HeadlessSettings& headless);

/// The paper's Figure 11: three pictures, and a summary of each of the three states.
void runFigure11(const HeadlessSettings& headless);

// What they are made of.

/// Where a build has libpng.
void takePicture(const DemolisherScene& scene, const HeadlessSettings& headless, const std::string& name,
				 const Camera& camera);

/// A line on the terminal.
void tell(const DemolisherSummary& summary);
}  // namespace ep

#endif  // EP_HEADLESS_H
