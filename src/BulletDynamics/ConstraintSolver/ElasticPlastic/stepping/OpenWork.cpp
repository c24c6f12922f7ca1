// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "OpenWork.h"

#include "../../btElasticPlasticJoint.h"
#include "../joint/BodyGate.h"
#include "../joint/JointWorks.h"
#include "../solver/Drive.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"

namespace btElasticPlastic
{
void OpenWork::measure(const btDynamicsWorld& world, const btAlignedObjectArray<btElasticPlasticJoint*>& joints,
					   double ahead)
{
	addBodies(world);
	addDrives(world);
	addJoints(joints, ahead);
	m_share = m_mendableShare = 0;
	for (int i = 0; i < m_islands.size(); ++i)
	{
		const Island& island = m_islands[i];
		m_share = btMax(m_share, island.m_open.getShare());
		if (island.m_flows || !island.m_isDriven)
			m_mendableShare = btMax(m_mendableShare, island.m_open.getMendableShare());
	}
}

void OpenWork::addBodies(const btDynamicsWorld& world)
{
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	m_islands.resize(0);
	m_islands.resize(objects.size());
	for (int i = 0; i < objects.size(); ++i)
	{
		const btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (!body || body->getInvMass() == 0 || !body->isActive())
			continue;
		const int tag = body->getIslandTag();
		if (tag >= 0 && tag < m_islands.size())
			m_islands[tag].m_open.addBody(*body);
	}
}

void OpenWork::addDrives(const btDynamicsWorld& world)
{
	for (int i = 0; i < world.getNumConstraints(); ++i)
	{
		// What of Bullet asks for its kind and motors does not change it.
		auto& constraint = const_cast<btTypedConstraint&>(*world.getConstraint(i));
		if (!isDrive(constraint, JointWorks::from(&constraint)))
			continue;
		for (const btRigidBody* body : {&constraint.getRigidBodyA(), &constraint.getRigidBodyB()})
			if (!isHeld(*body) && body->getIslandTag() >= 0 && body->getIslandTag() < m_islands.size())
				m_islands[body->getIslandTag()].m_isDriven = true;
	}
}

void OpenWork::addJoints(const btAlignedObjectArray<btElasticPlasticJoint*>& joints, double ahead)
{
	for (int i = joints.size() - 1; i >= 0; --i)
	{
		const btElasticPlasticJoint& joint = *joints[i];
		const btRigidBody &a = joint.getConstraint().getRigidBodyA(), &b = joint.getConstraint().getRigidBodyB();
		const bool isAHeld = isHeld(a);
		const int tag = (isAHeld ? b : a).getIslandTag();
		if (tag < 0 || tag >= m_islands.size())
			continue;
		OpenShare& island = m_islands[tag].m_open;
		if (isAHeld || isHeld(b))
			island.addSupport(isAHeld ? a : b, joint.getPosition());
		const double place = double(joint.getPosition().length()) + 1, length = joint.getState().m_lastStep;
		const JointStep& step = JointWorks::of(joint).m_step;
		m_islands[tag].m_flows |= step.isAnyAtBound();
		btScalar before[BT_EP_DOF_COUNT], after[BT_EP_DOF_COUNT];
		step.getMotion(before, after);
		for (int r = 0; r < step.getNumCommittedRows(); ++r)
		{
			OpenShare::Row row;
			row.m_dof = step.getDof(r);
			row.m_before = -before[row.m_dof];
			row.m_after = -after[row.m_dof];
			row.m_force = joint.getForce(row.m_dof);
			row.m_plastic = joint.getPlasticDeformation(row.m_dof);
			row.m_path = joint.getPlasticPath(row.m_dof);
			island.addRow(joint.getCapacity(), row, length, ahead, place);
		}
	}
}
}  // namespace btElasticPlastic
