// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FIGURE_11_H
#define EP_FIGURE_11_H

#include <functional>

#include "simulation/Demolisher.h"

namespace ep
{
/// The paper's Figure 11: the vehicle (a) before the gate, (b) once over the bridge without stopping, gate and fence lightly
/// damaged, (c) going back and forth until the bridge's end joints have gone and the deck has fallen.
class Figure11
{
public:
	enum State
	{
		INITIAL,
		CROSSED,
		FALLEN
	};
	static constexpr int STATES = 3;
	static const char* name(State state);  ///< for files

	/// Adds to what the scene is built of all that the figure needs.
	static DemolisherSettings settings();

	explicit Figure11(Demolisher& demolisher) : m_demolisher(demolisher) {}

	/// Drives until a state is reached, in their order. \param stepped  called after each step
	/// \return false if it was not within 10 minutes
	bool reach(
		State state, const std::function<void()>& stepped = [] {});

private:
	bool drive(const Route& route, const std::function<void()>& stepped);
	bool hasFallen() const;

	Demolisher& m_demolisher;
};
}  // namespace ep

#endif  // EP_FIGURE_11_H
