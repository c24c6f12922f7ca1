// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "sound/Speaker.h"

#ifdef EP_WITH_OPENAL
#include <AL/al.h>
#include <AL/alc.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "sound/Voice.h"
#endif

namespace ep
{
#ifdef EP_WITH_OPENAL
namespace
{
const int RATE = 44100, VOICES = 24;
const float NEAR_BY = 10;  // as loud as they are up to there [m]

/// A card, a server, or what somebody has set: without, libraries would complain on the terminal.
bool mayHaveDevice()
{
	namespace fs = std::filesystem;
	std::error_code ignored;
	for (const char* name : {"ALSOFT_DRIVERS", "ALSOFT_CONF", "PULSE_SERVER"})
		if (std::getenv(name))
			return true;
	const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
	return fs::exists("/dev/snd", ignored) || (runtime && (fs::exists(fs::path(runtime) / "pulse", ignored) ||
														   fs::exists(fs::path(runtime) / "pipewire-0", ignored)));
}
}  // namespace

/// A source for each voice; the one that began first gives way.
struct Speaker::Works
{
	ALCdevice* device;
	ALCcontext* context;
	ALuint sources[VOICES], buffers[VOICES];
	size_t next = 0;
};

Speaker::Speaker()
{
	ALCdevice* const device = mayHaveDevice() ? alcOpenDevice(nullptr) : nullptr;
	if (!device)
		return;
	m_works.reset(new Works{device, alcCreateContext(device, nullptr), {}, {}});
	alcMakeContextCurrent(m_works->context);
	alGenSources(VOICES, m_works->sources);
	alGenBuffers(VOICES, m_works->buffers);
}

Speaker::~Speaker()
{
	if (!m_works)
		return;
	alDeleteSources(VOICES, m_works->sources);
	alDeleteBuffers(VOICES, m_works->buffers);
	alcMakeContextCurrent(nullptr);
	alcDestroyContext(m_works->context);
	alcCloseDevice(m_works->device);
}

void Speaker::listenFrom(const Camera& camera)
{
	if (!m_works)
		return;
	const btVector3 sight = camera.target - camera.eye;
	const float forwardAndUp[] = {float(sight.x()), float(sight.y()), float(sight.z()), 0, 1, 0};
	alListener3f(AL_POSITION, float(camera.eye.x()), float(camera.eye.y()), float(camera.eye.z()));
	alListenerfv(AL_ORIENTATION, forwardAndUp);
}

void Speaker::play(const Burst& burst)
{
	const float loudness = loudnessOf(burst);
	if (!m_works || loudness <= 0)
		return;
	std::vector<std::int16_t> samples;
	for (float sample : voiceOf(burst, RATE))
		samples.push_back(std::int16_t(32767 * sample));
	const ALuint source = m_works->sources[m_works->next], buffer = m_works->buffers[m_works->next];
	m_works->next = (m_works->next + 1) % VOICES;
	alSourceStop(source);
	alSourcei(source, AL_BUFFER, 0);
	alBufferData(buffer, AL_FORMAT_MONO16, samples.data(), ALsizei(samples.size() * sizeof samples[0]), RATE);
	alSourcei(source, AL_BUFFER, ALint(buffer));
	alSourcef(source, AL_GAIN, loudness);
	alSourcef(source, AL_REFERENCE_DISTANCE, NEAR_BY);
	alSource3f(source, AL_POSITION, float(burst.place.x()), float(burst.place.y()), float(burst.place.z()));
	alSourcePlay(source);
}
#else
struct Speaker::Works
{
};

Speaker::Speaker() = default;
Speaker::~Speaker() = default;
void Speaker::listenFrom(const Camera&) {}
void Speaker::play(const Burst&) {}
#endif
}  // namespace ep
