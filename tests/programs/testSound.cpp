// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "sound/Speaker.h"
#include "sound/Voice.h"

namespace testSound
{
using namespace ep;

const int RATE = 44100;
const Burst::Kind KINDS[] = {Burst::Kind::Break, Burst::Kind::Blow, Burst::Kind::Charge};

double strongest(std::vector<float>::const_iterator from, std::vector<float>::const_iterator to)
{
	double most = 0;
	for (; from != to; ++from)
		most = std::max(most, std::fabs(double(*from)));
	return most;
}

TEST(Voice, IsHeardAndDiesAway)
{
	for (Burst::Kind kind : KINDS)
		for (bool isSteel : {false, true})
			for (double energy : {100., 1e6})
			{
				const std::vector<float> voice = voiceOf({kind, btVector3(0, 0, 0), energy, isSteel}, RATE);
				ASSERT_GT(voice.size(), 1000u);
				EXPECT_GT(strongest(voice.begin(), voice.begin() + long(voice.size() / 10)), .2);
				EXPECT_LE(strongest(voice.begin(), voice.end()), 1);
				EXPECT_LT(strongest(voice.end() - 100, voice.end()), .01) << "or it would click";
			}
}

TEST(Voice, IsLouderAndLongerWithEnergy)
{
	for (Burst::Kind kind : {Burst::Kind::Break, Burst::Kind::Blow})
	{
		const Burst light = {kind, btVector3(0, 0, 0), 1e3, true}, heavy = {kind, btVector3(0, 0, 0), 1e5, true};
		EXPECT_GT(loudnessOf(heavy), 1.5f * loudnessOf(light));
		EXPECT_GT(voiceOf(heavy, RATE).size(), voiceOf(light, RATE).size());
		EXPECT_EQ(loudnessOf({kind, btVector3(0, 0, 0), 1, true}), 0);
	}
}

TEST(Speaker, PlaysWithoutADevice)
{
#ifndef EP_WITH_OPENAL
	GTEST_SKIP() << "built without OpenAL";
#else
	// Into a file, as OpenAL Soft does without a device.
	const std::filesystem::path folder =
		std::filesystem::temp_directory_path() /
		("ep-sound-" + std::to_string(sizeof(btScalar)) + "-" + std::to_string(::getpid()));
	std::filesystem::create_directories(folder);
	const std::string sound = (folder / "sound.wav").string(), settings = (folder / "alsoft.conf").string();
	std::ofstream(settings) << "drivers = wave\n[wave]\nfile = " << sound << "\n";
	::setenv("ALSOFT_CONF", settings.c_str(), 1);
	const auto isHeard = [&sound]
	{
		std::ifstream file(sound, std::ios::binary);
		const std::string bytes{std::istreambuf_iterator<char>(file), {}};
		const size_t header = 128;
		return bytes.size() > header && bytes.find_first_not_of('\0', header) != std::string::npos;
	};
	{
		Speaker speaker;
		ASSERT_TRUE(speaker.isThere());
		speaker.listenFrom(Camera());
		const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
		for (int i = 0; !isHeard() && std::chrono::steady_clock::now() < end; ++i)
		{
			// More than there are voices.
			speaker.play({KINDS[i % 3], btVector3(0, 0, 0), 1e5, i % 2 == 0});
			std::this_thread::sleep_for(std::chrono::milliseconds(10));
		}
	}
	EXPECT_TRUE(isHeard());
	std::filesystem::remove_all(folder);
#endif
}
}  // namespace testSound
