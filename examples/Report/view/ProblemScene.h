// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PROBLEM_SCENE_H
#define EP_PROBLEM_SCENE_H

#include <vector>

#include "problems/Problem.h"
#include "drawing/ViewedScene.h"

namespace ep
{
/// A reference problem to look at: it is solved first, then its last run is played again and again, its displacements
/// magnified so that they are seen.
class ProblemScene : public ViewedScene
{
public:
	ProblemScene(const Problem& problem, const Method& method, const Stepping& stepping);

	std::string title() const override;
	btScalar stepTime() const override;
	void step(const Controls& controls) override;
	void restart() override { m_frame = 0; }
	Drawing draw() const override;
	btVector3 centre() const override;
	btScalar extent() const override;
	void key(char key) override;
	std::vector<std::string> keyHelp() const override;

	/// Of displacements and turns: a power of ten.
	double magnification() const { return m_magnification; }

private:
	struct Body
	{
		btVector3 size;
		bool isFixed;
	};
	struct Joint
	{
		btVector3 place;
		btScalar size;  ///< of its mark
		float utilisation, damage;
		bool isBroken;
	};
	struct Frame
	{
		double time;
		std::vector<btTransform> poses;
		std::vector<Joint> joints;
	};

	void record(World& world, double time);
	void measure();
	btTransform magnified(size_t body) const;

	const Problem& m_problem;
	Outcome m_outcome;
	std::vector<Body> m_bodies;
	std::vector<Frame> m_frames;
	size_t m_frame = 0;
	btVector3 m_low, m_high;  ///< where the moving bodies are
	double m_magnification = 1;
};
}  // namespace ep

#endif  // EP_PROBLEM_SCENE_H
