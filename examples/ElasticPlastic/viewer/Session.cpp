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
const double MOST_AT_ONCE = 0.25;                  // simulated for one picture [s]
const double SLOW_MOTION = 5, LONGEST_SLOWED = 1;  // times; simulated [s]
const float LEAST_WITH_PANELS = 50;                // width of a window whose panels are open [lines]
const double SLOWEST = 1. / 64, FASTEST = 4;       // simulated over real time

/// In a tile higher than wide a camera sees as much from side to side as it should see from top to bottom.
View fitted(View view, const Tile& tile)
{
	float& angle = view.camera.fieldOfView;
	angle = 2 * std::atan(std::tan(angle / 2) / std::min(1.f, tile.aspect()));
	return view;
}
}  // namespace

Session::Session(ViewedScene& scene, const WindowOptions& options)
	: m_scene(scene),
	  m_options(options),
	  m_renderer(new Renderer),
	  m_gui(new Gui(float(options.textSize))),
	  m_speaker(options.isFilmed() || options.isSilent ? nullptr : new Speaker),
	  m_camera(!scene.draw().views.empty(), scene.isDriven()),
	  m_last(Clock::now()),
	  m_panel(!options.noPanel && (options.record.empty() || options.filmPanel))
{
	m_camera.select(options.camera);
}

void Session::close()
{
	m_running = false;
	m_recorder.reset();
	m_gui.reset();
	m_renderer.reset();
}

/// \return real time since the last frame [s]
double Session::passTime()
{
	// Where the display does not hold frames back, nobody sees more than these.
	std::this_thread::sleep_until(m_last + std::chrono::milliseconds(8));
	const Clock::time_point now = Clock::now();
	const double seconds = std::chrono::duration<double>(now - m_last).count();
	m_last = now;
	m_frameRate += (1 / seconds - m_frameRate) * .1;
	return seconds;
}

void Session::frame()
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
	const Clock::time_point begin = Clock::now();
	draw(shown);
	// What is kept is drawn as finely as can be, however long it takes.
	if (!isKept())
	{
		glFinish();
		m_quality.drawn(std::chrono::duration<double>(Clock::now() - begin).count());
	}
	keepPicture(shown);
	glutSwapBuffers();
}

/// Simulated over real time: slower when something begins to break, for a second of the scene. Films and pictures keep their time.
double Session::tempo(double seconds)
{
	const bool isBreaking = m_slowMotion && !m_options.isFilmed() && m_scene.isBreaking();
	const bool isSlow = isBreaking && m_slowed < LONGEST_SLOWED;
	const double tempo = isSlow ? m_tempo / SLOW_MOTION : m_tempo;
	m_slowed = isBreaking ? m_slowed + seconds * tempo : 0;
	return tempo;
}

void Session::simulate(double seconds)
{
	const double step = double(m_scene.stepTime());
	// A slow machine falls behind real time rather than more and more behind itself.
	m_owed = m_paused ? 0 : std::min(m_owed + seconds * tempo(seconds), MOST_AT_ONCE);
	int steps = 0;
	// A film's pictures are as long as steps are, but for rounding.
	for (; m_owed > step * (1 - 1e-4); m_owed -= step, ++steps)
	{
		m_scene.step(m_keys.controls());
		playBursts();
	}
	m_stepRate += (steps / seconds - m_stepRate) * .05;
}

void Session::playBursts()
{
	if (!m_speaker)
		return;
	m_speaker->listenFrom(m_camera.shown());
	for (const Burst& burst : m_scene.bursts())
		m_speaker->play(burst);
}

void Session::draw(double seconds)
{
	const int width = glutGet(GLUT_WINDOW_WIDTH), height = glutGet(GLUT_WINDOW_HEIGHT);
	const float aspect = float(width) / float(std::max(1, height));
	m_gui->begin(width, height);
	const bool panel = m_panel && !m_scene.panels().empty();
	Margins margins;
	if (panel)
		margins = drawPanels(width, height);

	Drawing drawing = m_scene.draw();
	if (panel)
		drawing.text.clear();
	// A little more than what is written there.
	const float picture = float(std::max(1, height));
	margins.top = std::min(.3f, .04f + float(Overlay::textHeight(drawing.text.size())) / picture);
	margins.bottom = .01f + float(Overlay::legendHeight()) / picture;
	std::vector<View> views = drawing.views;
	m_camera.offer(!views.empty(), m_scene.isDriven());
	if (!m_camera.showsViews())
		views.assign(1, {drawing.parts, m_camera.camera(m_scene, drawing.subject, aspect, margins, btScalar(seconds)),
						 drawing.skins, drawing.puffs});
	const Layout layout(views.size(), !drawing.chart.bands.empty(), width, height);

	glClear(GL_COLOR_BUFFER_BIT);
	for (size_t i = 0; i < views.size(); ++i)
		m_renderer->draw(m_camera.showsViews() ? fitted(views[i], layout.views[i]) : views[i], layout.views[i],
						 isKept() ? 1 : m_quality.divisor());
	const std::string note = m_recorder && m_options.record.empty() ? "Recording" : m_paused ? "Paused" : "";
	std::vector<std::string> help;
	if (m_help)
		help = this->help();
	else if (m_options.record.empty())
		help = {"H  help"};
	drawOverlay({drawing, help, note}, layout, width, height);
	m_gui->end();
}

/// \return what they cover of the picture
Margins Session::drawPanels(int width, int height)
{
	const float line = float(brush::scaled(18)), panelWidth = float(m_scene.panelWidth()) * line,
				picture = float(std::max(1, width));
	const bool moves = width != m_width || height != m_height || panelWidth != m_panelWidth;
	m_width = width;
	m_height = height;
	m_panelWidth = panelWidth;
	Margins margins;
	const std::vector<std::string> titles = m_scene.panels();
	// Help takes the right one's place.
	for (size_t i = 0; i < (m_help ? 1 : titles.size()); ++i)
	{
		// Beside the legend below, and the note on help above.
		const float x = i == 0 ? line / 2 : float(width) - panelWidth - line / 2, y = i == 0 ? line / 2 : 3 * line;
		GuiPanel panel(titles[i].c_str(), {x, y, panelWidth, float(height) - y - (i == 0 ? 3 : 1) * line}, moves,
					   picture < LEAST_WITH_PANELS * line);
		if (panel.isOpen())
			(i == 0 ? margins.left : margins.right) = (panelWidth + line) / picture;
		if (i == 0)
			drawTime(panel);
		m_scene.panel(i, panel);
	}
	// Where they leave next to nothing the structure is behind them.
	return margins.left + margins.right < .75f ? margins : Margins();
}

void Session::drawTime(Panel& panel)
{
	char text[96];
	std::snprintf(text, sizeof text, "%.0f pictures, %.0f steps a second", m_frameRate, m_stepRate);
	panel.text(text);
	if (panel.button(m_paused ? "Go on" : "Pause"))
		command(Keys::PAUSE);
	panel.beside();
	if (panel.button("Step"))
		command(Keys::SINGLE_STEP);
	panel.beside();
	if (panel.button("Restart"))
		command(Keys::RESTART);
	panel.beside();
	if (panel.button("Help"))
		command(Keys::HELP);
	panel.slider("tempo", m_tempo, SLOWEST, FASTEST, "%.3g x");
}

std::vector<std::string> Session::help() const
{
	std::vector<std::string> lines = Keys::help(m_scene.isDriven(), !m_scene.panels().empty());
	for (const std::string& line : m_scene.keyHelp())
		lines.push_back(line);
	lines.push_back(std::string("Camera: ") + m_camera.name());
	lines.push_back(std::to_string(int(m_frameRate + .5)) + " pictures a second, " + m_quality.name() +
					(m_quality.level() == Quality::FINE ? "" : ": drawing was slow"));
	return lines;
}

void Session::command(Keys::Command command)
{
	switch (command)
	{
		case Keys::PAUSE:
			m_paused = !m_paused;
			break;
		case Keys::SINGLE_STEP:
			m_paused = true;
			m_scene.step(m_keys.controls());
			playBursts();
			break;
		case Keys::RESTART:
			m_scene.restart();
			break;
		case Keys::CAMERA:
			m_camera.next();
			break;
		case Keys::HELP:
			m_help = !m_help;
			break;
		case Keys::SCREENSHOT:
			// Of the next picture, which is drawn for that.
			if (m_wanted.empty())
				m_wanted = "screenshot-" + std::to_string(++m_screenshots) + ".png";
			break;
		case Keys::RECORD:
			if (m_recorder)
				endFilm();
			else
				startFilm("film-" + std::to_string(++m_films) + ".mp4");
			break;
		case Keys::SLOWER:
			m_tempo = std::max(SLOWEST, m_tempo / 2);
			break;
		case Keys::FASTER:
			m_tempo = std::min(FASTEST, m_tempo * 2);
			break;
		case Keys::PANEL:
			m_panel = !m_panel;
			break;
		case Keys::SLOW_MOTION:
			m_slowMotion = !m_slowMotion;
			break;
		case Keys::GO_BACK:
			m_scene.goBack();
			break;
		case Keys::CHARGE:
			m_scene.blowCharge(mouseRay());
			break;
		case Keys::SOUND:
			m_speaker.reset(m_speaker ? nullptr : new Speaker);
			break;
		case Keys::QUIT:
			m_running = false;
			break;
		case Keys::NOTHING:
			break;
		default:
			m_scene.jump(command - Keys::JUMP);
	}
}

void Session::key(int key, bool down)
{
	if (!m_gui)
		return;  // the window has just been closed
	try
	{
		// Typing in a field drives nothing; a key that was down before must come up.
		if (m_gui->key(key, down) && down)
			return;
		const Keys::Command wanted = m_keys.key(key, down);
		if (wanted != Keys::NOTHING)
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

void Session::mouseButton(int button, int state, int x, int y)
{
	if (!m_gui)
		return;
	const int wheelUp = 3, wheelDown = 4;
	const bool down = state == GLUT_DOWN, forPanel = m_gui->mouseButton(button, down, x, y);
	if ((button == wheelUp || button == wheelDown) && down && !forPanel)
		m_camera.zoom(button == wheelUp ? 1 : -1);
	m_mouseX = x;
	m_mouseY = y;
	if (m_pulling)
		m_scene.release();
	const bool isOurs = down && !forPanel && !m_camera.showsViews();
	m_pulling = isOurs && button == GLUT_LEFT_BUTTON && m_scene.grab(mouseRay());
	m_dragging = down && !forPanel && button == GLUT_LEFT_BUTTON && !m_pulling;
	if (isOurs && button == GLUT_RIGHT_BUTTON)
		m_scene.throwBall(mouseRay());
}

ViewedScene::Ray Session::mouseRay() const
{
	const int width = std::max(1, glutGet(GLUT_WINDOW_WIDTH)), height = std::max(1, glutGet(GLUT_WINDOW_HEIGHT));
	const CameraAxes axes = cameraAxes(m_camera.shown(), float(width) / float(height));
	const float x = 2 * float(m_mouseX) / float(width) - 1, y = 1 - 2 * float(m_mouseY) / float(height);
	btVector3 direction;
	for (int i = 0; i < 3; ++i)
		direction[i] = btScalar(axes.forward[size_t(i)] + x * axes.right[size_t(i)] + y * axes.up[size_t(i)]);
	return {m_camera.shown().eye, direction};
}

void Session::mouseMove(int x, int y)
{
	if (!m_gui)
		return;
	m_gui->mouseMove(x, y);
	if (m_dragging)
		m_camera.turn(x - m_mouseX, y - m_mouseY);
	m_mouseX = x;
	m_mouseY = y;
	if (m_pulling)
		m_scene.drag(mouseRay());
}
}  // namespace ep
