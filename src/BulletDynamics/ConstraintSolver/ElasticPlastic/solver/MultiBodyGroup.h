// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_MULTI_BODY_GROUP_H
#define BT_ELASTIC_PLASTIC_MULTI_BODY_GROUP_H

#include <vector>

#include "SolverWorks.h"

class btRigidBody;

namespace btElasticPlastic
{
/// What a multibody world hands over at a time, taken apart: islands with elastic-plastic joints, which are rigid bodies alone, and the
/// rest with the contacts of links, which Bullet solves first.
class MultiBodyGroup
{
public:
	/// \param hasMultiBodyConstraints  which may tie any rigid body to a link
	/// \return whether there are elastic-plastic joints; if not, nothing has to be taken apart
	bool split(SolverWorks& works, const SolverGroup& group, bool hasMultiBodyConstraints,
			   const btContactSolverInfo& info, btDispatcher* dispatcher);

	/// What Bullet is to solve. Bodies of elastic-plastic structures that links touch are among it, without what acts on them
	/// otherwise: their loads belong to the islands' solution.
	SolverGroup beginRest(btScalar dt);

	/// Ends what beginRest() has begun.
	void finishRest();

private:
	/// A body of an elastic-plastic structure while Bullet solves the rest.
	struct Guest
	{
		btRigidBody* m_body;
		int m_flags;
	};

	void invite(btCollisionObject& body);

	SolverGroup m_others;
	std::vector<btCollisionObject*> m_members;    // moving bodies of elastic-plastic structures, by address
	std::vector<btPersistentManifold*> m_links;   // contacts of links
	std::vector<btPersistentManifold*> m_solids;  // contacts of rigid bodies alone
	std::vector<Guest> m_guests;
	std::vector<btCollisionObject*> m_restBodies;
	std::vector<btPersistentManifold*> m_restManifolds;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_MULTI_BODY_GROUP_H
