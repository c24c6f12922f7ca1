// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_MEMBER_H
#define EP_MEMBER_H

#include <functional>
#include <string>

#include "world/Place.h"
#include "world/World.h"

namespace ep
{
/// A straight member of rigid boxes in a row, jointed where they meet: what structures are made of.
struct Member
{
	/// Of a joint between two parts of these lengths; 0: that side does not deform.
	typedef std::function<btElasticPlasticCapacity(btScalar lengthA, btScalar lengthB)> CapacityOf;

	/// Reference values know no damping.
	static btElasticPlasticMaterial undampedSteel()
	{
		btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel();
		steel.m_dampingRatio = 0;
		return steel;
	}

	struct Settings
	{
		btElasticPlasticMaterial material = undampedSteel();
		btScalar width = btScalar(0.1);   ///< of the rectangular section, along the pose's z [m]
		btScalar height = btScalar(0.1);  ///< along its y [m]
		int parts = 10;
		btScalar shapeShare = 1;  ///< of a part's length that its shape takes: less leaves gaps between colliding parts
		bool collides = false;
		btScalar partMass = 0;       ///< 0: the boxes are full of the material [kg]
		CapacityOf capacityOf = {};  ///< empty: the textbook's lumped beam
		std::string name = {};       ///< joints are called by it and their node's number; empty: they have no names
	};

	/// \param start  pose of the member's beginning, x along the member
	Member(World& world, const Settings& settings, const btTransform& start, btScalar length);

	/// Pose of the member's axis at the i-th of parts + 1 nodes, as built.
	btTransform node(int i) const { return m_start * at(m_partLength * i); }

	/// The joint of the first or last part with something that does not deform, at the member's end.
	btElasticPlasticJoint* joinStart(World& world, btRigidBody& support);
	btElasticPlasticJoint* joinEnd(World& world, btRigidBody& support);

	/// By the settings' rule.
	btElasticPlasticCapacity capacity(btScalar lengthA, btScalar lengthB) const;

	/// From the beginning on, those that there are.
	std::vector<btElasticPlasticJoint*> joints() const;

	btRigidBody& first() const { return *m_parts.front(); }
	btRigidBody& last() const { return *m_parts.back(); }

	std::vector<btRigidBody*> m_parts;
	std::vector<btElasticPlasticJoint*> m_jointAt;  ///< by node; null at an end that is not joined
	btScalar m_partLength;

private:
	btElasticPlasticJoint* join(World& world, btRigidBody& a, btRigidBody& b, int node, btScalar lengthA,
								btScalar lengthB);

	Settings m_settings;
	btTransform m_start;
};

/// Puts a force on the place of a joint, half on each of its bodies, for the next step.
void loadJoint(btElasticPlasticJoint& joint, const btVector3& force);
}  // namespace ep

#endif  // EP_MEMBER_H
