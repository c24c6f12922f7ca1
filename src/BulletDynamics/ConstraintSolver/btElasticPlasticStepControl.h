// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEP_CONTROL_H
#define BT_ELASTIC_PLASTIC_STEP_CONTROL_H

#include "btElasticPlasticAction.h"

/// Chooses the substeps of a world by what they leave open: short ones while something yields or is about to, else long ones.
///
/// After each substep an estimate T tells how much of the energy at play it has left open; it is of the size of the error in
/// how much flows, or above it (docs/performance.md). The substep is made so short that T stays below the error allowed, and
/// doubled after some steps with a small T. Elastic motion far from yield does not shorten it: where a structure comes to
/// rest does not depend on the step. Before two bodies meet, of which at least one is joined, the substep is made as short as
/// where something yields, and shorter if they would otherwise go further in it than a twentieth of the smaller one's least
/// edge.
class btElasticPlasticStepControl
{
public:
	/// \param error  allowed in how much flows, relative; 1e-6 to 1, else the nearer of these, not a number: 0.01
	explicit btElasticPlasticStepControl(double error = 0.01, btElasticPlasticOwnPrecision = {});
	~btElasticPlasticStepControl();
	btElasticPlasticStepControl(const btElasticPlasticStepControl&) = delete;
	btElasticPlasticStepControl& operator=(const btElasticPlasticStepControl&) = delete;

	void setError(double error);
	double getError() const;

	/// Bounds the time that a step can take; where more substeps would be needed getOpenShare() is above the error.
	/// \param most  1 to 4096, else the nearer of these; of it the largest power of two is taken. Default: 4096
	void setMaxSubsteps(int most);

	/// Steps the world by dt > 0 [s], in substeps. Forces that were applied before hold throughout, and kinematic bodies go
	/// evenly to where they were put. Internal tick callbacks come once per substep.
	/// \return how many substeps; 0, and nothing happens, if dt is not a positive number
	int step(btDynamicsWorld& world, btElasticPlasticAction& action, btScalar dt);

	// ---- the parts of step(), for those who do something between substeps

	/// Begins a step of dt > 0 [s].
	void begin(btScalar dt);

	/// Length of the next substep, for btDynamicsWorld::stepSimulation(length, 0) [s]; 0: the step is over.
	/// The direct form takes no inner steps in it (btElasticPlasticSolverSettings::m_innerError). During the substep the world's error reduction (btContactSolverInfo::m_erp, m_erp2) is less in proportion: penetration
	/// that a long step has left would else be pushed out at the speed of a blow. So are impulses by which Bullet's constraints are bounded (motors of hinges and cone
	/// twists, the clamp of ball sockets, breaking thresholds: they are those of a step), and constraints' own factors of error reduction by the square. What
	/// you change meanwhile stays, also from a tick callback. A substep that was begun but is not stepped
	/// has to be observed too, or the world keeps it so.
	btScalar next(btDynamicsWorld& world);

	/// After the substep: looks at what it has left open.
	void observe(btDynamicsWorld& world, btElasticPlasticAction& action);

	// ---- what it tells

	/// T of the last substep, the largest of all islands.
	double getOpenShare() const;

	/// How many substeps of the present length make a step.
	int getSubsteps() const;

	/// Begins again with the shortest substep, and doubles it as long as that leaves little open. To be called before a blow
	/// that the world does not show, such as an impulse, or a load that comes or goes suddenly: otherwise the first step
	/// treats it as a slow load. A world begins this way by itself. It costs some ten substeps.
	void expectBlow();

	/// Most substeps of a step that can be: 1 << MAX_LEVEL.
	static constexpr int MAX_LEVEL = 12;

private:
	struct Works;
	Works* const m_works;
};

#endif  // BT_ELASTIC_PLASTIC_STEP_CONTROL_H
