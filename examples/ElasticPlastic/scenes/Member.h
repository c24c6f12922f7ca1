// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_MEMBER_H
#define EP_MEMBER_H

#include "world/World.h"

namespace ep
{
/// A straight member of rigid boxes in a row, jointed where they meet: what reference structures are made of.
struct Member
{
	struct Settings
	{
		btElasticPlasticMaterial material = btElasticPlasticMaterial::steel();
		btScalar width = btScalar(0.1);   ///< of the rectangular section, along the pose's z [m]
		btScalar height = btScalar(0.1);  ///< along its y [m]
		int parts = 10;
		btScalar shapeShare = 1;  ///< of a part's length that its shape takes: less leaves gaps between colliding parts
		bool collides = false;
	};

	/// \param start  pose of the member's beginning, x along the member
	Member(World& world, const Settings& settings, const btTransform& start, btScalar length);

	/// Pose of the member's axis at the i-th of parts + 1 nodes, as built.
	btTransform node(int i) const { return m_start * along(m_partLength * i); }

	/// The joint of the first or last part with something that does not deform, at the member's end.
	btElasticPlasticJoint* joinStart(World& world, btRigidBody& support);
	btElasticPlasticJoint* joinEnd(World& world, btRigidBody& support);

	/// Capacity of the textbook's lumped beam: E A / l, G A_s / l, G J / l, E I / l. (btElasticPlasticCapacity::fromMember
	/// also counts how the parts themselves bend under shear; the reference values are without.)
	/// \param lengthA, lengthB  of the joint's two parts, 0: does not deform
	btElasticPlasticCapacity capacity(btScalar lengthA, btScalar lengthB) const;

	btRigidBody& first() const { return *m_parts.front(); }
	btRigidBody& last() const { return *m_parts.back(); }

	std::vector<btRigidBody*> m_parts;
	std::vector<btElasticPlasticJoint*> m_joints;  ///< between the parts: one less
	btScalar m_partLength;

private:
	static btTransform along(btScalar x) { return btTransform(btQuaternion(0, 0, 0, 1), btVector3(x, 0, 0)); }

	Settings m_settings;
	btTransform m_start;
};

/// Puts a force on the place of a joint, half on each of its bodies, for the next step.
void loadJoint(btElasticPlasticJoint& joint, const btVector3& force);
}  // namespace ep

#endif  // EP_MEMBER_H
