// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SAMPLES_H
#define EP_SAMPLES_H

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drawing/ViewedScene.h"
#include "world/Method.h"
#include "problems/Problem.h"

namespace ep
{
/// Something to look at.
struct Sample
{
	std::string name, what;
	/// Throws std::runtime_error if it cannot be shown.
	std::function<std::unique_ptr<ViewedScene>()> open;
	double pictureTime = -1;  ///< into it at which its picture is taken [s]; -1: of a replay when it has moved furthest
	bool isLarge = false;     ///< takes minutes

	/// The name of its picture, without a folder.
	std::string picture() const;
};

struct SampleGroup
{
	std::string title;
	std::vector<Sample> samples;
};

/// How problems, trials and scenes of destruction are computed.
struct SampleMethod
{
	Solver solver = Solver::Direct;
	JointKind joints = kinds::Ep2;
	/// Substeps as an error of 1 % asks for: what is shown is right.
	Stepping stepping = {1. / 60, 1, .01};
};

/// All that the project has to show.
/// \param folder  of scene files; without one there are none
std::vector<SampleGroup> allSamples(const SampleMethod& method, const std::string& folder);

/// Draws pictures of all samples that there are none of in a folder, but for the large ones.
void makePictures(const std::vector<SampleGroup>& groups, const std::string& folder);

/// \return null if there is none of that name
const Sample* findSample(const std::vector<SampleGroup>& groups, const std::string& name);

/// A line each.
std::string listOf(const std::vector<SampleGroup>& groups);

/// Throws std::runtime_error if there is none in it, or the build cannot read it.
std::unique_ptr<ViewedScene> openSceneFile(const std::string& file);
}  // namespace ep

#endif  // EP_SAMPLES_H
