// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_GATE_H
#define EP_GATE_H

#include "structures/Structure.h"

namespace ep
{
struct GateSettings
{
	int blocks = 10;
	btScalar length = 6;                 ///< of the boom, across the lane [m]
	btScalar thickness = btScalar(.06);  ///< of its square section: so slender that its own weight bends it visibly [m]
	btScalar height = btScalar(1.3);     ///< above the ground [m]
	btScalar hingeLength = btScalar(.6);  ///< over which plastic bending spreads [m]
	bool twoSupports = false;             ///< a box at either end
	btScalar box = btScalar(1.6);         ///< edge length of the concrete cube that holds it [m]
};

/// A boom of solid steel across the lane, held by a heavy box that stands on the ground, or by two.
class Gate : public Structure
{
public:
	Gate(World& world, const Materials& materials, const GateSettings& settings, const btVector3& origin);

	const Beam& boom() const { return m_beams.front(); }

	/// How far the boom's free end, or its middle if it has two supports, is below where it was built [m].
	btScalar sag() const;

	/// The same by beam theory, w L^4 / 8 E I or w L^4 / 384 E I and the share of shear, for small deflections [m].
	btScalar beamSag(btScalar gravity) const;

private:
	btRigidBody* addBox(World& world, const Materials& materials, const btVector3& origin, btScalar side);

	GateSettings m_settings;
};
}  // namespace ep

#endif  // EP_GATE_H
