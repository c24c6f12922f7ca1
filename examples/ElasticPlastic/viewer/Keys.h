// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_KEYS_H
#define EP_VIEWER_KEYS_H

#include <set>
#include <string>
#include <vector>

#include "vehicle/Controls.h"

namespace ep
{
/// What the keys mean, and which are down.
class Keys
{
public:
	static const int SPECIAL = 256;  ///< added to the codes of arrows and function keys

	enum Command
	{
		NOTHING,
		PAUSE,
		SINGLE_STEP,
		RESTART,
		CAMERA,
		HELP,
		SCREENSHOT,
		RECORD,
		SLOWER,
		FASTER,
		PANEL,
		SLOW_MOTION,
		GO_BACK,
		CHARGE,
		SOUND,
		JUMP,  ///< and one each for F2 to F4
		JUMP_LAST = JUMP + 3,
		QUIT
	};

	/// A key goes down or up. \return what it asks for
	Command key(int key, bool down);

	/// Whether it is one of the keys to drive with.
	static bool drives(int key);

	Controls controls() const;
	/// \param drive  whether there is something to drive, and places to jump to
	/// \param panel  whether there is one
	static std::vector<std::string> help(bool drive, bool panel);

private:
	bool isDown(int letter, int arrow) const;

	std::set<int> m_down;
};
}  // namespace ep

#endif  // EP_VIEWER_KEYS_H
