// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Picture.h"

#include "picture/OffScreen.h"
#include "picture/Renderer.h"

namespace ep
{
Image drawPicture(const View& view, int width, int height)
{
	// Opened once: shaders are compiled.
	struct Studio
	{
		OffScreen offScreen;
		Renderer renderer;
	};
	static Studio studio;
	studio.offScreen.begin(width, height);
	studio.renderer.draw(view, {0, 0, width, height});
	return Renderer::read(width, height);
}
}  // namespace ep
