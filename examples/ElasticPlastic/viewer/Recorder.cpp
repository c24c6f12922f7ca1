// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Recorder.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace ep
{
namespace
{
/// As one word of a shell's.
std::string quoted(const std::string& word)
{
	std::string all = "'";
	for (char c : word)
		all += c == '\'' ? std::string("'\\''") : std::string(1, c);
	return all + "'";
}
}  // namespace

Recorder::Recorder(const std::string& file, int width, int height) : m_file(file), m_width(width), m_height(height)
{
	if (std::system("command -v ffmpeg > /dev/null 2>&1") != 0)
		throw std::runtime_error("no film: ffmpeg is not installed (Debian and Ubuntu: apt install ffmpeg)");
	// When ffmpeg gives up, a failing write tells it.
	std::signal(SIGPIPE, SIG_IGN);
	// H.264 wants even sizes. A relative name could begin with a dash.
	const std::string name = file.empty() || file[0] == '/' ? file : "./" + file;
	const std::string command = "ffmpeg -y -loglevel error -f rawvideo -pix_fmt rgb24 -s " + std::to_string(width) +
								"x" + std::to_string(height) + " -r " + std::to_string(PICTURES_PER_SECOND) +
								" -i - -vf 'crop=trunc(iw/2)*2:trunc(ih/2)*2' -pix_fmt yuv420p -movflags +faststart " +
								quoted(name);
	m_pipe = popen(command.c_str(), "w");
	if (!m_pipe)
		throw std::runtime_error("no film: ffmpeg cannot be started");
}

Recorder::~Recorder()
{
	if (m_pipe)
		pclose(m_pipe);
}

void Recorder::add(const Image& image)
{
	if (image.width != m_width || image.height != m_height)
		throw std::runtime_error("the film '" + m_file + "' ends: the window has another size now");
	if (std::fwrite(image.pixels.data(), 1, image.pixels.size(), m_pipe) != image.pixels.size())
		throw std::runtime_error("the film '" + m_file +
								 "' cannot be written: ffmpeg has given up, its reason is above");
	if (++m_pictures % PICTURES_PER_SECOND == 0)
	{
		std::printf("  film %d s\n", m_pictures / PICTURES_PER_SECOND);
		std::fflush(stdout);
	}
}

void Recorder::finish()
{
	const int result = pclose(m_pipe);
	m_pipe = nullptr;
	if (result != 0)
		throw std::runtime_error("the film '" + m_file +
								 "' cannot be written: ffmpeg has given up, its reason is above");
	std::printf("film %s, %.1f s\n", m_file.c_str(), double(m_pictures) / PICTURES_PER_SECOND);
	std::fflush(stdout);
}
}  // namespace ep
