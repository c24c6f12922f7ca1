/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#ifndef BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H
#define BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H

#include "BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h"
#include "btElasticPlasticJoint.h"

/// Bullet's sequential impulses with exact soft rows: hand it to the world instead of btSequentialImpulseConstraintSolver.
///
/// Bullet multiplies the impulse by a row's compliance but leaves it out of the diagonal; the iteration then diverges for
/// springs that the step resolves. Here an elastic-plastic row (J v + C lambda = r) is divided by A + C instead of A, which is
/// Gauss-Seidel on the true matrix and converges for every C; so the joints give their implicit rows (btElasticPlasticLaw.h).
/// All other constraints and contacts are solved as by the base class, bit for bit where there are no elastic-plastic joints.
ATTRIBUTE_ALIGNED16(class)
btElasticPlasticConstraintSolver : public btSequentialImpulseConstraintSolver
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

protected:
	void convertJoints(btTypedConstraint * *constraints, int numConstraints, const btContactSolverInfo& info) override;
	btScalar solveGroupCacheFriendlyFinish(btCollisionObject * *bodies, int numBodies, const btContactSolverInfo& info)
		override;

private:
	/// A joint of the group that is being solved, and the first of its elastic-plastic rows in the pool.
	struct JointRows
	{
		btElasticPlasticJoint* m_joint;
		int m_firstRow;
		int m_rows;
	};

	static void makeSoft(btSolverConstraint & row, btElasticPlasticJoint & joint, int r,
						 const btContactSolverInfo& info);

	btAlignedObjectArray<JointRows> m_jointRows;
};

#endif  // BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H
