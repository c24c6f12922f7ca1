// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Program.h"

#include <cstddef>
#include <stdexcept>

#include "picture/Gl.h"

namespace ep
{
namespace
{
struct Attribute
{
	const char* name;
	int size;
	size_t offset;
};

const Attribute ATTRIBUTES[] = {{"position", 3, offsetof(Vertex, position)},
								{"normal", 3, offsetof(Vertex, normal)},
								{"colour", 3, offsetof(Vertex, colour)},
								{"edges", 4, offsetof(Vertex, edges)},
								{"gloss", 1, offsetof(Vertex, gloss)}};

GLuint compile(GLenum type, const std::string& source)
{
	const GLuint shader = glCreateShader(type);
	const char* const text = source.c_str();
	glShaderSource(shader, 1, &text, nullptr);
	glCompileShader(shader);
	GLint compiled = 0;
	glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
	if (!compiled)
	{
		char log[1024];
		glGetShaderInfoLog(shader, sizeof log, nullptr, log);
		throw std::runtime_error(std::string("OpenGL refuses a shader: ") + log);
	}
	return shader;
}
}  // namespace

Program::Program(const std::string& vertexShader, const std::string& fragmentShader) : m_program(glCreateProgram())
{
	for (GLuint shader : {compile(GL_VERTEX_SHADER, vertexShader), compile(GL_FRAGMENT_SHADER, fragmentShader)})
	{
		glAttachShader(m_program, shader);
		glDeleteShader(shader);  // once the program goes
	}
	for (GLuint i = 0; i < sizeof ATTRIBUTES / sizeof *ATTRIBUTES; ++i)
		glBindAttribLocation(m_program, i, ATTRIBUTES[i].name);
	glLinkProgram(m_program);
	GLint linked = 0;
	glGetProgramiv(m_program, GL_LINK_STATUS, &linked);
	if (!linked)
	{
		char log[1024];
		glGetProgramInfoLog(m_program, sizeof log, nullptr, log);
		throw std::runtime_error(std::string("OpenGL cannot link shaders: ") + log);
	}
}

Program::~Program() { glDeleteProgram(m_program); }

void Program::use() const { glUseProgram(m_program); }

int Program::location(const char* uniform) const { return glGetUniformLocation(m_program, uniform); }

void Program::set(const char* uniform, const Matrix& value) const
{
	glUniformMatrix4fv(location(uniform), 1, GL_FALSE, value.m);
}

void Program::set(const char* uniform, const Vector& value) const { glUniform3fv(location(uniform), 1, value.data()); }

void Program::set(const char* uniform, int value) const { glUniform1i(location(uniform), value); }

void Program::draw(const std::vector<Vertex>& vertices) const
{
	const char* const begin = reinterpret_cast<const char*>(vertices.data());
	const GLuint count = sizeof ATTRIBUTES / sizeof *ATTRIBUTES;
	for (GLuint i = 0; i < count; ++i)
	{
		glEnableVertexAttribArray(i);
		glVertexAttribPointer(i, ATTRIBUTES[i].size, GL_FLOAT, GL_FALSE, sizeof(Vertex), begin + ATTRIBUTES[i].offset);
	}
	glDrawArrays(GL_TRIANGLES, 0, GLsizei(vertices.size()));
	for (GLuint i = 0; i < count; ++i)
		glDisableVertexAttribArray(i);
}
}  // namespace ep
