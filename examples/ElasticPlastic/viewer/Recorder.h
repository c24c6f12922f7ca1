// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_RECORDER_H
#define EP_VIEWER_RECORDER_H

#include <cstdio>
#include <string>

#include "picture/Png.h"

namespace ep
{
/// Pipes pictures of one size into ffmpeg, which makes a film of them. Throws std::runtime_error, with the reason, if there is
/// no ffmpeg or it gives up.
class Recorder
{
public:
	static const int PICTURES_PER_SECOND = 60;

	Recorder(const std::string& file, int width, int height);
	~Recorder();
	Recorder(const Recorder&) = delete;
	Recorder& operator=(const Recorder&) = delete;

	double length() const { return double(m_pictures) / PICTURES_PER_SECOND; }  ///< so far [s]

	/// Tells of its progress on the terminal, once a second of film.
	void add(const Image& image);

	/// Waits until the film is written.
	void finish();

private:
	std::string m_file;
	int m_width, m_height;
	std::FILE* m_pipe = nullptr;
	int m_pictures = 0;
};
}  // namespace ep

#endif  // EP_VIEWER_RECORDER_H
