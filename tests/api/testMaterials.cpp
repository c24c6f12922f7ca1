// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <cmath>
#include <cstdlib>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticMaterials.h"
#include "support/Close.h"

namespace testMaterials
{
typedef btElasticPlasticReadyMaterial Ready;

TEST(Materials, AreValidAndEachHasANameAndASource)
{
	std::set<std::string> names;
	for (int i = 0; i < Ready::count(); ++i)
	{
		const Ready ready = Ready::at(i);
		EXPECT_FALSE(ready.m_material.fault()) << ready.m_name;
		EXPECT_TRUE(names.insert(ready.m_name).second) << ready.m_name;
		EXPECT_GT(std::string(ready.m_source).size(), 5u) << ready.m_name;
		EXPECT_EQ(ready.m_material.m_yieldStress, Ready::find(ready.m_name).m_yieldStress);
		const btElasticPlasticSection section =
			btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres();
		EXPECT_FALSE(btElasticPlasticCapacity::fromMember(ready.m_material, section, 1, 1).fault()) << ready.m_name;
	}
}

TEST(Materials, OfSteelHaveTheStrengthOfTheirName)
{
	for (const char* name : {"S235", "S275", "S355", "S420", "S460"})
		expectClose(1e6 * std::atof(name + 1), Ready::find(name).m_yieldStress);
	for (const char* name : {"B500A", "B500B", "B500C"})
		expectClose(500e6, Ready::find(name).m_yieldStress);
}

TEST(Materials, OfConcreteFollowTheFormulaOfTheirStandard)
{
	for (const char* name : {"C20/25", "C25/30", "C30/37", "C35/45", "C40/50", "C45/55", "C50/60"})
	{
		const btElasticPlasticMaterial concrete = Ready::find(name);
		const double strength = std::atof(name + 1);
		expectClose(1e6 * strength, concrete.m_yieldStress);
		EXPECT_EQ(0, concrete.m_tensileShare);
		// EN 1992-1-1, table 3.1: E = 22 GPa (f_cm / 10 MPa)^0.3, f_cm = f_ck + 8 MPa, which the table prints in whole GPa.
		EXPECT_NEAR(22e9 * std::pow((strength + 8) / 10, 0.3), double(concrete.m_youngsModulus), 0.51e9) << name;
		// Elastic and plastic strain together.
		EXPECT_NEAR(0.0035, double(concrete.m_crushingStrain + concrete.m_yieldStress / concrete.m_youngsModulus),
					1e-8);
	}
}

TEST(Materials, HaveStrengthsInShearOfTheirOwn)
{
	// Metals by von Mises, others as their standards have them.
	const struct
	{
		const char* m_name;
		double m_strength, m_modulus;
	} cases[] = {{"S355", 355e6 / std::sqrt(3.), 210e9 / 2.6},
				 {"C30/37", 2e6, 33e9 / 2.4},
				 {"C24 along", 4e6, 0.69e9},
				 {"C24 across", 0.8e6, 0.069e9},
				 {"GJL-250", 290e6, 110e9 / 2.52},
				 {"clay brick", 0.2e6, 2e9}};
	for (const auto& c : cases)
	{
		expectClose(c.m_strength, Ready::find(c.m_name).shearYieldStress());
		expectClose(c.m_modulus, Ready::find(c.m_name).shearModulus());
		EXPECT_EQ(std::string(c.m_name) == "clay brick" ? btScalar(0.4) : btScalar(0),
				  Ready::find(c.m_name).m_friction);
	}
}

TEST(Materials, HaveRatesThatAreToBeAskedFor)
{
	int rated = 0;
	for (int i = 0; i < Ready::count(); ++i)
	{
		Ready ready = Ready::at(i);
		EXPECT_EQ(0, ready.m_material.m_rate.m_reference) << ready.m_name;
		rated += ready.m_rate.m_reference > 0;
		ready.m_material.m_rate = ready.m_rate;
		EXPECT_FALSE(ready.m_material.fault()) << ready.m_name;
	}
	// All but cast iron, timber, brick and glass.
	EXPECT_EQ(Ready::count() - 6, rated);
	// fib Model Code 2010, 5.1.11.2.1: up to 30 1/s strength under pressure grows by the power 0.014 of the rate over 30e-6 1/s.
	const btElasticPlasticRate concrete = btElasticPlasticRate::concrete();
	for (const double rate : {1e-3, 0.1, 1., 30.})
		EXPECT_NEAR(std::pow(rate / 30e-6, 0.014),
					1 + std::pow(rate / double(concrete.m_reference), 1 / double(concrete.m_exponent)), 0.035)
			<< rate;
}

TEST(Materials, YieldInShearByOneOfTwoRules)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel();
	steel.m_shearYield = btElasticPlasticShearYield(4);
	char text[128];
	steel.fault().print(text, sizeof text);
	EXPECT_STREQ("yield in shear is 4; it must be BT_EP_TRESCA or BT_EP_VON_MISES", text);
}

TEST(Materials, ThatAreNotThereAreRefused)
{
	EXPECT_STREQ("density [kg/m^3]", Ready::find("S999").fault().m_quantity);
	EXPECT_TRUE(Ready::find(nullptr).fault());
	EXPECT_STREQ(Ready::at(0).m_name, Ready::at(-1).m_name);
	EXPECT_STREQ(Ready::at(0).m_name, Ready::at(1000).m_name);
}
}  // namespace testMaterials
