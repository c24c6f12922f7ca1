// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Keys.h"

#include <cctype>

#include "viewer/Gl.h"

namespace ep
{
namespace
{
const int UP = Keys::SPECIAL + GLUT_KEY_UP, DOWN = Keys::SPECIAL + GLUT_KEY_DOWN, LEFT = Keys::SPECIAL + GLUT_KEY_LEFT,
		  RIGHT = Keys::SPECIAL + GLUT_KEY_RIGHT;
const int ESCAPE = 27;

int plain(int key) { return key < Keys::SPECIAL ? std::tolower(key) : key; }
}  // namespace

Keys::Command Keys::key(int key, bool down)
{
	key = plain(key);
	if (!down)
	{
		m_down.erase(key);
		return NOTHING;
	}
	m_down.insert(key);
	switch (key)
	{
		case 'p':
			return PAUSE;
		case 'n':
		case 'o':
			return SINGLE_STEP;
		case 'r':
			return RESTART;
		case 'c':
			return CAMERA;
		case 'h':
			return HELP;
		case SPECIAL + GLUT_KEY_F12:
			return SCREENSHOT;
		case SPECIAL + GLUT_KEY_F1:
		case SPECIAL + GLUT_KEY_F2:
		case SPECIAL + GLUT_KEY_F3:
		case SPECIAL + GLUT_KEY_F4:
			return Command(JUMP + key - SPECIAL - GLUT_KEY_F1);
		case 'v':
			return RECORD;
		case '[':
			return SLOWER;
		case ']':
			return FASTER;
		case 'm':
			return PANEL;
		case 'l':
			return SLOW_MOTION;
		case 'z':
			return GO_BACK;
		case 'e':
			return CHARGE;
		case 'u':
			return SOUND;
		case ESCAPE:
			return QUIT;
		default:
			return NOTHING;
	}
}

bool Keys::drives(int key)
{
	key = plain(key);
	return key >= SPECIAL || key == 'w' || key == 'a' || key == 's' || key == 'd' || key == ' ';
}

bool Keys::isDown(int letter, int arrow) const { return m_down.count(letter) > 0 || m_down.count(arrow) > 0; }

Controls Keys::controls() const
{
	Controls controls;
	controls.throttle = btScalar(isDown('w', UP) - isDown('s', DOWN));
	controls.steer = btScalar(isDown('d', RIGHT) - isDown('a', LEFT));
	controls.handbrake = isDown(' ', ' ');
	return controls;
}

std::vector<std::string> Keys::help(bool drive, bool panel)
{
	std::vector<std::string> lines;
	if (drive)
		lines = {"W S  or arrows: drive, brake and reverse", "A D  or arrows: steer", "Space  handbrake",
				 "F1 F2 F3 F4  to the start of a scene"};
	for (const char* line :
		 {"P  pause,  N or O  single step", "[  slower,  ]  faster", "R  restart,  U  sound on or off",
		  "C  camera,  mouse  turns it, wheel zooms", "mouse on a body  pulls it, right button  throws a ball",
		  "E  a charge goes off where the mouse points",
		  "Z  back to before the crash,  L  slow motion at breaks on or off"})
		lines.emplace_back(line);
	if (panel)
		lines.emplace_back("M  panel on or off");
	for (const char* line : {"F12  screenshot,  V  film on or off", "Esc  quit,  H  help on or off"})
		lines.emplace_back(line);
	return lines;
}
}  // namespace ep
