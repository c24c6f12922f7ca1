// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "EnergyLedger.h"

#include <math.h>

#include <algorithm>

#include "BodyEnergy.h"
#include "BodyGate.h"
#include "JointWorks.h"
#include "LinearMath/btTransformUtil.h"

namespace btElasticPlastic
{
namespace
{
/// Beyond this nothing is energy.
const double MOST = 1e300;
}  // namespace

// ---- structures

void EnergyLedger::begin()
{
	m_entries.clear();
	m_bodies.clear();
	m_indices.clear();
}

int EnergyLedger::indexOf(const JointWorks& joint, int side)
{
	btRigidBody& body = side ? joint.m_model.bodyB() : joint.m_model.bodyA();
	const int place = body.getWorldArrayIndex();
	// Another action may have taken the body out of the world within the step.
	if (place < 0 || !(body.getInvMass() > 0) || isHeld(body))
		return -1;
	if (size_t(place) >= m_indices.size())
		m_indices.resize(size_t(place) + 1, -1);
	int& index = m_indices[size_t(place)];
	if (index < 0)
	{
		index = int(m_bodies.size());
		m_bodies.push_back({&body, index, btVector3(0, 0, 0), btVector3(0, 0, 0), &joint.m_step.getSpinBefore(side)});
	}
	return index;
}

int EnergyLedger::rootOf(int body)
{
	const auto parentOf = [this](int of) -> int& { return m_bodies[size_t(of)].m_parent; };
	while (parentOf(body) != body)
		body = parentOf(body) = parentOf(parentOf(body));
	return body;
}

void EnergyLedger::add(JointWorks& joint)
{
	const JointModel& model = joint.m_model;
	const int a = indexOf(joint, 0), b = indexOf(joint, 1);
	if (a < 0 && b < 0)
		return;
	m_entries.push_back({&joint, {a, b}, 0, 0, model.m_state.m_plasticEnergy, model.m_state.m_dampingEnergy});
	if (a >= 0 && b >= 0)
		m_bodies[size_t(rootOf(b))].m_parent = rootOf(a);
}

void EnergyLedger::sortByStructure()
{
	for (Entry& entry : m_entries)
		entry.m_structure = rootOf(entry.m_bodies[0] >= 0 ? entry.m_bodies[0] : entry.m_bodies[1]);
	std::stable_sort(m_entries.begin(), m_entries.end(),
					 [](const Entry& a, const Entry& b) { return a.m_structure < b.m_structure; });
	m_accounts.clear();
	for (size_t i = 0; i < m_entries.size(); ++i)
		if (i > 0 && m_entries[i].m_structure == m_entries[i - 1].m_structure)
			++m_accounts.back().m_end;
		else
			m_accounts.push_back({i, i + 1, 0});
}

// ---- before joints end their steps

void EnergyLedger::limit()
{
	sortByStructure();
	for (Account& account : m_accounts)
		limit(account);
}

void EnergyLedger::limit(Account& account)
{
	double given = 0, givers = 0, loan = 0;
	for (size_t i = account.m_first; i < account.m_end; ++i)
	{
		Entry& entry = m_entries[i];
		const JointStep& step = entry.m_joint->m_step;
		entry.m_given = step.measureWork();
		given += entry.m_given;
		givers += fmax(entry.m_given, 0);
		account.m_balance += step.getStored();
		loan += step.getLoan();
	}
	account.m_balance -= fmax(findWorkOfTurning(account), 0);
	const double most = fmax(account.m_balance + loan, 0);
	// A step that is not finite is the joints' own to refuse.
	if (given > most && given < MOST)
	{
		findParts(account);
		calm(account, given - most);
		move(m_entries[account.m_first].m_joint->m_step.getTimeStep());
		// Those that have given give back.
		for (size_t i = account.m_first; i < account.m_end; ++i)
			m_entries[i].m_given -= fmax(m_entries[i].m_given, 0) / givers * (given - most);
		given = most;
	}
	for (size_t i = account.m_first; i < account.m_end; ++i)
		m_entries[i].m_joint->m_step.setWork(m_entries[i].m_given);
	account.m_balance -= given;
}

/// Bodies that move, each once, where they were when the impulses came.
void EnergyLedger::findParts(const Account& account)
{
	const btScalar dt = m_entries[account.m_first].m_joint->m_step.getTimeStep();
	m_parts.clear();
	m_partBodies.clear();
	for (size_t i = account.m_first; i < account.m_end; ++i)
		for (const int body : m_entries[i].m_bodies)
			if (body >= 0)
				m_partBodies.push_back(body);
	std::sort(m_partBodies.begin(), m_partBodies.end());
	m_partBodies.erase(std::unique(m_partBodies.begin(), m_partBodies.end()), m_partBodies.end());
	for (const int i : m_partBodies)
	{
		const btRigidBody& body = *m_bodies[size_t(i)].m_body;
		RigidMotion::Part part = {&body, btTransform(), body.getInterpolationLinearVelocity(),
								  body.getInterpolationAngularVelocity()};
		btTransformUtil::integrateTransform(body.getCenterOfMassTransform(), -part.m_velocity, -part.m_spin, dt,
											part.m_pose);
		m_parts.push_back(part);
	}
}

/// What Bullet's gyroscopic torques have given the structure: none to a body that is free, but they work on what joints have changed of
/// its spin.
double EnergyLedger::findWorkOfTurning(const Account& account)
{
	const btScalar dt = m_entries[account.m_first].m_joint->m_step.getTimeStep();
	// Of what turns by less than a thousandth of a radian in the step it is next to nothing.
	const auto turns = [&](int i)
	{
		const int gyroscopic = BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
		return i >= 0 && m_bodies[size_t(i)].m_body->getFlags() & gyroscopic &&
			   m_bodies[size_t(i)].m_spinBefore->length2() * dt * dt > btScalar(1e-6);
	};
	const auto isAny = [&](const Entry& entry) { return turns(entry.m_bodies[0]) || turns(entry.m_bodies[1]); };
	const auto first = m_entries.begin();
	if (std::none_of(first + int(account.m_first), first + int(account.m_end), isAny))
		return 0;
	findParts(account);
	double work = 0;
	for (size_t i = 0; i < m_parts.size(); ++i)
	{
		if (!turns(m_partBodies[i]))
			continue;
		const RigidMotion::Part& part = m_parts[i];
		btRigidBody& body = *m_bodies[size_t(m_partBodies[i])].m_body;
		const btVector3& before = *m_bodies[size_t(m_partBodies[i])].m_spinBefore;
		// Bullet tells the torque of a body as it is.
		const btTransform place = body.getWorldTransform();
		const btVector3 spin = body.getAngularVelocity();
		body.setWorldTransform(part.m_pose);
		body.setAngularVelocity(before);
		work += energyOfTurning(body, part.m_velocity, before, part.m_spin, part.m_pose.getBasis(), dt);
		body.setWorldTransform(place);
		body.setAngularVelocity(spin);
	}
	return work;
}

/// The motion that joints leave alone: that of what the structure is joined to, or its own as one.
RigidMotion EnergyLedger::findReference(const Account& account) const
{
	for (size_t i = account.m_first; i < account.m_end; ++i)
	{
		const JointModel& model = m_entries[i].m_joint->m_model;
		for (const btRigidBody* body : {&model.bodyA(), &model.bodyB()})
			if (isHeld(*body))
				return RigidMotion::ofHeld(*body);
	}
	return RigidMotion::of(m_parts.data(), int(m_parts.size()));
}

/// Slows all motion w beside the reference to (1 - x) w, with the x by which the joints have given less by an amount,
///
///     x sum w M w - x^2 / 2 sum w M w = beyond + x dt / 2 sum F w.
///
/// The last term is the work of the loads F on the places, which are moved by the velocities at the step's end.
void EnergyLedger::calm(const Account& account, double beyond)
{
	const RigidMotion reference = findReference(account);
	const btScalar halfStep = m_entries[account.m_first].m_joint->m_step.getTimeStep() / 2;
	double twice = 0, loads = 0;
	for (size_t i = 0; i < m_parts.size(); ++i)
	{
		const RigidMotion::Part& part = m_parts[i];
		const btRigidBody& body = *part.m_body;
		Body& change = m_bodies[size_t(m_partBodies[i])];
		change.m_linear = (part.m_velocity - reference.at(part.m_pose.getOrigin())) * body.getLinearFactor();
		change.m_angular = (part.m_spin - reference.m_spin) * body.getAngularFactor();
		twice += double(change.m_linear.length2() / body.getInvMass()) +
				 double(part.angularMomentum(change.m_angular).dot(change.m_angular));
		loads += double(body.getTotalForce().dot(change.m_linear) * halfStep) +
				 double(body.getTotalTorque().dot(change.m_angular) * halfStep);
	}
	const double along = twice - loads, root = sqrt(fmax(along * along - 2 * twice * beyond, 0));
	// The smaller solution, in a form that loses no digits. Of impulses without measure none are left in what remains: it stops.
	const double share = 2 * beyond / (along + root);
	const btScalar less = share > 0 && share < 1 - 64 * double(SIMD_EPSILON) ? btScalar(-share) : btScalar(-1);
	for (const int i : m_partBodies)
	{
		m_bodies[size_t(i)].m_linear *= less;
		m_bodies[size_t(i)].m_angular *= less;
	}
}

/// Bullet has moved the bodies by the velocities that change now. Turned anew from where it was, a body's kinetic energy is what it was
/// counted for. What turns by less than a basis is rounded by stays as it is: rounded back and forth in each step it would turn by that.
void EnergyLedger::move(btScalar dt)
{
	for (size_t i = 0; i < m_parts.size(); ++i)
	{
		const RigidMotion::Part& part = m_parts[i];
		const Body& change = m_bodies[size_t(m_partBodies[i])];
		btRigidBody& body = *change.m_body;
		const btVector3 linear = part.m_velocity + change.m_linear, angular = part.m_spin + change.m_angular;
		btTransform place = body.getCenterOfMassTransform();
		if (change.m_angular.length() * dt > SIMD_EPSILON / 2)
			btTransformUtil::integrateTransform(part.m_pose, linear, angular, dt, place);
		place.setOrigin(body.getCenterOfMassPosition() + change.m_linear * dt);
		body.setLinearVelocity(body.getLinearVelocity() + change.m_linear);
		body.setAngularVelocity(body.getAngularVelocity() + change.m_angular);
		body.setCenterOfMassTransform(place);
		body.setInterpolationLinearVelocity(linear);
		body.setInterpolationAngularVelocity(angular);
	}
}

// ---- after joints have ended their steps

void EnergyLedger::book()
{
	for (Account& account : m_accounts)
	{
		limitDissipation(account);
		book(account);
	}
	m_accounts.clear();
}

/// Counts as dissipated what the joints have had for it, and a half of what flows on: places are moved by the velocity at the step's end,
/// and the second half of that work is still to be given.
void EnergyLedger::limitDissipation(Account& account)
{
	double sum = 0, ahead = 0;
	for (size_t i = account.m_first; i < account.m_end; ++i)
	{
		const btElasticPlasticState& state = m_entries[i].m_joint->m_model.m_state;
		const double own =
			state.m_plasticEnergy - m_entries[i].m_plastic + state.m_dampingEnergy - m_entries[i].m_damping;
		sum += own;
		ahead += state.m_broken ? 0 : own / 2;
	}
	const double paid = fmax(account.m_balance, 0), share = sum - ahead > paid ? paid / (sum - ahead) : 1;
	for (size_t i = account.m_first; i < account.m_end && share < 1; ++i)
	{
		btElasticPlasticState& state = m_entries[i].m_joint->m_model.m_state;
		state.m_plasticEnergy -= (1 - share) * (state.m_plasticEnergy - m_entries[i].m_plastic);
		state.m_dampingEnergy -= (1 - share) * (state.m_dampingEnergy - m_entries[i].m_damping);
	}
	account.m_balance -= share * sum;
}

void EnergyLedger::book(Account& account)
{
	double springs = 0, ahead = 0, dissipation = 0;
	for (size_t i = account.m_first; i < account.m_end; ++i)
	{
		const btElasticPlasticState& state = m_entries[i].m_joint->m_model.m_state;
		springs += m_entries[i].m_joint->m_model.springEnergy();
		dissipation += state.m_plasticEnergy + state.m_dampingEnergy;
		ahead += m_entries[i].m_joint->m_step.getHalfStep();
	}
	// What bodies still owe is no part of what joints tell, of those that break now for ever.
	const double owed = dissipation > 0 ? fmin(fmax(-account.m_balance, 0) / dissipation, 1) : 0;
	// What is there beyond what springs hold has been dissipated by the integration.
	account.m_balance = fmax(fmin(fmin(account.m_balance, springs + ahead), MOST), -MOST);
	for (size_t i = account.m_first; i < account.m_end; ++i)
	{
		JointWorks& joint = *m_entries[i].m_joint;
		const double share =
			springs > 0 ? joint.m_model.springEnergy() / springs : 1 / double(account.m_end - account.m_first);
		btElasticPlasticState& state = joint.m_model.m_state;
		state.m_storedEnergy =
			share * (account.m_balance + owed * dissipation) - owed * (state.m_plasticEnergy + state.m_dampingEnergy);
		joint.m_step.rememberPlace();
	}
}
}  // namespace btElasticPlastic
