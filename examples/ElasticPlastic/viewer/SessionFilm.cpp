// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The pictures and films that a session keeps.

#include <cstdio>

#include "viewer/Gl.h"
#include "viewer/Session.h"

namespace ep
{
void Session::save(const std::string& file)
{
	writePng(file, Renderer::read(glutGet(GLUT_WINDOW_WIDTH), glutGet(GLUT_WINDOW_HEIGHT)));
	std::printf("picture %s\n", file.c_str());
	std::fflush(stdout);
}

void Session::saveWanted()
{
	try
	{
		save(m_wanted);
	}
	catch (const std::exception& error)
	{
		// A picture that cannot be saved is no reason to stop driving.
		std::fprintf(stderr, "%s\n", error.what());
	}
	m_wanted.clear();
}

/// For a film, and of the window as a whole.
void Session::keepPicture(double seconds)
{
	m_filmTime += seconds;
	if (!m_wanted.empty())
		saveWanted();
	if (m_recorder)
		addToFilm();
	if (!m_options.record.empty() && m_frames >= int(m_options.recordTime * Recorder::PICTURES_PER_SECOND + .5))
	{
		endFilm();
		m_running = false;
	}
	// The window is there for certain and has its size.
	if (!m_options.screenshot.empty() && m_frames == 3)
	{
		save(m_options.screenshot);
		m_running = false;
	}
}

/// As often as the time that has passed wants it.
void Session::addToFilm()
{
	try
	{
		const Image image = Renderer::read(glutGet(GLUT_WINDOW_WIDTH), glutGet(GLUT_WINDOW_HEIGHT));
		while (m_recorder->length() < m_filmTime - .5 / Recorder::PICTURES_PER_SECOND)
			m_recorder->add(image);
	}
	catch (const std::exception& error)
	{
		m_recorder.reset();
		if (!m_options.record.empty())
			throw;
		// A film that cannot be made is no reason to stop driving.
		std::fprintf(stderr, "%s\n", error.what());
	}
}

void Session::startFilm(const std::string& file)
{
	m_filmTime = 0;
	m_recorder.reset(new Recorder(file, glutGet(GLUT_WINDOW_WIDTH), glutGet(GLUT_WINDOW_HEIGHT)));
}

void Session::endFilm()
{
	m_recorder->finish();
	m_recorder.reset();
}
}  // namespace ep
