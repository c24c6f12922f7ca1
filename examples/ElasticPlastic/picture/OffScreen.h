// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_OFF_SCREEN_H
#define EP_PICTURE_OFF_SCREEN_H

namespace ep
{
/// OpenGL without a window or a display, the current context for as long as it lives. Throws std::runtime_error if there is none.
class OffScreen
{
public:
	OffScreen();
	~OffScreen();
	OffScreen(const OffScreen&) = delete;
	OffScreen& operator=(const OffScreen&) = delete;

	/// What is drawn from now on is drawn into a picture of this size [pixels].
	void begin(int width, int height);

private:
	// EGL's
	void* m_display;
	void* m_config = nullptr;
	void* m_context = nullptr;
	void* m_surface = nullptr;
};
}  // namespace ep

#endif  // EP_PICTURE_OFF_SCREEN_H
