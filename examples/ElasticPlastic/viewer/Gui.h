// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_GUI_H
#define EP_VIEWER_GUI_H

#include <deque>

namespace ep
{
/// Dear ImGui in GLUT's window. Needs a current OpenGL context all its life; one at a time.
class Gui
{
public:
	/// \param textSize  height of a line [pixels], 0: by the screen's resolution
	explicit Gui(float textSize);
	~Gui();
	Gui(const Gui&) = delete;
	Gui& operator=(const Gui&) = delete;

	void begin(int width, int height);
	/// Draws all since begin().
	void end();

	// What GLUT tells. \return whether it is meant for a panel
	bool key(int key, bool down);
	bool mouseButton(int button, bool down, int x, int y);
	bool mouseMove(int x, int y);

private:
	struct Click
	{
		int button;
		bool down;
		int x, y;
	};
	void takeClicks();

	std::deque<Click> m_clicks;  ///< not seen yet
};
}  // namespace ep

#endif  // EP_VIEWER_GUI_H
