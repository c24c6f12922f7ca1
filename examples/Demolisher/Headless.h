#ifndef EP_HEADLESS_H
#define EP_HEADLESS_H

#include <string>

#include "Demolisher.h"

namespace ep
{
struct HeadlessSettings
{
	std::string out = "demo-output";  ///< directory for summary.json and pictures, made if it is not there
	double seconds = 60;              ///< simulated at most; it ends when the vehicle has arrived [s]
	int width = 1280, height = 720;   ///< of the pictures
};

/// Lets the autopilot drive across, tells of it on the terminal, and leaves pictures and a summary.
/// Throws std::runtime_error if a file cannot be written.
DemolisherSummary runHeadless(const DemolisherSettings& settings, const HeadlessSettings& headless);
}  // namespace ep

#endif  // EP_HEADLESS_H
