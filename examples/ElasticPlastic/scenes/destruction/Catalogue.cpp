// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/destruction/Catalogue.h"

#include "scenes/destruction/Buildings.h"
#include "scenes/destruction/Decks.h"
#include "scenes/destruction/Props.h"
#include "scenes/destruction/Walls.h"

namespace ep
{
namespace
{
/// For a list: how a scene with these parameters is built.
template <class Scene>
std::function<void(Stage&)> of(const Scene& scene)
{
	return [scene](Stage& stage) { scene.build(stage); };
}

Wall wall(int columns, int rows, int balls = 2)
{
	Wall wall;
	wall.columns = columns;
	wall.rows = rows;
	wall.balls = balls;
	return wall;
}

Lattice lattice(int side)
{
	Lattice lattice;
	lattice.side = side;
	return lattice;
}
}  // namespace

const std::vector<DestructionScene>& destructionScenes()
{
	static const std::vector<DestructionScene> scenes = {
		{"wall-hit", "a wall of 500 blocks hit by two balls of 10 t", 300, false, of(wall(25, 20))},
		{"wall-2000-hit", "the same with 2000 blocks", 300, true, of(wall(50, 40))},
		{"wall-10000-hit", "a wall of 10000 blocks and 20000 joints hit in one place", 90, true, of(wall(100, 100, 1))},
		{"frame", "a building of 4 storeys loses the columns of its front, all but one", 240, false, of(Frame())},
		{"weak-frame", "the same with a tenth of the strength comes down", 240, false, of(Frame()), btScalar(0.1)},
		{"tower", "a tower of 288 blocks is shot to pieces", 360, false, of(Tower())},
		{"city", "50 buildings asleep, of which one is destroyed", 400, false, of(City())},
		{"bridge", "a jointed bridge with 10 vehicles that drive", 240, false, of(Bridge())},
		{"plate", "500 loose boxes on a jointed plate, which a ball hits", 300, false, of(Plate())},
		{"pyramid", "a pyramid of 55 boxes on a jointed deck", 180, false, of(PyramidOnDeck())},
		{"props", "200 signs and fences on the ground, and balls that roll into them", 300, false, of(Props())},
		{"lattice", "a lattice of 8 x 8 x 8 cubes hit by a ball", 180, false, of(lattice(8))},
		{"lattice-15", "a lattice of 15 x 15 x 15 cubes hit by a ball", 75, true, of(lattice(15))}};
	return scenes;
}

const DestructionScene* findDestructionScene(const std::string& name)
{
	for (const DestructionScene& scene : destructionScenes())
		if (name == scene.name)
			return &scene;
	return nullptr;
}

int playDestruction(const DestructionScene& scene, bool isBulletsWay, const Watch& watch)
{
	Stage::Settings settings;
	settings.isBulletsWay = isBulletsWay;
	settings.strength = scene.strength;
	Stage stage(settings);
	scene.build(stage);
	watch(stage.world(), 0);
	while (stage.frame() < scene.frames)
	{
		stage.playScript();
		stage.step();
		watch(stage.world(), stage.frame() * Stage::FRAME);
	}
	return stage.numBroken();
}
}  // namespace ep
