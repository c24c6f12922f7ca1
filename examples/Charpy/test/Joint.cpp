// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "test/Joint.h"

namespace ep::charpy
{
namespace
{
/// Bullet's unit of length in place of the metre. A force is kg times length, a moment kg times length squared.
btElasticPlasticCapacity inUnits(btElasticPlasticCapacity c, double lengthsPerMetre)
{
	const btScalar s = btScalar(lengthsPerMetre);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const bool linear = i < 3;
		c.m_stiffness[i] *= linear ? 1 : s * s;
		c.m_yield[i] *= linear ? s : s * s;
	}
	return c;
}

/// The material's, but tearing only by bending to the maximum rotation.
btElasticPlasticCapacity capacityOf(const Settings& s, const JointPlace& place)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(s.yieldStress));
	steel.m_youngsModulus = btScalar(s.youngsModulus);
	steel.m_dampingRatio = 0;  // as in the paper
	const btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(s.width), btScalar(place.height));
	btElasticPlasticCapacity c =
		btElasticPlasticCapacity::fromMember(steel, section, btScalar(place.pieceLength), btScalar(place.pieceLength));
	for (btScalar& ductility : c.m_ductility)
		ductility = btElasticPlasticCapacity::unlimited();
	c.m_ductility[BT_EP_BENDING_Z] = btScalar(s.maxRotation);
	// A spring of Bullet's is explicit: it bends, and all else is locked.
	if (s.way.joints == Joints::Springs)
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			if (i != BT_EP_BENDING_Z)
				c.setRigidPlastic(i, c.m_yield[i]);
	return inUnits(c, s.lengthsPerMetre);
}

}  // namespace

Joint::Joint(World& world, Energy& energy, const Settings& s, const JointPlace& p)
	: m_energy(energy),
	  m_joint(world.joint(*p.a, *p.b, p.frame, capacityOf(s, p))),
	  m_bullets(world.inPlaceOf(*m_joint))
{
	if (m_bullets)
		m_number = energy.watch(m_bullets->constraint());
}

double Joint::plasticWork() const
{
	if (!m_bullets)
		return m_joint->getPlasticEnergy();
	return m_bullets->isBrake() ? taken() : 0;
}

double Joint::numericalEnergy() const
{
	return m_bullets ? taken() - plasticWork() - elasticEnergy() : m_joint->getNumericalEnergy();
}
}  // namespace ep::charpy
