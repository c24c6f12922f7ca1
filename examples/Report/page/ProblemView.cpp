// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "page/ProblemView.h"

#ifdef EP_WITH_PICTURES
#include <filesystem>
#include <fstream>
#include <sstream>

#include "picture/ScenePicture.h"
#include "problems/Catalogue.h"
#include "replay/ReplayScene.h"
#endif

namespace ep
{
#ifdef EP_WITH_PICTURES
namespace
{
const int WIDTH = 480, HEIGHT = 300;  // [pixels]

std::string base64(const std::string& bytes)
{
	const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::string text;
	for (size_t i = 0; i < bytes.size(); i += 3)
	{
		const size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
		unsigned three = 0;
		for (size_t k = 0; k < 3; ++k)
			three = three << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
		for (size_t k = 0; k < 4; ++k)
			text += k <= count ? digits[three >> (18 - 6 * k) & 63] : '=';
	}
	return text;
}

void draw(const Problem& problem, const std::string& file)
{
	// Our solver with the step control: what it shows is right.
	Stepping stepping;
	stepping.error = .01;
	ReplayScene scene(problem.name,
					  [&](const Watch& watch)
					  {
						  stepping.watch = watch;
						  problem.solve(Method(Solver::Direct), stepping);
						  return "";
					  });
	scene.goToFurthest();
	writePng(file, takePicture(scene, WIDTH, HEIGHT));
}
}  // namespace

std::string viewOfProblem(const std::string& name, const std::string& file)
{
	const Problem* const problem = findProblem(name);
	if (!problem)
		return "";
	if (!std::filesystem::exists(file))
		draw(*problem, file);
	std::ostringstream bytes;
	bytes << std::ifstream(file, std::ios::binary).rdbuf();
	return base64(bytes.str());
}
#else
std::string viewOfProblem(const std::string&, const std::string&) { return ""; }
#endif
}  // namespace ep
