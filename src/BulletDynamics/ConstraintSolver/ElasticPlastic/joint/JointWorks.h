// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_WORKS_H
#define BT_ELASTIC_PLASTIC_JOINT_WORKS_H

#include "../Prefetch.h"
#include "EventQueue.h"
#include "JointStep.h"
#include "Levels.h"
#include "Separation.h"
#include "StockFeedback.h"

class btElasticPlasticJoint;
struct btSolverBody;

namespace btElasticPlastic
{
class JointRegistry;

/// A joint's place in the registry of its action; written by the registry alone.
struct RegistryEntry
{
	JointRegistry* m_registry = nullptr;  ///< null: no action knows the joint
	int m_index = 0;                      ///< in the registry's list of joints that hold, or of those that are broken
	int m_number = 0;                     ///< of the joint in the order in which the registry has got to know them
	int m_worldIndex = 0;                 ///< in the world's list of constraints, as it was last; -1: it was not there
	UnreadEvents m_events;
};

/// The implementation of btElasticPlasticJoint, together in memory: the model, its step, and their connection to Bullet and
/// to the action.
///
/// The direct form gets rows by beginAlone() and the step's begin(), and returns impulses and bounds by finishAlone(). The
/// iterative form asks for Jacobians by requestJacobians(), and returns impulses by the step's setImpulse(). Bullet's own
/// solvers get rows by prepare() and writeRows(), and return impulses by Bullet's joint feedback. In every case commit() ends
/// the step.
class JointWorks
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	JointWorks(btElasticPlasticJoint& joint, btTypedConstraint& constraint, const btTransform& frameInA,
			   const btTransform& frameInB)
		: m_joint(joint), m_model(constraint, frameInA, frameInB), m_step(m_model)
	{
	}
	JointWorks(const JointWorks&) = delete;
	JointWorks& operator=(const JointWorks&) = delete;

	/// Has the processor load what a step uses of the joint.
	void prefetch() const
	{
		btElasticPlastic::prefetch(this, m_step.getEndWithoutFibres());
		btElasticPlastic::prefetch(&m_entry, this + 1);
	}

	/// Has it load what a step uses of a constraint itself: of Bullet's base class, and frames, which come next.
	static void prefetch(const btTypedConstraint* constraint)
	{
		btElasticPlastic::prefetch(constraint, reinterpret_cast<const char*>(constraint + 1) + 2 * sizeof(btTransform));
	}

	/// The same of its fibres and its bodies, which tell where they are once the joint itself has been loaded. Rows of a wall follow each other after so many
	/// joints that their bodies have left the cache.
	void prefetchParts() const
	{
		if (m_model.m_bearing.size() > 0)
			m_step.getFibres().prefetch();
		btElasticPlastic::prefetch(&m_model.m_bodyA, &m_model.m_bodyA + 1);
		btElasticPlastic::prefetch(&m_model.m_bodyB, &m_model.m_bodyB + 1);
	}

	/// What finishAlone() uses of them.
	void prefetchPartsForSolution() const
	{
		if (m_model.m_bearing.size() > 0)
			m_step.getFibres().prefetchForSolution();
	}

	/// Finds the works of a constraint without run-time type information. \return null if it is not elastic-plastic
	static JointWorks* from(btTypedConstraint* constraint);
	static const JointWorks& of(const btElasticPlasticJoint& joint);

	// ---- for Bullet's class

	/// Called before Bullet asks for rows.
	void buildJacobian();

	/// Begins a step. \return number of rows that Bullet is to hold
	int prepare();

	/// Whether Bullet's class has rows besides the elastic-plastic ones in the step that prepare() has begun.
	bool hasBaseRows() const;

	/// Writes the rows that prepare() counted, beginning at firstRow.
	void writeRows(btTypedConstraint::btConstraintInfo2* info, int firstRow);

	/// Answers from(). Does nothing if the caller is not from().
	void answer(btSolverBody& asked);

	// ---- for solvers

	/// For the iterative form: in the next step Bullet gets only Jacobians, and the solver itself asks for the laws by the
	/// step's makeRow(). It returns impulses by the step's setImpulse().
	void requestJacobians();

	/// For the direct form: begins a step in which Bullet sees no rows of the joint. This saves Bullet's three calls for each
	/// constraint.
	/// \return false if Bullet has to prepare the joint all the same, because its class has rows, too, or because the joint
	/// is broken and its bodies still overlap
	bool beginAlone();

	/// Ends the solution begun by beginAlone(). Does with the impulses what Bullet does for its own rows: it fills the user's
	/// feedback, sets Bullet's applied impulse, and applies Bullet's breaking threshold.
	/// \param impulses, bounds  of the step's rows, then of its fibres; a bound is -1, 0 or 1, and null stands for 0 throughout
	void finishAlone(const double* impulses, const signed char* bounds);

	/// Whether it holds its bodies together: it is not broken, and nothing is wrong with it.
	bool holds() const { return !m_model.m_fault && !m_model.m_state.m_broken; }

	/// Ends an inner step within the solver. The registry gets what has come of all of them by commit().
	/// \param share  of the world's step
	void commitInside(double share);

	/// Forgets the step under way, inner steps included. \param state  of the joint when the step began
	void rewind(const btElasticPlasticState& state);

	/// Begins a step that may have inner ones. What former ones have left for an action that has not come is forgotten.
	/// \return false if no action ends the joint's steps: there is one that it has had a part in and that is not ended
	bool beginInside();

	// ---- for the registry

	/// Takes what a solver of Bullet's tells of the step, before commit().
	void takeFeedback();

	/// Ends the step. \return JointStep::Outcome
	int commit();

	/// Whether the joint has a part in the step that commit() is to end.
	bool isInStep() const { return m_isCommittedInside || m_outcome != 0 || m_step.getNumRows() > 0; }

	/// Forgets that step: the joint's bodies may be deleted.
	void leaveStep();

	/// The same of a step that has been solved, and that nobody commits. After three of them the joint is refused.
	void leaveUncommitted();

	/// Whether the last commit ended a step that the joint had a part in.
	bool wasInStep() const { return m_step.getNumCommittedRows() > 0; }

	/// Forgets what the joint stands on: it is not followed any more.
	void forgetSupport()
	{
		m_model.m_state.m_support = btElasticPlasticState::Support();
		m_step.forgetLead();
	}

	/// Whether the joint has stood on a static or kinematic body, or has not been looked at yet.
	bool mayHaveSupport() const;

	/// Whether the joint's bodies must not sleep: its load has changed, it flows, or what it stands on moves.
	/// To be called after commit(), while the bodies exist.
	/// \param share  of the yield value; see LoadWatch
	/// \param step   length of the substep, after which its support is followed (SupportWay) [s]
	bool isLoadChanging(btScalar share, btScalar step);

	/// What the joint has given body A in the last step [N s], and how fast body B moves against body A at the joint [m/s], in world
	/// axes.
	btVector3 appliedImpulse() const;
	btVector3 relativeVelocity() const;

	void updateDrawnFrames();

	/// Has an action that knows the joint look at it when the substep ends.
	void rouse();

	/// Wakes both bodies, if an action knows the joint.
	void wakeBodies();

	/// Hides the constraint from Bullet's islands, or shows it again.
	void setOutOfIslands(bool isOut);

	/// Sets the number of substeps that nobody has committed to zero.
	void forgetUncommitted() { m_numUncommitted = m_numLeft = 0; }

	// ---- for snapshots

	int getNumUncommitted() const { return m_numUncommitted; }
	int getNextRequest() const { return m_nextRequest; }

	/// Puts back what Bullet sees of the joint, after its model has been put back.
	void resume(int numUncommitted, int nextRequest);

	/// Makes the solution of the next step independent of the factor that the direct form has kept.
	void leaveFactor()
	{
		if (m_islandId > 0)
			m_islandId = -m_islandId;
	}

	/// Whether a world has asked for the joint's rows, or a registry has seen it there.
	bool hasBeenInWorld() const { return m_hasBeenInWorld; }
	void setInWorld() { m_hasBeenInWorld = true; }

	/// Tells, once, that the joint is in no world.
	void tellForgotten();

	/// Tells, once, that a body of it is in no world, if that is so.
	void tellMissingBody();

	void setFault(const btElasticPlasticFault& fault);

	/// Takes Bullet's own limits, motors and springs off what is elastic-plastic.
	void releaseBase();

	/// Forgets what kept the joint out of the last step.
	void forgetStepFault() { m_stepFault = btElasticPlasticFault(); }

	/// Reports m_model.m_fault to a registry's listener or, without a registry, on the standard error output.
	void tellFault(JointRegistry* registry);
	/// Reports m_model.m_fault to the joint's own registry, unless it has been reported since it was found.
	void tellFaultOnce();

	/// Puts a state back, and the joint with it among those that hold or are broken.
	/// \return false, and the listener is told why, if it cannot be one of this joint
	bool setState(const btElasticPlasticState& state);

	/// What keeps the joint out of the simulation until it is set anew, or out of the present step.
	const btElasticPlasticFault& getFault() const { return m_model.m_fault ? m_model.m_fault : m_stepFault; }

	/// "joint 'name' (id i) at (x, y, z): quantity is value; it must be range", always terminated. Name and id are left out where
	/// they are not set.
	void printFault(const btElasticPlasticFault& fault, char* text, int capacity) const;

	btElasticPlasticJoint& m_joint;
	JointModel m_model;
	JointStep m_step;
	RegistryEntry m_entry;
	Separation m_separation;
	Levels m_levels;
	int m_islandId =
		0;  ///< the id by which the direct form finds the kept factor of the joint's island; 0: none; less: not to be used

private:
	/// What Bullet sees of the joint in a step.
	enum Request
	{
		WHOLE_ROWS,
		JACOBIANS,
		NO_ROWS
	};

	void request(Request request);
	bool passesGate();
	void setStepFault(const btElasticPlasticFault& fault);
	void tell(const btElasticPlasticFault& fault, JointRegistry* registry);
	bool needsRegistry() const;
	void refuseWithoutRegistry();

	Request m_request = WHOLE_ROWS;      ///< of this step
	Request m_nextRequest = WHOLE_ROWS;  ///< of the next one
	int m_numLeft = 0;                   ///< number of solved substeps that the joint has left since the last commit
	int m_numUncommitted = 0;            ///< number of successive substeps that nobody has committed
	bool m_isFaultTold = true;
	btElasticPlasticFault m_stepFault;  ///< what keeps the joint out of the present step
	bool m_isLeftOut = false;           ///< of the present step
	bool m_isOutOfIslands = false;
	bool m_hasBeenInWorld = false;
	bool m_isCommittedInside = false;  ///< whether the solver has ended the step itself
	bool m_isNew = false;              ///< whether the step that has begun inside is the joint's first
	unsigned char m_outcome = 0;       ///< of its inner steps, JointStep::Outcome
	StockFeedback m_feedback;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINT_WORKS_H
