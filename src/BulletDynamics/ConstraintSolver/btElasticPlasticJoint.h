// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_H
#define BT_ELASTIC_PLASTIC_JOINT_H

#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"
#include "btElasticPlasticCapacity.h"
#include "ElasticPlastic/joint/Kinematics.h"
#include "ElasticPlastic/joint/Law.h"
#include "btElasticPlasticState.h"

class btDynamicsWorld;
class btElasticPlasticAction;

/// Which rows a joint gives to the solver.
enum btElasticPlasticScheme
{
	BT_EP_SCHEME_IMPLICIT,  ///< the default: btElasticPlasticLaw.h
	BT_EP_SCHEME_PAPER      ///< the paper's, as a baseline: wrong at many steps, see docs/theory.md
};

/// The elastic-plastic part of a joint, shared by both constraint classes: capacity, state, rows, return mapping.
/// A step goes: prepare() and writeRows() by the solver, commit() by btElasticPlasticAction.
/// Evaluating never changes the state; only commit() does, once per substep.
ATTRIBUTE_ALIGNED16(class)
btElasticPlasticJoint
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	// ---- settings

	/// Makes every degree of freedom with a yield value elastic-plastic and takes Bullet's own limit, motor and spring off it;
	/// for good: one that a later capacity leaves out is free, until Bullet's setLimit() says otherwise. Those that never had
	/// a yield value are as Bullet's class made them: translations locked, rotations free, unless set.
	/// Before or after btDynamicsWorld::addConstraint, also while running. Frames that do not meet load the joint from the
	/// first step; only a misfit of the size of rounding is taken for none (setReferenceToCurrentPose() takes any).
	/// A joint that has nothing else is no more drawn by Bullet itself (setDbgDrawSize(0)), but by btElasticPlasticAction.
	/// \return false, and the joint stays out of the simulation until it gets a valid capacity, if the capacity or the bodies
	/// have a fault (see fault()).
	bool setCapacity(const btElasticPlasticCapacity& capacity);
	const btElasticPlasticCapacity& getCapacity() const { return m_capacity; }

	/// Takes effect with the next step. Default: BT_EP_SCHEME_IMPLICIT.
	void setScheme(btElasticPlasticScheme scheme) { m_scheme = scheme; }
	btElasticPlasticScheme getScheme() const { return m_scheme; }

	/// For error messages and reports; up to 31 characters are kept. Default: empty.
	void setName(const char* name);
	const char* getName() const { return m_name; }

	/// Makes the bodies' present pose the one without force, keeping plastic deformation as it is counted.
	void setReferenceToCurrentPose();

	// ---- what it tells, all as of the last commit

	/// Force or moment by the law, stiffness times elastic deformation within the yield value [N], [N m]. It acts on body A
	/// along the joint's axis and on body B against it: positive axial force is tension. A solver that leaves an error
	/// leaves elastic deformation that it has applied no force for: see getAppliedForce().
	btScalar getForce(int dof) const { return m_state.m_force[dof]; }

	/// Mean force or moment that the joint has really applied in the last substep [N], [N m], impulse over time. With the
	/// direct solver the same as getForce() but for the mean over the step.
	btScalar getAppliedForce(int dof) const { return m_state.m_applied[dof]; }

	/// Axis of the degree of freedom (translation along it, rotation about it) in world coordinates, at the start of the last
	/// substep: half way between the frames of the two bodies.
	const btVector3& getJointAxis(int dof) const { return m_step.m_kinematics.m_axis[dof % 3]; }

	/// Elastic deformation, force over stiffness [m], [rad]; 0 where rigid-plastic.
	btScalar getElasticDeformation(int dof) const;

	/// Plastic deformation with its sign [m], [rad].
	btScalar getPlasticDeformation(int dof) const { return m_state.m_plastic[dof]; }

	/// Sum of the absolute values of plastic increments [m], [rad].
	btScalar getPlasticPath(int dof) const { return m_state.m_plasticPath[dof]; }

	/// |applied force| over yield: 1 is yield.
	btScalar getUtilisation(int dof) const;

	/// The largest utilisation, and which degree of freedom has it (-1: none).
	btScalar getUtilisation(int* limitingDof = nullptr) const;

	/// Share of the ductility of one degree of freedom that is spent.
	btScalar getDamage(int dof) const { return m_state.m_plasticPath[dof] / m_capacity.m_ductility[dof]; }

	/// Share of the joint's ductility that is spent, the sum over the degrees of freedom (Miner's rule); 1 breaks it.
	btScalar getDamage() const;

	/// Stored in the springs, f^2 / 2k [J]; of a broken joint: what it held when it broke, lost in the fracture.
	double getElasticEnergy() const;

	/// Dissipated by plastic flow [J].
	double getPlasticEnergy() const { return m_state.m_plasticEnergy; }

	/// Taken from the bodies by the joint in all, less elastic and plastic energy: what the time integration has dissipated [J].
	/// May be a little negative: plastic flow counts by the step's last velocity, work by its mean one.
	double getNumericalEnergy() const { return m_state.m_work - m_state.m_plasticEnergy - getElasticEnergy(); }

	/// Taken from the bodies by the joint in all [J].
	double getWork() const { return m_state.m_work; }

	/// Rows of the last substep, 0 if the joint had no part in it, and what they were about (see btElasticPlasticStepControl.h):
	/// degree of freedom, and rate at which the deformation grew before and after [m/s], [rad/s].
	int getNumCommittedRows() const { return m_step.m_committedRows; }
	void getCommittedRow(int r, int& dof, btScalar& rateBefore, btScalar& rateAfter) const
	{
		dof = m_step.m_row[r].m_dof;
		rateBefore = -m_step.m_row[r].m_velocity0;
		rateAfter = -m_step.m_row[r].m_velocity1;
	}

	bool hasYielded() const { return m_state.m_yielded; }
	bool isBroken() const { return m_state.m_broken; }

	/// What keeps the joint out of the simulation, false if nothing does.
	const btElasticPlasticFault& fault() const { return m_fault; }

	/// "joint 'name' (id i) at (x, y, z): quantity is value; it must be range", always terminated.
	void printFault(char* text, int capacity) const;

	const btElasticPlasticState& getState() const { return m_state; }
	/// Whether the joint is broken stays as it is: to go back to before a break, btElasticPlasticAction::repair the joint
	/// first, then set the state.
	void setState(const btElasticPlasticState& state);

	btTypedConstraint& getConstraint() { return m_constraint; }
	const btTypedConstraint& getConstraint() const { return m_constraint; }

	/// World position of the joint: half way between its frames' origins.
	btVector3 getPosition() const;

	/// The joint's frame on each body, world coordinates.
	btTransform getFrameA() const { return m_constraint.getRigidBodyA().getCenterOfMassTransform() * m_frameInA; }
	btTransform getFrameB() const { return m_constraint.getRigidBodyB().getCenterOfMassTransform() * m_frameInB; }

	// ---- for solvers and the action

	/// Begins a step. \return number of rows that Bullet is to hold
	int prepare();

	/// For a solver that takes NO_ROWS: prepare() without the way through Bullet, which would ask three times more of a constraint.
	/// \return false if Bullet's class has rows too, or the overlap of broken joints to hold: then Bullet has to prepare it
	bool prepareAlone();

	/// Writes the rows that prepare() counted, beginning at firstRow.
	void writeRows(btTypedConstraint::btConstraintInfo2 * info, int firstRow);

	/// How a solver wants the rows of the next step. Ours take them by implicitRow() and give impulses back by setRowImpulse().
	enum Request
	{
		WHOLE_ROWS,  ///< Bullet's own solvers
		JACOBIANS,   ///< writeRows() writes no more
		NO_ROWS  ///< Bullet does not see them; startStep() stands for writeRows(), and reportImpulses() ends the solution
	};
	void request(Request request);

	/// Evaluates the joint at the bodies' present transforms and velocities, for a step of dt [s].
	/// \return false, and the joint has no part in the step, if they are no numbers
	bool startStep(btScalar dt);

	/// A = J M^-1 J^T of all rows.
	void getDiagonals(btScalar diagonals[BT_EP_DOF_COUNT]) const;

	/// The r-th row of the default scheme (or the joint's other one) for a solver that adds compliance to the diagonal.
	/// \param diagonal  A = J M^-1 J^T of the row
	btElasticPlastic::SoftRow implicitRow(int r, btScalar diagonal, btScalar erp);

	/// Elastic-plastic rows in the step under way; they are the last of the constraint's rows.
	int getNumRows() const { return m_step.m_rows; }
	int getRowDof(int r) const { return m_step.m_row[r].m_dof; }
	const btElasticPlastic::Kinematics& getKinematics() const { return m_step.m_kinematics; }

	/// The impulse of the r-th row, from a solver of ours. From others commit() takes it from Bullet's joint feedback.
	void setRowImpulse(int r, btScalar impulse) { m_step.m_row[r].m_impulse = impulse; }

	/// Does with the impulses what Bullet does for rows that it holds: the user's feedback, Bullet's applied impulse and breaking
	/// threshold.
	void reportImpulses();

	/// Whether the row was at a bound (-1, 0, 1) when a direct solver saw it last: where it begins its search.
	int getRowBound(int r) const { return m_bound[m_step.m_row[r].m_dof]; }
	void setRowBound(int r, int bound) { m_bound[m_step.m_row[r].m_dof] = static_cast<signed char>(bound); }

	/// By which a direct solver knows the joint's island again.
	int getTicket() const { return m_ticket; }
	void setTicket(int ticket) { m_ticket = ticket; }

	/// Its place in its action's books: joints that were added earlier come first.
	int getEntry() const { return m_entry; }

	/// What a commit brought about, a set of bits.
	enum Outcome
	{
		NOTHING = 0,
		YIELDED = 1,  ///< flowed for the first time
		BROKE = 2     ///< its ductility is spent
	};

	/// Tells the processor that commit() comes soon: a large structure does not fit its caches.
	void prefetch() const
	{
#if defined(__GNUC__)
		for (const char* line = reinterpret_cast<const char*>(&m_step);
			 line < reinterpret_cast<const char*>(&m_hasReference); line += 64)
			__builtin_prefetch(line);
#endif
	}

	/// Ends the step: return mapping, plastic increments, energies, damage. Does nothing if the joint was not in the step.
	int commit();

	/// Forgets the step: the state stays as it was committed last.
	void revert() { m_step.m_rows = 0; }

	/// Puts the joint back as new at the bodies' present pose; not for the user, see btElasticPlasticAction::repair.
	void resetState();

	/// Asks a constraint who it is, without run-time type information. \return null if it is not elastic-plastic
	static btElasticPlasticJoint* from(btTypedConstraint * constraint);

	btElasticPlasticJoint(const btElasticPlasticJoint&) = delete;
	btElasticPlasticJoint& operator=(const btElasticPlasticJoint&) = delete;

protected:
	btElasticPlasticJoint(btTypedConstraint & constraint, const btTransform& frameInA, const btTransform& frameInB);
	~btElasticPlasticJoint();

	/// Takes Bullet's limit, motor and spring off a degree of freedom.
	virtual void releaseBase(int dof) = 0;

	/// Is any degree of freedom left to Bullet's class?
	bool hasBaseDof() const { return m_dofs != (1u << BT_EP_DOF_COUNT) - 1; }

	/// Does Bullet's class have a limit, motor or spring on any degree of freedom?
	virtual bool isBaseActive() = 0;

	/// Stock solvers tell impulses only through a feedback: sets one unless the user has.
	void ensureFeedback()
	{
		if (m_request == WHOLE_ROWS && !m_constraint.getJointFeedback())
			setOwnFeedback();
	}

	/// If the joint is broken and its bodies still overlap: see btElasticPlasticParting.h.
	void holdOverlap()
	{
		if (m_partingWorld)
			measureOverlap();
	}

	/// Answers from() if asked.
	void answer(btSolverBody & asked, btScalar timeStep);

private:
	friend class btElasticPlasticAction;

	/// One row of the step: what it was given, and what came out.
	struct Row
	{
		btScalar m_lower, m_upper;  ///< bounds of the impulse
		btScalar m_velocity0;       ///< J v at the start of the step
		btScalar m_velocity1;       ///< and at its end, once committed
		btScalar m_impulse;
		int m_dof;
	};

	/// The step under way, from prepare() to commit().
	struct Step
	{
		int m_rows = 0;
		int m_committedRows = 0;  ///< until the next commit
		btScalar m_dt = 0;
		Request m_request = WHOLE_ROWS;
		btElasticPlastic::Kinematics m_kinematics;
		Row m_row[BT_EP_DOF_COUNT];
	};

	btElasticPlasticFault findFault() const;
	static void clear(btJointFeedback & feedback);
	void setOwnFeedback();
	void measureOverlap();
	void takeRoundingAsReference();
	void takePoseAsReference(unsigned dofs);
	void refuseWithoutBooks();
	void separateBaseRows(const btTypedConstraint::btConstraintInfo2& info, int baseRows);
	void project(const btVector3& linear, const btVector3& angular, btScalar onAxes[BT_EP_DOF_COUNT]) const;
	inline btElasticPlastic::SoftRow makeRow(int dof, btScalar diagonal, btScalar erp) const;
	inline btElasticPlastic::SoftRow startRow(Row & row, btScalar diagonal, btScalar erp);
	void measure(btElasticPlastic::Kinematics & k) const;
	btElasticPlastic::RelativeRotation turn() const;
	btScalar paperInverseMass(int dof) const;
	void takeBackKinematicMotion(btScalar dt);
	void readFeedback();
	btElasticPlastic::ReturnMapping returnMap(const Row& row, btScalar velocity1) const;
	void turnReference(const btScalar increment[6]);

	// In the order of use: what every step touches stands together.
	btTypedConstraint& m_constraint;
	const btTransform& m_frameInA;
	const btTransform& m_frameInB;
	unsigned m_dofs = 0;  ///< bit i: degree of freedom i is elastic-plastic
	btElasticPlasticScheme m_scheme = BT_EP_SCHEME_IMPLICIT;
	Request m_request = WHOLE_ROWS;              ///< for the next step
	int m_uncommitted = 0;                       ///< substeps in a row that nobody committed
	btElasticPlasticAction* m_action = nullptr;  ///< that knows this joint
	int m_entry = 0;                             ///< in its books
	int m_ticket = 0;
	btDynamicsWorld* m_partingWorld = nullptr;  ///< set while the joint is broken and its bodies have not parted
	btElasticPlasticFault m_fault;
	Step m_step;
	btElasticPlasticState m_state;
	btElasticPlasticCapacity m_capacity;
	signed char m_bound[BT_EP_DOF_COUNT] = {};
	bool m_hasReference = false;  ///< has had a valid capacity
	btScalar m_overlap = 0;       ///< of the bodies, while they part
	btJointFeedback m_feedback;
	btAlignedObjectArray<btVector3>
		m_dual;  ///< two vectors a row: impulse = force . first + torque . second; empty: the axes do
	char m_name[32] = {};
};

#endif  // BT_ELASTIC_PLASTIC_JOINT_H
