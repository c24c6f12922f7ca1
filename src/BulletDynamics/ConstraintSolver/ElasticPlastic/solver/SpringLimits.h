// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SPRING_LIMITS_H
#define BT_ELASTIC_PLASTIC_SPRING_LIMITS_H

#include "LinearMath/btMinMax.h"
#include "LinearMath/btScalar.h"

class btGeneric6DofSpring2Constraint;

namespace btElasticPlastic
{
/// What a spring of btGeneric6DofSpring2Constraint may be at most in a step: Bullet makes those softer that would swing faster than a step can follow.
class SpringLimits
{
public:
	/// \param dof  of a spring that is enabled, 0 to 5
	/// \param dt   [s]
	SpringLimits(btGeneric6DofSpring2Constraint& constraint, int dof, btScalar dt);

	/// [N/m], [N m/rad]
	btScalar limitStiffness(btScalar stiffness) const
	{
		return m_limitsStiffness ? btMin(stiffness, m_mass / (16 * m_dt * m_dt)) : stiffness;
	}
	/// [N s/m], [N m s/rad]
	btScalar limitDamping(btScalar damping) const { return m_limitsDamping ? btMin(damping, m_mass / m_dt) : damping; }

private:
	btScalar m_mass;  ///< that Bullet takes the spring to move [kg], [kg m^2]
	btScalar m_dt;
	bool m_limitsStiffness, m_limitsDamping;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SPRING_LIMITS_H
