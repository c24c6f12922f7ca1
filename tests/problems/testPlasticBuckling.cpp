// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Stocky struts, which buckle as their material flows, against the tangent modulus load (Engesser, Shanley): with the slope E_t of the stress over
// the strain at the stress s itself,
//
//     s = pi^2 E_t(s) / slenderness^2.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/Run.h"
#include "world/Place.h"

namespace testPlasticBuckling
{
using namespace ep;

const double WIDTH = 0.1, HEIGHT = 0.05;  // it bends across the height [m]

/// An aluminium alloy by Ramberg and Osgood: strain = s / E + 0.002 (s / f)^n.
struct Alloy
{
	static constexpr double YOUNGS = 70e9, PROOF = 250e6, EXPONENT = 10;
	/// Shares of PROOF between which flow is told by points, with next to none below.
	static constexpr double FIRST = 0.5, LAST = 1.3;

	static double plasticStrain(double stress) { return 0.002 * std::pow(stress / PROOF, EXPONENT); }
	static double tangentModulus(double stress)
	{
		return 1 / (1 / YOUNGS + 0.002 * EXPONENT / PROOF * std::pow(stress / PROOF, EXPONENT - 1));
	}

	static btElasticPlasticMaterial material(double kinematicShare)
	{
		btElasticPlasticMaterial alloy = btElasticPlasticMaterial::steel(btScalar(FIRST * PROOF));
		alloy.m_youngsModulus = btScalar(YOUNGS);
		alloy.m_density = 2700;
		alloy.m_ultimatePlasticStrain = 1;
		alloy.m_dampingRatio = 0;  // stiffer in motion than at rest, with it
		alloy.m_kinematicShare = btScalar(kinematicShare);
		const int points = 12;
		for (int i = 1; i <= points; ++i)
		{
			const double stress = PROOF * (FIRST + (LAST - FIRST) * i / points);
			alloy.m_hardening.push_back(
				{btScalar(plasticStrain(stress) - plasticStrain(FIRST * PROOF)), btScalar(stress)});
		}
		return alloy;
	}

	static double bucklingStress(double slenderness)
	{
		double low = 0, high = 10 * PROOF;
		for (int i = 0; i < 100; ++i)
		{
			const double middle = (low + high) / 2;
			(middle < M_PI * M_PI * tangentModulus(middle) / (slenderness * slenderness) ? low : high) = middle;
		}
		return low;
	}
};

/// A strut with hinges at both ends, which a head that nothing stops presses together.
struct Strut
{
	World m_world{Solver::Direct, btVector3(0, 0, 0)};
	double m_length;
	std::vector<btRigidBody*> m_parts;
	btRigidBody* m_head;
	btElasticPlasticJoint* m_foot = nullptr;

	Strut(double slenderness, int parts, const btElasticPlasticMaterial& material)
		: m_length(slenderness * HEIGHT / std::sqrt(12.))
	{
		const btScalar l = btScalar(m_length / parts), height = btScalar(HEIGHT), width = btScalar(WIDTH);
		const btElasticPlasticSection section = btElasticPlasticSection::rectangle(width, height);
		btElasticPlasticMaterial strong = material;
		strong.m_hardening.clear();
		strong.m_yieldStress = btScalar(1e12);
		btCollisionShape *const box = m_world.box(btVector3(1, 1, 1)), *const part =
																		   m_world.box(btVector3(l, height, width));
		btRigidBody* before = m_world.body(0, box, at(btScalar(-0.5)), false);
		m_head = m_world.body(btScalar(1e7), box, at(btScalar(m_length + 0.5)), false);
		for (int i = 0; i <= parts; ++i)
		{
			const bool isLast = i == parts, isEnd = isLast || i == 0;
			if (!isLast)
				m_parts.push_back(m_world.body(material.m_density * l * height * width, part,
											   at(l * (btScalar(i) + btScalar(0.5))), false));
			btRigidBody* const next = isLast ? m_head : m_parts.back();
			btElasticPlasticJoint* const joint = m_world.joint(
				*before, *next, at(l * btScalar(i)),
				isEnd ? btElasticPlasticCapacity::fromMember(strong, section, i > 0 ? l : 0, isLast ? 0 : l)
					  : btElasticPlasticCapacity::fromMember(material, section.withFibres(), l, l));
			for (const int dof : {BT_EP_BENDING_Y, BT_EP_BENDING_Z})
				if (isEnd)
					m_world.release(*joint, dof);
			m_foot = m_foot ? m_foot : joint;
			before = next;
		}
		// The head goes along the strut only.
		btElasticPlasticCapacity slides;
		for (int dof = BT_EP_SHEAR_Y; dof < BT_EP_DOF_COUNT; ++dof)
			slides.set(dof, btScalar(1e12), btElasticPlasticCapacity::unlimited());
		btRigidBody* const guide = m_world.body(0, box, at(btScalar(m_length + 3)), false);
		m_world.release(*m_world.joint(*m_head, *guide, at(btScalar(m_length + 1)), slides), BT_EP_AXIAL);
	}

	/// \return the greatest stress at its foot while it is shortened by two thousandths a second and a force in the middle makes it crooked by
	/// a ten-thousandth of its length
	double press(double strain)
	{
		const int rate = 240;
		const double bending = Alloy::YOUNGS * WIDTH * std::pow(HEIGHT, 3) / 12,
					 force = 48 * bending * 1e-4 / (m_length * m_length), speed = 2e-3;
		double most = 0;
		for (int i = 0; i < int(strain / speed * rate); ++i)
		{
			const size_t middle = m_parts.size() / 2;
			for (const size_t part : {middle, m_parts.size() - 1 - middle})
				m_parts[part]->applyCentralForce(btVector3(0, btScalar(force / 2 * std::min(1., 10. * i / rate)), 0));
			const double share = std::max(0., std::min(1., 10. * i / rate - 1));
			m_head->setLinearVelocity(btVector3(btScalar(-speed * m_length * share), 0, 0));
			m_world.step(btScalar(1) / rate);
			most = std::max(most, -double(m_foot->getAppliedForce(BT_EP_AXIAL)) / (WIDTH * HEIGHT));
		}
		return most;
	}
};

TEST(PlasticBuckling, IsAtTheTangentModulusLoad)
{
	// Of Euler's load that is 0.30, 0.58 and 0.87. What is found is 1 to 3 % less: it is crooked by 0.3 to 0.9 mm.
	for (const double slenderness : {30., 45., 60.})
		for (const int parts : {8, 16})
			// Hardening in layers takes its time.
			for (const double kinematicShare : {0., parts == 8 ? 1. : 0.5})
			{
				if (kinematicShare == 0.5 && slenderness != 45)
					continue;
				const double exact = Alloy::bucklingStress(slenderness);
				Strut strut(slenderness, parts, Alloy::material(kinematicShare));
				EXPECT_NEAR(exact, strut.press(3 * (exact / Alloy::YOUNGS + Alloy::plasticStrain(exact))), 0.05 * exact)
					<< "slenderness " << slenderness << ", parts " << parts << ", kinematic " << kinematicShare;
			}
}

TEST(PlasticBuckling, AStrutOfOnePartCannot)
{
	const double exact = Alloy::bucklingStress(60);
	Strut strut(60, 1, Alloy::material(0));
	EXPECT_GT(strut.press(3 * (exact / Alloy::YOUNGS + Alloy::plasticStrain(exact))), 1.5 * exact);
}
}  // namespace testPlasticBuckling
