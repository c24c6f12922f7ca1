// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "OpenShare.h"

#include <math.h>

#include "JoinedVelocity.h"

namespace btElasticPlastic
{
namespace
{
/// Of the yield value. From 0.15 to 0.4 no problem's result changes; with 0.5 a mass that is dropped on a beam is measured too late.
const double LOADED_SHARE = 0.4;
/// A flow that takes more steps than this to come to rest is right within the error that is allowed by default.
const double MOST_STEPS_TO_REST = 25;
}  // namespace

double OpenShare::getEnergy() const
{
	// Joints cannot dissipate the motion of an island as a whole if nothing holds it.
	double carried = m_carried;
	for (int k = 0; k < 3 && !m_isHeld; ++k)
		carried += 0.5 * m_momentum[k] * m_momentum[k] / m_mass;
	return btMax(m_energy - carried, m_openWork);
}

void OpenShare::addBody(const btRigidBody& body)
{
	const double mass = 1 / double(body.getInvMass());
	const btVector3& v = body.getLinearVelocity();
	const btVector3 spin = body.getAngularVelocity() * body.getCenterOfMassTransform().getBasis();
	m_mass += mass;
	for (int k = 0; k < 3; ++k)
	{
		m_momentum[k] += mass * double(v[k]);
		m_energy += 0.5 * mass * double(v[k]) * double(v[k]);
		if (body.getInvInertiaDiagLocal()[k] > 0)
			m_energy += 0.5 * double(spin[k]) * double(spin[k]) / double(body.getInvInertiaDiagLocal()[k]);
	}
}

/// An island that moves with its support has so much less kinetic energy that joints can dissipate. Of several supports the one
/// counts that leaves the least.
void OpenShare::addSupport(const btRigidBody& support, const btVector3& place)
{
	const btVector3 v = velocityAt(support, place - support.getCenterOfMassPosition());
	double carried = 0;
	for (int k = 0; k < 3; ++k)
		carried += double(v[k]) * (m_momentum[k] - 0.5 * m_mass * double(v[k]));
	m_carried = m_isHeld ? btMax(m_carried, carried) : carried;
	m_isHeld = true;
}

bool OpenShare::isClear(const btElasticPlasticCapacity& capacity, const Motion& motion, btScalar length, btScalar ahead)
{
	// As addRow() for all rows at once, with the stiffness of those that are coupled for all. A little less, for rounding.
	const btScalar coupling = btMax(btFabs(capacity.m_coupling[0]), btFabs(capacity.m_coupling[1])),
				   time = ahead / (1 - coupling * coupling), gain = ahead / (2 * length),
				   share = btScalar(0.99 * LOADED_SHARE);
	btScalar path = 0;
	int numNear = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const btScalar reached =
			btFabs(motion.m_force[i]) +
			capacity.m_stiffness[i] * time *
				(btFabs(motion.m_after[i]) + gain * btFabs(motion.m_after[i] - motion.m_before[i]));
		path += motion.m_path[i];
		numNear += !(reached <= share * capacity.m_yield[i]);
	}
	return numNear == 0 && path == 0;
}

double OpenShare::stepsLikeThis(const Row& row)
{
	const double before = fabs(double(row.m_before)), change = fabs(double(row.m_after - row.m_before));
	const bool slows = double(row.m_after) * double(row.m_before) >= 0 && fabs(double(row.m_after)) < before;
	if (!row.m_flows || !slows)
		return 1;
	return btMax(1., btMin(before / change, MOST_STEPS_TO_REST) / 2);
}

void OpenShare::addRow(const btElasticPlasticCapacity& capacity, const Row& row, double length, double ahead,
					   double place)
{
	const int dof = row.m_dof;
	const double yield = capacity.m_yield[dof], change = fabs(double(row.m_after - row.m_before));
	// A rigid-plastic row that has not flowed leaves nothing open, and has no energy with which to compare the solver's rounding.
	if (capacity.isRigidPlastic(dof) && row.m_path == 0)
		return;
	if (!capacity.isRigidPlastic(dof))
	{
		const double stiffness = capacity.m_stiffness[dof];
		// The force that may be reached within a step: a row whose force stays below half of its yield value is not near yield.
		// A coupled row is stiffer while its partner keeps still.
		const double coupling = double(capacity.relativeCoupling(dof)), own = stiffness / (1 - coupling * coupling);
		const auto reached = [&](double time)
		{ return fabs(double(row.m_force)) + own * time * (fabs(double(row.m_after)) + change * time / (2 * length)); };
		const bool isNear = reached(ahead) >= yield / 2;
		m_isLoaded = m_isLoaded || reached(length) >= LOADED_SHARE * yield;
		if (row.m_path == 0 && !isNear)
			return;
		m_energy += 0.5 * yield * yield / stiffness + yield * fabs(double(row.m_plastic));
		if (m_canGoBack && !isNear)
			return;
		m_yieldEnergy += 0.5 * yield * yield / stiffness;
	}
	else
	{
		m_isLoaded = true;
		m_energy += yield * fabs(double(row.m_plastic));
	}
	m_openWork += yield * length * change * stepsLikeThis(row);
	m_power += yield * fmax(fabs(double(row.m_before)), fabs(double(row.m_after)));
	const double rounding = 4 * double(SIMD_EPSILON) * (dof < 3 ? place : 1.);
	m_roundedWork += yield * btMin(length * change, rounding);
}
}  // namespace btElasticPlastic
