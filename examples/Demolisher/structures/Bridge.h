// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BRIDGE_H
#define EP_BRIDGE_H

#include "structures/Structure.h"

namespace ep
{
/// What the bridge is built of. SI units; x runs along the bridge, y up, z across, the origin on the ground below its middle.
struct BridgeSettings
{
	int blocks = 12;
	btScalar span = 24;                 ///< between the supports [m]
	btScalar width = 5;                 ///< of deck, supports and ramps [m]
	btScalar thickness = btScalar(.8);  ///< of the deck [m]
	btScalar height = btScalar(4.5);    ///< of the roadway above the ground [m]
	btScalar supportLength = 4;         ///< along the bridge [m]
	btScalar rampLength = 26;           ///< along the bridge [m]
	btScalar ledge = btScalar(.4);  ///< how far a support reaches under the deck, which falls on it when torn off [m]

	bool slidingEnd = true;  ///< the right end is free to slide lengthwise

	btScalar steelShare = btScalar(.027);  ///< of the section; spread over it evenly, it carries all load
	btScalar hingeLength = btScalar(.8);   ///< over which plastic bending spreads, the deck's thickness [m]
};

/// Rigid ramps and supports at both ends, and between them a deck of concrete blocks. The blocks are joined to each other
/// and to the supports by joints which stand for the steel between the blocks' centres.
class Bridge : public Structure
{
public:
	Bridge(World& world, const Materials& materials, const BridgeSettings& settings, const btVector3& origin);

	const BridgeSettings& settings() const { return m_settings; }
	const btVector3& origin() const { return m_origin; }
	const Beam& deck() const { return m_beams.front(); }

	/// How far the middle of the deck is below where it was built [m].
	btScalar sag() const;

	/// The same at rest under the deck's own weight for these rigid blocks on these joints, exactly (small deflections) [m].
	double exactSag(btScalar gravity) const;

	/// The same by beam theory for the deck's own weight: a bar of the steel's bending and shear stiffness, clamped at both ends [m].
	btScalar beamSag(btScalar gravity) const;

	/// What the supports bear by way of the joints, positive upwards [N].
	btScalar supportForce() const;

private:
	btTransform fromOrigin(btScalar x, btScalar y) const;
	btRigidBody* addSupport(World& world, btScalar side);
	void addRamp(World& world, btScalar side);

	BridgeSettings m_settings;
	btVector3 m_origin;
};
}  // namespace ep

#endif  // EP_BRIDGE_H
