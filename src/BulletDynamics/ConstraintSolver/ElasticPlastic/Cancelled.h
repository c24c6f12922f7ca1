// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CANCELLED_H
#define BT_ELASTIC_PLASTIC_CANCELLED_H

#include <math.h>

namespace btElasticPlastic
{
/// Of what a sum is made of, a share that rounding in double may leave where its terms cancel.
const double ROUNDING_OF_SUM = 1e-14;

/// A sum, 0 where its terms cancel but for rounding. A wall that stands in a plane would else be moved out of it, by so little that
/// products of that have no normal number in float any more: processors take several times as long for these.
/// \param size  sum of the terms' absolute values
inline double cancelled(double sum, double size) { return fabs(sum) < ROUNDING_OF_SUM * size ? 0 : sum; }

/// The same of sum a b, by the sums of a^2 and b^2.
inline double cancelledProduct(double sum, double squares, double otherSquares)
{
	return sum * sum < ROUNDING_OF_SUM * ROUNDING_OF_SUM * squares * otherSquares ? 0 : sum;
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_CANCELLED_H
