// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_EXPECTED_RUN_H
#define EP_TEST_EXPECTED_RUN_H

#include <gtest/gtest.h>

#include "run/RunFiles.h"
#include "simulation/Probes.h"

namespace ep
{
/// Runs a scene to its end, which has to be as its file expects it; each file has to expect something.
inline void runAsExpected(Simulation& simulation)
{
	RunFiles files(simulation);
	while (simulation.ending() == Ending::None)
	{
		simulation.step();
		files.step();
	}
	EXPECT_NE(simulation.ending(), Ending::NotFinite);
	EXPECT_FALSE(simulation.scene().expectations.empty());
	for (const std::string& unmet : unmetExpectations(simulation, files.values()))
		ADD_FAILURE() << unmet;
}
}  // namespace ep

#endif  // EP_TEST_EXPECTED_RUN_H
