// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_GL_H
#define EP_VIEWER_GL_H

#include "picture/Gl.h"
// After it, which asks for functions by name.
#include <GL/freeglut.h>

#endif  // EP_VIEWER_GL_H
