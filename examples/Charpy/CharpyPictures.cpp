#include "CharpyPictures.h"

#include <cstdio>
#include <stdexcept>

#include "CharpyDrawing.h"
#ifdef EP_WITH_PICTURES
#include "pictureRaster.h"
#endif

namespace ep
{
#ifdef EP_WITH_PICTURES
namespace
{
Camera camera(double ex, double ey, double ez, double tx, double ty, double tz)
{
	Camera c;
	const btVector3 level(0, btScalar(CHARPY_DRAWN_LEVEL), 0);
	c.eye = level + btVector3(btScalar(ex), btScalar(ey), btScalar(ez));
	c.target = level + btVector3(btScalar(tx), btScalar(ty), btScalar(tz));
	return c;
}
}  // namespace

void takeCharpyPictures(const CharpySettings& settings, const std::string& directory)
{
	// From above, and from the side with all of the hammer.
	const Camera detail = camera(7, 15, 9, 1, 0, 0);
	const Camera overview = camera(40, 14, 70, -14, 8, 0);
	const struct
	{
		const char* name;
		double angle, bend;
		bool cut;
	} shots[] = {{"detail-1-before", -0.03, -1, true},
				 {"detail-2-bending", -9, 0.8, true},
				 {"overview", -9, 1.2, false},
				 {"detail-3-passing", -9, 1.9, true},
				 {"detail-4-passed", 0.045, -1, true}};
	Charpy charpy(settings);
	for (const auto& shot : shots)
	{
		while (!charpy.isOver() && (charpy.angle() < shot.angle || charpy.result().hingeAngle < shot.bend))
			charpy.step();
		const std::string file = directory + "/charpy-" + shot.name + ".png";
		writePng(file, drawPicture(drawCharpy(charpy, shot.cut), shot.cut ? detail : overview, 960, 600));
		std::printf("  picture %s\n", file.c_str());
	}
}
#else
void takeCharpyPictures(const CharpySettings&, const std::string&)
{
	throw std::runtime_error("no pictures (--pictures): built without libpng");
}
#endif
}  // namespace ep
