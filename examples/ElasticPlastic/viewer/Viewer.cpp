// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Viewer.h"

#include <algorithm>
#include <cstdlib>

#include "viewer/Gl.h"
#include "viewer/Session.h"

namespace ep
{
namespace
{
Session* theSession = nullptr;  // GLUT's callbacks take no argument of ours

int openWindow(const WindowOptions& options, const std::string& title)
{
	int argc = 1;
	char name[] = "viewer", *argv[] = {name, nullptr};
	glutInit(&argc, argv);
	glutSetOption(GLUT_ACTION_ON_WINDOW_CLOSE, GLUT_ACTION_CONTINUE_EXECUTION);
	glutSetOption(GLUT_MULTISAMPLE, 4);
	// As large as asked, where the screen has room.
	const int screenWidth = glutGet(GLUT_SCREEN_WIDTH), screenHeight = glutGet(GLUT_SCREEN_HEIGHT);
	glutInitWindowSize(screenWidth > 0 ? std::min(options.width, screenWidth) : options.width,
					   screenHeight > 0 ? std::min(options.height, screenHeight) : options.height);
	const unsigned mode = GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH;
	glutInitDisplayMode(mode | GLUT_MULTISAMPLE);
	if (!glutGet(GLUT_DISPLAY_MODE_POSSIBLE))
		glutInitDisplayMode(mode);
	return glutCreateWindow(title.c_str());
}

void setCallbacks()
{
	glutDisplayFunc([] {});  // every frame is drawn anyhow, but GLUT insists
	glutCloseFunc([] { theSession->close(); });
	glutIgnoreKeyRepeat(1);
	glutKeyboardFunc([](unsigned char k, int, int) { theSession->key(k, true); });
	glutKeyboardUpFunc([](unsigned char k, int, int) { theSession->key(k, false); });
	glutSpecialFunc([](int k, int, int) { theSession->key(Keys::SPECIAL + k, true); });
	glutSpecialUpFunc([](int k, int, int) { theSession->key(Keys::SPECIAL + k, false); });
	glutMouseFunc([](int button, int state, int x, int y) { theSession->mouseButton(button, state, x, y); });
	glutMotionFunc([](int x, int y) { theSession->mouseMove(x, y); });
	glutPassiveMotionFunc([](int x, int y) { theSession->mouseMove(x, y); });
}

/// The window goes before its session does, however that ends.
struct WindowEnd
{
	int window;

	~WindowEnd()
	{
		if (glutGetWindow() == window)
		{
			glutDestroyWindow(window);
			glutMainLoopEvent();  // only now the window goes, and close() is called
		}
		theSession = nullptr;
	}
};
}  // namespace

bool hasDisplay()
{
#if defined(__unix__) && !defined(__APPLE__)
	const char* const display = std::getenv("DISPLAY");
	return display && *display;
#else
	return true;
#endif
}

void runViewer(ViewedScene& scene, const WindowOptions& options)
{
	if (!options.screenshot.empty())
		for (double time = 0; time < options.screenshotTime; time += double(scene.stepTime()))
			scene.step(Controls());

	const int window = openWindow(options, scene.title());
	Session session(scene, options);
	const WindowEnd end = {window};
	theSession = &session;
	setCallbacks();
	glutMainLoopEvent();
	// Not glutMainLoop(): it would let no exception through.
	while (session.isRunning())
	{
		session.frame();
		glutMainLoopEvent();
	}
}
}  // namespace ep
