// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_STIFF_STRUCTURE_H
#define EP_STIFF_STRUCTURE_H

#include <string>
#include <vector>

#include "world/World.h"

namespace ep
{
/// Structures of concrete to compare solvers on, as large as one likes.
class StiffStructure
{
public:
	enum class Shape
	{
		Chain,   ///< a cantilever of size blocks
		Chains,  ///< size cantilevers of 20 blocks, side by side
		Frame,   ///< a building: size x size columns, one and a half times as many storeys, four joints a member
		Wall     ///< size x size blocks on piers, with openings between them
	};

	struct Settings
	{
		Shape shape = Shape::Chain;
		int size = 10;
		Joints joints = Joints::ElasticPlastic;  ///< or Springs: what a game has without us
		Solver solver = Solver::Direct;
		int fibres = 0;            ///< of each section, 0: each degree of freedom yields by itself
		bool collapsing = false;   ///< everything is given a push that makes joints yield all over
		bool splitIslands = true;  ///< Bullet's default; if not, our solver splits them, and Bullet's takes all at once
	};

	explicit StiffStructure(const Settings& settings);

	World& world() { return m_world; }
	int joints() const { return m_numJoints; }

	/// Time of a step of 1/60 s, all of it [s].
	double step();

private:
	struct Direction;
	struct Part;

	btRigidBody* block(const btVector3& size, const btVector3& place, const Direction& along);
	void join(btRigidBody& a, btRigidBody& b, const btVector3& place, const Direction& along, const Part& part);
	void buildChain(int blocks, btScalar z);
	void buildFrame(int bays);
	void buildMember(btRigidBody& from, btRigidBody& to, const btVector3& begin, const Direction& along);
	void buildWall(int blocks);

	Settings m_settings;
	World m_world;
	btRigidBody* m_ground;
	int m_numJoints = 0;
};

/// The median of a list of times.
double medianOf(std::vector<double> times);
}  // namespace ep

#endif  // EP_STIFF_STRUCTURE_H
