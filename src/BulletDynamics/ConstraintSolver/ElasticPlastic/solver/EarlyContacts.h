// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_EARLY_CONTACTS_H
#define BT_ELASTIC_PLASTIC_EARLY_CONTACTS_H

#include "../../btElasticPlasticSolverSettings.h"
#include "Islands.h"
#include "LinearMath/btScalar.h"

class btDispatcher;

namespace btElasticPlastic
{
/// Finds the contacts of joined bodies before they touch.
///
/// Bullet finds most contacts when bodies are in each other already: after a step at 10 m/s 17 cm deep, and what is found deep has a
/// normal of which nobody knows where it points. Here the way of two convex bodies in the coming step is looked at. If they meet,
/// Bullet's collision detection is asked for the contact points where they do, and the points are moved back to where the bodies are
/// now: contacts with a gap, which the solver lets close.
///
/// Of a loose body that has just parted from a joined one, the way is looked at as if that stayed, too: its joints may bring it back within the step.
///
/// Bullet's broadphase has the pair already, as it looks as far ahead, and with it an empty manifold.
class EarlyContacts
{
public:
	/// Adds points to empty manifolds of pairs that meet in the coming step of dt > 0 [s], of which at least one has an elastic-plastic
	/// joint, and that are no part of too large a structure.
	/// \param group    gets an array of its manifolds that is kept until the next call
	/// \param islands  of the group; what else it has makes no difference to a structure
	/// \return whether anything meets, so that islands are others now
	bool find(SolverGroup& group, Islands& islands, btScalar dt, const btElasticPlasticSolverSettings& settings,
			  btDispatcher& dispatcher);

private:
	std::vector<btPersistentManifold*> m_manifolds;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_EARLY_CONTACTS_H
