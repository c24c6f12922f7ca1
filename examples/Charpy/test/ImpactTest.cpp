// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "test/ImpactTest.h"

#include <cmath>
#include <stdexcept>

namespace ep::charpy
{
namespace
{
const Settings& checked(const Settings& settings)
{
	const std::string fault = settings.fault();
	if (!fault.empty())
		throw std::invalid_argument(fault);
	return settings;
}
}  // namespace

const char* nameOf(Outcome outcome)
{
	static const char* const names[] = {"swinging", "missed", "passed", "bounced", "stuck", "slipped"};
	return names[int(outcome)];
}

double Result::auditError() const
{
	const double explained =
		plasticWork + elasticEnergy + specimenEnergy + frictionWork + contactWork + numericalDissipation;
	return loss() != 0 ? (loss() - explained) / loss() : 0;
}

ImpactTest::ImpactTest(const Settings& settings)
	: m_settings(checked(settings)),
	  m_world(Method(settings.solver, settings.way, settings.iterations),
			  btVector3(0, btScalar(-settings.gravity * settings.lengthsPerMetre), 0)),
	  m_parts(m_world, settings),
	  m_energy(m_world),
	  m_perJoule(settings.lengthsPerMetre * settings.lengthsPerMetre)
{
	btContactSolverInfo& info = m_world.bullet().getSolverInfo();
	if (settings.preciseContacts)
	{
		// All penetration is taken back by Bullet's split impulse, which moves bodies without giving them velocity.
		info.m_splitImpulsePenetrationThreshold = 0;
		info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
		info.m_restitutionVelocityThreshold *= btScalar(settings.lengthsPerMetre);
		// A rigid specimen between hammer and anvils, 450 times lighter than the hammer, takes as many iterations, and more:
		// until no velocity changes by more than 2 um/s.
		if (settings.way == kinds::Rigid)
		{
			info.m_numIterations = btMax(settings.iterations, 5000);
			info.m_leastSquaresResidualThreshold = btScalar(4e-12 * m_perJoule);
		}
	}
	m_energy.watch(*m_parts.bearing);
	join();
	for (const btRigidBody* piece : m_parts.pieces)
		m_seat.push_back(piece->getWorldTransform());
	m_hammerLevel = settings.hammerMass * settings.gravity * settings.lengthsPerMetre * settings.lengthsPerMetre *
					double((hammerAxis(settings) + hammerCentre(settings)).y());
	m_result.plasticMoment = settings.plasticMoment();
	m_result.passingAngle = settings.passingAngle();
}

void ImpactTest::join()
{
	const int n = int(m_parts.pieces.size());
	for (int i = 0; i + 1 < n; ++i)
	{
		const bool notched = i + 1 == n / 2;
		JointPlace place;
		place.a = m_parts.pieces[size_t(i)];
		place.b = m_parts.pieces[size_t(i) + 1];
		place.height = m_settings.height - (notched ? m_settings.notch : 0);
		place.pieceLength = m_settings.length / n;
		const double toAnvils = notched ? m_settings.hingeHeight() : m_settings.height / 2;
		// x along the specimen, y along the blow, z up.
		place.frame.setBasis(btMatrix3x3(0, 1, 0, 0, 0, 1, 1, 0, 0));
		place.frame.setOrigin(btVector3(btScalar(-toAnvils), 0, btScalar(m_settings.length * ((i + 1.) / n - 0.5))) *
							  btScalar(m_settings.lengthsPerMetre));
		m_joints.emplace_back(m_world, m_energy, m_settings, place);
	}
}

double ImpactTest::angle() const
{
	const btVector3 x = m_parts.hammer->getWorldTransform().getBasis().getColumn(0);
	return std::atan2(double(x.y()), double(x.x()));
}

double ImpactTest::angularSpeed() const { return double(m_parts.hammer->getAngularVelocity().z()); }

double ImpactTest::stepAt(double angle) const
{
	const double a = std::fabs(angle), inner = m_settings.impactAngle, outer = m_settings.swingAngle;
	if (a >= outer)
		return m_settings.swingStep;
	if (a <= inner)
		return m_settings.step;
	return m_settings.step + (m_settings.swingStep - m_settings.step) * (a - inner) / (outer - inner);
}

double ImpactTest::bendRate() const
{
	const size_t n = m_parts.pieces.size();
	if (n < 2)
		return 0;
	return double(
		(m_parts.pieces[n / 2]->getAngularVelocity() - m_parts.pieces[n / 2 - 1]->getAngularVelocity()).length());
}

const Joint* ImpactTest::notch() const { return m_joints.empty() ? nullptr : &m_joints[m_joints.size() / 2]; }

/// In its seat: what an explicit spring makes of rounding in a step that it cannot be computed with is no part of the test.
void ImpactTest::hold()
{
	for (size_t i = 0; i < m_seat.size(); ++i)
	{
		btRigidBody& piece = *m_parts.pieces[i];
		piece.setWorldTransform(m_seat[i]);
		piece.setLinearVelocity(btVector3(0, 0, 0));
		piece.setAngularVelocity(btVector3(0, 0, 0));
	}
}

void ImpactTest::followBend()
{
	if (!notch() || notch()->isBroken())
		return;
	const size_t n = m_parts.pieces.size();
	const btMatrix3x3 &a = m_parts.pieces[n / 2 - 1]->getWorldTransform().getBasis(),
					  &b = m_parts.pieces[n / 2]->getWorldTransform().getBasis();
	const double now =
		std::atan2(double(b.getColumn(2).dot(a.getColumn(0))), double(b.getColumn(2).dot(a.getColumn(2))));
	m_bend += std::remainder(now - m_bend, 2 * M_PI);
	m_result.greatestAngle = btMax(m_result.greatestAngle, std::fabs(m_bend));
}

int ImpactTest::substepsIn(double dt) const
{
	const auto whole = [](double parts) { return int(std::ceil(parts - 1e-9)); };
	double parts = btMax(1., dt * std::fabs(angularSpeed()) / LARGEST_TURN);
	if (!m_struck && angle() + angularSpeed() * dt <= -m_settings.impactAngle)
		return whole(parts);
	for (const Joint& joint : m_joints)
		parts = btMax(parts, dt / joint.longestStep());
	// A hinge that is pushed at speed v between anvils a gap g apart bends by 2 v / (g / 2) per time when straight, less when
	// bent. That holds from the first contact on: so it is known before, and a step does not begin with a surprise.
	const double pushed = 4 * std::fabs(angularSpeed()) * m_settings.arm / m_settings.gap;
	if (m_settings.hingeStep > 0)
		parts = btMax(parts, dt * btMax(pushed, bendRate()) / m_settings.hingeStep);
	return whole(parts);
}

void ImpactTest::step() { step(stepAt(angle())); }

void ImpactTest::step(double dt)
{
	const int n = substepsIn(dt);
	for (int i = 0; i < n; ++i)
		substep(btScalar(dt / n));
}

bool ImpactTest::isHammerTouching() const
{
	btDispatcher& dispatcher = *const_cast<World&>(m_world).bullet().getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
	{
		const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
		if (manifold.getBody0() != m_parts.hammer && manifold.getBody1() != m_parts.hammer)
			continue;
		for (int p = 0; p < manifold.getNumContacts(); ++p)
			if (manifold.getContactPoint(p).m_appliedImpulse > 0)
				return true;
	}
	return false;
}

double ImpactTest::hammerEnergy() const
{
	return (Energy::kinetic(*m_parts.hammer) + Energy::potential(*m_parts.hammer) - m_hammerLevel) / m_perJoule;
}

void ImpactTest::substep(btScalar dt)
{
	const double hammerBefore = m_struck ? 0 : hammerEnergy();
	const double speedBefore = angularSpeed() * m_settings.arm;
	if (!m_struck)
		m_energy.reset();
	m_energy.beforeStep();
	m_world.step(dt);
	m_energy.afterStep(dt);
	m_time += double(dt);
	++m_result.substeps;
	if (!m_struck && isHammerTouching())
	{
		m_result.hammerBefore = hammerBefore;
		m_result.blowSpeed = speedBefore;
		strike();
	}
	if (!m_struck)
		hold();
	followBend();
	observe();
}

void ImpactTest::strike()
{
	m_struck = true;
	m_struckTime = m_time;
	for (btRigidBody* piece : m_parts.pieces)
		piece->setGravity(m_world.bullet().getGravity());
	for (const btRigidBody* piece : m_parts.pieces)
		m_specimenLevel += Energy::potential(*piece);
}

/// Above or below the anvils before it was bent by what it takes to pass; rounded corners take less by 1 % or two.
bool ImpactTest::hasSlipped() const
{
	for (const Joint& joint : m_joints)
		if (joint.isBroken())
			return false;
	const double edge = (anvilShape(m_settings, true).height + m_settings.width) / 2 * m_settings.lengthsPerMetre;
	for (const btRigidBody* piece : m_parts.pieces)
		if (std::fabs(double(piece->getWorldTransform().getOrigin().y())) < edge)
			return false;
	return m_result.greatestAngle < 0.95 * m_settings.passingAngle();
}

void ImpactTest::observe()
{
	if (!m_struck)
	{
		if (angle() > m_settings.swingAngle)
			m_outcome = Outcome::Missed;
		return;
	}
	if (isOver())
		return;
	btDispatcher& dispatcher = *m_world.bullet().getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
		for (int p = 0; p < dispatcher.getManifoldByIndexInternal(i)->getNumContacts(); ++p)
			m_result.deepest = btMax(
				m_result.deepest, -double(dispatcher.getManifoldByIndexInternal(i)->getContactPoint(p).getDistance()) /
									  m_settings.lengthsPerMetre);

	bool through = true;
	for (const btRigidBody* piece : m_parts.pieces)
		through = through && double(piece->getWorldTransform().getOrigin().x()) >
								 (m_settings.anvilWidth + m_settings.length / 2) * m_settings.lengthsPerMetre;
	if (angularSpeed() > 0 && hasSlipped())
		m_outcome = Outcome::Slipped;
	else if (through || angle() > m_settings.swingAngle)
		m_outcome = Outcome::Passed;
	else if (angle() < -m_settings.impactAngle)
		m_outcome = Outcome::Bounced;
	else if (m_time - m_struckTime > 0.2)
		m_outcome = Outcome::Stuck;
}

Result ImpactTest::run()
{
	while (!isOver() && m_time < LONGEST)
		step();
	return result();
}

Result ImpactTest::result() const
{
	Result r = m_result;
	r.outcome = m_outcome;
	if (!m_struck)
		r.hammerBefore = hammerEnergy();
	r.hammerAfter = hammerEnergy();
	r.numericalDissipation = -(m_energy.work(0) + m_energy.integrationWork()) / m_perJoule;
	for (const Joint& joint : m_joints)
	{
		r.plasticWork += joint.plasticWork() / m_perJoule;
		r.elasticEnergy += joint.elasticEnergy() / m_perJoule;
		r.numericalDissipation += joint.numericalEnergy() / m_perJoule;
		r.broken = r.broken || joint.isBroken();
	}
	for (const btRigidBody* piece : m_parts.pieces)
		r.specimenEnergy += (Energy::kinetic(*piece) + (m_struck ? Energy::potential(*piece) : 0)) / m_perJoule;
	r.specimenEnergy -= m_specimenLevel / m_perJoule;
	r.frictionWork = (0 - m_energy.frictionWork()) / m_perJoule;  // nothing is 0, not -0
	r.contactWork = (0 - m_energy.contactWork()) / m_perJoule;
	r.hingeAngle = std::fabs(m_bend);
	r.duration = m_struck ? m_time - m_struckTime : 0;
	return r;
}
}  // namespace ep::charpy
