// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_STEP_H
#define BT_ELASTIC_PLASTIC_JOINT_STEP_H

#include "Diagonal.h"
#include "FibreStep.h"
#include "JointModel.h"
#include "JointRows.h"
#include "MaterialDamping.h"
#include "PaperLaw.h"
#include "SpringLanes.h"
#include "StepKind.h"

namespace btElasticPlastic
{
/// One step of a joint: from pose and velocities to rows, from impulses and bounds to the next state.
///
/// Evaluating never changes the joint's state; only commit() does, once per substep.
class JointStep
{
public:
	explicit JointStep(JointModel& model) : m_model(model), m_fibres(model, m_damping, m_yield) {}

	// ---- pose and step -> rows

	/// Chooses the rows of a joint that may be solved.
	/// \param knowsFibres  whether the solver takes fibres instead of an axial row and two of bending
	/// \return how many there are, none if the joint is broken; of fibres the three that they add up to
	int prepare(bool knowsFibres = false);

	/// Evaluates the joint at the bodies' present transforms and velocities, for a step of dt [s].
	/// \param share  of the world's step
	/// \return false, and the joint has no part in the step, if its strain is no number or the step not finite and above 0
	bool evaluate(btScalar dt, btScalar share = 1);

	/// All that a solver needs: evaluate(), and the rows with their own diagonals.
	/// \param erp    Bullet's error reduction, for rigid-plastic rows
	/// \param kind   of step
	bool begin(btScalar dt, btScalar erp, StepKind kind, JointRows& rows);

	/// For a solver that makes rows one by one, after evaluate() and before makeRow(): makes the fibres of a joint that uses them, without
	/// what couples them with shears.
	void beginFibres(JointRows& rows);

	/// The r-th row's law, after evaluate().
	/// \param diagonal    A = J M^-1 J^T of the row
	/// \param isForStock  the row is for one of Bullet's own solvers
	SoftRow makeRow(int r, btScalar diagonal, btScalar erp, bool isForStock);

	int getNumRows() const { return m_numRows; }
	/// Without the last three, which are what fibres add up to, of a joint that uses them.
	int getNumPlainRows() const { return m_usesFibres && m_numRows > 0 ? m_numRows - 3 : m_numRows; }
	bool usesFibres() const { return m_usesFibres; }
	int getDof(int r) const { return m_row[r].m_dof; }
	btScalar getTimeStep() const { return m_dt; }
	const Kinematics& getKinematics() const { return m_kinematics; }

	// ---- impulses and bounds -> the next state

	void setImpulse(int r, btScalar impulse)
	{
		m_row[r].m_impulse = impulse;
		m_row[r].m_isBoundKnown = false;
	}

	/// Of the fibres, whose sums are set as rows, by a solver that makes rows one by one.
	void setFibres(const double* impulses, const signed char* bounds);

	/// All of a solution by a solver that knows which rows are at a bound: first of the rows, then of the fibres.
	/// \param bounds  null: all are between theirs
	void setSolution(const double* impulses, const signed char* bounds);

	btScalar getImpulse(int r) const { return m_row[r].m_impulse; }

	/// As setImpulse() for a solver that knows which rows are at a bound.
	/// \param bound  -1 at the lower, 1 at the upper bound, 0 between
	void setImpulse(int r, btScalar impulse, int bound)
	{
		m_row[r].m_impulse = impulse;
		m_row[r].m_isBoundKnown = true;
		m_lastBound[m_row[r].m_dof] = static_cast<signed char>(bound);
	}

	/// Whether the r-th row flows by the solution of the step, or of what fibres add up to some of them.
	bool isFlowing(int r) const
	{
		const bool isOfFibres = m_usesFibres && btElasticPlasticCapacity::isOfFibres(m_row[r].m_dof);
		return isOfFibres ? m_fibres.isAnyAtBound() : m_lastBound[m_row[r].m_dof] != 0;
	}

	/// Before the step is evaluated, where it is not as long as the last one: velocities have been brought to the time to which they would belong if it had been, see
	/// JoinedShift. A change of step that nobody does this for is damped.
	void setEven(bool isEven) { m_isEven = isEven; }

	/// Tells that the impulses are of a search that has been cut: they obey the law, and do not belong to the deformation.
	void setCut() { m_isCut = true; }

	/// Whether nothing acts from outside on what the joint is part of: no load, no contact with and no joint to what moves by itself.
	void setFree(bool isFree) { m_isFree = isFree; }

	/// That the bodies' places move in the step beside their velocities, to take penetration back. The joint's reference moves along:
	/// no body has given what a spring would store of it.
	/// \param linear, angular  velocities of that motion, of both bodies
	void setRecovery(const btVector3 linear[2], const btVector3 angular[2]);

	/// What tension damping has applied about the common point [N m s], on body A.
	void setDampingImpulse(const btVector3& impulse) { m_dampingImpulse = impulse; }

	/// Impulses as a force and a torque about the joint's common point [N], [N m], on body A.
	void getLoad(btVector3& force, btVector3& torque) const;

	/// What happened to the joint in a step, a set of bits.
	enum Outcome
	{
		NOTHING = 0,
		YIELDED = 1,  ///< flowed for the first time
		BROKE = 2     ///< its ductility is spent
	};

	/// J v of all degrees of freedom at the bodies' present velocities, along the axes of the step.
	void projectVelocities(btScalar onAxes[BT_EP_DOF_COUNT]) const;

	// ---- for EnergyLedger, before commit()

	/// Whether the joint has a part in the step that no exact solver has solved.
	bool isUnsure() const { return m_numRows > 0 && !m_row[0].m_isBoundKnown; }

	/// What the joint has had from its bodies before the step and not given back; with what it has been given by who has moved them
	/// since [J].
	double getStored() const;

	/// What it may give beyond that: rigid-plastic rows close by error reduction, and take the speed back as they do [J].
	double getLoan() const;

	/// What the step's impulses give to the bodies [J].
	double measureWork() const;

	/// Angular velocity of a body with which the step began [rad/s].
	const btVector3& getSpinBefore(int side) const { return m_spin0[side]; }

	/// What the joint is to count as given [J].
	void setWork(double given)
	{
		m_given = given;
		m_isWorkKnown = true;
	}

	/// Ends the step: return mapping, plastic increments, energies, damage. Does nothing if the joint was not in the step.
	/// \param share  of the world's step: 1, or less of an inner one
	/// \param isNew  the joint has its first step of the world
	int commit(double share, bool isNew);

	// ---- for EnergyLedger, after commit()

	/// What the springs' energy differs at most from what has been given for it, as places stand half a step after velocities [J].
	double getHalfStep() const;

	/// Remembers how the bodies stand at the end of the step.
	void rememberPlace();

	/// What a joint without fibres uses of the step ends here.
	const void* getEndWithoutFibres() const { return &m_fibres; }

	const FibreStep& getFibres() const { return m_fibres; }

	// ---- where tension comes on within the step

	/// Of a solution that has not been committed, whether its tension asks for more than twice the TensionDamping that it was solved with, by the tension of
	/// the step before: in a joint's first step, and of a joint that is as good as a rope's, with next to no strength in bending. Then the step is to be
	/// solved once more, and knows it.
	bool foreseeTension();
	void forgetTension() { m_isTensionKnown = false; }

	// ---- of a step that has been solved, before commit()

	/// J v of all degrees of freedom, before and after it. Where nothing flows, but for what turning bodies have of it: a step of straight motion leaves their circles, and the next
	/// one comes back. A shorter one does so in less time, and that is nothing that it would mend.
	/// \param before  0 where there is no row
	/// \return whether anything flows
	bool projectMotion(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const;

	/// Forgets the step: the state stays as it was committed last.
	void revert() { m_numRows = 0; }

	/// By which time a kinematic support is shown ahead in the substep, as its first evaluate() has found. \return below 0: there was none
	btScalar getLead() const { return m_isLeadFound ? m_lead : btScalar(-1); }
	void forgetLead() { m_isLeadFound = false; }

	/// Forgets the last committed step as well.
	void forget()
	{
		m_isLeadFound = false;
		m_numRows = m_numCommittedRows = 0;
		m_fibres.forgetLosses();
	}

	// ---- the last committed step

	int getNumCommittedRows() const { return m_numCommittedRows; }
	/// As projectMotion().
	void getMotion(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const;
	/// Rate at which the r-th row's deformation grew before and after it [m/s], [rad/s].
	btScalar getRateBefore(int r) const { return -m_row[r].m_velocity0; }
	btScalar getRateAfter(int r) const { return -m_row[r].m_velocity1; }

	/// Whether anything was at its bound in the last solution.
	bool isAnyAtBound() const
	{
		bool isAny = m_model.usesFibres() && m_fibres.isAnyAtBound();
		for (const signed char bound : m_lastBound)
			isAny |= bound != 0;
		return isAny;
	}

	/// By degree of freedom: -1, 0 or 1. The next step's search for the rows at their bounds begins with them.
	const signed char* getLastBounds() const { return m_lastBound; }
	void setLastBound(int dof, signed char bound) { m_lastBound[dof] = bound; }

	/// Fibres that have cracked or ruptured since they were forgotten, see FibreStep.
	const btAlignedObjectArray<FibreStep::Loss>& getLosses() const { return m_fibres.getLosses(); }
	void forgetLosses() { m_fibres.forgetLosses(); }

	/// As getLastBounds(), of the fibres in the capacity's order.
	std::vector<signed char> getLastFibreBounds() const { return m_fibres.getLastBounds(); }
	void setLastFibreBounds(const std::vector<signed char>& bounds) { m_fibres.setLastBounds(bounds); }
	/// After a change of the capacity, which may have come between a step's solution and its end: one that has been solved with another number of fibres
	/// has come to nothing.
	void followCapacity()
	{
		const int numFibres = m_model.m_capacity.m_fibres.size();
		if (m_usesFibres && m_fibres.getNumFibres() != numFibres)
			revert();
		m_fibres.forgetLastBoundsBeyond(numFibres);
	}

private:
	struct Row
	{
		btScalar m_lower, m_upper;  ///< bounds of the impulse
		btScalar m_velocity0;       ///< J v at the start of the step
		btScalar m_velocity1;       ///< J v at the end of the step, once committed
		btScalar m_impulse;
		int m_dof : 8;
		bool m_isBoundKnown;
		bool m_isForStock;
		bool m_isOfWaves;       ///< see begin()
		bool m_isAtRest;        ///< had hardly moved when a blow's steps became of this length
		signed char m_partner;  ///< the row with which it is coupled in this step, -1: none
		btScalar m_coupling;    ///< compliance beside the diagonal, of both
	};

	/// Strain beside the law's [m], [rad].
	struct Drift
	{
		btScalar m_way, m_turn;

		btScalar of(int dof) const { return dof < 3 ? m_way : m_turn; }
	};

	Drift driftOf(const btScalar spin[2], btScalar dt) const;
	void withholdDrift();
	const btScalar* lastForce() const;
	bool carriesWaves(int r, btScalar diagonal) const;
	bool isAtRest(int r) const;
	bool areAlike() const;
	SpringLanes findSprings() const;
	void makeRows(btScalar erp, JointRows& rows);
	void makeRowsAlike(btScalar erp, JointRows& rows);
	void mapRows(bool isCut, ReturnMapping mapped[BT_EP_DOF_COUNT]) const;
	bool mapAlike(const btScalar velocity1[BT_EP_DOF_COUNT], ReturnMapping mapped[BT_EP_DOF_COUNT]) const;
	/// Whether the past of a row is as of steps of this length.
	bool isEven(int r) const { return tauOfWaves(r) > 0; }
	btScalar tauOfWaves(int r) const { return MeanForce::tauOfWaves(m_dt, m_row[r].m_isAtRest ? m_dt : lastStep()); }
	/// [s]
	btScalar lastStep() const { return m_isEven ? m_dt : m_model.m_state.m_lastStep; }
	DofState dofState(int r) const;
	PaperLaw paperLaw(int dof) const;
	void couple(JointRows& rows);
	/// Deformation if the whole step was elastic. It is along the axes at the start of the step: measured in the turned configuration, the turn
	/// would count as strain.
	btScalar trialOf(int r) const { return m_kinematics.m_strain[m_row[r].m_dof] - m_dt * m_row[r].m_velocity1; }
	RowOutcome outcomeOf(int r) const;
	ReturnMapping returnMap(int r) const;
	void returnMapPair(int r, ReturnMapping mapped[BT_EP_DOF_COUNT]) const;
	btScalar cutForce(int r) const;
	ReturnMapping mapCut(int r) const;
	bool findMotion(int numRows, btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const;
	void leaveTurnOut(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const;
	void limitFlow(double work, ReturnMapping mapped[BT_EP_DOF_COUNT]) const;
	btScalar shareUntilBreak(const ReturnMapping mapped[]) const;
	void takeBackKinematicMotion();
	FibreStep::Motion beginShear(const Diagonal& diagonal);
	btScalar tauOfFibres(bool hasOtherPast);
	void takeScheme();
	void makeFibres(const FibreStep::Motion& motion, const Diagonal& diagonal, JointRows& rows);
	FibreStep::Outcome commitFibres(ReturnMapping mapped[BT_EP_DOF_COUNT]);
	void projectEnd(btScalar onAxes[BT_EP_DOF_COUNT], btVector3& spin) const;
	bool isUsable(double work) const;
	MeanForce meanForce(int r, btScalar a) const
	{
		if (m_row[r].m_isOfWaves)
			return MeanForce::byMode(tauOfWaves(r));
		const btScalar last = m_row[r].m_isAtRest ? m_dt : lastStep();
		return m_model.m_isByMode && !m_usesFibres ? MeanForce::byMode(m_dt, last) : MeanForce::byRow(a, m_dt, last);
	}
	/// In the step.
	btScalar yieldOf(int dof) const { return m_usesFibres ? m_fibres.yieldOf(dof) : m_yield[dof]; }
	void damp(const btScalar change[BT_EP_DOF_COUNT], const FibreStep::Outcome& fibres);
	double strainEnergy(const btScalar strains[BT_EP_DOF_COUNT]) const;
	double twiceWork(const btScalar velocity1[BT_EP_DOF_COUNT], const btVector3& spin1) const;

	JointModel& m_model;
	int m_numRows = 0;  ///< of a joint with fibres the last three are what these add up to
	int m_numCommittedRows = 0;
	btScalar m_lead = 0;  ///< see getLead() [s]
	bool m_isLeadFound = false;
	btScalar m_dt = 0;
	btScalar m_withheld[BT_EP_DOF_COUNT];  ///< strain that this step leaves to later ones, see withholdDrift()
	btScalar m_withheldStep = 0;
	btScalar m_erp = 0;
	double m_given = 0;  ///< see setWork()
	bool m_hasRecovery = false, m_isCut = false, m_isFree = false, m_usesFibres = false, m_isWorkKnown = false;
	bool m_isEven = false;                 ///< see setEven()
	bool m_areAlike = false;               ///< all rows are springs of one law, see SpringLanes
	bool m_isTensionKnown = false;         ///< m_tension is the step's, see foreseeTension()
	btScalar m_tension[3] = {};            ///< along the joint's axes [N]
	btScalar m_tensionDamping = 0;         ///< that the step is solved with, see TensionDamping::getSum()
	btScalar m_recovery[BT_EP_DOF_COUNT];  ///< J times the motion of places beside velocities
	btScalar m_recoverySpin[2];            ///< of that, how fast bodies A and B turn [rad/s]
	btVector3 m_dampingImpulse;
	btVector3 m_spin0[2];  ///< of A and of B at the start of the step [rad/s]
	MaterialDamping m_damping;
	Kinematics m_kinematics;
	Row m_row[BT_EP_DOF_COUNT];
	signed char m_lastBound[BT_EP_DOF_COUNT] = {};
	/// Yield values in the step, before fibres take of them [N], [N m]. Shears have their friction: what cracks in it has its bond until the end.
	btScalar m_yield[BT_EP_DOF_COUNT] = {};
	FibreStep m_fibres;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINT_STEP_H
