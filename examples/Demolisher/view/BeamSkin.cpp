// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/BeamSkin.h"

#include "world/JointReading.h"

namespace ep
{
namespace
{
const int STATIONS = 5;  // in each block

struct Node
{
	btTransform before, after;  ///< where the block before it ends, and the next one begins
	bool holds;                 ///< both are the same
};

btTransform facePose(const btRigidBody& block, btScalar x) { return block.getCenterOfMassTransform() * at(x); }

Node nodeOf(const World& world, const Beam& beam, int i)
{
	const int n = int(beam.m_parts.size());
	const btScalar half = beam.m_partLength / 2;
	Node node;
	node.after = i < n ? facePose(*beam.m_parts[i], -half) : btTransform::getIdentity();
	node.before = i > 0 ? facePose(*beam.m_parts[i - 1], half) : node.after;
	if (i == n)
		node.after = node.before;
	const btElasticPlasticJoint* const joint = beam.m_jointAt[i];
	const JointReading reading = joint ? readJoint(world, *joint) : JointReading();
	node.holds = reading.isThere && !reading.isBroken;
	if (!node.holds)
		return node;
	// At a support the beam begins as the support stands.
	if (i == 0 || i == n)
	{
		(i == 0 ? node.after : node.before)
			.setRotation((i == 0 ? joint->getFrameA() : joint->getFrameB()).getRotation());
		return node;
	}
	const btTransform middle(node.before.getRotation().slerp(node.after.getRotation(), btScalar(.5)),
							 (node.before.getOrigin() + node.after.getOrigin()) / 2);
	node.before = node.after = middle;
	return node;
}

/// Hermite's cubic from a to b, which are about a block's length apart; t from 0 to 1.
btTransform between(const btTransform& a, const btTransform& b, btScalar t)
{
	const btScalar length = (b.getOrigin() - a.getOrigin()).length(), s = 1 - t;
	const btVector3 from = a.getBasis().getColumn(0) * length, to = b.getBasis().getColumn(0) * length;
	const btVector3 place = a.getOrigin() * (s * s * (1 + 2 * t)) + b.getOrigin() * (t * t * (3 - 2 * t)) +
							from * (t * s * s) - to * (t * t * s);
	return btTransform(a.getRotation().slerp(b.getRotation(), t), place);
}
}  // namespace

std::vector<std::vector<btTransform>> skinStations(const World& world, const Beam& beam)
{
	std::vector<std::vector<btTransform>> lengths(1);
	const int n = int(beam.m_parts.size());
	Node node = nodeOf(world, beam, 0);
	for (int i = 0; i < n; ++i)
	{
		const Node next = nodeOf(world, beam, i + 1);
		for (int k = lengths.back().empty() ? 0 : 1; k <= STATIONS; ++k)
			lengths.back().push_back(between(node.after, next.before, btScalar(k) / STATIONS));
		if (!next.holds && i + 1 < n)
			lengths.emplace_back();
		node = next;
	}
	return lengths;
}
}  // namespace ep
