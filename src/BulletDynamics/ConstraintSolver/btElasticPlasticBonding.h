// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BONDING_H
#define BT_ELASTIC_PLASTIC_BONDING_H

#include "LinearMath/btAlignedObjectArray.h"
#include "btElasticPlastic6DofSpring2Constraint.h"

class btDynamicsWorld;
class btElasticPlasticAction;

/// A face in which two bodies touch.
struct alignas(16) btElasticPlasticFace
{
	BT_DECLARE_ALIGNED_ALLOCATOR();

	btTransform m_frame = btTransform::
		getIdentity();  ///< world coordinates: origin in the middle of the face, x across it from A to B, y along its height
	btRigidBody* m_bodyA = nullptr;
	btRigidBody* m_bodyB = nullptr;
	btScalar m_area = 0;  ///< [m^2]
	btScalar m_height = 0,
			 m_width = 0;  ///< along y and z, of the rectangle with the same area and ratio of second moments [m]
	btScalar m_lengthA = 0,
			 m_lengthB =
				 0;  ///< of the bodies across the face, twice the way from their centres; 0 of what does not move [m]
};

/// Makes breakable structures of bodies that touch: walls of bricks, voxels, the pieces of a fractured mesh.
///
/// Boxes and convex hulls, and compounds of them, are looked at, as they stand; other shapes have no faces. Each pair of convex pieces
/// touches in one face at most, the largest in which they lie on each other.
struct btElasticPlasticBonding
{
	/// Finds all faces between the given bodies, of which at least one has to move.
	/// \param gap  the largest distance between two faces that counts as touching, and how deep they may overlap [m], > 0; the
	///             collision margins of hulls are taken for what they are, a part of the body
	/// \param faces  gets them; what it held before is gone
	/// \return false, with no faces, if the gap is not finite and greater than 0, or a body is null or its place not finite or no rotation
	static bool findFaces(btRigidBody* const* bodies, int numBodies, btScalar gap,
						  btAlignedObjectArray<btElasticPlasticFace>& faces);

	/// Capacity of a joint in a face, as of a member with the face for its section that runs from one body's centre to the other's.
	/// Its degrees of freedom are independent and know one strength, that in compression of brick, concrete and cast iron: these hardly
	/// ever tear so, see docs/games.md.
	/// \param gaugeLength  see btElasticPlasticCapacity::fromMember()
	static btElasticPlasticCapacity capacityOf(const btElasticPlasticFace& face,
											   const btElasticPlasticMaterial& material, btScalar gaugeLength = 0);

	/// Makes a joint in a face by new, for the caller to own; it is in no world and in no action yet.
	static btElasticPlastic6DofSpring2Constraint* join(const btElasticPlasticFace& face,
													   const btElasticPlasticCapacity& capacity);

	/// All at once: finds faces, and puts a joint into each of them, the world and the action. Joined bodies do not collide with each
	/// other until their joint breaks.
	/// \param joints  the joints are added to it; the caller owns them
	/// \return false, and nothing changes, as findFaces(), or if the material has a fault
	static bool joinAll(btDynamicsWorld& world, btElasticPlasticAction& action, btRigidBody* const* bodies,
						int numBodies, btScalar gap, const btElasticPlasticMaterial& material,
						btAlignedObjectArray<btElasticPlastic6DofSpring2Constraint*>& joints);
};

#endif  // BT_ELASTIC_PLASTIC_BONDING_H
