// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Session.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "viewer/Brush.h"
#include "viewer/Gl.h"
#include "viewer/Overlay.h"
#include "viewer/GuiPanel.h"

namespace ep
{
namespace
{
const double MOST_AT_ONCE = 0.25;             // simulated for one picture [s]
const double SLOWEST = 1. / 64, FASTEST = 4;  // simulated over real time

/// In a tile higher than wide a camera sees as much from side to side as it should see from top to bottom.
View fitted(View view, const Tile& tile)
{
	float& angle = view.camera.fieldOfView;
	angle = 2 * std::atan(std::tan(angle / 2) / std::min(1.f, tile.aspect()));
	return view;
}
}  // namespace

Viewer::Viewer(ViewedScene& scene, const ViewerOptions& options)
	: m_scene(scene),
	  m_options(options),
	  m_renderer(new Renderer),
	  m_gui(new Gui(options.textSize)),
	  m_camera(!scene.draw().views.empty()),
	  m_last(Clock::now()),
	  m_panel(options.panel)
{
	if (!options.camera.empty())
		m_camera.select(options.camera);
}

void Viewer::close()
{
	m_running = false;
	m_recorder.reset();
	m_gui.reset();
	m_renderer.reset();
}

/// \return real time since the last frame [s]
double Viewer::passTime()
{
	// Where the display does not hold frames back, nobody sees more than these.
	std::this_thread::sleep_until(m_last + std::chrono::milliseconds(8));
	const Clock::time_point now = Clock::now();
	const double seconds = std::chrono::duration<double>(now - m_last).count();
	m_last = now;
	m_frameRate += (1 / seconds - m_frameRate) * .1;
	return seconds;
}

void Viewer::frame()
{
	const double seconds = passTime();
	++m_frames;
	const bool films = !m_options.record.empty();
	if (films && !m_recorder)
		startFilm(m_options.record);
	if (films)
		simulate(1. / Recorder::PICTURES_PER_SECOND);
	else if (m_options.screenshot.empty())
		simulate(seconds);
	const double shown = films ? 1. / Recorder::PICTURES_PER_SECOND : seconds;
	draw(shown);
	keepPicture(shown);
	glutSwapBuffers();
}

void Viewer::simulate(double seconds)
{
	const double step = double(m_scene.stepTime());
	// A slow machine falls behind real time rather than more and more behind itself.
	m_owed = m_paused ? 0 : std::min(m_owed + seconds * m_tempo, MOST_AT_ONCE);
	int steps = 0;
	// A film's pictures are as long as steps are, but for rounding.
	for (; m_owed > step * (1 - 1e-4); m_owed -= step, ++steps)
		m_scene.step(m_keys.controls());
	m_stepRate += (steps / seconds - m_stepRate) * .05;
}

void Viewer::draw(double seconds)
{
	const int width = glutGet(GLUT_WINDOW_WIDTH), height = glutGet(GLUT_WINDOW_HEIGHT);
	const float aspect = float(width) / float(std::max(1, height));
	m_gui->begin(width, height);
	const bool panel = m_panel && !m_scene.panels().empty();
	if (panel)
		drawPanels(width, height);

	Drawing drawing = m_scene.draw();
	std::vector<View> views = drawing.views;
	if (!m_camera.showsViews())
		views.assign(
			1, {drawing.parts, m_camera.camera(m_scene, drawing.subject, aspect, btScalar(seconds)), drawing.skins});
	const ViewerLayout layout(views.size(), !drawing.chart.bands.empty(), width, height);

	glClear(GL_COLOR_BUFFER_BIT);
	for (size_t i = 0; i < views.size(); ++i)
		m_renderer->draw(m_camera.showsViews() ? fitted(views[i], layout.views[i]) : views[i], layout.views[i]);
	if (panel)
		drawing.text.clear();
	const std::string note = m_recorder && m_options.record.empty() ? "Recording" : m_paused ? "Paused" : "";
	drawOverlay({drawing, m_help ? help() : std::vector<std::string>{"H  help"}, note}, layout, width, height);
	m_gui->end();
}

void Viewer::drawPanels(int width, int height)
{
	const float line = float(brush::scaled(18)), panelWidth = 20 * line;
	const bool moves = width != m_width || height != m_height;
	m_width = width;
	m_height = height;
	const std::vector<std::string> titles = m_scene.panels();
	// Help takes the right one's place.
	for (size_t i = 0; i < (m_help ? 1 : titles.size()); ++i)
	{
		// Beside the legend below, and the note on help above.
		const float x = i == 0 ? line / 2 : float(width) - panelWidth - line / 2, y = i == 0 ? line / 2 : 3 * line;
		ViewerPanel panel(titles[i].c_str(), {x, y, panelWidth, float(height) - y - (i == 0 ? 3 : 1) * line}, moves);
		if (i == 0)
			drawTime(panel);
		m_scene.panel(i, panel);
	}
}

void Viewer::drawTime(Panel& panel)
{
	char text[96];
	std::snprintf(text, sizeof text, "%.0f pictures, %.0f steps a second", m_frameRate, m_stepRate);
	panel.text(text);
	if (panel.button(m_paused ? "Go on" : "Pause"))
		command(ViewerKeys::PAUSE);
	panel.beside();
	if (panel.button("Step"))
		command(ViewerKeys::SINGLE_STEP);
	panel.beside();
	if (panel.button("Restart"))
		command(ViewerKeys::RESTART);
	panel.beside();
	if (panel.button("Help"))
		command(ViewerKeys::HELP);
	panel.slider("tempo", m_tempo, SLOWEST, FASTEST, "%.3g x");
}

std::vector<std::string> Viewer::help() const
{
	std::vector<std::string> lines = ViewerKeys::help(m_scene.isDriven(), !m_scene.panels().empty());
	for (const std::string& line : m_scene.keyHelp())
		lines.push_back(line);
	lines.push_back(std::string("Camera: ") + m_camera.name());
	lines.push_back(std::to_string(int(m_frameRate + .5)) + " pictures a second");
	return lines;
}

void Viewer::command(ViewerKeys::Command command)
{
	switch (command)
	{
		case ViewerKeys::PAUSE:
			m_paused = !m_paused;
			break;
		case ViewerKeys::SINGLE_STEP:
			m_paused = true;
			m_scene.step(m_keys.controls());
			break;
		case ViewerKeys::RESTART:
			m_scene.restart();
			break;
		case ViewerKeys::CAMERA:
			m_camera.next();
			break;
		case ViewerKeys::HELP:
			m_help = !m_help;
			break;
		case ViewerKeys::SCREENSHOT:
			save("screenshot-" + std::to_string(++m_screenshots) + ".png");
			break;
		case ViewerKeys::RECORD:
			if (m_recorder)
				endFilm();
			else
				startFilm("film-" + std::to_string(++m_films) + ".mp4");
			break;
		case ViewerKeys::SLOWER:
			m_tempo = std::max(SLOWEST, m_tempo / 2);
			break;
		case ViewerKeys::FASTER:
			m_tempo = std::min(FASTEST, m_tempo * 2);
			break;
		case ViewerKeys::PANEL:
			m_panel = !m_panel;
			break;
		case ViewerKeys::QUIT:
			m_running = false;
			break;
		case ViewerKeys::NOTHING:
			break;
		default:
			m_scene.jump(command - ViewerKeys::JUMP);
	}
}

void Viewer::key(int key, bool down)
{
	if (!m_gui)
		return;  // the window has just been closed
	try
	{
		// Typing in a field drives nothing; a key that was down before must come up.
		if (m_gui->key(key, down) && down)
			return;
		const ViewerKeys::Command wanted = m_keys.key(key, down);
		if (wanted != ViewerKeys::NOTHING)
			command(wanted);
		else if (down && !m_keys.drives(key))
			m_scene.key(char(key));
	}
	catch (const std::exception& error)
	{
		// A picture that cannot be saved is no reason to stop driving.
		std::fprintf(stderr, "%s\n", error.what());
	}
}

void Viewer::mouseButton(int button, int state, int x, int y)
{
	if (!m_gui)
		return;
	const int wheelUp = 3, wheelDown = 4;
	const bool down = state == GLUT_DOWN, forPanel = m_gui->mouseButton(button, down, x, y);
	if ((button == wheelUp || button == wheelDown) && down && !forPanel)
		m_camera.zoom(button == wheelUp ? 1 : -1);
	m_dragging = button == GLUT_LEFT_BUTTON && down && !forPanel;
	m_mouseX = x;
	m_mouseY = y;
}

void Viewer::mouseMove(int x, int y)
{
	if (!m_gui)
		return;
	m_gui->mouseMove(x, y);
	if (m_dragging)
		m_camera.turn(x - m_mouseX, y - m_mouseY);
	m_mouseX = x;
	m_mouseY = y;
}
}  // namespace ep
