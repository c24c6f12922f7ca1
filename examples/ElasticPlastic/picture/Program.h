// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_PROGRAM_H
#define EP_PICTURE_PROGRAM_H

#include <string>

#include "picture/Projection.h"

namespace ep
{
/// A pair of shaders. Needs a current OpenGL context, throws std::runtime_error with the compiler's words.
class Program
{
public:
	Program(const std::string& vertexShader, const std::string& fragmentShader);
	~Program();
	Program(const Program&) = delete;
	Program& operator=(const Program&) = delete;

	void use() const;
	void set(const char* uniform, const Matrix& value) const;
	void set(const char* uniform, const Vector& value) const;
	void set(const char* uniform, int value) const;

	/// Draws triangles, in the world's coordinates or whatever the shaders take them for.
	void draw(const std::vector<Vertex>& vertices) const;

private:
	int location(const char* uniform) const;

	unsigned m_program;
};
}  // namespace ep

#endif  // EP_PICTURE_PROGRAM_H
