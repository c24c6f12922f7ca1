// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_SHADERS_H
#define EP_PICTURE_SHADERS_H

namespace ep
{
/// GLSL 1.20. A fragment shader is SHADER_LIGHT and one of the others behind it.
extern const char* const SHADER_LIGHT;
extern const char* const SHADER_SURFACE_VERTEX;
extern const char* const SHADER_SURFACE;
extern const char* const SHADER_PUFF;  ///< with SHADER_SURFACE_VERTEX
extern const char* const SHADER_BACKGROUND_VERTEX;
extern const char* const SHADER_BACKGROUND;
extern const char* const SHADER_SHADOW_VERTEX;
extern const char* const SHADER_SHADOW;
}  // namespace ep

#endif  // EP_PICTURE_SHADERS_H
