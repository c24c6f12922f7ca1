// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Renderer.h"

#include <algorithm>
#include <utility>

#include "picture/Gl.h"
#include "picture/Shaders.h"

namespace ep
{
namespace
{
const int SHADOW_SIZE = 2048;  // the shaders' too
}

Renderer::Renderer()
	: m_surface(SHADER_SURFACE_VERTEX, std::string(SHADER_LIGHT) + SHADER_SURFACE),
	  m_puff(SHADER_SURFACE_VERTEX, std::string(SHADER_LIGHT) + SHADER_PUFF),
	  m_background(SHADER_BACKGROUND_VERTEX, std::string(SHADER_LIGHT) + SHADER_BACKGROUND),
	  m_shadow(SHADER_SHADOW_VERTEX, SHADER_SHADOW)
{
	glGenTextures(1, &m_shadowMap);
	glBindTexture(GL_TEXTURE_2D, m_shadowMap);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, SHADOW_SIZE, SHADOW_SIZE, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
				 nullptr);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
	glGenFramebuffers(1, &m_shadowFrame);
	glBindFramebuffer(GL_FRAMEBUFFER, m_shadowFrame);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, m_shadowMap, 0);
	glDrawBuffer(GL_NONE);
	glReadBuffer(GL_NONE);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Renderer::~Renderer()
{
	glDeleteFramebuffers(1, &m_shadowFrame);
	glDeleteTextures(1, &m_shadowMap);
	glDeleteFramebuffers(1, &m_smallFrame);
	glDeleteTextures(1, &m_small);
	glDeleteRenderbuffers(1, &m_smallDepth);
}

void Renderer::drawShadowMap(const std::vector<Vertex>& mesh, const Matrix& sun)
{
	glBindFramebuffer(GL_FRAMEBUFFER, m_shadowFrame);
	glViewport(0, 0, SHADOW_SIZE, SHADOW_SIZE);
	glClear(GL_DEPTH_BUFFER_BIT);
	m_shadow.use();
	m_shadow.set("sunMatrix", sun);
	m_shadow.draw(mesh);
	glBindFramebuffer(GL_FRAMEBUFFER, m_target);
}

void Renderer::setLight(const Program& program, const Camera& camera, const Matrix& sun) const
{
	program.use();
	program.set("eye", toVector(camera.eye));
	program.set("toSun", sunDirection());
	program.set("sunMatrix", sun);
	program.set("shadowMap", 0);
}

void Renderer::draw(const View& view, const Tile& tile, int divisor)
{
	const Tile small = {0, 0, std::max(1, tile.width / divisor), std::max(1, tile.height / divisor)};
	if (divisor == 1)
		return drawScene(view, tile);
	prepareSmall(small);
	m_target = m_smallFrame;
	drawScene(view, small);
	m_target = 0;
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	enlarge(tile);
}

/// For a picture of this size; what there is is kept as long as it has that.
void Renderer::prepareSmall(const Tile& tile)
{
	if (!m_smallFrame)
	{
		glGenTextures(1, &m_small);
		glGenRenderbuffers(1, &m_smallDepth);
		glGenFramebuffers(1, &m_smallFrame);
	}
	if (tile.width == m_smallWidth && tile.height == m_smallHeight)
		return;
	m_smallWidth = tile.width;
	m_smallHeight = tile.height;
	glBindTexture(GL_TEXTURE_2D, m_small);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, tile.width, tile.height, 0, GL_RGB, GL_UNSIGNED_BYTE, nullptr);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	glBindRenderbuffer(GL_RENDERBUFFER, m_smallDepth);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, tile.width, tile.height);
	glBindFramebuffer(GL_FRAMEBUFFER, m_smallFrame);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, m_small, 0);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, m_smallDepth);
}

/// The small picture over a tile of the window: a rectangle, as a window of several samples takes no picture of another size.
void Renderer::enlarge(const Tile& tile)
{
	glViewport(tile.x, tile.y, tile.width, tile.height);
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_TEXTURE_2D);
	glBindTexture(GL_TEXTURE_2D, m_small);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glColor3f(1, 1, 1);
	glBegin(GL_TRIANGLE_FAN);
	for (const auto& [x, y] : {std::pair(0.f, 0.f), std::pair(1.f, 0.f), std::pair(1.f, 1.f), std::pair(0.f, 1.f)})
	{
		glTexCoord2f(x, y);
		glVertex2f(2 * x - 1, 2 * y - 1);
	}
	glEnd();
	glBindTexture(GL_TEXTURE_2D, 0);
	glDisable(GL_TEXTURE_2D);
}

void Renderer::drawScene(const View& view, const Tile& tile)
{
	const Camera& camera = view.camera;
	const std::vector<Vertex> mesh = makeMesh(view.parts, view.skins);
	const Matrix sun = sunMatrix(camera.target);
	const float aspect = tile.aspect();

	glEnable(GL_DEPTH_TEST);
	glDisable(GL_BLEND);
	drawShadowMap(mesh, sun);
	glViewport(tile.x, tile.y, tile.width, tile.height);
	glBindTexture(GL_TEXTURE_2D, m_shadowMap);
	glClear(GL_DEPTH_BUFFER_BIT);

	setLight(m_surface, camera, sun);
	m_surface.set("viewMatrix", cameraMatrix(camera, aspect));
	m_surface.draw(mesh);

	// Behind all, so that only what stays visible is computed.
	glDepthFunc(GL_LEQUAL);
	const CameraAxes axes = cameraAxes(camera, aspect);
	setLight(m_background, camera, sun);
	m_background.set("right", axes.right);
	m_background.set("up", axes.up);
	m_background.set("forward", axes.forward);
	std::vector<Vertex> whole(3);
	whole[0].position = {-1, -1, 0};
	whole[1].position = {3, -1, 0};
	whole[2].position = {-1, 3, 0};
	m_background.draw(whole);
	glDepthFunc(GL_LESS);
	if (!view.puffs.empty())
		drawPuffs(view, aspect, sun);
	glUseProgram(0);
	glBindTexture(GL_TEXTURE_2D, 0);
}

/// They hide what is behind them in part, and nothing hides behind them.
void Renderer::drawPuffs(const View& view, float aspect, const Matrix& sun)
{
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glDepthMask(GL_FALSE);
	setLight(m_puff, view.camera, sun);
	m_puff.set("viewMatrix", cameraMatrix(view.camera, aspect));
	m_puff.draw(makeMesh(view.puffs, view.camera));
	glDepthMask(GL_TRUE);
	glDisable(GL_BLEND);
}

Image Renderer::read(int width, int height)
{
	Image image = {width, height, std::vector<unsigned char>(size_t(3) * width * height)};
	glPixelStorei(GL_PACK_ALIGNMENT, 1);
	glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
	// OpenGL begins at the bottom.
	for (int y = 0; y < height / 2; ++y)
		std::swap_ranges(image.pixels.begin() + 3 * width * y, image.pixels.begin() + 3 * width * (y + 1),
						 image.pixels.end() - 3 * width * (y + 1));
	return image;
}
}  // namespace ep
