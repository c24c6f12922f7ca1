// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_SESSION_H
#define EP_VIEWER_SESSION_H

#include <chrono>
#include <memory>

#include "cli/WindowOptions.h"
#include "drawing/ViewedScene.h"
#include "picture/Renderer.h"
#include "sound/Speaker.h"
#include "viewer/Gui.h"
#include "viewer/Keys.h"
#include "viewer/Quality.h"
#include "viewer/Recorder.h"
#include "viewer/UserCamera.h"

namespace ep
{
/// What goes on in the window: time, camera, keys, pictures.
class Session
{
public:
	/// Needs a current OpenGL context.
	Session(ViewedScene& scene, const WindowOptions& options);

	bool isRunning() const { return m_running; }

	/// The window goes, and OpenGL with it.
	void close();

	/// Simulates the time that has passed, and draws.
	void frame();

	void key(int key, bool down);
	void mouseButton(int button, int state, int x, int y);
	void mouseMove(int x, int y);

private:
	using Clock = std::chrono::steady_clock;

	double passTime();
	void simulate(double seconds);
	void playBursts();
	void draw(double seconds);
	Margins drawPanels(int width, int height);
	void drawTime(Panel& panel);
	/// Whether the picture is for a file.
	bool isKept() const { return m_options.isFilmed() || m_recorder || !m_wanted.empty(); }
	void keepPicture(double seconds);
	void addToFilm();
	void startFilm(const std::string& file);
	void endFilm();
	void command(Keys::Command command);
	void save(const std::string& file);
	void saveWanted();
	std::vector<std::string> help() const;
	ViewedScene::Ray mouseRay() const;
	double tempo(double seconds);

	ViewedScene& m_scene;
	WindowOptions m_options;
	std::unique_ptr<Renderer> m_renderer;
	std::unique_ptr<Gui> m_gui;
	std::unique_ptr<Recorder> m_recorder;
	std::unique_ptr<Speaker> m_speaker;  ///< null: silent
	UserCamera m_camera;
	Keys m_keys;
	Quality m_quality;
	std::string m_wanted;  ///< file that the next picture is for, empty: none
	Clock::time_point m_last;
	double m_frameRate = 0;  ///< smoothed [1/s]
	double m_stepRate = 0;   ///< of the scene, the same
	double m_filmTime = 0;   ///< what has passed since a film began [s]
	double m_tempo = 1;      ///< simulated over real time
	double m_owed = 0;       ///< real time that the scene has not simulated yet [s]
	double m_slowed = 0;     ///< how long something has been breaking, simulated [s]
	bool m_running = true, m_paused = false, m_help = false, m_dragging = false, m_pulling = false, m_slowMotion = true;
	bool m_panel;
	int m_width = 0, m_height = 0;  ///< of the window when panels were placed
	float m_panelWidth = 0;         ///< then
	int m_mouseX = 0, m_mouseY = 0, m_frames = 0, m_screenshots = 0, m_films = 0;
};
}  // namespace ep

#endif  // EP_VIEWER_SESSION_H
