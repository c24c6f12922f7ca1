// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SPEAKER_H
#define EP_SPEAKER_H

#include <memory>

#include "drawing/Burst.h"
#include "drawing/Drawing.h"

namespace ep
{
/// Plays bursts from where they are, by OpenAL. Silent where there is no device, or no OpenAL was built in.
class Speaker
{
public:
	Speaker();
	~Speaker();

	/// Whether there is a device.
	bool isThere() const { return m_works != nullptr; }
	void listenFrom(const Camera& camera);
	void play(const Burst& burst);

private:
	struct Works;
	std::unique_ptr<Works> m_works;
};
}  // namespace ep

#endif  // EP_SPEAKER_H
