// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "structures/Beam.h"

namespace ep
{
btElasticPlasticMaterial Materials::mixed(btScalar steelShare) const
{
	btElasticPlasticMaterial m = btElasticPlasticMaterial::reinforcedConcrete(steelShare, yieldStress);
	m.m_density = concreteDensity * (1 - steelShare) + steelDensity * steelShare;
	m.m_ultimatePlasticStrain = ductility;
	m.m_dampingRatio = dampingRatio;
	return m;
}

namespace
{
btScalar massOf(const BeamSettings& s)
{
	// The box around a round bar is larger than the bar.
	const btScalar area = s.isRound ? s.section.m_area : s.height * s.width;
	return s.material.m_density * (s.length / s.blocks) * area;
}

Member::Settings memberOf(const std::string& name, const BeamSettings& s)
{
	Member::Settings member;
	member.name = name;
	member.parts = s.blocks;
	member.height = s.height;
	member.width = s.width;
	member.collides = true;
	member.partMass = massOf(s);
	member.capacityOf = [s](btScalar lengthA, btScalar lengthB)
	{
		const bool atSupport = lengthA == 0 || lengthB == 0;
		const btScalar hinge = atSupport && s.endHingeLength > 0 ? s.endHingeLength : s.hingeLength;
		return btElasticPlasticCapacity::fromMember(s.material, s.section, lengthA, lengthB, hinge);
	};
	return member;
}
}  // namespace

Beam::Beam(World& world, const std::string& name, const BeamSettings& settings, const btTransform& start)
	: Member(world, memberOf(name, settings), start, settings.length), m_settings(settings)
{
	for (btRigidBody* block : m_parts)
		block->setFriction(settings.friction);
}

btVector3 Beam::startPoint() const { return first().getCenterOfMassTransform() * btVector3(-m_partLength / 2, 0, 0); }

btVector3 Beam::endPoint() const { return last().getCenterOfMassTransform() * btVector3(m_partLength / 2, 0, 0); }

btScalar Beam::blockMass() const { return massOf(m_settings); }

btScalar Beam::bendingStiffness() const
{
	const btElasticPlasticMaterial& m = m_settings.material;
	return m.m_youngsModulus * m.m_loadBearingShare * m_settings.section.m_secondMoment[1];
}

btScalar Beam::shearStiffness() const
{
	const btElasticPlasticMaterial& m = m_settings.material;
	return m.shearModulus() * m.m_loadBearingShare * m_settings.section.m_shearArea[0];
}
}  // namespace ep
