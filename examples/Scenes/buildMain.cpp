// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-build: makes a scene's file of a model whose pieces touch.

#include <CLI/CLI.hpp>
#include <iostream>

#include "build/BondedScene.h"
#include "simulation/Simulation.h"
#include "text/OutputFiles.h"

int main(int argc, char** argv)
{
	CLI::App app("Makes a scene of a glTF model: its pieces become bodies, joined where faces of them touch");
	std::string model, out = "scene.json";
	ep::BondSettings settings;
	app.add_option("model", model, "FILE.glb or FILE.gltf, each mesh a box or another convex piece")->required();
	app.add_option("--out", out, "The scene's file that is written")->capture_default_str();
	app.add_option("--material", settings.material,
				   "Of pieces that name none by a custom property or their surface's name")
		->capture_default_str();
	app.add_option("--materials", settings.materials,
				   "A scene's file with materials, which is included; else there is steel")
		->check(CLI::ExistingFile);
	app.add_option("--static", settings.fixed,
				   "Name or pattern of pieces that do not move; also by their property motion");
	app.add_option("--gap", settings.gap, "The largest that counts as touching, and how deep pieces may overlap [m]")
		->check(CLI::Range(1e-6, 10.))
		->capture_default_str();
	app.add_flag("--ground", settings.ground, "There is one, at height 0");
	CLI11_PARSE(app, argc, argv);
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
