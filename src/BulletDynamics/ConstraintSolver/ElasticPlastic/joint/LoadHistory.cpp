// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "LoadHistory.h"

#include "BodyGate.h"
#include "BodyLoad.h"

namespace btElasticPlastic
{
namespace
{
/// A load changes smoothly while two successive changes differ by no more than this share of the greatest one lately.
const btScalar SMOOTH = btScalar(0.95);
/// How much of the greatest change counts after a step.
const btScalar STILL_COUNTS = btScalar(0.97);
/// How much of what has come at once counts as smooth after each step.
const btScalar BECOMES_SMOOTH = btScalar(0.1);
/// What is left of it is nothing below this share.
const btScalar SPENT = btScalar(1e-3);
/// Steps that differ by more are of other lengths: how loads have changed tells nothing about the next one.
const btScalar OTHER_LENGTH = btScalar(0.1);
}  // namespace

void LoadHistory::Part::follow(const btVector3& load)
{
	const btVector3 change = load - m_load, bend = change - m_change;
	const bool isSmooth = bend.length2() <= SMOOTH * SMOOTH * m_greatest * m_greatest;
	m_smooth += isSmooth ? change : commonOf(change, m_change);
	m_smooth += (load - m_smooth) * BECOMES_SMOOTH;
	m_greatest = btMax(change.length(), STILL_COUNTS * m_greatest);
	if (load.isZero() && m_smooth.length2() <= SPENT * SPENT * m_greatest * m_greatest)
		m_smooth.setZero();
	m_load = load;
	m_change = change;
	// What is beyond all numbers is no history.
	if (!(m_greatest < BT_LARGE_FLOAT))
		*this = Part();
}

void LoadHistory::follow(btRigidBody& body, btScalar dt)
{
	const int proxy = uidOf(body);
	if (m_body != &body || m_proxy != proxy)
		*this = LoadHistory();
	m_body = &body;
	m_proxy = proxy;
	const btVector3 force = forceBesideWeight(body), torque = body.getTotalTorque();
	if (btFabs(m_step - dt) <= OTHER_LENGTH * dt)
	{
		m_force.follow(force);
		m_torque.follow(torque);
	}
	else
	{
		m_force = m_torque = Part();
		m_force.m_load = force;
		m_torque.m_load = torque;
	}
	m_step = dt;
}
}  // namespace btElasticPlastic
