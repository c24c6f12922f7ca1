// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_MODEL_H
#define BT_ELASTIC_PLASTIC_JOINT_MODEL_H

#include "../../btElasticPlasticCapacity.h"
#include "../../btElasticPlasticState.h"
#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"
#include "Kinematics.h"
#include "SectionStiffness.h"

namespace btElasticPlastic
{
/// Whether a number other than an energy may be in a state: arithmetic with it stays finite.
inline bool canBeKept(btScalar value)
{
	return btElasticPlasticIsFinite(double(value)) && btFabs(value) <= btElasticPlasticCapacity::greatestYield();
}

/// \return a fault if a state has a number that none keeps, whatever its joint
btElasticPlasticFault findNumberFault(const btElasticPlasticState& state);

/// A joint between steps: its two bodies and frames, its capacity, and its state.
struct JointModel
{
	btTypedConstraint& m_constraint;
	/// Of the constraint, which has them elsewhere in memory: a step's end uses nothing else of it.
	btRigidBody &m_bodyA, &m_bodyB;
	const btTransform& m_frameInA;
	const btTransform& m_frameInB;
	unsigned m_dofs = 0;  ///< bit i: degree of freedom i is elastic-plastic
	bool m_isPaper = false;
	bool m_isByMode = false;
	bool m_hasReference = false;  ///< has had a capacity
	btElasticPlasticFault m_fault;
	btElasticPlasticFault m_refused;  ///< of the capacity that was to take the place of m_capacity, and has not
	btElasticPlasticState m_state;
	btElasticPlasticCapacity m_capacity;

	JointModel(btTypedConstraint& constraint, const btTransform& frameInA, const btTransform& frameInB)
		: m_constraint(constraint),
		  m_bodyA(constraint.getRigidBodyA()),
		  m_bodyB(constraint.getRigidBodyB()),
		  m_frameInA(frameInA),
		  m_frameInB(frameInB)
	{
	}

	btRigidBody& bodyA() const { return m_bodyA; }
	btRigidBody& bodyB() const { return m_bodyB; }
	bool isElasticPlastic(int dof) const { return (m_dofs >> dof & 1u) != 0; }
	/// What the joint bears of a turn about one of its axes: its stiffness, or what yields within a radian [N m].
	btScalar momentWithinARadian(int dof) const
	{
		if (!isElasticPlastic(dof))
			return 0;
		const btScalar yield = m_capacity.m_yield[dof];
		return m_capacity.isRigidPlastic(dof) ? yield : btMin(yield, m_capacity.m_stiffness[dof]);
	}
	btScalar bendingWithinARadian() const
	{
		return btMax(momentWithinARadian(BT_EP_BENDING_Y), momentWithinARadian(BT_EP_BENDING_Z));
	}

	/// Whether the strength in bending is next to nothing beside that in tension. By the frames alone: a joint that has not been in a step has no other
	/// arms.
	bool isOfRope() const
	{
		const btScalar arm = btMin(m_frameInA.getOrigin().length(), m_frameInB.getOrigin().length());
		return !m_isPaper && bendingWithinARadian() < btScalar(1e-3) * arm * m_capacity.m_yield[BT_EP_AXIAL];
	}
	bool isElasticPlasticThroughout() const { return m_dofs == (1u << BT_EP_DOF_COUNT) - 1; }

	/// The joint's frame on each body, world coordinates.
	btTransform frameA() const;
	btTransform frameB() const;

	/// The static or kinematic body that the joint stands on; null: none.
	const btRigidBody* support() const;

	/// Axes, arms and elastic deformation at the bodies' present transforms.
	/// \param lead  by which time kinematic bodies are shown ahead of where they are [s]
	void measure(Kinematics& kinematics, btScalar lead = 0) const;

	/// The same with the support at a place.
	void measureAt(Kinematics& kinematics, const btTransform& place) const;

	/// What rounding may make of a strain that is measured at the bodies' present transforms [m], [rad].
	btScalar strainRounding(int dof) const;

	/// What keeps the joint out of the simulation until it is set anew: a fault of its capacity, its frames or its bodies.
	btElasticPlasticFault findFault() const;

	/// \return a fault if a body that can move is in no world: it has to be added to one before it can be joined
	btElasticPlasticFault findMissingWorld() const;

	/// What keeps the joint out of the present step: a fault of one of its bodies.
	btElasticPlasticFault findStepFault() const;

	/// \return a fault if a state cannot be one of this joint
	btElasticPlasticFault findStateFault(const btElasticPlasticState& state) const;

	/// Sets the capacity alone; the state that belongs to it comes from elsewhere.
	void setCapacity(const btElasticPlasticCapacity& capacity);

	/// Makes those degrees of freedom elastic-plastic that have a yield value in a capacity without a fault. Those of them that were free
	/// until now take the present pose for their reference.
	void takeCapacity(const btElasticPlasticCapacity& capacity);

	/// Makes the bodies' present pose the one without force, keeping plastic deformation as it is counted.
	void setReferenceToCurrentPose();

	/// Turns the plastic rotation so that the elastic rotation that is measured at the present pose loses the increment.
	/// \param increment  of all degrees of freedom, of which the rotations are used
	/// \return by how much the axial strain has grown since the member bows less, see Kinematics::bow() [m]
	btScalar turnReference(const btScalar increment[BT_EP_DOF_COUNT]);

	/// Has the reference turn with the bodies about what is free. Deformations stay as they are; with the turn among them, springs would
	/// do more work than they take.
	/// \param before  as the step began
	void followFreeTurn(const Kinematics& before);

	/// Reduces the elastic deformation at the present pose by moving the reference, without counting that as plastic [m],
	/// [rad].
	void moveReference(const btScalar deformation[BT_EP_DOF_COUNT]);

	/// That belongs to the present force. Only the direct form knows coupling, and only the implicit law.
	btScalar elasticDeformation(int dof) const { return elasticDeformation(m_capacity, dof); }
	btScalar elasticDeformation(const btElasticPlasticCapacity& capacity, int dof) const
	{
		if (m_state.m_solvedExactly && !m_isPaper && hasFibreStrain(capacity, dof))
			return m_state.m_fibreStrain[dof == BT_EP_AXIAL ? 0 : dof - BT_EP_TORSION];
		return elasticDeformation(capacity, m_state.m_force, dof);
	}
	btScalar elasticDeformation(const btElasticPlasticCapacity& capacity, const btScalar force[BT_EP_DOF_COUNT],
								int dof) const
	{
		if (m_state.m_solvedExactly && !m_isPaper)
			return capacity.elasticDeformation(force, dof);
		return capacity.m_stiffness[dof] > 0 ? force[dof] / capacity.m_stiffness[dof] : btScalar(0);
	}

	/// In the springs, and in those by which the material damps [J].
	double elasticEnergy() const;

	/// Of what has been dissipated, the share that bodies have given for so far.
	double paidShare() const;

	/// After a step that has been solved exactly: what bodies still owe for what the joint has taken before it first unloads.
	/// \param share  of the world's step: 1, or less of an inner one
	/// \param isNew  the joint has its first step of the world
	/// \param taken  by its force along the way of the step, at the velocities of its end [J]
	/// \param aheadBefore  aheadOfWork() before the step if nothing acts from outside on what the joint is part of, else null
	void findOwed(double share, bool isNew, double taken, const double* aheadBefore);

	/// By how much what the joint holds and has dissipated is more than bodies have given it [J].
	double aheadOfWork() const { return springEnergy() + dissipatedEnergy() - m_state.m_work; }

	/// By flow and by damping, whether it has been given for or not [J].
	double dissipatedEnergy() const { return m_state.m_plasticEnergy + m_state.m_dampingEnergy; }

	/// Of the springs' forces and deformations [J].
	double springEnergy() const;

	/// The part of it that bodies give in the next half of a step only [J].
	double springsAhead() const;

	/// Share of the ductility that is spent, the sum over the degrees of freedom (Miner's rule), with fibres of the section as one.
	btScalar damage() const
	{
		btScalar sum = usesFibres() ? fibreDamage() : btScalar(0);
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			sum += isOfFibres(i) ? btScalar(0) : damage(i);
		return sum;
	}
	btScalar damage(int dof) const
	{
		return isOfFibres(dof) ? fibreDamage() : m_state.m_plasticPath[dof] / m_capacity.m_ductility[dof];
	}

	/// What fibres bear over what they could, 0 without fibres.
	btScalar fibreUtilisation() const;

	btElasticPlasticFibreReading readFibre(int fibre) const;

	/// Whether fibres stand for the axial force and the bending moments, for a solver that knows them.
	bool usesFibres() const { return m_capacity.hasFibres() && !m_isPaper && !m_fault; }

	/// What an elastic step asks of a fibre, close together: of thousands of joints the processor loads it anew in each pass over them.
	struct BearingFibre
	{
		btScalar m_y, m_z, m_stiffness, m_tension, m_compression;
	};
	btAlignedObjectArray<BearingFibre> m_bearing;
	btScalar m_reach[2] = {0, 0};  ///< of all fibres, from the axes of bending about y and about z [m]
	bool m_areSteady = true;       ///< all of them, see btElasticPlasticFibre::isSteady()

	/// What a fibre at rest bears in tension and in compression as it is now, and with so much more plastic path [N].
	struct FibreStrength
	{
		btScalar m_tension, m_compression;
	};
	FibreStrength strengthOf(int fibre, btScalar morePath = 0) const;

	/// Which share of a section holds together: all of it, but for fibres that are cracked or torn.
	btScalar bondedShare() const;

	/// The yield value of a degree of freedom under a pressure on the section, without what shears and torsion take of each other.
	/// \param pressure  [N], negative: none
	btScalar yieldUnder(btScalar pressure, int dof) const
	{
		const btScalar own = m_capacity.m_yield[dof];
		if (!(m_capacity.m_friction > 0) || (dof != BT_EP_SHEAR_Y && dof != BT_EP_SHEAR_Z))
			return own;
		return own * bondedShare() + m_capacity.m_friction * btMax(pressure, btScalar(0));
	}

	/// Whether a fibre opens without a force.
	bool bearsPressureOnly(int fibre) const
	{
		return m_bearing[fibre].m_tension == 0 || m_state.m_fibres[fibre].m_isCracked;
	}

	/// Whether any that is left does.
	bool anyBearsPressureOnly() const
	{
		for (int i = 0; i < m_bearing.size(); ++i)
			if (bearsPressureOnly(i) && !m_state.m_fibres[i].isRuptured())
				return true;
		return false;
	}

	/// Whether a fibre has a part in what the section bears: neither ruptured nor open.
	bool bears(int fibre) const
	{
		const btElasticPlasticFibreState& state = m_state.m_fibres[fibre];
		return !state.isRuptured() && !(state.m_force >= 0 && bearsPressureOnly(fibre));
	}

	bool doAllBear() const
	{
		bool doAll = true;
		for (int i = 0, n = m_state.m_fibres.size(); i < n; ++i)
			doAll &= bears(i);
		return doAll;
	}

	/// Of the fibres that bear.
	SectionCompliance bearingCompliance() const { return doAllBear() ? m_wholeCompliance : partCompliance(); }
	/// While all do.
	const SectionCompliance& getWholeCompliance() const { return m_wholeCompliance; }

	/// What one of the damping's branches adds to the section.
	SectionForces branchForces(int branch) const
	{
		const btScalar* const q = m_state.m_branch[branch];
		return {double(q[BT_EP_AXIAL]), double(q[BT_EP_BENDING_Y]), double(q[BT_EP_BENDING_Z])};
	}

	/// That of all the damping's branches together, under which they have their forces.
	SectionPlane branchPlane() const;

	/// Sets the fibres' state from the joint's forces, where a solver has not known them.
	void followFibres();

	/// Spends a share of the ductility of all fibres, by flow under a solver that has not known them.
	void wearFibres(btScalar damage);

private:
	SectionCompliance m_wholeCompliance;  ///< see getWholeCompliance()
	SectionCompliance partCompliance() const;

	RelativeRotation relativeRotation() const;
	bool measureReference(Kinematics& kinematics) const;

	void measureBetween(Kinematics& kinematics, const btTransform& placeA, const btTransform& placeB) const;
	bool pointsTowardsB() const;
	/// For Kinematics::bow(), of a member with a length.
	struct BowedLengths
	{
		btScalar m_y, m_z;
	};
	BowedLengths bowedLengths() const;
	void takeRoundingAsReference();
	void takePoseAsReference(unsigned dofs);

	/// What springs hold before their stiffness changes.
	struct Stretch
	{
		btScalar m_deformation[BT_EP_DOF_COUNT];
		btAlignedObjectArray<btScalar> m_elongation;  ///< of fibres [m]
		double m_energy;                              ///< [J]
	};
	Stretch findStretch() const;
	bool hasFibresAt(const btElasticPlasticCapacity& before) const;
	void soften(const btElasticPlasticCapacity& before, double most, bool areSame);
	void scaleForce(int dof, btScalar factor);
	btScalar limitEnergy(double most);
	void sumFibres();
	void followBow(const BowedLengths& before);
	void followStiffness(const btElasticPlasticCapacity& before, const Stretch& stretch);
	void takeFibres(const Stretch& stretch, bool areSame);
	btScalar elasticElongation(const btElasticPlasticCapacity& capacity, int fibre) const;
	btScalar forceOf(int fibre, const SectionPlane& branches) const;
	bool isOfFibres(int dof) const { return btElasticPlasticCapacity::isOfFibres(dof) && usesFibres(); }
	bool hasFibreStrain(const btElasticPlasticCapacity& capacity, int dof) const
	{
		return btElasticPlasticCapacity::isOfFibres(dof) && capacity.hasFibres() && m_state.m_fibres.size() > 0;
	}
	btScalar fibreDamage() const;
	btScalar mostForce(const btElasticPlasticState& state, int dof) const;
	btScalar mostForce(const btElasticPlasticFibreState& state, const btElasticPlasticFibre& fibre) const;
	btElasticPlasticFault findFibreFault(const btElasticPlasticState& state) const;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINT_MODEL_H
