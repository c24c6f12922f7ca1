// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_WORKS_H
#define BT_ELASTIC_PLASTIC_JOINT_WORKS_H

#include "JointStep.h"
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
	int m_index = 0;                      ///< of whole joints: those that were added earlier come first
};

/// What stands behind a btElasticPlasticJoint, together in memory: the model, its step, and how they meet Bullet and the action.
///
/// A solver that knows elastic-plastic joints goes through two doors. Before the solution, beginAlone() and the step's begin()
/// give it rows; after it, finishAlone() takes impulses and bounds. Bullet's own solvers go through prepare() and writeRows(),
/// and their impulses come back by Bullet's joint feedback. commit() ends the step either way.
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

	/// The works behind a constraint, without run-time type information. \return null if it is not elastic-plastic
	static JointWorks* from(btTypedConstraint* constraint);

	// ---- for Bullet's class

	/// Before Bullet asks for rows.
	void buildJacobian();

	/// Begins a step. \return number of rows that Bullet is to hold
	int prepare();

	/// Has Bullet's class rows beside the elastic-plastic ones in the step that prepare() has begun?
	bool hasBaseRows() const;

	/// Writes the rows that prepare() counted, beginning at firstRow.
	void writeRows(btTypedConstraint::btConstraintInfo2* info, int firstRow);

	/// Answers from(), if it is from() that asks.
	void answer(btSolverBody& asked);

	// ---- for solvers

	/// The iterative form's way: Bullet gets Jacobians in the next step, the laws are the solver's to ask for. It gives impulses
	/// back by the step's setImpulse().
	void requestJacobians();

	/// The direct form's way: Bullet sees no rows of the joint in this step. Saves the way through Bullet, which would ask
	/// three times more of a constraint.
	/// \return false if Bullet's class has rows too, or the overlap of broken joints to hold: then Bullet has to prepare it
	bool beginAlone();

	/// Ends the solution begun by beginAlone(): does with the impulses what Bullet does for rows that it holds: the user's
	/// feedback, Bullet's applied impulse and breaking threshold.
	/// \param impulses, bounds  by the step's rows; a bound is -1, 0 or 1
	void finishAlone(const double* impulses, const signed char* bounds);

	// ---- for the registry

	/// Ends the step. \return JointStep::Outcome
	int commit();

	/// Hides the constraint from Bullet's islands, or shows it again.
	void setOutOfIslands(bool isOut);

	/// Begins anew with the count of substeps that nobody committed.
	void forgetUncommitted() { m_numUncommitted = 0; }

	void setFault(const btElasticPlasticFault& fault);

	/// Tells of m_model.m_fault: to a registry's listener or, without one, on the standard error output.
	void tellFault(JointRegistry* registry);
	/// The same to the joint's own registry, if it has not been told since it was found.
	void tellFaultOnce();

	/// "joint 'name' (id i) at (x, y, z): quantity is value; it must be range", always terminated.
	void printFault(const btElasticPlasticFault& fault, char* text, int capacity) const;

	btElasticPlasticJoint& m_joint;
	JointModel m_model;
	JointStep m_step;
	RegistryEntry m_entry;
	Separation m_separation;
	int m_islandId = 0;  ///< by which a direct solver knows the joint's island again; 0: none

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
	void tell(const btElasticPlasticFault& fault, JointRegistry* registry);
	bool needsRegistry() const;
	void refuseWithoutRegistry();

	Request m_request = WHOLE_ROWS;      ///< of this step
	Request m_nextRequest = WHOLE_ROWS;  ///< of the next one
	int m_numUncommitted = 0;            ///< substeps in a row that nobody committed
	bool m_isFaultTold = true;
	bool m_isStepFaultTold = false;  ///< the fault that keeps the joint out of the present steps
	bool m_isLeftOut = false;        ///< of the present step
	bool m_isOutOfIslands = false;
	StockFeedback m_feedback;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINT_WORKS_H
