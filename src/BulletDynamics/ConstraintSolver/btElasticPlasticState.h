// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STATE_H
#define BT_ELASTIC_PLASTIC_STATE_H

#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btTransform.h"
#include "btElasticPlasticFibre.h"

/// All that a joint remembers from step to step. Copy it to save, put it back to rewind.
/// The arrays run over the degrees of freedom (btElasticPlasticDof), components of the mid frame.
struct btElasticPlasticState
{
	BT_DECLARE_ALIGNED_ALLOCATOR();

	enum
	{
		BRANCHES = 3
	};

	btQuaternion m_plasticRotation = btQuaternion(0, 0, 0, 1);  ///< turn of the reference, in frame A
	btQuaternion m_plasticMiddle =
		btQuaternion(0, 0, 0, 1);         ///< the half of it that belongs to A: the unstrained mid frame, in frame A
	btScalar m_plastic[6] = {};           ///< plastic deformation, signed sum of increments [m], [rad]
	btScalar m_initial[3] = {};           ///< offset of the frames at which the joint is free of force [m], not plastic
	btScalar m_lastStep = 0;              ///< [s]
	btScalar m_force[6] = {};             ///< of the springs, stiffness times elastic deformation [N], [N m]
	btScalar m_branch[BRANCHES][6] = {};  ///< of the branches by which a material damps (MaterialDamping.h) [N], [N m]
	btScalar m_forceRate[6] =
		{};  ///< of springs and branches in the last step, their change over its length [N/s], [N m/s]
	btScalar m_load[2][6] =
		{};  ///< on bodies A and B in the last step, beside their weight: force [N], torque [N m], world axes
	btScalar m_given[2][6] =
		{};  ///< what others have added to the velocities of bodies A and B before the last step, over its length [m/s^2], [rad/s^2], world axes
	bool m_isGiven = false;            ///< whether that is anything
	btScalar m_withheld[6] = {};       ///< drift that shorter steps still have to take back [m], [rad]
	btScalar m_withheldStep = 0;       ///< length of the step that left it [s]
	btScalar m_spin[2] = {};           ///< how fast the last step has turned bodies A and B at most [rad/s]
	bool m_solvedExactly = false;      ///< the last step, by a solver that knows which rows are at a bound
	btScalar m_applied[6] = {};        ///< mean force that was applied in the last substep [N], [N m]
	btScalar m_appliedBefore[6] = {};  ///< in the one before it
	bool m_yielded = false;            ///< has flowed at least once
	bool m_broken = false;
	// In double whatever Bullet's precision: sums over many steps.
	double m_work = 0;           ///< taken from the bodies [J]
	double m_plasticEnergy = 0;  ///< dissipated by plastic flow, force at yield times path [J]
	double m_dampingEnergy = 0;  ///< dissipated by the material's damping [J]
	double m_storedEnergy =
		0;  ///< below 0: what bodies still owe for the two above and the springs [J]. Where no exact solver has the
			///< joint (EnergyLedger.h), otherwise: in the springs, as far as they have given for it
	double m_placeEnergy = -1;       ///< there: of the bodies' places when the last step had ended; -1: not known [J]
	btScalar m_plasticPath[6] = {};  ///< sum of |increment| [m], [rad]
	btScalar m_watched[6] = {};      ///< deformation, elastic and plastic, when the load last changed [m], [rad]
	unsigned m_passedLevels =
		0;  ///< bit q: quantity q (btElasticPlasticQuantity) has passed its level and not fallen below it
	/// The static or kinematic body that the joint stands on, as it was when the last substep had ended.
	struct Support
	{
		enum Kind : unsigned char
		{
			NOT_SEEN,  ///< not looked for yet
			NONE,
			SEEN
		};
		unsigned char m_kind = NOT_SEEN;
		btTransform m_place = btTransform::getIdentity();  ///< [m]
		btScalar m_lead = 0;  ///< by which a kinematic body is shown ahead of its way, see SupportWay.h [s]
		btScalar m_late =
			0;  ///< by which the joint still follows it late, since it has moved while the joint slept [s]
	} m_support;

	/// Of a joint with fibres, in the capacity's order. Their forces add up to m_force in the axial direction and in bending.
	btAlignedObjectArray<btElasticPlasticFibreState> m_fibres;
	btScalar m_fibreStrain[3] =
		{};  ///< elastic elongation and turns about y and z at the end of the last step [m], [rad]

	/// In how many inner steps the joint's island has taken the last step (btElasticPlasticSolverSettings::m_innerError). Islands join and part;
	/// their joints remember it.
	struct InnerRhythm
	{
		unsigned char m_level = 0;  ///< 1 << m_level inner steps
		unsigned char m_calm = 0;   ///< successive steps that have left little open
		unsigned char m_spare =
			0;  ///< by so many levels less they would all have left less than half of the error allowed
		unsigned char m_quiet = 0;  ///< successive steps in which nothing has flowed, as far as they count
		float m_ringing = 0;  ///< how fast joints have moved meanwhile, yield values times rates of deformation [W]
	} m_innerRhythm;

	/// Makes a degree of freedom free of force.
	void forget(int dof)
	{
		m_force[dof] = m_forceRate[dof] = m_applied[dof] = m_appliedBefore[dof] = m_withheld[dof] = 0;
		for (btScalar* branch : m_branch)
			branch[dof] = 0;
	}

	/// Linear offset of the reference, plastic and initial [m].
	btVector3 offset() const
	{
		return btVector3(m_plastic[0] + m_initial[0], m_plastic[1] + m_initial[1], m_plastic[2] + m_initial[2]);
	}
};

#endif  // BT_ELASTIC_PLASTIC_STATE_H
