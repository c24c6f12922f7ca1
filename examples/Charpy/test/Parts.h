// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_PARTS_H
#define EP_CHARPY_PARTS_H

#include "test/Settings.h"

namespace ep::charpy
{
// The machine and the specimen as bodies. x is the direction of the blow, y is up, z runs along the specimen; the origin is in
// the middle of the specimen's face at the anvils. All lengths inside Bullet are in its own unit, see lengthsPerMetre.

/// A convex body whose upright is the same all along: its corners in the plan view, x and z [m], about its centre of mass.
struct Shape
{
	std::vector<btVector3> plan;  ///< y is not used
	double height;                ///< along y [m]
};

Shape hammerShape(const Settings& settings);
/// What it weighs and looks like.
Shape pieceShape(const Settings& settings);
/// The left one is at z < 0.
Shape anvilShape(const Settings& settings, bool left);

/// Centre of the hammer as seen from its axis of rotation, at angle 0 [m].
btVector3 hammerCentre(const Settings& settings);
/// The axis of rotation [m].
btVector3 hammerAxis(const Settings& settings);
/// Centre of an anvil and of the i-th piece [m].
btVector3 anvilCentre(const Settings& settings, bool left);
btVector3 pieceCentre(const Settings& settings, int i);

/// The bodies. A rigid specimen is one piece.
struct Parts
{
	Parts(World& world, const Settings& settings);

	btRigidBody* hammer;
	btHingeConstraint* bearing;
	btRigidBody* anvils[2];
	std::vector<btRigidBody*> pieces;
};
}  // namespace ep::charpy

#endif  // EP_CHARPY_PARTS_H
