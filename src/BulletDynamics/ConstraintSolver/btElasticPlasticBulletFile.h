// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BULLET_FILE_H
#define BT_ELASTIC_PLASTIC_BULLET_FILE_H

#include "btElasticPlasticFault.h"
#include "btElasticPlasticPrecision.h"
#include "LinearMath/btAlignedObjectArray.h"

class btDynamicsWorld;
class btElasticPlasticAction;
class btTypedConstraint;

// Bullet's own files. btDynamicsWorld::serialize() writes elastic-plastic joints, too: as constraints of Bullet's class, which any
// btBulletWorldImporter loads and which are locked where the joint is elastic-plastic, at the pose to which it has bent; and beside
// each of them a block with capacity, state and levels, of which Bullet takes no notice. Joints that are broken or have a fault are
// Bullet's alone, without limits.

/// Puts elastic-plastic joints in place of the constraints that Bullet has loaded for them, as they were when the file was written, and
/// gives them to the action. To be called when btBulletWorldImporter has loaded the file. The constraints that it has made
/// leave the world, and stay the importer's to delete; all others stay in the world in their order. Joints of a body with the world itself
/// (made with one body) are left out, as Bullet's importer leaves them out: join to a static body.
///
/// \param file   as it was written; Bullet may change its own copy while it loads it
/// \param size   of the file [bytes]
/// \param made   the joints are added to it, which are made by new and the caller's to delete; their btElasticPlasticJoint is told by from()
/// \param first  index in the world of the first constraint that was loaded: how many there were before
/// \return a fault, and nothing is changed, if this is not a whole file of Bullet's, if its constraints are not those in the world, or
/// if a joint of it cannot be one
btElasticPlasticFault btElasticPlasticImport(btDynamicsWorld& world, btElasticPlasticAction& action, const void* file,
											 int size, btAlignedObjectArray<btTypedConstraint*>& made, int first = 0,
											 btElasticPlasticOwnPrecision = {});

#endif  // BT_ELASTIC_PLASTIC_BULLET_FILE_H
