// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STIFF_SHARES_H
#define BT_ELASTIC_PLASTIC_STIFF_SHARES_H

#include "LinearMath/btAlignedObjectArray.h"

struct btElasticPlasticSection;

namespace btElasticPlastic
{
/// Shares of the section's stiffness with which the member's own fibres have its area and its second moments, and no first moments:
/// area times a polynomial of their place, the one that is nearest to 1. Of bars, their area over the section's.
void findShares(const btElasticPlasticSection& section, btAlignedObjectArray<double>& shares);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STIFF_SHARES_H
