// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/Strut.h"

#include <cmath>

#include "world/Place.h"

namespace ep
{
namespace
{
const double PI = 3.14159265358979323846;
const double WIDTH = 0.1, HEIGHT = 0.05;  // it bends across the height [m]
const double YOUNGS = 70e9, PROOF = 250e6, EXPONENT = 10;
/// Shares of PROOF between which flow is told by points, with next to none below.
const double FIRST = 0.5, LAST = 1.3;
const int POINTS = 12;
/// Of what pushes, so that it does not slow down [kg].
const double HEAD = 1e12;
}  // namespace

double Strut::Alloy::plasticStrain(double stress) { return 0.002 * std::pow(stress / PROOF, EXPONENT); }

double Strut::Alloy::strain(double stress) { return stress / YOUNGS + plasticStrain(stress); }

double Strut::Alloy::tangentModulus(double stress)
{
	return 1 / (1 / YOUNGS + 0.002 * EXPONENT / PROOF * std::pow(stress / PROOF, EXPONENT - 1));
}

double Strut::Alloy::bucklingStress(double slenderness)
{
	double low = 0, high = 10 * PROOF;
	for (int i = 0; i < 100; ++i)
	{
		const double middle = (low + high) / 2;
		(middle < PI * PI * tangentModulus(middle) / (slenderness * slenderness) ? low : high) = middle;
	}
	return low;
}

btElasticPlasticMaterial Strut::Alloy::material(double kinematicShare)
{
	btElasticPlasticMaterial alloy = btElasticPlasticMaterial::steel(btScalar(FIRST * PROOF));
	alloy.m_youngsModulus = btScalar(YOUNGS);
	alloy.m_density = 2700;
	alloy.m_ultimatePlasticStrain = 1;
	alloy.m_dampingRatio = 0;  // stiffer in motion than at rest, with it
	alloy.m_kinematicShare = btScalar(kinematicShare);
	for (int i = 1; i <= POINTS; ++i)
	{
		const double stress = PROOF * (FIRST + (LAST - FIRST) * i / POINTS);
		alloy.m_hardening.push_back({btScalar(plasticStrain(stress) - plasticStrain(FIRST * PROOF)), btScalar(stress)});
	}
	return alloy;
}

Strut::Strut(const Method& method, double slenderness, int parts, const btElasticPlasticMaterial& material, int fibres)
	: m_world(method, btVector3(0, 0, 0)), m_length(slenderness * HEIGHT / std::sqrt(12.))
{
	const btScalar l = btScalar(m_length / parts), height = btScalar(HEIGHT), width = btScalar(WIDTH);
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(width, height);
	btElasticPlasticMaterial strong = material;
	strong.m_hardening.clear();
	strong.m_yieldStress = btScalar(1e12);
	btCollisionShape *const box = m_world.box(btVector3(width, width, width)), *const part = m_world.box(
																				   btVector3(l, height, width));
	// The head is where float resolves its slow way best.
	const btScalar end = -width / 2, begin = end - btScalar(m_length);
	btRigidBody* before = m_world.body(0, box, at(begin - width / 2), false);
	btRigidBody* const head = m_world.body(btScalar(HEAD), box, at(0), false);
	head->setLinearVelocity(btVector3(btScalar(-SHORTENING * m_length), 0, 0));
	for (int i = 0; i <= parts; ++i)
	{
		const bool isLast = i == parts, isEnd = isLast || i == 0;
		if (!isLast)
			m_parts.push_back(m_world.body(material.m_density * l * height * width, part,
										   at(begin + l * (btScalar(i) + btScalar(0.5))), false));
		btRigidBody* const next = isLast ? head : m_parts.back();
		btElasticPlasticJoint* const joint =
			m_world.joint(*before, *next, at(begin + l * btScalar(i)),
						  isEnd ? btElasticPlasticCapacity::fromMember(strong, section, i > 0 ? l : 0, isLast ? 0 : l)
								: btElasticPlasticCapacity::fromMember(material, section.withFibres(fibres), l, l));
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
	btRigidBody* const guide = m_world.body(0, box, at(3 * width), false);
	m_world.release(*m_world.joint(*head, *guide, at(width), slides), BT_EP_AXIAL);
}

void Strut::push(double share)
{
	const double bending = YOUNGS * WIDTH * std::pow(HEIGHT, 3) / 12,
				 force = share * 48 * bending * 1e-4 / (m_length * m_length);
	const size_t middle = m_parts.size() / 2;
	for (const size_t part : {middle, m_parts.size() - 1 - middle})
		m_parts[part]->applyCentralForce(btVector3(0, btScalar(force / 2), 0));
}

double Strut::pressureAtFoot() const { return -double(m_foot->getAppliedForce(BT_EP_AXIAL)) / (WIDTH * HEIGHT); }
}  // namespace ep
