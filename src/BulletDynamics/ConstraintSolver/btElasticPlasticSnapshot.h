// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SNAPSHOT_H
#define BT_ELASTIC_PLASTIC_SNAPSHOT_H

#include "btElasticPlasticFault.h"
#include "btElasticPlasticPrecision.h"

class btDiscreteDynamicsWorld;
class btElasticPlasticAction;
struct btDbvtBroadphase;

// A world between steps as bytes, to go back to: a rollback, a saved game, a run that goes on elsewhere. What follows a restored
// snapshot has the same bits as what followed the saved one, in this world or in another one of the same program that was built by
// the same calls, with contacts, breaks and repairs since.
//
// A snapshot holds what steps change: bodies (poses, velocities, forces, sleep, collision flags), contacts with their impulses, the
// broadphase's pairs and trees, which joints and other constraints are in the world and in which order, joints with state, capacity and
// levels, and unread events. It does not hold what only games change: shapes, masses, factors, gravity, damping, solver settings, the
// action's waking share, joints' frames, listeners, motion states' own data, and what other actions remember
// (btElasticPlasticStepper and btElasticPlasticStepControl, too).
// Motion states of bodies that steps move are told where they are, of sleeping bodies, too: those to within the way that such a body
// drifted in its last fixed step.
// See docs/limits.md for what else is left out.

/// Saves a world.
///
/// The next step factorises large islands anew, as it will after btElasticPlasticRestore: a factor that is kept from step to step is
/// not saved, and the result would differ by its rounding.
///
/// \param broadphase  the world's
/// \param action      of the world
/// \param buffer      where the snapshot goes; null: nowhere
/// \param capacity    of the buffer [bytes], >= 0. If the snapshot does not fit, what the buffer then holds is no snapshot
/// \return the snapshot's length [bytes]; 0 if the broadphase is not the world's, holds what is no object of the world or lacks one, if bodies of the
/// action's broken joints are still parting in another world, if the snapshot would be longer than 2 GB, or if a listener calls it: it is told of events before all of a step is done, and saves when
/// stepSimulation has returned. So do tick callbacks and other actions of the world, of whose calls nothing is known here: what they save
/// in the middle of a step goes on with other bits
int btElasticPlasticSave(btDiscreteDynamicsWorld& world, btDbvtBroadphase& broadphase, btElasticPlasticAction& action,
						 void* buffer, int capacity, btElasticPlasticOwnPrecision = {});

/// Restores a world from a snapshot of it, or of one that was built by the same calls. No listener hears of it. Joints, constraints and
/// bodies must be those that there were, in the world or broken; bodies must not have been removed and added again.
///
/// \param size  of the snapshot [bytes], as it was returned
/// \return a fault, and nothing is changed, if this is not a whole snapshot of this version and precision, or of another world, or if a
/// listener calls it
btElasticPlasticFault btElasticPlasticRestore(btDiscreteDynamicsWorld& world, btDbvtBroadphase& broadphase,
											  btElasticPlasticAction& action, const void* buffer, int size,
											  btElasticPlasticOwnPrecision = {});

#endif  // BT_ELASTIC_PLASTIC_SNAPSHOT_H
