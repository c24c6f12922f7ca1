// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Materials and capacities against formulas of structural mechanics and the paper's Table IV.

#include <math.h>

#include <limits>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"
#include "support/Close.h"

namespace testCapacity
{
typedef btElasticPlasticSection Section;
typedef btElasticPlasticMaterial Material;
typedef btElasticPlasticCapacity Capacity;

TEST(Capacity, TableIV)
{
	// b wide, h high, Tresca: shear 0.5 b h fy, normal b h fy, bending 0.25 b h^2 fy and 0.25 b^2 h fy, torque 0.19 b h (b+h)/2 fy.
	const double b = 0.02, h = 0.03, fy = 200e6;
	const Capacity c = Capacity::fromMember(Material::steel(),
											Section::rectangle(btScalar(b), btScalar(h), BT_EP_TORSION_PAPER), 1, 1);
	ASSERT_FALSE(c.fault());
	expectClose(b * h * fy, c.m_yield[BT_EP_AXIAL]);
	expectClose(0.5 * b * h * fy, c.m_yield[BT_EP_SHEAR_Y]);
	expectClose(0.5 * b * h * fy, c.m_yield[BT_EP_SHEAR_Z]);
	expectClose(0.19 * b * h * (b + h) / 2 * fy, c.m_yield[BT_EP_TORSION]);
	expectClose(0.25 * b * b * h * fy, c.m_yield[BT_EP_BENDING_Y]);
	expectClose(0.25 * b * h * h * fy, c.m_yield[BT_EP_BENDING_Z]);
	// "If the von Mises yield criterion is used 0.5 is replaced by 0.58 (1/sqrt(3))."
	Material mises = Material::steel();
	mises.m_shearYield = BT_EP_VON_MISES;
	const Capacity m = Capacity::fromMember(mises, Section::rectangle(btScalar(b), btScalar(h)), 1, 1);
	expectClose(b * h * fy / sqrt(3.), m.m_yield[BT_EP_SHEAR_Y]);
	expectClose(b * h * fy, m.m_yield[BT_EP_AXIAL]);
	expectClose(0.0001 / 6 * 4 * (0.09 - 0.02) * fy / sqrt(3.), m.m_yield[BT_EP_TORSION]);
}

TEST(Capacity, PapersBlock)
{
	// 0.04 % steel on 1 m^2: 80 kN, and 53.33 MN/m over the half length of 1.5 m; the support has no length.
	const Capacity c =
		Capacity::fromMember(Material::reinforcedConcrete(btScalar(0.0004)), Section::rectangle(1, 1), 0, 3);
	expectClose(80e3, c.m_yield[BT_EP_AXIAL]);
	expectClose(200e9 * 0.0004 / 1.5, c.m_stiffness[BT_EP_AXIAL]);
	EXPECT_EQ(2000, Material::reinforcedConcrete(btScalar(0.0004)).m_density);
}

TEST(Capacity, AYieldValueNearTheLargestNumberIsRefused)
{
	// Times a deformation it would be an infinite energy.
	Capacity c;
	c.set(BT_EP_AXIAL, 1, Capacity::greatestYield());
	EXPECT_FALSE(c.fault());
	c.set(BT_EP_SHEAR_Z, 1, std::numeric_limits<btScalar>::max());
	EXPECT_STREQ("yield force [N]", c.fault().m_quantity);
	EXPECT_EQ(BT_EP_SHEAR_Z, c.fault().m_dof);
	c.clear(BT_EP_SHEAR_Z);
	c.setRigidPlastic(BT_EP_TORSION, 2 * Capacity::greatestYield());
	EXPECT_STREQ("yield moment [N m]", c.fault().m_quantity);
	c.scaleYield(btScalar(0.25));
	EXPECT_FALSE(c.fault());
}

TEST(Capacity, StiffnessOfAMember)
{
	const double E = 200e9, G = E / 2.6, l = 0.5;
	const Section s = Section::rectangle(btScalar(0.1), btScalar(0.2));
	const Capacity c = Capacity::fromMember(Material::steel(), s, btScalar(l), btScalar(l));
	expectClose(E * 0.02 / l, c.m_stiffness[BT_EP_AXIAL]);
	expectClose(G * s.m_torsionConstant / l, c.m_stiffness[BT_EP_TORSION]);
	expectClose(E * 0.2 * 1e-3 / 12 / l, c.m_stiffness[BT_EP_BENDING_Y]);
	expectClose(E * 0.1 * 8e-3 / 12 / l, c.m_stiffness[BT_EP_BENDING_Z]);
	// A beam of length l whose middle bears shear but no moment deflects by V l^3 / 12 E I, and by V l / G A_s.
	const double bends = l * l * l / (12 * E * 0.1 * 8e-3 / 12), shears = l / (G * 0.02 * 5 / 6);
	expectClose(1 / (bends + shears), c.m_stiffness[BT_EP_SHEAR_Y]);
	// The stiffness is that of the half lengths together; a part at a rigid support counts alone.
	expectClose(2 * c.m_stiffness[BT_EP_AXIAL],
				Capacity::fromMember(Material::steel(), s, btScalar(l), 0).m_stiffness[BT_EP_AXIAL]);
	expectClose(
		c.m_stiffness[BT_EP_AXIAL],
		Capacity::fromMember(Material::steel(), s, btScalar(0.25 * l), btScalar(1.75 * l)).m_stiffness[BT_EP_AXIAL]);
}

TEST(Capacity, CouplingOfAMember)
{
	const double E = 200e9, I = 0.1 * 8e-3 / 12;
	const Section s = Section::rectangle(btScalar(0.1), btScalar(0.2));
	// Half lengths of 0.2 and 0.6 m: the middle of what is elastic is 0.2 m ahead. A force of 1 N there makes no turn, and at the
	// joint it turns by 0.2 m over E I / l against what a moment would.
	const Capacity c = Capacity::fromMember(Material::steel(), s, btScalar(0.4), btScalar(1.2));
	expectClose(0.2, c.elasticMiddle(BT_EP_SHEAR_Y), byPrecision(1e-12, 1e-5));
	expectClose(0.2, c.elasticMiddle(BT_EP_SHEAR_Z), byPrecision(1e-12, 1e-5));
	btScalar force[BT_EP_DOF_COUNT] = {};
	force[BT_EP_SHEAR_Y] = 1;
	expectClose(-0.2 * 0.8 / (E * I), c.elasticDeformation(force, BT_EP_BENDING_Z), byPrecision(1e-12, 1e-5));
	force[BT_EP_BENDING_Z] = btScalar(0.2);
	EXPECT_NEAR(0, c.elasticDeformation(force, BT_EP_BENDING_Z), byPrecision(1e-12, 1e-5) * 0.2 * 0.8 / (E * I));
	// What is left of the shift is that of a beam of 0.8 m under shear without moment in its middle.
	const double bends = 0.8 * 0.8 * 0.8 / (12 * E * I), shears = 0.8 / (E / 2.6 * 0.02 * 5 / 6);
	expectClose(bends + shears, c.elasticDeformation(force, BT_EP_SHEAR_Y), byPrecision(1e-12, 1e-5));
	// The other way round, the other sign; between equal parts, none.
	const Capacity reversed = Capacity::fromMember(Material::steel(), s, btScalar(1.2), btScalar(0.4));
	for (int plane = 0; plane < 2; ++plane)
	{
		EXPECT_EQ(-c.m_coupling[plane], reversed.m_coupling[plane]);
		EXPECT_EQ(0, Capacity::fromMember(Material::steel(), s, 1, 1).m_coupling[plane]);
	}
}

TEST(Capacity, CouplingNeedsTwoSpringsAndTheBowALength)
{
	const Section s = Section::rectangle(btScalar(0.1), btScalar(0.2));
	const Capacity whole = Capacity::fromMember(Material::steel(), s, 0, 1);
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		EXPECT_EQ(dof % 3 != 0, whole.couplingCompliance(dof) != 0);
	EXPECT_EQ(whole.couplingCompliance(BT_EP_SHEAR_Z), whole.couplingCompliance(BT_EP_BENDING_Y));
	Capacity hinge = whole, rigid = whole, byHand = whole;
	hinge.clear(BT_EP_BENDING_Z);
	rigid.setRigidPlastic(BT_EP_BENDING_Z, 1);
	byHand.set(BT_EP_SHEAR_Y, 1, 1);
	for (const Capacity& c : {hinge, rigid, byHand})
	{
		EXPECT_EQ(0, c.couplingCompliance(BT_EP_SHEAR_Y));
		EXPECT_EQ(0, c.elasticMiddle(BT_EP_SHEAR_Y));
		EXPECT_EQ(whole.couplingCompliance(BT_EP_SHEAR_Z), c.couplingCompliance(BT_EP_SHEAR_Z));
		EXPECT_FALSE(c.fault());
	}
	for (const btScalar bad : {btScalar(1), btScalar(-1), btScalar(NAN)})
	{
		Capacity c = whole;
		c.m_coupling[1] = bad;
		EXPECT_TRUE(c.fault());
	}
	EXPECT_EQ(btScalar(0.5), whole.m_length);
	for (const btScalar bad : {btScalar(-1), btScalar(INFINITY), btScalar(NAN)})
	{
		Capacity c = whole;
		c.m_length = bad;
		EXPECT_TRUE(c.fault());
	}
}

TEST(Capacity, DuctilityFromStrainAndGaugeLength)
{
	Material m = Material::steel();
	m.m_ultimatePlasticStrain = btScalar(0.15);
	const Section s = Section::rectangle(btScalar(0.1), btScalar(0.2));
	const Capacity whole = Capacity::fromMember(m, s, 1, 1), hinge = Capacity::fromMember(m, s, 1, 1, btScalar(0.2));
	expectClose(0.15, whole.m_ductility[BT_EP_AXIAL]);
	expectClose(0.15 * 0.2, hinge.m_ductility[BT_EP_AXIAL]);
	// Rotation at which the outer fibre of the hinge has the ultimate strain: e g / (h/2).
	expectClose(0.15 * 0.2 / 0.1, hinge.m_ductility[BT_EP_BENDING_Z]);
	expectClose(0.15 * 0.2 / 0.05, hinge.m_ductility[BT_EP_BENDING_Y]);
	expectClose(2 * 0.15 * 0.2, hinge.m_ductility[BT_EP_SHEAR_Y]);
	expectClose(2 * 0.15 * 0.2 / 0.1, hinge.m_ductility[BT_EP_TORSION]);
}

TEST(Capacity, ByHand)
{
	Capacity c;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		EXPECT_FALSE(c.isElasticPlastic(i));
	c.set(BT_EP_BENDING_Y, 10, 2, 3);
	c.setRigidPlastic(BT_EP_AXIAL, 5);
	EXPECT_TRUE(c.isElasticPlastic(BT_EP_BENDING_Y) && !c.isRigidPlastic(BT_EP_BENDING_Y) &&
				c.isRigidPlastic(BT_EP_AXIAL));
	EXPECT_FALSE(c.fault());
	c.scaleYield(btScalar(0.5));
	EXPECT_EQ(1, c.m_yield[BT_EP_BENDING_Y]);
	c.set(BT_EP_AXIAL, 1, 1);
	EXPECT_FALSE(c.isRigidPlastic(BT_EP_AXIAL));
	c.clear(BT_EP_AXIAL);
	EXPECT_FALSE(c.isElasticPlastic(BT_EP_AXIAL));
}
}  // namespace testCapacity
