// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SNAPSHOT_WORKS_H
#define BT_ELASTIC_PLASTIC_SNAPSHOT_WORKS_H

#include "../../btElasticPlasticFault.h"
#include "BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h"
#include "LinearMath/btHashMap.h"
#include "WorldImage.h"

class btCollisionObject;
class btDiscreteDynamicsWorld;
class btElasticPlasticAction;
class btTypedConstraint;
struct btBroadphasePair;
struct btDbvtBroadphase;

namespace btElasticPlastic
{
class JointRegistry;
class JointWorks;

/// Writes a world as bytes, and makes a world again what an image of it shows.
class Snapshot
{
public:
	/// Looks at the world as it is now.
	Snapshot(btDiscreteDynamicsWorld& world, btDbvtBroadphase& broadphase, btElasticPlasticAction& action);

	/// Whether no substep is being ended, and no listener told of an event.
	bool isBetweenSteps() const;

	/// Whether bodies of broken joints separate in another world than this one.
	bool isOfAnotherWorld() const;

	/// Writes the world, part after part in the order in which transfer() has those of a WorldImage.
	void save(Writer& writer) const;

	/// What of an image does not belong to this world.
	btElasticPlasticFault findMismatch(const WorldImage& image) const;

	/// \param image  without a mismatch
	void write(const WorldImage& image);

	/// Makes the next step independent of what solvers have kept.
	void leaveFactors();

private:
	int rankOf(const btCollisionObject& object) const;
	bool hasBodies(const JointWorks& joint) const;
	ConstraintImage describe(btTypedConstraint& constraint) const;
	btTypedConstraint* findConstraint(const ConstraintImage& image, std::vector<btTypedConstraint*>& left) const;

	// ---- reading
	void readObject(const btCollisionObject& object, ObjectImage& image) const;
	void readJoint(const JointWorks& joint, JointImage& image) const;
	std::vector<MotionImage> readMotions() const;
	std::vector<LoadImage> readLoads() const;
	std::vector<EventImage> readEvents() const;
	void readPair(const btBroadphasePair& pair, btManifoldArray& manifolds, PairImage& image) const;

	// ---- what does not fit
	btElasticPlasticFault findForeignObject(const WorldImage& image) const;
	btElasticPlasticFault findForeignJoint(const WorldImage& image) const;
	btElasticPlasticFault findForeignConstraint(const WorldImage& image) const;
	bool arePairsSound(const WorldImage& image) const;
	bool areMotionsSound(const WorldImage& image) const;
	bool areEventsSound(const WorldImage& image) const;

	// ---- writing
	void writeRegistry(const WorldImage& image);
	void writeMotions(const WorldImage& image);
	void writeConstraints(const WorldImage& image);
	void writeObjects(const WorldImage& image);
	void writePairs(const WorldImage& image);
	btCollisionAlgorithm* makeAlgorithm(const PairImage& image) const;
	btCollisionAlgorithm* makeChild(const PairImage& image, int child) const;
	void destroy(btCollisionAlgorithm* algorithm) const;
	void writeChildren(const PairImage& image, btCollisionAlgorithm& algorithm) const;

	btDiscreteDynamicsWorld& m_world;
	btDbvtBroadphase& m_broadphase;
	JointRegistry& m_registry;
	std::vector<btCollisionObject*> m_objects;  ///< by rank, without the registry's own
	btHashMap<btHashPtr, int> m_ranks;
	std::vector<JointWorks*> m_joints;  ///< by number, null: deleted, or of another registry now
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SNAPSHOT_WORKS_H
