// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "world/JointReading.h"

#include <cmath>

namespace ep
{
namespace
{
JointReading read(const btElasticPlasticJoint& joint)
{
	JointReading r;
	r.isThere = true;
	r.hasYielded = joint.hasYielded();
	r.isBroken = joint.isBroken();
	r.utilisation = r.isBroken ? 0 : double(joint.getUtilisation(&r.limitingDof));
	if (r.limitingDof < 0 || r.isBroken)
		r.limitingDof = 0;
	r.damage = double(joint.getDamage());
	r.elasticEnergy = r.isBroken ? 0 : joint.getElasticEnergy();
	r.plasticEnergy = joint.getPlasticEnergy();
	r.dampingEnergy = joint.getDampingEnergy();
	r.numericalEnergy = joint.getNumericalEnergy();
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		r.force[i] = r.isBroken ? 0 : double(joint.getAppliedForce(i));
		r.deformation[i] = double(joint.getPlasticDeformation(i));
		if (!r.isBroken)
			r.deformation[i] += double(joint.getElasticDeformation(i));
	}
	// It is the largest share of a broken one's ductility that tells what broke it.
	for (int i = 0; r.isBroken && i < BT_EP_DOF_COUNT; ++i)
		if (joint.getDamage(i) > joint.getDamage(r.limitingDof))
			r.limitingDof = i;
	return r;
}

JointReading read(const BulletJoint& own, const btElasticPlasticCapacity& capacity)
{
	JointReading r;
	r.isThere = true;
	r.isBroken = own.isBroken();
	r.damage = r.isBroken ? 1 : 0;
	r.plasticEnergy = own.plasticWork();
	r.hasYielded = r.plasticEnergy > 0;
	if (r.isBroken)
		return r;
	r.elasticEnergy = own.elasticEnergy();
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		r.force[i] = double(own.load(i));
		r.deformation[i] = double(own.deformation(i));
		const double used = capacity.isElasticPlastic(i) ? std::fabs(r.force[i]) / double(capacity.m_yield[i]) : 0;
		if (used > r.utilisation)
		{
			r.utilisation = used;
			r.limitingDof = i;
		}
	}
	return r;
}
}  // namespace

JointReading readJoint(const World& world, const btElasticPlasticJoint& joint)
{
	if (world.method().kind().isElasticPlastic())
		return read(joint);
	const BulletJoint* const own = world.inPlaceOf(joint);
	return own ? read(*own, joint.getCapacity()) : JointReading();
}
}  // namespace ep
