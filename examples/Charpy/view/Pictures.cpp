// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/Pictures.h"

#include <cstdio>
#include <stdexcept>

#include "view/Drawing.h"
#ifdef EP_WITH_PICTURES
#include "picture/Picture.h"
#endif

namespace ep::charpy
{
#ifdef EP_WITH_PICTURES
void takePictures(const Settings& settings, const std::string& directory)
{
	const struct
	{
		const char* name;
		double angle, bend;
		Viewpoint view;
	} shots[] = {{"detail-1-before", -0.03, -1, DETAIL},
				 {"detail-2-bending", -9, 0.8, DETAIL},
				 {"overview", -9, 1.2, OVERVIEW},
				 {"detail-3-passing", -9, 1.9, DETAIL},
				 {"detail-4-passed", 0.045, -1, DETAIL}};
	ImpactTest charpy(settings);
	for (const auto& shot : shots)
	{
		while (!charpy.isOver() && (charpy.angle() < shot.angle || charpy.result().hingeAngle < shot.bend))
			charpy.step();
		const std::string file = directory + "/charpy-" + shot.name + ".png";
		writePng(file, drawPicture(viewsOf(charpy, true)[shot.view], 960, 600));
		std::printf("  picture %s\n", file.c_str());
	}
}
#else
void takePictures(const Settings&, const std::string&)
{
	throw std::runtime_error("no pictures (--pictures): built without OpenGL and libpng");
}
#endif
}  // namespace ep::charpy
