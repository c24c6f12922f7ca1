#include "Problem.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "problemsOfBars.h"
#include "problemsOfBeams.h"
#include "problemsOfBlows.h"

namespace ep
{
double Quantity::error() const { return std::isfinite(value) ? std::fabs(value / exact - 1) : HUGE_VAL; }

void Run::begin()
{
	m_left = m_stepping.substeps;
	m_control.begin(btScalar(m_stepping.step));
}

btScalar Run::next()
{
	if (m_stepping.error > 0)
		return m_control.next(m_world.bullet());
	return m_left-- > 0 ? btScalar(m_stepping.step / m_stepping.substeps) : btScalar(0);
}

void Run::substep(btScalar dt)
{
	if (!m_isBegun)
	{
		m_energy = m_most = m_world.kineticEnergy();
		m_isBegun = true;
	}
	m_audit.begin();
	const auto begin = std::chrono::steady_clock::now();
	m_world.step(dt);
	if (m_stepping.error > 0)
		m_control.observe(m_world.bullet(), m_world.action());
	++m_outcome.substeps;
	m_outcome.runTime += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
	const double energy = m_audit.end(dt);
	m_created += std::max(0., energy - m_energy);
	m_energy = energy;
	m_most = std::max(m_most, m_world.kineticEnergy());
	for (const btElasticPlasticJoint* joint : m_world.joints())
		m_most = std::max(m_most, joint->getWork());
	m_time += double(dt);
	m_outcome.simulated += double(dt);
}

Run::~Run()
{
	const double created = m_most > 0 ? m_created / m_most : 0;
	// Bullet's own joints do not tell what they take.
	if (!m_world.method().kind().isElasticPlastic())
		m_outcome.energyCreated = NAN;
	// Of several runs the worst.
	else if (!(created <= m_outcome.energyCreated))
		m_outcome.energyCreated = created;
}

const std::vector<Problem>& problems()
{
	static const std::vector<Problem> all = []
	{
		std::vector<Problem> list;
		for (const auto& group : {problemsOfBars(), problemsOfBeams(), problemsOfBlows()})
			list.insert(list.end(), group.begin(), group.end());
		return list;
	}();
	return all;
}

const Problem* findProblem(const std::string& name)
{
	for (const Problem& problem : problems())
		if (name == problem.name)
			return &problem;
	return nullptr;
}
}  // namespace ep
