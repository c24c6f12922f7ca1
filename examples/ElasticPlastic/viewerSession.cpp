#include "viewerSession.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "viewerGl.h"
#include "viewerOverlay.h"

namespace ep
{
namespace
{
const double MOST_AT_ONCE = 0.25;  // simulated for one picture [s]

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
	  m_camera(!scene.draw().views.empty()),
	  m_last(Clock::now())
{
	if (!options.camera.empty())
		m_camera.select(options.camera);
}

void Viewer::close()
{
	m_running = false;
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
	if (m_options.screenshot.empty())
	{
		simulate(seconds);
		draw(seconds);
	}
	else
	{
		draw(seconds);
		// The window is there for certain and has its size.
		if (m_frames == 3)
		{
			save(m_options.screenshot);
			m_running = false;
		}
	}
	glutSwapBuffers();
}

void Viewer::simulate(double seconds)
{
	const double step = double(m_scene.stepTime());
	// A slow machine falls behind real time rather than more and more behind itself.
	m_owed = m_paused ? 0 : std::min(m_owed + seconds, MOST_AT_ONCE);
	for (; m_owed >= step; m_owed -= step)
		m_scene.step(m_keys.controls());
}

void Viewer::draw(double seconds)
{
	const int width = glutGet(GLUT_WINDOW_WIDTH), height = glutGet(GLUT_WINDOW_HEIGHT);
	const float aspect = float(width) / float(std::max(1, height));
	const Drawing drawing = m_scene.draw();
	std::vector<View> views = drawing.views;
	if (!m_camera.showsViews())
		views.assign(
			1, {drawing.parts, m_camera.camera(m_scene, drawing.subject, aspect, btScalar(seconds)), drawing.skins});
	const ViewerLayout layout(views.size(), !drawing.chart.bands.empty(), width, height);

	glClear(GL_COLOR_BUFFER_BIT);
	for (size_t i = 0; i < views.size(); ++i)
		m_renderer->draw(m_camera.showsViews() ? fitted(views[i], layout.views[i]) : views[i], layout.views[i]);
	drawOverlay({drawing, m_help ? help() : std::vector<std::string>{"H  help"}, m_paused ? "Paused" : ""}, layout,
				width, height);
}

void Viewer::save(const std::string& file)
{
	writePng(file, Renderer::read(glutGet(GLUT_WINDOW_WIDTH), glutGet(GLUT_WINDOW_HEIGHT)));
	std::printf("picture %s\n", file.c_str());
	std::fflush(stdout);
}

std::vector<std::string> Viewer::help() const
{
	std::vector<std::string> lines = ViewerKeys::help(m_scene.isDriven());
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
		case ViewerKeys::QUIT:
			m_running = false;
			break;
		case ViewerKeys::NOTHING:
			break;
	}
}

void Viewer::key(int key, bool down)
{
	try
	{
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
	const int wheelUp = 3, wheelDown = 4;
	if ((button == wheelUp || button == wheelDown) && state == GLUT_DOWN)
		m_camera.zoom(button == wheelUp ? 1 : -1);
	m_dragging = button == GLUT_LEFT_BUTTON && state == GLUT_DOWN;
	m_mouseX = x;
	m_mouseY = y;
}

void Viewer::mouseMove(int x, int y)
{
	if (m_dragging)
		m_camera.turn(x - m_mouseX, y - m_mouseY);
	m_mouseX = x;
	m_mouseY = y;
}
}  // namespace ep
