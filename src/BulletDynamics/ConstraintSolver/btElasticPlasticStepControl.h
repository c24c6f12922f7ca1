// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEP_CONTROL_H
#define BT_ELASTIC_PLASTIC_STEP_CONTROL_H

#include "LinearMath/btAlignedObjectArray.h"
#include "btElasticPlasticAction.h"
#include "ElasticPlastic/stepping/BodyMarks.h"

/// Chooses the substeps of a world by what they leave open: fine while something yields or is about to, coarse else.
///
/// A substep of length h takes the rate of deformation v as constant. What that leaves out is the second difference of the
/// deformation, h |v1 - v0|, which falls as h^2. Times the yield value it is work that may have gone one way or the other, the
/// open work. Set against the energy that is at play,
///
///     T = sum of open work / (kinetic energy + energy of the springs at yield + yield values times plastic deformation),
///
/// of an island (the deformation that there is, not the path of all that has gone to and fro: each swing counts by itself), it is of the size of the error in how much flows or above it, for single degrees of freedom as for beams
/// under blows, down to errors of a per cent (docs/performance.md). So h is made so short that T stays below the error
/// allowed, and doubled after some steps of calm.
///
/// Only degrees of freedom count that have flowed or may reach half of their yield value within a step, by their force's rate
/// and its change. Elastic motion far from yield asks for nothing: where a structure comes to rest does not depend on the
/// step. Before bodies meet of which one is joined the substep is made as fine as for what yields, and finer where they would
/// go further in it than a twentieth of the smaller one's least edge.
class btElasticPlasticStepControl
{
public:
	/// \param error  allowed in how much flows, relative; 1e-6 to 1, else the nearer of these, not a number: 0.01
	explicit btElasticPlasticStepControl(double error = 0.01) { setError(error); }

	void setError(double error);
	double getError() const { return m_error; }

	/// Bounds the time that a step can take; where more substeps would be needed getOpenShare() is above the error.
	/// \param most  1 to 4096, else the nearer of these; of it the largest power of two is taken. Default: 4096
	void setMaxSubsteps(int most);

	/// Steps the world by dt > 0 [s], in substeps. Forces that were applied before hold throughout, and kinematic bodies go
	/// evenly to where they were put. Internal tick callbacks come once per substep.
	/// \return how many substeps; 0, and nothing happens, if dt is not a positive number
	int step(btDynamicsWorld& world, btElasticPlasticAction& action, btScalar dt);

	// ---- the same piece by piece, for those who do something between substeps

	/// Begins a step of dt > 0 [s].
	void begin(btScalar dt);

	/// Length of the next substep, for btDynamicsWorld::stepSimulation(length, 0) [s]; 0: the step is over.
	/// During the substep the world's error reduction (btContactSolverInfo::m_erp, m_erp2) is less in proportion: penetration
	/// that a long step has left would else be pushed out at the speed of a blow. A substep that was begun but is not stepped
	/// has to be observed too, or the world keeps it so.
	btScalar next(btDynamicsWorld& world);

	/// After the substep: looks at what it has left open.
	void observe(btDynamicsWorld& world, btElasticPlasticAction& action);

	// ---- what it tells

	/// T of the last substep, the largest of all islands.
	double getOpenShare() const { return m_openShare; }

	/// How many substeps of the present length make a step.
	int getSubsteps() const { return 1 << m_level; }

	/// Begins anew with the finest substep, and doubles it as long as that leaves little open: for a blow that the world does not
	/// show, as an impulse, or a load that comes or goes at once. Without it the first step takes such a load for a slow one.
	/// Worlds begin with it; it costs some ten substeps.
	void expectBlow();

	/// Most substeps of a step that can be: 1 << MAX_LEVEL.
	static constexpr int MAX_LEVEL = 12;

private:
	/// How many steps have to leave little open before the substep is doubled.
	static constexpr int CALM_STEPS = 6;

	struct Island
	{
		double m_openWork;
		double m_roundedWork;  ///< of it, what may be the rounding of places: shorter substeps do not mend that
		double m_energy, m_mass, m_momentum[3];
		double m_carried;  ///< of the kinetic energy, what the motion of the whole is
		bool m_isHeld;     ///< by something that does not move with it
	};

	void refine(int level) { m_level = btMax(m_level, btMin(m_maxLevel, level)); }
	/// From here on coarser steps have to show that they leave little open: a spring that the level below resolves has
	/// T = error / 16, which takes two of them.
	int getResolvedLevel() const;
	void lookAhead(btDynamicsWorld& world);
	void restore(btDynamicsWorld& world);
	void addBodies(const btDynamicsWorld& world);
	void addJoints(btElasticPlasticAction& action, double length);
	static void addSupport(Island& island, const btRigidBody& support, const btVector3& place);
	void addRow(Island& island, const btElasticPlasticJoint& joint, int r, double length, double place) const;

	double m_error;
	btScalar m_erp = 0, m_erp2 = 0;  ///< the world's own, while a substep is under way
	bool m_isUnderWay = false;
	double m_openShare = 0;
	int m_maxLevel = MAX_LEVEL;
	int m_level = 0;                         ///< the substep is the step over 1 << m_level
	bool m_isSearching = true;               ///< for the substep, from the finest up
	btScalar m_dt = 0;                       ///< of the step
	btScalar m_length = 0;                   ///< of the substep, the last one
	btScalar m_calm = 0;                     ///< for how long little has been left open [s]
	int m_left = 0;                          ///< of the step, in parts of it over 1 << MAX_LEVEL
	int m_parts = 0;                         ///< that the substep under way takes of them
	btAlignedObjectArray<Island> m_islands;  ///< by Bullet's tag
	btElasticPlastic::BodyMarks m_joined;      ///< those that move and that elastic-plastic joints hold
};

#endif  // BT_ELASTIC_PLASTIC_STEP_CONTROL_H
