// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-build: makes a scene's file of a model whose pieces touch.

#include <iostream>

#include "build/BondedScene.h"
#include "cli/CommandLine.h"
#include "simulation/Simulation.h"
#include "text/OutputFiles.h"

int main(int argc, char** argv)
{
	ep::CommandLine line("Makes a scene of a glTF model: its pieces become bodies, joined where faces of them touch");
	std::string model, out = "scene.json";
	ep::BondSettings settings;
	line.add("model", model, "FILE.glb or FILE.gltf, each mesh a box or another convex piece").required();
	line.add("--out", out, "The scene's file that is written").showDefault();
	line.add("--material", settings.material, "Of pieces that name none by a custom property or their surface's name")
		.showDefault();
	line.add("--materials", settings.materials, "A scene's file with materials, which is included; else there is steel")
		.existingFile();
	line.add("--static", settings.fixed, "Name or pattern of pieces that do not move; also by their property motion");
	line.add("--gap", settings.gap, "The largest that counts as touching, and how deep pieces may overlap [m]")
		.within(1e-6, 10)
		.showDefault();
	line.addFlag("--ground", settings.ground, "There is one, at height 0");
	if (const std::optional<int> status = line.parse(argc, argv))
		return *status;
	try
	{
		const ep::BondedScene made = ep::bondPieces(ep::readModel(model), settings, out);
		for (const std::string& remark : made.remarks)
			std::cout << remark << "\n";
		ep::Simulation simulation(made.scene);  // refuses what stands in each other
		ep::writeText(out, made.text);
		std::cout << made.scene.bodies.size() << " bodies and " << made.scene.joints.size() << " joints in " << out
				  << "\n";
		return 0;
	}
	catch (const std::exception& error)
	{
		std::cerr << error.what() << "\n";
	}
	return 1;
}
