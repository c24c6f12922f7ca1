// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_RENDERER_H
#define EP_VIEWER_RENDERER_H

#include "picture/Png.h"
#include "viewer/Layout.h"
#include "viewer/Program.h"

namespace ep
{
/// Draws with OpenGL what drawPicture() draws without. Needs a current context all its life.
class Renderer
{
public:
	Renderer();
	~Renderer();

	void draw(const View& view, const Tile& tile);

	/// What is in the back buffer.
	static Image read(int width, int height);

private:
	void drawShadowMap(const std::vector<Vertex>& mesh, const Matrix& sun);
	void setLight(const Program& program, const Camera& camera, const Matrix& sun) const;

	Program m_surface, m_background, m_shadow;
	unsigned m_shadowMap = 0, m_shadowFrame = 0;
};
}  // namespace ep

#endif  // EP_VIEWER_RENDERER_H
