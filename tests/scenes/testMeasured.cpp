// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Scenes that are compared with measurements in docs/validation.md. What was measured is no bound here.

#include <algorithm>
#include <filesystem>

#include "scenes/ExpectedRun.h"
#include "scenes/Scenes.h"

namespace testMeasured
{
using namespace ep;

class Measured : public testing::TestWithParam<const char*>
{
};

TEST_P(Measured, RunsAsExpected)
{
	const std::string file =
		(std::filesystem::path(EP_SOURCE_DIR) / "examples/scenes/measured" / GetParam()).string() + ".json";
	Simulation simulation(describeScene(SceneText::read(file)));
	runAsExpected(simulation);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Measured,
						 testing::Values("column-removal-welded", "column-removal-reduced", "drop-on-concrete-beam",
										 "charpy-general-yield", "bollard-m50"),
						 [](const auto& info)
						 {
							 std::string name = info.param;
							 std::replace(name.begin(), name.end(), '-', '_');
							 return name;
						 });
}  // namespace testMeasured
