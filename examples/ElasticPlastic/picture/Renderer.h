// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_RENDERER_H
#define EP_PICTURE_RENDERER_H

#include "picture/Png.h"
#include "picture/Program.h"
#include "picture/Tile.h"

namespace ep
{
/// Draws with OpenGL, a window's pictures as those without one. Needs a current context all its life.
class Renderer
{
public:
	Renderer();
	~Renderer();

	/// \param divisor  of rows and columns: above 1 fewer are computed, and drawn larger
	void draw(const View& view, const Tile& tile, int divisor = 1);

	/// What has been drawn.
	static Image read(int width, int height);

private:
	void drawScene(const View& view, const Tile& tile);
	void drawPuffs(const View& view, float aspect, const Matrix& sun);
	void prepareSmall(const Tile& tile);
	void enlarge(const Tile& tile);
	void drawShadowMap(const std::vector<Vertex>& mesh, const Matrix& sun);
	void setLight(const Program& program, const Camera& camera, const Matrix& sun) const;

	Program m_surface, m_puff, m_background, m_shadow;
	unsigned m_shadowMap = 0, m_shadowFrame = 0;
	unsigned m_small = 0, m_smallDepth = 0, m_smallFrame = 0;  ///< what is enlarged; 0: never yet
	int m_smallWidth = 0, m_smallHeight = 0;
	unsigned m_target = 0;  ///< the frame that a scene is drawn into, 0: the window
};
}  // namespace ep

#endif  // EP_PICTURE_RENDERER_H
