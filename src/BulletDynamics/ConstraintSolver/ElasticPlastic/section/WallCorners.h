// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_WALL_CORNERS_H
#define BT_ELASTIC_PLASTIC_WALL_CORNERS_H

#include <stddef.h>

#include "Slips.h"

namespace btElasticPlastic
{
/// Parts clusters of pieces at corners, where two walls meet, into one for each wall: a fibre is sheared along one of them, and would stand askew between both.
/// \param owners  clusters of the pieces, which get the new ones of what is parted
/// \return the number of clusters
size_t partAtCorners(const std::vector<SectionPoint>& points, const std::vector<Slips>& slips, size_t numClusters,
					 std::vector<size_t>& owners);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_WALL_CORNERS_H
