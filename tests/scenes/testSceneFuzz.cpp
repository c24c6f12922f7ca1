// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Scene files that have been spoilt, by seeds: each is read or refused with a message, and never crashes.

#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>

#include "scenes/Scenes.h"
#include "simulation/Probes.h"

namespace testSceneFuzz
{
using namespace ep;

typedef std::mt19937 Random;

size_t below(Random& random, size_t n) { return n == 0 ? 0 : random() % n; }

/// What people and programs get wrong, in place of a value or in the middle of one.
const char* const SPOILERS[] = {
	"null",      "-1",     "0",    "1e308", "1e-308",      "-0",         "NaN",
	"[]",        "{}",     "\"\"", "\"*\"", "\"=1/0\"",    "true",       "\"=(\"",
	"\"world\"", "[[[[[[", "\xff", "1e999", "\"\\u0000\"", "\"=span+\"", "99999999999999999999",
	",",         "//",     "/*"};

/// Where a value begins: behind a colon, a comma or a bracket.
size_t someValue(Random& random, const std::string& text)
{
	const size_t from = below(random, text.size());
	const size_t found = text.find_first_of(":,[", from);
	return found == std::string::npos ? from : found + 1;
}

/// Numbers that are other numbers: what is described is mostly possible, and is computed.
std::string varied(Random& random, const std::string& text)
{
	std::string out;
	for (size_t i = 0; i < text.size();)
	{
		const bool isNumber =
			isdigit((unsigned char)(text[i])) && i > 0 && strchr(" [-", text[i - 1]) && below(random, 8) == 0;
		char* end = nullptr;
		const double number = isNumber ? strtod(text.c_str() + i, &end) : 0;
		if (isNumber)
		{
			out += std::to_string(number * double(1 + below(random, 20)) / 8);
			i = size_t(end - text.c_str());
		}
		else
			out += text[i++];
	}
	return out;
}

std::string spoilt(Random& random, std::string text)
{
	if (below(random, 3) == 0)
		return varied(random, text);
	for (size_t times = 1 + below(random, 4); times > 0 && !text.empty(); --times)
	{
		const size_t at = someValue(random, text), end = std::min(text.find_first_of(",]}\n", at), text.size());
		const char* const spoiler = SPOILERS[below(random, std::size(SPOILERS))];
		switch (below(random, 6))
		{
			case 0:
				text.resize(at);
				break;
			case 1:
				text.erase(at, below(random, 30));
				break;
			case 2:
				text.insert(at, text.substr(below(random, text.size()), below(random, 60)));
				break;
			case 3:
				text[below(random, text.size())] = char(random());
				break;
			default:
				text.replace(at, std::max(at, end) - at, spoiler);
		}
	}
	return text;
}

std::vector<std::string> originals()
{
	std::vector<std::string> texts;
	for (const char* name :
		 {"materials", "block-under-tension", "cantilever", "guard-rail", "mast-in-gust", "portal", "slab-and-mass"})
	{
		std::ifstream stream(std::string(EP_SOURCE_DIR) + "/examples/scenes/" + name + ".json");
		texts.emplace_back((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
	}
	// All that the others do not use.
	texts.push_back(
		R"({"version": 1, "parameters": {"span": {"value": 2, "least": 1}}, "world": {"error": 0.1, "ramp": 0.1},
		"materials": {"m": {}}, "bodies": [{"name": "h", "hull": [0,0,0, 1,0,0, 0,1,0, 0,0,1], "at": [9, 9, 9], "turn": [1, 0, 0, 30]},
		{"name": "t", "mesh": [0,0,0, 1,0,0, 0,0,1], "motion": "static", "at": [0, -5, 0]}, {"name": "c", "capsule": [0.2, 1], "at": [3, 9, 3]},
		{"name": "k", "box": ["=span", 1, 1], "motion": "kinematic", "at": [-9, 0, 0], "path": [{"time": 0, "at": [-9, 0, 0]}, {"time": 1, "at": [-8, 0, 0]}]}],
		"joints": [{"name": "j", "from": "h", "at": [9, 9, 9], "capacity": {"axial": {"stiffness": 1e5, "yield": 100, "ductility": 0.1}}},
		{"name": "g", "from": "c", "to": "h", "type": "hinge", "motor_speed": 1, "motor_force": 5, "breaks_at": 1e3}],
		"loads": [{"on": "h", "moment": [1, 0, 0], "frequency": 2}], "blasts": [{"at": [0, 0, 0], "time": 0.01}],
		"events": [{"time": 0.02, "cut": "g", "push": "c", "velocity": [0, 1, 0]}],
		"probes": [{"name": "p", "of": "*", "measure": "contact_force", "with": "t", "gather": "mean"}], "end": {"standstill": 0.1},
		"vehicles": [{"name": "v", "kind": "car", "at": [-40, 0, 0], "velocity": 3, "route": [{"to": [-30, 0], "speed": 5, "stop": false}, {"wait": 1}]}],
		"structures": [{"wall": {"name": "w", "material": "m", "length": 2, "height": 1, "thickness": 0.2, "at": [20, 0, 0]}},
		{"grid": {"name": "q", "material": "m", "at": [40, 0, 0], "count_x": 2, "count_y": 2, "count_z": 2}},
		{"chain": {"name": "r", "material": "m", "section": {"circle": 0.05}, "from": [50, 5, 0], "to": [52, 5, 0], "sag": 0.3}}]})");
	return texts;
}
/// Reads it, and computes some steps if it is small. \return whether it was refused
bool isRefused(const std::function<SceneText()>& read, int& computed)
{
	const size_t smallScene = 300;  // bodies: larger ones are described, but not built
	try
	{
		const SceneDescription scene = describeScene(read());
		if (scene.bodies.size() > smallScene)
			return false;
		Simulation simulation(scene);
		for (int i = 0; i < 3 && simulation.ending() == Ending::None; ++i)
		{
			simulation.step();
			for (const auto& probe : scene.probes)
				readProbe(simulation, probe);
		}
		++computed;
	}
	catch (const SceneError& error)
	{
		EXPECT_GT(std::string(error.what()).size(), 10u);
		EXPECT_LT(std::string(error.what()).size(), 20000u);
		return true;
	}
	return false;
}

/// A path of the text's keys and names, in any order.
std::string somePath(Random& random, const std::string& text)
{
	std::string path;
	for (size_t parts = 1 + below(random, 4); parts > 0; --parts)
	{
		const size_t begin = text.find('"', below(random, text.size())), end = text.find('"', begin + 1);
		if (end < text.size())
			path += (path.empty() ? "" : ".") + text.substr(begin + 1, end - begin - 1);
	}
	return path;
}

TEST(SceneFuzz, SpoiltFilesAreReadOrRefusedWithAMessage)
{
	const int cases = 700;
	const std::vector<std::string> texts = originals();
	int refused = 0, computed = 0;
	for (int seed = 0; seed < cases; ++seed)
	{
		SCOPED_TRACE(seed);
		Random random(seed);
		const std::string text = spoilt(random, texts[below(random, texts.size())]);
		const auto read = [&]
		{ return SceneText::parse(text, "spoilt.json", {}, std::string(EP_SOURCE_DIR) + "/examples/scenes"); };
		refused += isRefused(read, computed);
	}
	// Neither is everything refused, nor everything taken.
	EXPECT_GT(refused, cases / 5);
	EXPECT_GT(computed, cases / 20);
}

TEST(SceneFuzz, SpoiltIncludesAndSettingsAreReadOrRefusedWithAMessage)
{
	const int cases = 400;
	const TemporaryFolder folder;
	const std::vector<std::string> texts = originals();
	const std::string own =
		R"({"version": 1, "include": ["materials.json", {"file": "spoilt.json", "set": {"PATH": VALUE}}],
		"world": {"step": 0.01}, "bodies": [{"name": "own", "sphere": 1, "at": [99, 99, 99]}]})";
	folder.write("materials.json", texts[0]);
	int refused = 0, computed = 0;
	for (int seed = 0; seed < cases; ++seed)
	{
		SCOPED_TRACE(seed);
		Random random(seed);
		const std::string& text = texts[below(random, texts.size())];
		folder.write("spoilt.json", below(random, 2) == 0 ? spoilt(random, text) : text);
		std::string outer = own;
		const bool isSet = below(random, 3) == 0;
		outer.replace(outer.find("PATH"), 4, isSet ? somePath(random, text) : "world.step");
		outer.replace(outer.find("VALUE"), 5, isSet ? SPOILERS[below(random, std::size(SPOILERS))] : "0.01");
		const std::string file = folder.write("own.json", below(random, 4) == 0 ? spoilt(random, outer) : outer);
		std::vector<Setting> settings;
		if (below(random, 4) == 0)
			settings.push_back({somePath(random, text), SPOILERS[below(random, std::size(SPOILERS))]});
		refused += isRefused([&] { return SceneText::read(file, settings); }, computed);
	}
	EXPECT_GT(refused, cases / 5);
	EXPECT_GT(computed, cases / 20);
}
}  // namespace testSceneFuzz
