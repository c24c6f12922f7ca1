// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BODY_ENERGY_H
#define BT_ELASTIC_PLASTIC_BODY_ENERGY_H

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
/// The kinetic energy that a body would have with an orientation and velocities [J].
inline double kineticEnergy(const btRigidBody& body, const btMatrix3x3& basis, const btVector3& linear,
							const btVector3& angular)
{
	if (body.getInvMass() == 0)
		return 0;
	double energy = 0;
	for (int i = 0; i < 3; ++i)
	{
		const double inverse = body.getInvInertiaDiagLocal()[i];
		const btVector3 axis = basis.getColumn(i);
		const double spin =
			double(axis.x()) * angular.x() + double(axis.y()) * angular.y() + double(axis.z()) * angular.z();
		energy += double(linear[i]) * linear[i] / double(body.getInvMass()) + (inverse > 0 ? spin * spin / inverse : 0);
	}
	return energy / 2;
}

/// How a step of Bullet's changes a body's kinetic energy by its turn [J]: by the gyroscopic torque that its flags ask for (but the explicit
/// one), and as the body keeps its angular velocity while its inertia turns.
/// \param before  angular velocity with which the solver began, which the body has now, as it has the basis of that time
inline double energyOfTurning(const btRigidBody& body, const btVector3& linear, const btVector3& before,
							  const btVector3& after, const btMatrix3x3& basisAfter, btScalar dt)
{
	const btMatrix3x3& basis = body.getWorldTransform().getBasis();
	double energy = kineticEnergy(body, basisAfter, linear, after) - kineticEnergy(body, basis, linear, after);
	btVector3 change(0, 0, 0);  // of angular velocity
	if (body.getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD)
		change += body.computeGyroscopicImpulseImplicit_World(dt);
	if (body.getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY)
		change += body.computeGyroscopicImpulseImplicit_Body(dt);
	const btVector3 mean = (before + after) / 2;
	for (int i = 0; i < 3; ++i)
		if (body.getInvInertiaDiagLocal()[i] > 0)
			energy += double(change.dot(basis.getColumn(i))) * double(mean.dot(basis.getColumn(i))) /
					  double(body.getInvInertiaDiagLocal()[i]);
	return energy;
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BODY_ENERGY_H
