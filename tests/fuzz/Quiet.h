// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FUZZ_QUIET_H
#define EP_FUZZ_QUIET_H

#include <stdint.h>

#include <memory>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticAction.h"
#include "btBulletDynamicsCommon.h"

/// Blocks that hang from a wall, yield, and touch nobody: an island of which nothing elsewhere may change a bit. They have an
/// action of their own.
class Quiet
{
public:
	explicit Quiet(btDiscreteDynamicsWorld& world);
	~Quiet();

	/// Of all bits of bodies and joints.
	uint64_t hash() const;
	bool isFinite() const;

private:
	btDiscreteDynamicsWorld& m_world;
	btBoxShape m_shape{btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5))};
	btElasticPlasticAction m_action;
	std::vector<std::unique_ptr<btRigidBody>> m_bodies;
	std::vector<std::unique_ptr<btElasticPlastic6DofSpring2Constraint>> m_joints;
};

#endif  // EP_FUZZ_QUIET_H
