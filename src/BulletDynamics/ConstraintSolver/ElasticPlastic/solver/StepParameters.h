// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEP_PARAMETERS_H
#define BT_ELASTIC_PLASTIC_STEP_PARAMETERS_H

#include "Islands.h"
#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
/// What Bullet's constraints have for a step, and what that is in a shorter one.
///  - Impulses that bound what would better be bound by a force (a constraint's breaking threshold, the motors of hinges and cone twists, the
///    clamp of ball sockets): less in proportion.
///  - Their own factors of error reduction (limits of hinges, sliders, cone twists and of our joints' free directions): by the square. An error that a
///    long step has left, closed by the same share in a short one, would come out as many times as fast; and in proportion it would be closed with
///    one speed through all of them, by a motor that feeds what rings. Bullet's common factor is in btContactSolverInfo.
///  - Springs of btGeneric6DofSpring2Constraint: what Bullet lets them be in the whole step. One that a long step has let get deep, and a short one is stiffer by,
///    gives what nobody has put into it.
class StepParameters
{
public:
	/// \param share  of the world's step
	/// \param dt     of the world's step [s]
	void scale(const SolverGroup& island, btScalar share, btScalar dt);

	/// The same for one more constraint. \param hasRows  whether it has rows of Bullet's
	void scale(btTypedConstraint& constraint, bool hasRows, btScalar share, btScalar dt);

	void restore();

	/// Where others have had a say meanwhile: what they have changed stays as it is.
	/// \param exists  function of a constraint, whether it is known to exist; one that is not is left for the next time
	template <class Exists>
	void restoreWhere(const Exists& exists)
	{
		int left = 0;
		for (int i = 0; i < m_held.size(); ++i)
			if (exists(m_held[i].m_constraint))
				giveBack(m_held[i], true);
			else
				m_held[left++] = m_held[i];
		m_held.resize(left);
	}

	bool isAnyHeld() const { return m_held.size() > 0; }

private:
	enum
	{
		MOST_FACTORS = 6,
		MOST_SPRINGS = 6
	};

	struct Value
	{
		btScalar m_own, m_scaled;

		bool isScaled() const { return m_scaled != m_own; }
		btScalar restored(btScalar present, bool mayBeChanged) const
		{
			return mayBeChanged && present != m_scaled ? present : m_own;
		}
	};

	struct Held
	{
		btTypedConstraint* m_constraint;
		int m_type;  ///< by which another constraint at its address is told from it
		Value m_threshold, m_impulse;
		unsigned m_factors = 0;  ///< bit i: has the factor i
		Value m_factor[MOST_FACTORS] = {};
		unsigned m_springs = 0;  ///< bit i: has the spring i
		Value m_stiffness[MOST_SPRINGS] = {}, m_damping[MOST_SPRINGS] = {};
	};

	static void giveBack(const Held& held, bool mayBeChanged);

	btAlignedObjectArray<Held> m_held;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STEP_PARAMETERS_H
