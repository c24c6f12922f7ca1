#include "Headless.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "DemolisherScene.h"
#include "Summary.h"
#ifdef EP_WITH_PICTURES
#include "pictureRaster.h"
#endif

namespace ep
{
namespace
{
/// What the run shows, each when the vehicle gets there.
struct Shot
{
	const char* name;
	btScalar x;  ///< of the vehicle [m]
	bool chase;
};

const Shot SHOTS[] = {
	{"1-start", btScalar(-1e9), true}, {"2-on-the-bridge", btScalar(-4), true}, {"3-crossing", 0, false}};
const Shot LAST = {"4-end", 0, false};

std::string write(const std::string& file, const std::string& text)
{
	std::ofstream stream(file);
	if (!(stream << text << std::flush))
		throw std::runtime_error("cannot write the file '" + file + "'");
	return file;
}

void takePicture(const DemolisherScene& scene, const HeadlessSettings& headless, const Shot& shot)
{
#ifdef EP_WITH_PICTURES
	const Drawing drawing = scene.draw();
	const float aspect = float(headless.width) / float(headless.height);
	const Camera camera =
		shot.chase ? chaseCamera(drawing.subject) : sideCamera(scene.centre(), scene.extent(), aspect);
	const std::string file = (std::filesystem::path(headless.out) / (std::string(shot.name) + ".png")).string();
	writePng(file, drawPicture({drawing.parts, camera}, headless.width, headless.height));
	std::printf("  picture %s\n", file.c_str());
#else
	(void)scene, (void)headless, (void)shot;
#endif
}

void tell(const DemolisherSummary& s)
{
	std::printf("  %5.1f s  x %6.1f m  %5.1f km/h  sag %.3f m  yielded %d  broken %d of %d  plastic %.1f kJ\n", s.time,
				double(s.vehicle.x()), s.speed * 3.6, s.sag, s.yielded, s.broken, s.joints, s.plasticEnergy / 1000);
	std::fflush(stdout);
}
}  // namespace

DemolisherSummary runHeadless(const DemolisherSettings& settings, const HeadlessSettings& headless)
{
	std::error_code error;
	std::filesystem::create_directories(headless.out, error);
	if (error)
		throw std::runtime_error("cannot make the directory '" + headless.out + "': " + error.message());
#ifndef EP_WITH_PICTURES
	std::printf("Built without libpng: no pictures\n");
#endif

	DemolisherScene scene(settings);
	scene.setAutopilot(true);
	const Demolisher& demolisher = scene.demolisher();
	const int steps = int(headless.seconds / double(Demolisher::STEP) + .5);
	size_t shots = 0;
	for (int i = 0; i < steps && !demolisher.hasArrived(); ++i)
	{
		const btScalar x = demolisher.vehicle().pose().getOrigin().x();
		for (; shots < sizeof SHOTS / sizeof *SHOTS && x >= SHOTS[shots].x; ++shots)
			takePicture(scene, headless, SHOTS[shots]);
		if (i % 60 == 0)
			tell(demolisher.summary());
		scene.step(Controls());
	}
	takePicture(scene, headless, LAST);

	const DemolisherSummary summary = demolisher.summary();
	tell(summary);
	const std::string file = (std::filesystem::path(headless.out) / "summary.json").string();
	std::printf("  summary %s\n", write(file, toJson(summary, settings)).c_str());
	return summary;
}
}  // namespace ep
