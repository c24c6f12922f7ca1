// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEPPER_H
#define BT_ELASTIC_PLASTIC_STEPPER_H

#include <string>

#include "btElasticPlasticConstraintSolver.h"
#include "btElasticPlasticStepControl.h"

/// Steps a world to an error that is allowed: looks at it, leaves out what this scene does not need, and says why.
///
///     btElasticPlasticStepper stepper(world, action, &solver, 0.01, 1. / 60);
///     puts(stepper.getText());
///     ... each frame: stepper.step();
///
/// Substeps that are left out come back when something is about to yield or to be hit. The text names the measured cost of
/// what is kept (docs/performance.md).
class btElasticPlasticStepper
{
public:
	/// Describes the world as it is now, with its joints. What is added later is stepped as well, but not described.
	/// \param solver  the world's, set to its direct form; null: the world has one of Bullet's, which stays as it is
	/// \param error   allowed in how much flows, relative: see btElasticPlasticStepControl
	/// \param step    of the game [s], > 0
	/// World, action and solver must outlive it.
	btElasticPlasticStepper(btDynamicsWorld& world, btElasticPlasticAction& action,
							btElasticPlasticConstraintSolver* solver, double error, btScalar step);

	/// Steps the world by the game's step, or by that of a frame [s]. \return number of substeps, 0 for no step (a pause)
	int step() { return step(m_step); }
	int step(btScalar dt) { return m_control.step(m_world, m_action, dt); }

	/// What was seen, what is left out, and why: a line each.
	const char* getText() const { return m_text.c_str(); }

	btElasticPlasticStepControl& getControl() { return m_control; }

private:
	btDynamicsWorld& m_world;
	btElasticPlasticAction& m_action;
	btElasticPlasticStepControl m_control;
	btScalar m_step;
	std::string m_text;
};

#endif  // BT_ELASTIC_PLASTIC_STEPPER_H
