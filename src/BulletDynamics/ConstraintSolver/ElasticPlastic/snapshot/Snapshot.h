// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SNAPSHOT_WORKS_H
#define BT_ELASTIC_PLASTIC_SNAPSHOT_WORKS_H

#include <unordered_map>

#include "../../btElasticPlasticFault.h"
#include "WorldImage.h"

class btCollisionAlgorithm;
class btCollisionObject;
class btDiscreteDynamicsWorld;
class btElasticPlasticAction;
class btTypedConstraint;
struct btDbvtBroadphase;

namespace btElasticPlastic
{
class JointRegistry;
class JointWorks;

/// Reads a world into an image of it, and makes a world again what an image shows.
class Snapshot
{
public:
	/// Looks at the world as it is now.
	Snapshot(btDiscreteDynamicsWorld& world, btDbvtBroadphase& broadphase, btElasticPlasticAction& action);

	WorldImage read() const;

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
	ObjectImage readObject(const btCollisionObject& object) const;
	JointImage readJoint(const JointWorks& joint) const;
	std::vector<MotionImage> readMotions() const;
	std::vector<EventImage> readEvents() const;
	std::vector<PairImage> readPairs() const;

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
	std::unordered_map<const btCollisionObject*, int> m_ranks;
	std::vector<JointWorks*> m_joints;  ///< by number, null: deleted, or of another registry now
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SNAPSHOT_WORKS_H
