// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Worlds that threads of a game step at the same time share nothing: each gives the bits that it gives alone.

#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticSnapshot.h"
#include "scenes/destruction/Catalogue.h"
#include "support/Precision.h"

namespace testWorldsInThreads
{
using namespace ep;

/// The bodies' places after some frames, before one of which the world is saved and restored. (Of loose bodies Bullet finds pairs in an order that is of
/// addresses, too.)
std::vector<btVector3> places(const char* scene, int frames)
{
	const DestructionScene& found = *findDestructionScene(scene);
	Stage::Settings settings;
	settings.strength = found.strength;
	Stage stage(settings);
	found.build(stage);
	World& world = stage.world();
	auto& broadphase = static_cast<btDbvtBroadphase&>(*world.bullet().getBroadphase());
	std::vector<unsigned char> bytes;
	while (stage.frame() < frames)
	{
		stage.playScript();
		if (stage.frame() == frames / 2)
		{
			bytes.resize(size_t(btElasticPlasticSave(world.bullet(), broadphase, world.action(), nullptr, 0)));
			btElasticPlasticSave(world.bullet(), broadphase, world.action(), bytes.data(), int(bytes.size()));
			btElasticPlasticRestore(world.bullet(), broadphase, world.action(), bytes.data(), int(bytes.size()));
		}
		stage.step();
	}
	std::vector<btVector3> result;
	for (const auto& body : world.bodies())
		result.push_back(body->getCenterOfMassPosition());
	return result;
}

TEST(WorldsInThreads, GiveTheBitsThatTheyGiveAlone)
{
	const struct
	{
		const char* name;
		int frames;
	} scenes[] = {{"pyramid", 40}, {"frame", 70}, {"pyramid", 50}, {"frame", 65}};
	const size_t number = sizeof scenes / sizeof scenes[0];
	std::vector<btVector3> together[number];
	std::vector<std::thread> threads;
	for (size_t i = 0; i < number; ++i)
		threads.emplace_back([&, i] { together[i] = places(scenes[i].name, scenes[i].frames); });
	for (std::thread& thread : threads)
		thread.join();
	for (size_t i = 0; i < number; ++i)
	{
		const std::vector<btVector3> alone = places(scenes[i].name, scenes[i].frames);
		ASSERT_EQ(alone.size(), together[i].size());
		ASSERT_LT(0u, alone.size());
		for (size_t k = 0; k < alone.size(); ++k)
			for (int axis = 0; axis < 3; ++axis)
				ASSERT_EQ(alone[k][axis], together[i][k][axis]) << scenes[i].name << ", body " << k;
	}
}
}  // namespace testWorldsInThreads
