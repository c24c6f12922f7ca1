// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticStepper.h"

#include <stdarg.h>
#include <stdio.h>

#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "ElasticPlastic/stepping/SceneSurvey.h"

using btElasticPlastic::SceneSurvey;
using btElasticPlastic::surveyScene;

namespace
{
/// Lines of text, put together as by printf.
struct Text
{
	std::string m_lines;

	void add(const char* format, ...)
	{
		char line[512];
		va_list values;
		va_start(values, format);
		vsnprintf(line, sizeof line, format, values);
		va_end(values);
		m_lines += line;
	}
};

void describeScene(Text& text, const SceneSurvey& survey)
{
	text.add(
		"%d joints between %d bodies; up to %d joints from a support; neighbours' masses up to %.3g : 1; bodies up to "
		"%.3g times longer than thick\n",
		survey.m_joints, survey.m_bodies, survey.m_depth, survey.m_massRatio, survey.m_slenderness);
}

void describeMistakes(Text& text, const SceneSurvey& survey, const btDynamicsWorld& world,
					  const btElasticPlasticConstraintSolver* solver, btScalar step)
{
	if (!(step > 0) || !btElasticPlasticIsFinite(step))
		text.add("mistake: the step is %g s; it must be finite and > 0, or step() does nothing\n", double(step));
	if (solver && solver != const_cast<btDynamicsWorld&>(world).getConstraintSolver())
		text.add("mistake: the solver is not the world's; give the one that the world was made with, or null\n");
	if (survey.m_joints == 0)
		text.add(
			"mistake: the action has no joints in the world; call addConstraint and btElasticPlasticAction::addJoint "
			"before\n");
}

void describeSolver(Text& text, const SceneSurvey& survey, btDynamicsWorld& world, bool isOurs)
{
	if (!isOurs)
	{
		text.add("direct solve: left as the world's solver does it; Bullet's own reaches %d joints in a step\n",
				 world.getSolverInfo().m_numIterations);
		return;
	}
	// Gauss-Seidel on a chain of n springs takes n^2 iterations and more.
	if (survey.m_depth > 1)
		text.add("direct solve: kept; to carry a force through %d joints takes iterations about %.0f\n", survey.m_depth,
				 double(survey.m_depth) * survey.m_depth);
	else
		text.add("direct solve: kept; for joints by themselves it takes as long as 10 iterations\n");
	if (survey.m_colliding > 0)
		text.add(
			"contacts in the direct solve: kept; %d joined bodies may be touched, and contacts solved apart do not see "
			"the structure behind them\n",
			survey.m_colliding);
	else
		text.add("contacts in the direct solve: none; no joined body collides\n");
}

void describeRest(Text& text, const SceneSurvey& survey, double step, double error)
{
	text.add(
		"substeps: left out; back when something may flow that a step of %.3g ms would get wrong by more than %.3g %%, "
		"or when a joined body is about to be hit\n",
		1e3 * step, 100 * error);
	if (survey.m_springs > 0)
		text.add("elastic part: kept; of %d springs with periods from %.3g to %.3g ms the step damps %d, at no cost\n",
				 survey.m_springs, 1e3 * survey.m_shortest, 1e3 * survey.m_longest, survey.m_stiff);
	else if (survey.m_joints > 0)
		text.add("elastic part: none; all joints are rigid-plastic\n");
	text.add(
		"shear and torsion: kept; a degree of freedom left out is free, and half of them cost a tenth of a step\n");
	if (survey.m_endless > 0)
		text.add("yield: left out of %d degrees of freedom, which have no limit\n", survey.m_endless);
	text.add("energies and events: kept; they cost less than a hundredth of a step\n");
	text.add("continuous collision detection: left out; substeps come before a joined body is hit\n");
}
}  // namespace

btElasticPlasticStepper::btElasticPlasticStepper(btDynamicsWorld& world, btElasticPlasticAction& action,
												 btElasticPlasticConstraintSolver* solver, double error, btScalar step)
	: m_world(world), m_action(action), m_control(error), m_step(step)
{
	const bool isOurs = solver && solver == world.getConstraintSolver();
	if (isOurs)
		solver->setForm(BT_EP_DIRECT);
	btAlignedObjectArray<btElasticPlasticJoint*> joints;
	action.getJointsInWorld(world, joints);
	const SceneSurvey survey = surveyScene(joints, double(step));
	Text text;
	describeScene(text, survey);
	describeMistakes(text, survey, world, solver, step);
	describeSolver(text, survey, world, isOurs);
	describeRest(text, survey, double(step), m_control.getError());
	m_text = text.m_lines;
}
