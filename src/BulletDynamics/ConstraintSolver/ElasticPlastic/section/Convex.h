// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONVEX_H
#define BT_ELASTIC_PLASTIC_CONVEX_H

namespace btElasticPlastic
{
/// The least value of a convex function between -reach and reach, by golden sections. Its place is found to 1e-8 of the reach, so that a smooth
/// function's value is exact but for rounding.
template <class Function>
double leastOf(const Function& function, double reach)
{
	const double golden = 0.6180339887498949;
	double low = -reach, high = reach, left = high - golden * (high - low), right = low + golden * (high - low);
	double atLeft = function(left), atRight = function(right);
	for (int i = 0; i < 40; ++i)
		if (atLeft < atRight)
		{
			high = right;
			right = left;
			atRight = atLeft;
			left = high - golden * (high - low);
			atLeft = function(left);
		}
		else
		{
			low = left;
			left = right;
			atLeft = atRight;
			right = low + golden * (high - low);
			atRight = function(right);
		}
	return atLeft < atRight ? atLeft : atRight;
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_CONVEX_H
