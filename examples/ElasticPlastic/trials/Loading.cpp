// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "trials/Loading.h"

#include <algorithm>
#include <cmath>

#include "trials/TrialRun.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace ep
{
namespace
{
const double FRAME = 1. / 60;

/// Three cubes of 100 kg in a row on a support, without weight.
struct Row
{
	World m_world;
	double m_strength;  ///< [N]
	btRigidBody* m_bodies[4];
	btElasticPlasticJoint* m_joints[3];

	Row(const TrialSetup& setup, double stiffness, double strength)
		: m_world(setup.method, btVector3(0, 0, 0)), m_strength(strength)
	{
		btElasticPlasticCapacity capacity = evenCapacity(stiffness, strength);
		capacity.m_damping = btScalar(0.1);
		btCollisionShape* cube = m_world.box(btVector3(1, 1, 1));
		for (int i = 0; i < 4; ++i)
			m_bodies[i] = m_world.body(i == 0 ? btScalar(0) : btScalar(100), cube, at(i), false);
		for (int i = 0; i < 3; ++i)
			m_joints[i] = m_world.joint(*m_bodies[i], *m_bodies[i + 1], at(i + 0.5), capacity);
	}

	double flow() const
	{
		double path = 0;
		for (const btElasticPlasticJoint* joint : m_joints)
			for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
				path += double(joint->getPlasticPath(dof));
		return path;
	}

	/// What joints have given beyond what they have taken, above a hundredth of what they hold at yield, over that.
	double created() const
	{
		double numerical = 0, held = 0;
		for (const btElasticPlasticJoint* joint : m_joints)
		{
			numerical -= joint->getNumericalEnergy();
			held += m_strength * m_strength / 2 / double(joint->getCapacity().m_stiffness[0]);
		}
		return std::max(0., numerical / held - 0.01);
	}
};

/// A pull that comes on in a second to nine tenths of what the joints bear, by an impulse before each step.
Verdict impulses(const TrialSetup& setup)
{
	const double strength = 2000;
	Row row(setup, 1e6, strength);
	Verdict verdict;
	for (int i = 0; i < 300; ++i)
	{
		setup.look(row.m_world, i * FRAME);
		const double pull = 0.9 * strength * std::min(1., i * FRAME);
		row.m_bodies[3]->applyCentralImpulse(btVector3(btScalar(pull * FRAME), 0, 0));
		row.m_world.step(btScalar(FRAME));
		verdict.isFinite &= std::isfinite(row.m_world.kineticEnergy());
	}
	verdict.created = row.created();
	verdict.value = double(row.m_joints[0]->getForce(BT_EP_AXIAL)) + 1e6 * row.flow();
	verdict.exact = 0.9 * strength;
	verdict.slack = 0.01 * verdict.exact;
	return verdict;
}

/// A support that is moved once for four substeps, and comes to half a metre a second: the row follows without flow.
Verdict movedOnce(const TrialSetup& setup)
{
	Row row(setup, 1e8, 2e4);
	row.m_bodies[0]->setCollisionFlags(row.m_bodies[0]->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
	Verdict verdict;
	double place = 0;
	for (int i = 0; i < 120; ++i)
	{
		setup.look(row.m_world, i * FRAME);
		place += 0.5 * std::min(1., i * FRAME) * FRAME;
		row.m_bodies[0]->setWorldTransform(at(0, place));
		row.m_world.bullet().stepSimulation(btScalar(FRAME * (1 + 1e-6)), 4, btScalar(FRAME / 4));
		verdict.isFinite &= std::isfinite(row.m_world.kineticEnergy());
	}
	verdict.created = row.created();
	verdict.value = double(row.m_bodies[3]->getCenterOfMassPosition().y()) - place + row.flow();
	verdict.exact = 0;
	verdict.slack = 1e-4;
	return verdict;
}

/// A static support that has been given a velocity stands: the row stays.
Verdict standing(const TrialSetup& setup)
{
	Row row(setup, 1e6, 2000);
	row.m_bodies[0]->setLinearVelocity(btVector3(5, -3, 2));
	row.m_bodies[0]->setAngularVelocity(btVector3(1, 2, 3));
	TrialRun run(row.m_world, setup);
	run.runFor(2, FRAME);
	return run.verdict(double(row.m_bodies[3]->getCenterOfMassPosition().distance(btVector3(3, 0, 0))) + row.flow(), 0,
					   2e-3 * double(SIMD_EPSILON) / 1.2e-7);
}
}  // namespace

std::vector<Trial> trialsOfLoading()
{
	return {{"loads", "an impulse in each step", impulses},
			{"partners", "kinematic, once for four substeps", movedOnce},
			{"partners", "static, with a velocity", standing}};
}
}  // namespace ep
