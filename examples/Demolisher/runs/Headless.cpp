// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "runs/Headless.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "runs/Figure11.h"
#include "runs/RunLog.h"
#include "text/OutputFiles.h"
#include "drawing/Cameras.h"
#ifdef EP_WITH_PICTURES
#include "picture/Picture.h"
#endif

namespace ep
{
namespace
{
const Margins WRECK_MARGINS = {.05f, .05f, .05f, .25f};  // of the picture, around what is left

/// At the first scene: the way to it may be too short for what is asked for.
void tellIfSlow(double fastest, const DemolisherSettings& settings)
{
	if (settings.route.empty() && fastest < .85 * double(settings.speed))
		std::printf("  --speed asks for %.1f m/s; on the way to the %s the vehicle comes to %.1f m/s\n",
					double(settings.speed), nameOf(scenes(), settings.onTheWay().front()).c_str(), fastest);
}
}  // namespace

void takePicture(const DemolisherScene& scene, const HeadlessSettings& headless, const std::string& name,
				 const Camera& camera)
{
#ifdef EP_WITH_PICTURES
	const Drawing drawing = scene.draw();
	const std::string file = (std::filesystem::path(headless.out) / (name + ".png")).string();
	writePng(file, drawPicture({drawing.parts, camera, drawing.skins, drawing.puffs}, headless.width, headless.height));
	std::printf("  picture %s\n", file.c_str());
#else
	(void)scene, (void)headless, (void)name, (void)camera;
#endif
}

void tell(const DemolisherSummary& s)
{
	std::printf("  %5.1f s  x %6.1f m  %5.1f km/h  sag %.3f m  yielded %d  broken %d of %d  plastic %.1f kJ\n", s.time,
				double(s.vehicle.x()), s.speed * 3.6, s.sag, s.yielded, s.broken, s.joints, s.plasticEnergy / 1000);
	std::fflush(stdout);
}

DemolisherSummary runHeadless(const DemolisherSettings& settings, const HeadlessSettings& headless)
{
	makeDirectory(headless.out);
#ifndef EP_WITH_PICTURES
	std::printf("Built without OpenGL and libpng: no pictures\n");
#endif
	DemolisherScene scene(settings);
	scene.setAutopilot(true);
	const Demolisher& demolisher = scene.demolisher();
	RunLog log(demolisher);
	const float aspect = float(headless.width) / float(headless.height);
	const auto take = [&](const std::string& name, const Camera& camera)
	{ takePicture(scene, headless, name, camera); };
	take("1-start", chaseCamera(demolisher.vehicle().pose()));
	// Each scene when the vehicle is there.
	const std::vector<Scene> way = settings.onTheWay();
	size_t next = 0;
	double fastest = 0;
	for (int i = 0; demolisher.time() + 1e-9 < headless.seconds && !demolisher.autopilot().hasArrived(); ++i)
	{
		if (i % int(1 / double(settings.step) + .5) == 0)
			tell(demolisher.summary());
		scene.step(Controls());
		log.step();
		fastest = std::max(fastest, double(demolisher.vehicle().speed()));
		if (next < way.size() && demolisher.vehicle().pose().getOrigin().x() > settings.placeOf(way[next]))
		{
			if (next == 0)
				tellIfSlow(fastest, settings);
			take(std::to_string(next + 2) + "-" + nameOf(scenes(), way[next]),
				 framingCamera(scene.bounds(), scene.sight(), aspect));
			++next;
		}
	}
	const Scene damaged = scene.mostDamaged();
	take(std::to_string(way.size() + 2) + "-end",
		 framingCamera(scene.wreckOf(damaged), DemolisherScene::sightOf(damaged), aspect, WRECK_MARGINS));

	const DemolisherSummary summary = demolisher.summary();
	tell(summary);
	if (!summary.isFinite())
		std::printf(
			"  Something has flown apart: these joints do not bear this step. Choose others, or smaller steps.\n");
	std::printf("  joints %s\n", writeFile(headless.out, "joints.csv", log.jointsCsv()).c_str());
	std::printf("  summary %s\n", writeFile(headless.out, "summary.json", log.summary()).c_str());
	return summary;
}

void runFigure11(const HeadlessSettings& headless)
{
	makeDirectory(headless.out);
	DemolisherScene scene(Figure11::settings());
	Demolisher& demolisher = scene.demolisher();
	Figure11 figure(demolisher);
	RunLog log(demolisher);
	// The vehicle and the gate in front, the bridge behind them, the fence at the end.
	Camera camera;
	const btScalar gate = demolisher.settings().placeOf(Scene::Gate);
	camera.eye = btVector3(gate - 42, 9, 21);
	camera.target = btVector3(gate + 10, btScalar(1.5), -3);
	camera.fieldOfView = .45f;
	for (Figure11::State state : {Figure11::INITIAL, Figure11::CROSSED, Figure11::FALLEN})
	{
		if (!figure.reach(state, [&log] { log.step(); }))
			throw std::runtime_error(std::string("the state of ") + Figure11::name(state) + " was not reached");
		tell(demolisher.summary());
		// What has fallen fills the picture.
		if (state == Figure11::FALLEN)
			camera = framingCamera(scene.wreckOf(Scene::Bridge), DemolisherScene::sightOf(Scene::Bridge),
								   float(headless.width) / float(headless.height), WRECK_MARGINS);
		takePicture(scene, headless, Figure11::name(state), camera);
		const std::string name = std::string(Figure11::name(state)) + ".json";
		std::printf("  summary %s\n", writeFile(headless.out, name, log.summary()).c_str());
	}
}
}  // namespace ep
