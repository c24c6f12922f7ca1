// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/OffScreen.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <stdexcept>
#include <string>

namespace ep
{
namespace
{
void need(bool isThere, const char* what)
{
	if (!isThere)
		throw std::runtime_error(std::string("no picture: OpenGL without a display (EGL) has no ") + what);
}
}  // namespace

OffScreen::OffScreen() : m_display(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr))
{
	need(eglInitialize(m_display, nullptr, nullptr) && eglBindAPI(EGL_OPENGL_API), "library");
	const EGLint wanted[] = {EGL_SURFACE_TYPE,
							 EGL_PBUFFER_BIT,
							 EGL_RENDERABLE_TYPE,
							 EGL_OPENGL_BIT,
							 EGL_RED_SIZE,
							 8,
							 EGL_GREEN_SIZE,
							 8,
							 EGL_BLUE_SIZE,
							 8,
							 EGL_DEPTH_SIZE,
							 24,
							 EGL_SAMPLES,
							 4,
							 EGL_NONE};
	EGLint count = 0;
	need(eglChooseConfig(m_display, wanted, &m_config, 1, &count) && count > 0, "pictures of four samples a pixel");
	m_context = eglCreateContext(m_display, m_config, EGL_NO_CONTEXT, nullptr);
	begin(1, 1);
}

void OffScreen::begin(int width, int height)
{
	const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
	void* const last = m_surface;
	m_surface = eglCreatePbufferSurface(m_display, m_config, size);
	need(eglMakeCurrent(m_display, m_surface, m_surface, m_context), "room for a picture of this size");
	if (last)
		eglDestroySurface(m_display, last);
}

OffScreen::~OffScreen()
{
	eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
	eglDestroySurface(m_display, m_surface);
	eglDestroyContext(m_display, m_context);
	eglTerminate(m_display);
}
}  // namespace ep
