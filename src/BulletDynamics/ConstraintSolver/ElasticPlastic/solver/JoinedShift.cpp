// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JoinedShift.h"

#include "../joint/BodyLoad.h"
#include "../joint/Diagonal.h"
#include "../joint/JointWorks.h"
#include "../joint/RigidMotion.h"

namespace btElasticPlastic
{
namespace
{
/// Whether a joint that has part in the coming step had one before, of another length.
bool isChange(const JointWorks& joint, btScalar h)
{
	const JointModel& model = joint.m_model;
	const btScalar last = model.m_state.m_lastStep;
	return last > 0 && btFabs(last - h) > btScalar(0.01) * btMin(last, h) && !model.m_state.m_broken &&
		   !model.m_fault && model.m_constraint.isEnabled();
}

/// The mean force of a degree of freedom between the two times. A spring that steps resolve has that of the moment in the middle. One that
/// they do not has come to rest within the last step, so that its rate tells how loads have changed and not how it moves: that has the mean force of
/// the step, which is what has kept balance with the loads.
/// \param A     of its row, see Diagonal
/// \param time  between the two times [s]
btScalar forceBetween(const JointModel& model, int dof, btScalar A, btScalar time)
{
	const btElasticPlasticState& state = model.m_state;
	const btScalar before = (state.m_lastStep - time) / 2,
				   moment = state.m_force[dof] - before * state.m_forceRate[dof],
				   square = model.m_capacity.m_stiffness[dof] * A * btFabs(time) * before;  // of frequency times time
	return square > 1 ? state.m_applied[dof] + (moment - state.m_applied[dof]) / square : moment;
}

/// What impulses give to bodies: a share s of them gives s (first + s second) [J].
struct GivenEnergy
{
	double m_first = 0, m_second = 0;

	/// The largest share, up to 1, that gives none.
	btScalar shareWithoutGain() const
	{
		if (m_first + m_second <= 0)
			return 1;
		return m_first < 0 ? btScalar(-m_first / m_second) : btScalar(0);
	}
};

const btRigidBody& bodyOf(const JointWorks& works, int side)
{
	return side == 0 ? works.m_model.bodyA() : works.m_model.bodyB();
}
}  // namespace

bool JoinedShift::isWanted(const SolverGroup& island, btScalar h)
{
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i] && isChange(*island.m_joints[i], h))
			return true;
	return false;
}

/// The index of a body here is kept in its companion id, which Bullet does not use between two solutions.
void JoinedShift::collect(const SolverGroup& island, const std::vector<btRigidBody*>& bodies, btScalar h)
{
	m_joints.resize(0);
	m_bodies.resize(0);
	m_isAnyAtBound = false;
	const btVector3 zero(0, 0, 0);
	for (btRigidBody* body : bodies)
	{
		body->setCompanionId(m_bodies.size());
		m_bodies.push_back({body, false, 0, zero, zero, zero, zero, zero, zero, zero, zero, zero});
	}
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		btTypedConstraint& constraint = *island.m_constraints[i];
		if (!constraint.isEnabled())
			continue;
		int ends[2];
		for (int side = 0; side < 2; ++side)
		{
			const btRigidBody& body = side == 0 ? constraint.getRigidBodyA() : constraint.getRigidBodyB();
			const int index = body.isStaticOrKinematicObject() ? -1 : body.getCompanionId();
			ends[side] = index >= 0 && size_t(index) < bodies.size() && bodies[size_t(index)] == &body ? index : -1;
		}
		JointWorks* const works = island.m_joints[i];
		if (works && isChange(*works, h) && !works->hasBaseRows())
			addJoint(*works, ends, h);
		else
			for (const int end : ends)
				if (end >= 0)
					leaveOut(end);
	}
	for (btRigidBody* body : bodies)
		body->setCompanionId(-1);
}

/// What a joint's impulses give to a body by its velocities, with the sign of A's side [J].
double JoinedShift::givenTo(const Joint& joint, int side, const btVector3& velocity, const btVector3& spin)
{
	const btVector3& arm = side == 0 ? joint.m_kinematics.m_rA : joint.m_kinematics.m_rB;
	return double(joint.m_impulse.dot(velocity + spin.cross(arm))) + double(joint.m_twist.dot(spin));
}

/// The same of a body that is none of the island's.
double JoinedShift::givenToSupport(const Joint& joint, int side)
{
	const RigidMotion motion = RigidMotion::ofHeld(bodyOf(*joint.m_works, side));
	return givenTo(joint, side, motion.m_velocity, motion.m_spin);
}

void JoinedShift::addJoint(JointWorks& works, const int bodies[2], btScalar h)
{
	m_isAnyAtBound |= works.m_step.isAnyAtBound();
	const btElasticPlasticState& state = works.m_model.m_state;
	const btScalar time = (state.m_lastStep - h) / 2;
	Joint joint = {&works, {bodies[0], bodies[1]}, Kinematics(), btVector3(0, 0, 0), btVector3(0, 0, 0)};
	works.m_model.measure(joint.m_kinematics);
	const Diagonal diagonal(works.m_model.bodyA(), works.m_model.bodyB());
	for (int k = 0; k < 3; ++k)
	{
		const btVector3& axis = joint.m_kinematics.m_axis[k];
		const btScalar along = diagonal.along(joint.m_kinematics.armA(k).cross(axis),
											  joint.m_kinematics.armB(k).cross(axis)),
					   about = diagonal.about(axis);
		const btVector3 impulse = axis * (time * forceBetween(works.m_model, k, along, time));
		joint.m_impulse += impulse;
		if (k == BT_EP_AXIAL)
			joint.m_twist += joint.m_kinematics.armOfBow().cross(impulse);
		joint.m_twist += axis * (time * forceBetween(works.m_model, 3 + k, about, time));
	}
	for (int side = 0; side < 2; ++side)
	{
		const btScalar sign = side == 0 ? btScalar(1) : btScalar(-1);
		if (bodies[side] < 0)
			continue;
		Body& body = m_bodies[bodies[side]];
		const btVector3& arm = side == 0 ? joint.m_kinematics.m_rA : joint.m_kinematics.m_rB;
		const btScalar* const load = state.m_load[side];
		body.m_time = time;
		body.m_impulse += joint.m_impulse * sign;
		body.m_twist += (arm.cross(joint.m_impulse) + joint.m_twist) * sign;
		body.m_force.setValue(load[0], load[1], load[2]);
		body.m_torque.setValue(load[3], load[4], load[5]);
	}
	m_joints.push_back(joint);
}

bool JoinedShift::isAnyLeftOut() const
{
	for (int i = 0; i < m_bodies.size(); ++i)
		if (m_bodies[i].m_isLeftOut)
			return true;
	return false;
}

void JoinedShift::find(bool withLoads)
{
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& body = m_bodies[i];
		const btRigidBody& b = *body.m_body;
		const btScalar time = withLoads ? body.m_time : btScalar(0);
		body.m_force = (weightOf(b) + commonOf(body.m_force, forceBesideWeight(b))) * time;
		body.m_weight = weightOf(b) * time;
		body.m_torque = commonOf(body.m_torque, b.getTotalTorque()) * time;
		body.m_isLeftOut |= body.m_time == 0;
		if (body.m_isLeftOut)
			continue;
		body.m_linear = (body.m_impulse + body.m_force) * b.getInvMass() * b.getLinearFactor();
		body.m_angular = b.getInvInertiaTensorWorld() * (body.m_twist + body.m_torque) * b.getAngularFactor();
	}
}

double JoinedShift::getEnergy() const
{
	double twice = 0;
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		const Body& body = m_bodies[i];
		if (!body.m_isLeftOut)
			twice += double((body.m_impulse + body.m_force).dot(body.m_linear)) +
					 double((body.m_twist + body.m_torque).dot(body.m_angular));
	}
	return twice / 2;
}

void JoinedShift::apply(bool isResolved)
{
	const btScalar share = findShare(isResolved);
	if (share == 0)
	{
		for (int i = 0; i < m_bodies.size(); ++i)
			m_bodies[i].m_isLeftOut = true;
		return;
	}
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& body = m_bodies[i];
		btRigidBody& b = *body.m_body;
		body.m_meanLinear = b.getLinearVelocity() + body.m_linear * (share / 2);
		body.m_meanAngular = b.getAngularVelocity() + body.m_angular * (share / 2);
		body.m_force *= share;
		body.m_weight *= share;
		body.m_torque *= share;
		b.setLinearVelocity(b.getLinearVelocity() + body.m_linear * share);
		b.setAngularVelocity(b.getAngularVelocity() + body.m_angular * share);
	}
	bookWork(share);
	for (int i = 0; i < m_joints.size(); ++i)
		m_joints[i].m_works->m_step.setEven(isResolved && !isLeftOut(m_joints[i].m_bodies[0]) &&
											!isLeftOut(m_joints[i].m_bodies[1]));
}

/// The share of all that is given: all of it, unless forces are not resolved and the joints would give energy. Where something flows, unless they together with the loads would, too: of a structure that falls as it
/// yields loads give to what is later, and joints what is less to what is earlier, and only one of the two would add up. Nothing of what is beyond all numbers.
btScalar JoinedShift::findShare(bool isResolved) const
{
	GivenEnergy ofJoints, ofAll;
	double squares = 0;
	// What travels as one with what holds it is as it would be at rest.
	btVector3 travel(0, 0, 0);
	int numSupports = 0;
	for (int i = 0; i < m_joints.size(); ++i)
		for (int side = 0; side < 2; ++side)
		{
			const Joint& joint = m_joints[i];
			if (joint.m_bodies[side] >= 0)
				continue;
			ofJoints.m_first += (side == 0 ? 1 : -1) * givenToSupport(joint, side);
			travel += RigidMotion::ofHeld(bodyOf(*joint.m_works, side)).m_velocity;
			++numSupports;
		}
	travel /= btScalar(btMax(numSupports, 1));
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		const Body& body = m_bodies[i];
		if (body.m_isLeftOut)
			continue;
		const btVector3 &v = body.m_body->getLinearVelocity(), &w = body.m_body->getAngularVelocity();
		ofJoints.m_first += double(body.m_impulse.dot(v)) + double(body.m_twist.dot(w));
		ofJoints.m_second +=
			0.5 * (double(body.m_impulse.dot(body.m_linear)) + double(body.m_twist.dot(body.m_angular)));
		ofAll.m_first += double(body.m_force.dot(v - travel)) + double(body.m_torque.dot(w));
		squares += double(v.length2() + w.length2());
	}
	ofAll.m_first += ofJoints.m_first;
	ofAll.m_second = getEnergy();
	for (int i = 0; i < m_joints.size(); ++i)
		squares += double(m_joints[i].m_kinematics.m_rA.length2() + m_joints[i].m_kinematics.m_rB.length2());
	if (!btElasticPlasticIsFinite(ofAll.m_first + ofAll.m_second + ofJoints.m_second + squares))
		return 0;
	if (isResolved)
		return 1;
	const btScalar share = ofJoints.shareWithoutGain();
	return m_isAnyAtBound ? btMax(share, ofAll.shareWithoutGain()) : share;
}

double JoinedShift::getLoadWork(int body) const
{
	const Body& b = m_bodies[body];
	return b.m_isLeftOut ? 0 : double(b.m_force.dot(b.m_meanLinear)) + double(b.m_torque.dot(b.m_meanAngular));
}

double JoinedShift::getWeightWork(int body) const
{
	const Body& b = m_bodies[body];
	return b.m_isLeftOut ? 0 : double(b.m_weight.dot(b.m_meanLinear));
}

void JoinedShift::bookWork(btScalar share)
{
	for (int i = 0; i < m_joints.size(); ++i)
		for (int side = 0; side < 2; ++side)
		{
			const Joint& joint = m_joints[i];
			const Body* const body = joint.m_bodies[side] >= 0 ? &m_bodies[joint.m_bodies[side]] : nullptr;
			if (body && body->m_isLeftOut)
				continue;
			const double given =
				body ? givenTo(joint, side, body->m_meanLinear, body->m_meanAngular) : givenToSupport(joint, side);
			joint.m_works->m_model.m_state.m_work -= double(share) * (side == 0 ? given : -given);
		}
}
}  // namespace btElasticPlastic
