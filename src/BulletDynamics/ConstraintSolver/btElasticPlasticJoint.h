// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_H
#define BT_ELASTIC_PLASTIC_JOINT_H

#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"
#include "btElasticPlasticCapacity.h"
#include "btElasticPlasticEvent.h"
#include "btElasticPlasticPrecision.h"
#include "btElasticPlasticState.h"

namespace btElasticPlastic
{
class JointWorks;
}

/// Which rows a joint gives to the solver.
enum btElasticPlasticScheme : int  // of a fixed type: a value that is none can be passed, and is the default
{
	BT_EP_SCHEME_IMPLICIT,  ///< the default, see docs/theory.md
	/// What the step does not resolve is damped by the frequency of a structure's mode, not by the stiffness of each row: swings and blows
	/// keep their energy, however finely a member is divided. All joints of a structure should have it. Fibres are damped as by
	/// default, whatever the scheme. See docs/theory.md.
	BT_EP_SCHEME_BY_MODE,
	BT_EP_SCHEME_PAPER  ///< the paper's, as a baseline: wrong at many steps, see docs/theory.md
};

/// The elastic-plastic part of a joint, shared by both constraint classes: what is set, and what is read.
class btElasticPlasticJoint
{
public:
	// ---- settings

	/// Makes every degree of freedom with a yield value elastic-plastic and takes Bullet's own limit, motor and spring off it;
	/// for good: one that a later capacity leaves out is free, until Bullet's setLimit() says otherwise. Those that never had
	/// a yield value are as Bullet's class made them: translations locked, rotations free, unless set.
	/// Before or after btDynamicsWorld::addConstraint, also while running. Frames that do not meet load the joint from the
	/// first step; only a misfit of the size of rounding is taken for none (setReferenceToCurrentPose() takes any).
	/// Under load a spring that becomes softer keeps its deformation, and one that becomes stiffer its force: its energy never grows.
	/// What bows by another length than before is not stretched by that.
	/// \return false, and the joint stays out of the simulation, if the capacity or the bodies have a fault (see fault()); the listener of
	/// the joint's action is told. A capacity with a fault is not kept: the joint stays out until it gets another one. Once what is wrong
	/// with its bodies is mended, setCapacity() or btElasticPlasticAction::addJoint() takes the joint in.
	bool setCapacity(const btElasticPlasticCapacity& capacity);
	const btElasticPlasticCapacity& getCapacity() const;

	/// Takes effect with the next step. Default: BT_EP_SCHEME_IMPLICIT.
	void setScheme(btElasticPlasticScheme scheme);
	btElasticPlasticScheme getScheme() const;

	/// For error messages and reports; up to 31 characters are kept. Default: empty.
	void setName(const char* name);
	const char* getName() const { return m_name; }

	/// Has an event come (BT_EP_EVENT_LEVEL) when a quantity of the joint rises to a level, and again once it has been below nine
	/// tenths of it meanwhile. Nothing else happens: the joint does not break by it.
	/// \param level  > 0, in the quantity's unit; btElasticPlasticCapacity::unlimited(), the default: no event
	/// \return false, and nothing changes, if the quantity is none or the level out of its range
	bool setLevel(btElasticPlasticQuantity quantity, btScalar level);
	btScalar getLevel(btElasticPlasticQuantity quantity) const;

	/// The present value of a quantity, of what was applied in the last substep; 0 of what is none.
	btScalar getQuantity(btElasticPlasticQuantity quantity) const;

	/// Makes the bodies' present pose the one without force, keeping plastic deformation as it is counted.
	void setReferenceToCurrentPose();

	// ---- readings, all as of the last commit

	/// Force or moment by the law [N], [N m]: stiffness times elastic deformation, and what the material's damping adds. Within the yield value, but for shears with
	/// friction or beside fibres, and for axial force and bendings of a joint with fibres, which may harden. It acts on body A
	/// along the joint's axis and on body B against it: positive axial force is tension. A solver that leaves an error
	/// leaves elastic deformation that it has applied no force for: see getAppliedForce().
	btScalar getForce(int dof) const;

	/// Mean force or moment that the joint has really applied in the last substep [N], [N m], impulse over time. With the
	/// direct solver the same as getForce() but for the mean over the step.
	btScalar getAppliedForce(int dof) const;

	/// Axis of the degree of freedom (translation along it, rotation about it) in world coordinates, at the start of the last
	/// substep: half way between the frames of the two bodies.
	const btVector3& getJointAxis(int dof) const;

	/// Elastic deformation, force over stiffness [m], [rad]; 0 where rigid-plastic.
	btScalar getElasticDeformation(int dof) const;

	/// Plastic deformation with its sign [m], [rad].
	btScalar getPlasticDeformation(int dof) const;

	/// Sum of the absolute values of plastic increments [m], [rad].
	btScalar getPlasticPath(int dof) const;

	/// |applied force| over yield, of shears with what friction adds to it now: 1 is yield.
	btScalar getUtilisation(int dof) const;

	/// The largest utilisation, and which degree of freedom has it (-1: none). With fibres that of the section counts too: the sum of what
	/// they bear over the sum of what they could.
	btScalar getUtilisation(int* limitingDof = nullptr) const;

	/// Share of the ductility of one degree of freedom that is spent; of the axial force and bendings of a joint with fibres that of all of
	/// them.
	btScalar getDamage(int dof) const;

	/// Share of the joint's ductility that is spent, the sum over the degrees of freedom (Miner's rule); 1 breaks it. Fibres count
	/// together, with the share of the section's strength that is spent.
	btScalar getDamage() const;

	/// What a fibre shows, by its index in btElasticPlasticCapacity::m_fibres; zeros of one that there is not.
	btElasticPlasticFibreReading getFibre(int index) const;

	/// The fibre that rules: of those that bear, the one with the most damage or, while there is none, with the largest utilisation. -1: none
	/// is loaded
	int getRulingFibre() const;

	/// Stored in the springs, f^2 / 2k [J]; of a broken joint: what it held when it broke, lost in the fracture. With a solver whose iterations
	/// may end before the solution, as far as the bodies have given for it: the strain that such a solver leaves is no energy. Places are half
	/// a step ahead of velocities: what the springs took in the last half of a step is told when bodies have given it.
	double getElasticEnergy() const;

	/// Dissipated by plastic flow, force times way (m_plasticEnergy of the state) [J]; with the iterative form and Bullet's own solvers, and until the joint
	/// first unloads, as far as the bodies have given for it.
	double getPlasticEnergy() const;

	/// Dissipated by the material's damping, as far as the bodies have given for it, as plastic energy is [J].
	double getDampingEnergy() const;

	/// Taken from the bodies by the joint in all, less elastic, plastic and damping energy: what the time integration has dissipated [J].
	/// May be a little negative with the direct form: plastic flow counts by the step's last velocity, work by its mean one. What fibres held as they
	/// ruptured is in it, too.
	double getNumericalEnergy() const;

	/// Taken from the bodies by the joint in all [J].
	double getWork() const;

	/// The number of the joint's rows in the last substep, 0 if it had no part in it; and of each row the degree of freedom,
	/// and the rate at which its deformation grew before and after the substep [m/s], [rad/s]; of a row that there is not, 0. What a
	/// step control makes of them is in docs/performance.md.
	int getNumCommittedRows() const;
	void getCommittedRow(int r, int& dof, btScalar& rateBefore, btScalar& rateAfter) const;

	bool hasYielded() const;
	bool isBroken() const;

	/// What keeps the joint out of the simulation, false if nothing does: a fault of its capacity, frames or bodies, until it is set
	/// anew or added again; or what has kept it out of the last substep, as a body that is in no world or not finite.
	const btElasticPlasticFault& fault() const;

	/// "joint 'name' (id i) at (x, y, z): quantity is value; it must be range", always terminated. The name is that of setName(), the
	/// id that of btTypedConstraint::setUserConstraintId(); what is not set is left out.
	void printFault(char* text, int capacity) const;

	const btElasticPlasticState& getState() const;
	/// Puts a state back, of this joint or of its like in another world. It does not move bodies: put them back, too, and their
	/// velocities and sleep.
	/// A joint that the state makes broken bears nothing from now on, and leaves its world at the end of the next substep, without an
	/// event; until then its bodies do not collide, if they did not while it held. One that the state makes hold again goes back
	/// into its world.
	/// \return false, with a message to the listener, and the joint stays as it is, if a number in it is not finite or beyond 1e37 in float, 1e250 in double, a rotation not
	/// of unit length, a force beyond 64 times the joint's yield value or a fibre's strength, a path, an energy, the step or a fibre's damage, path or rate negative, the
	/// level of inner steps above 12, the number of fibres not that of the joint's capacity, or if the joint is to go back into its world and a body of it is in none
	bool setState(const btElasticPlasticState& state);

	btTypedConstraint& getConstraint();
	const btTypedConstraint& getConstraint() const;

	/// World position of the joint: half way between its frames' origins.
	btVector3 getPosition() const;

	/// The joint's frame on each body, world coordinates.
	btTransform getFrameA() const;
	btTransform getFrameB() const;

	/// Finds the elastic-plastic joint of a constraint without run-time type information. \return null if it has none
	static btElasticPlasticJoint* from(btTypedConstraint* constraint, btElasticPlasticOwnPrecision = {});

	btElasticPlasticJoint(const btElasticPlasticJoint&) = delete;
	btElasticPlasticJoint& operator=(const btElasticPlasticJoint&) = delete;

protected:
	btElasticPlasticJoint(btTypedConstraint& constraint, const btTransform& frameInA, const btTransform& frameInB);
	~btElasticPlasticJoint();

	/// Takes Bullet's limit, motor and spring off a degree of freedom.
	virtual void releaseBase(int dof) = 0;

	/// Does Bullet's class have a limit, motor or spring on any degree of freedom?
	virtual bool isBaseActive() = 0;

	/// Brings the frames that Bullet draws under btIDebugDraw::DBG_DrawConstraints to where the bodies are.
	virtual void updateDrawnFrames() = 0;

	// What Bullet asks a constraint, for the elastic-plastic part of it.

	/// Before buildJacobian() of Bullet's class.
	void buildElasticPlastic();

	/// Begins a step. \return number of elastic-plastic rows, which come after those of Bullet's class
	int countElasticPlasticRows();

	/// Does Bullet's class have to be asked for rows too?
	bool hasBaseRows();

	/// Writes the rows that were counted, beginning at firstRow.
	void writeElasticPlasticRows(btTypedConstraint::btConstraintInfo2* info, int firstRow);

	/// Answers from(). Does nothing if the caller is not from().
	void answer(btSolverBody& asked);

	// For a file of Bullet's, see btElasticPlasticBulletFile.h.

	/// Whether a file keeps the joint as elastic-plastic.
	bool isInFile() const;

	/// Writes a block beside what Bullet's class writes of itself.
	void serializeElasticPlastic(btSerializer& serializer) const;

	/// Locks what is elastic-plastic in the data that Bullet's class has written of itself, at the pose to which the joint has bent.
	template <class Data>
	void lockInFile(Data& data) const
	{
		getReferenceInA().serialize(data.m_rbAFrame);
		for (int i = 0; i < 3; ++i)
		{
			if (getCapacity().isElasticPlastic(i))
				data.m_linearLowerLimit.m_floats[i] = data.m_linearUpperLimit.m_floats[i] = 0;
			if (getCapacity().isElasticPlastic(3 + i))
				data.m_angularLowerLimit.m_floats[i] = data.m_angularUpperLimit.m_floats[i] = 0;
		}
	}

private:
	btTransform getReferenceInA() const;

	friend class btElasticPlasticAction;
	friend class btElasticPlastic::JointWorks;

	btElasticPlastic::JointWorks* const m_works;
	char m_name[32] = {};
};

#endif  // BT_ELASTIC_PLASTIC_JOINT_H
