// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H
#define BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H

#include "BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h"
#include "btElasticPlasticPrecision.h"
#include "btElasticPlasticSolverSettings.h"
#include "btElasticPlasticStatistics.h"

namespace btElasticPlastic
{
class SolverWorks;
}

/// Bullet's solver, which also solves elastic-plastic joints accurately: give it to the world instead of
/// btSequentialImpulseConstraintSolver. Islands without elastic-plastic joints are solved as by Bullet, bit for bit.
///
/// Direct (the default): all joints of an island at once, by a sparse factorisation. A stiff structure holds at any step. Contacts are
/// solved with them or swept around them, see btElasticPlasticContacts.
///
/// Iterative: Bullet's sequential impulses, with rows that have the joints' true compliance.
class alignas(16) btElasticPlasticConstraintSolver : public btSequentialImpulseConstraintSolver
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	btElasticPlasticConstraintSolver(btElasticPlasticOwnPrecision = {});
	~btElasticPlasticConstraintSolver() override;
	btElasticPlasticConstraintSolver(const btElasticPlasticConstraintSolver&) = delete;
	btElasticPlasticConstraintSolver& operator=(const btElasticPlasticConstraintSolver&) = delete;

	/// All settings at once, between steps. \return false, with a message on the standard error output, and everything stays as it
	/// was, if one is out of its range (see btElasticPlasticSolverSettings::fault).
	bool setSettings(const btElasticPlasticSolverSettings& settings);
	const btElasticPlasticSolverSettings& getSettings() const;

	/// Change one setting; the others stay as they are. \return as setSettings()
	bool setForm(btElasticPlasticForm form);
	bool setNumThreads(int threads);
	btElasticPlasticForm getForm() const { return getSettings().m_form; }
	int getNumThreads() const { return getSettings().m_numThreads; }

	/// Of the direct form, summed since resetStatistics().
	const btElasticPlasticStatistics& getStatistics() const;
	void resetStatistics();

	void prepareSolve(int numBodies, int numManifolds) override;
	btScalar solveGroup(btCollisionObject** bodies, int numBodies, btPersistentManifold** manifolds, int numManifolds,
						btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info,
						btIDebugDraw* debugDrawer, btDispatcher* dispatcher) override;

private:
	btElasticPlastic::SolverWorks* const m_works;
};

#endif  // BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H
