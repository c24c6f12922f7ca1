// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FIBRE_SLIPS_H
#define BT_ELASTIC_PLASTIC_FIBRE_SLIPS_H

#include "Clusters.h"

namespace btElasticPlastic
{
/// How a fibre that stands for a cluster slips, as btElasticPlasticFibre has it.
struct FibreSlip
{
	double m_wall[2];  ///< direction of a wall, which is sheared along itself; 0, 0: in any direction
	double m_twist[2];
};

/// Where most of a section is thin walls, fibres are sheared along these, else in any direction.
std::vector<FibreSlip> fibreSlipsOf(const std::vector<Cluster>& clusters);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_FIBRE_SLIPS_H
