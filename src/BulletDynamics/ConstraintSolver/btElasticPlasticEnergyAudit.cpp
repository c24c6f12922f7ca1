// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticEnergyAudit.h"

#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "ElasticPlastic/audit/EnergyFlow.h"

btElasticPlasticEnergyAudit::btElasticPlasticEnergyAudit(btDynamicsWorld& world, btElasticPlasticAction& action,
														 btElasticPlasticOwnPrecision)
	: m_world(world), m_flow(new btElasticPlastic::EnergyFlow(world, action))
{
	m_world.addAction(this);
}

btElasticPlasticEnergyAudit::~btElasticPlasticEnergyAudit()
{
	m_world.removeAction(this);
	delete m_flow;
}

void btElasticPlasticEnergyAudit::begin() { m_flow->begin(); }

const btElasticPlasticEnergyBalance& btElasticPlasticEnergyAudit::getBalance() const { return m_flow->getBalance(); }

void btElasticPlasticEnergyAudit::reset() { m_flow->reset(); }

void btElasticPlasticEnergyAudit::updateAction(btCollisionWorld*, btScalar timeStep) { m_flow->end(timeStep); }
