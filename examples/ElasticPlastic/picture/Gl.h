// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_GL_H
#define EP_PICTURE_GL_H

// OpenGL 3.0's functions by name: Mesa's and the vendors' libraries of Linux export them.
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#endif  // EP_PICTURE_GL_H
