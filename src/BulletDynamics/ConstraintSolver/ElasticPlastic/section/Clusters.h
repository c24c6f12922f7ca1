// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CLUSTERS_H
#define BT_ELASTIC_PLASTIC_CLUSTERS_H

#include "Slips.h"

namespace btElasticPlastic
{
struct Cluster
{
	double m_y, m_z;  ///< its centroid
	double m_area;
	Slips m_slips = {};                                  ///< means
	double m_twistYY = 0, m_twistYZ = 0, m_twistZZ = 0;  ///< means of the twist's slips' products
};

/// Cuts a figure into about equally large clusters, by Lloyd's method: each has what is nearest to it. They stand in no rows, so that a
/// straight line cuts few of them at a time; what lies on a line is what a bundle of fibres bears too little of.
/// Each one next to the one before, as far as they go. At corners of thin walls there is one for each wall, so that they may be some more.
/// \param region  of which y and z are principal axes with their origin at the centroid
std::vector<Cluster> clustersOf(const Region& region, int count);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_CLUSTERS_H
