// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_QUALITY_H
#define EP_VIEWER_QUALITY_H

namespace ep
{
/// How finely the window is drawn: by steps less where that takes too long, as without a graphics card. It does not come back by itself,
/// or the window would go to and fro.
class Quality
{
public:
	enum Level
	{
		FINE,
		PLAIN,   ///< the scene in half as many rows and columns, and without smooth edges
		COARSE,  ///< a third of them
	};

	/// \param seconds  that drawing a picture has taken
	void drawn(double seconds)
	{
		m_sum += seconds;
		if (++m_pictures < PICTURES)
			return;
		if (m_sum > SLOWEST * m_pictures && m_level < COARSE)
			m_level = Level(m_level + 1);
		m_sum = 0;
		m_pictures = 0;
	}

	Level level() const { return m_level; }
	/// What rows and columns are divided by.
	int divisor() const { return m_level + 1; }
	const char* name() const { return m_level == FINE ? "fine" : m_level == PLAIN ? "plain" : "coarse"; }

	static constexpr int PICTURES = 20;         ///< that are looked at together
	static constexpr double SLOWEST = 1. / 25;  ///< the mean of them [s]

private:
	Level m_level = FINE;
	double m_sum = 0;
	int m_pictures = 0;
};
}  // namespace ep

#endif  // EP_VIEWER_QUALITY_H
