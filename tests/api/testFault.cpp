// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <stdlib.h>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticFault.h"

namespace testFault
{
// The compiler knows neither the factors nor the product; with -ffast-math it may take that for finite.
bool isProductFinite(double a, double b) { return btElasticPlasticIsFinite(a * b); }
bool isProductFinite(float a, float b) { return btElasticPlasticIsFinite(a * b); }
bool isDifferenceFinite(double a, double b) { return btElasticPlasticIsFinite(a - b); }

TEST(Fault, SeesWhatIsNotFiniteWhateverTheCompilerAssumes)
{
	const double large = atof("1e300"), infinite = large * large;
	EXPECT_FALSE(isProductFinite(large, large));
	EXPECT_FALSE(isProductFinite(float(atof("1e30")), float(atof("1e30"))));
	EXPECT_FALSE(isDifferenceFinite(infinite, atof("inf")));
	EXPECT_FALSE(btElasticPlasticIsNumber(atof("nan")));
	EXPECT_FALSE(btElasticPlasticIsNumber(-atof("nan")));
	EXPECT_TRUE(btElasticPlasticIsNumber(infinite) && btElasticPlasticIsNumber(-infinite));
	EXPECT_FALSE(btElasticPlasticIsFinite(atof("nan")));
	EXPECT_FALSE(btElasticPlasticIsFinite(atof("-inf")));
	EXPECT_TRUE(isProductFinite(large, 1e8));
	EXPECT_TRUE(isProductFinite(float(atof("1e30")), 1e8f));
	EXPECT_TRUE(isDifferenceFinite(large, -large));
	EXPECT_TRUE(isProductFinite(0., 0.));
	EXPECT_TRUE(btElasticPlasticIsFinite(atof("5e-324")));
	EXPECT_TRUE(btElasticPlasticIsFinite(-1.7976931348623157e308));
	EXPECT_TRUE(btElasticPlasticCheckPositive("mass", btScalar(atof("nan"))));
	EXPECT_TRUE(btElasticPlasticCheckNotNegative("mass", btScalar(infinite)));
}
}  // namespace testFault
