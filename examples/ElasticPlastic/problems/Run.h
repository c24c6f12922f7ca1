// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_RUN_H
#define EP_RUN_H

#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepControl.h"
#include "problems/Problem.h"
#include "world/EnergyAudit.h"

namespace ep
{
/// Steps a world, and keeps account of time and energy.
class Run
{
public:
	Run(World& world, const Stepping& stepping, Outcome& outcome)
		: m_world(world), m_stepping(stepping), m_outcome(outcome), m_audit(world), m_control(stepping.error)
	{
		// Not a part of the first step's time.
		world.start();
	}
	~Run();

	/// A step. Bullet takes loads off at the end of each substep: load() puts them on at its beginning.
	template <class Load>
	void step(const Load& load)
	{
		begin();
		for (btScalar length; (length = next()) > 0;)
		{
			load();
			substep(length);
		}
	}
	void step()
	{
		step([] {});
	}

	/// Steps until a time [s]. \return mean over time of what read() tells at the ends of those substeps that begin after
	/// another time: frames alone may be too few for a swing
	template <class Read>
	double meanUntil(double to, double from, const Read& read)
	{
		double sum = 0, span = 0;
		while (stepsUntil(to) > 0)
		{
			begin();
			for (btScalar length; (length = next()) > 0;)
			{
				const bool counts = m_time > from - m_stepping.step / 2;
				const double before = read();
				substep(length);
				sum += counts ? (before + read()) / 2 * double(length) : 0;
				span += counts ? double(length) : 0;
			}
		}
		return span > 0 ? sum / span : read();
	}

	/// Steps until a time [s], hit within half a step, that comes after the present one.
	int stepsUntil(double time) const { return int((time - m_time) / m_stepping.step + 0.5); }
	double time() const { return m_time; }
	double dt() const { return m_stepping.step; }

private:
	void begin();
	btScalar next();
	void substep(btScalar dt);

	World& m_world;
	Stepping m_stepping;
	Outcome& m_outcome;
	EnergyAudit m_audit;
	btElasticPlasticStepControl m_control;
	int m_left = 0;  // substeps of the step
	double m_time = 0;
};
}  // namespace ep

#endif  // EP_RUN_H
