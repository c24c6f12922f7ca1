// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_HOUSE_H
#define EP_HOUSE_H

#include "structures/Structure.h"

namespace ep
{
struct HouseSettings
{
	int storeys = 3;
	int columnsAlong = 2, columnsAcross = 3;  ///< along the vehicle's way and across it
	btScalar spacing = 3;                     ///< of columns [m]
	int storeyBlocks = 3;                     ///< of a column in each storey
	btScalar storeyHeight = 3;                ///< [m]
	btScalar columnThickness = btScalar(.3);  ///< of their square section, reinforced concrete [m]
	btScalar beamHeight = btScalar(.4);       ///< as wide as columns are thick [m]
	int beamBlocks = 2;                       ///< from column to column
	btScalar steelShare = btScalar(.02);      ///< of all sections
	btScalar hingeLength = btScalar(.4);      ///< over which plastic bending spreads [m]
};

/// The frame of a house of reinforced concrete: columns from the ground to the roof, and beams from column to column in each storey.
/// One of the columns stands in the middle of the lane.
class House : public Structure
{
public:
	House(World& world, const Materials& materials, const HouseSettings& settings, const btVector3& origin);

private:
	struct Build;

	void addColumn(const Build& build, const btVector3& foot, const std::string& name);
	/// From one column to another one, in each storey.
	void addBeams(const Build& build, int from, int to, const btMatrix3x3& along);
};
}  // namespace ep

#endif  // EP_HOUSE_H
