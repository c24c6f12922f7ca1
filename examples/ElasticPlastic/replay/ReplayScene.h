// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPLAY_SCENE_H
#define EP_REPLAY_SCENE_H

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "drawing/ViewedScene.h"
#include "world/World.h"

namespace ep
{
/// What has been computed, to look at: it is played again and again, drawn at a size that a window can show and its
/// displacements magnified so that they are seen.
class ReplayScene : public ViewedScene
{
public:
	/// \param run  computes with a watch; of several runs the last one is kept. \return a line that tells what came of it
	ReplayScene(const std::string& title, const std::function<std::string(const Watch& watch)>& run);

	std::string title() const override { return m_title; }
	btScalar stepTime() const override;
	void step(const Controls& controls) override;
	void restart() override { m_frame = 0; }
	/// To the moment at which it has moved furthest, which one picture shows best.
	void goToFurthest() { m_frame = m_furthest; }
	Drawing draw() const override;
	Bounds bounds() const override;
	void key(char key) override;
	std::vector<std::string> keyHelp() const override;

private:
	struct Body
	{
		btVector3 size;
		bool isFixed;
	};
	struct Joint
	{
		btTransform pose;
		btVector3 size;  ///< of its mark: a band round what it joins
		float utilisation, damage;
		bool isBroken;
	};
	struct Placed
	{
		btTransform pose;
		bool isThere;  ///< in the world
	};
	struct Frame
	{
		double time;
		std::vector<Placed> bodies;  ///< those that have appeared so far
		std::vector<Joint> joints;
	};

	void begin();
	void addBodies(const World& world);
	void record(World& world, double time);
	void measure();
	const Frame& frame() const { return m_frames[std::min(m_frame, m_frames.size() - 1)]; }
	btTransform magnified(const btTransform& start, const btTransform& now) const;
	btVector3 shown(const btVector3& place) const;
	/// What is much larger is but where it lies on.
	bool isGround(const Body& body) const { return body.isFixed && body.size.length() > 3 * m_bounds.size().length(); }

	std::string m_title, m_result;
	std::vector<Body> m_bodies;
	std::vector<Frame> m_frames;
	size_t m_frame = 0, m_furthest = 0;
	Bounds m_bounds;             ///< of what moves, and of its supports
	btScalar m_clearance = 0;    ///< from the drawn ground to the lowest of it, before it is drawn larger [m]
	double m_interval;           ///< from frame to frame [s]
	double m_size = 1;           ///< of what is drawn over what it is: a power of ten
	double m_magnification = 1;  ///< of displacements and turns: a power of ten
};
}  // namespace ep

#endif  // EP_REPLAY_SCENE_H
