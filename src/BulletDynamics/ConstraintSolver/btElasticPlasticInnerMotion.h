// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_INNER_MOTION_H
#define BT_ELASTIC_PLASTIC_INNER_MOTION_H

#include "LinearMath/btVector3.h"

/// How a body has gone through a substep that the solver has taken in several inner steps, see
/// btElasticPlasticSolverSettings::m_innerError: what an account of its energy needs beside its velocities before and after.
struct btElasticPlasticInnerMotion
{
	int m_steps = 1;                        ///< inner steps
	btVector3 m_way = btVector3(0, 0, 0);   ///< on which its velocity has moved it [m]
	btVector3 m_turn = btVector3(0, 0, 0);  ///< the same of its angular velocity, summed up [rad]
	btVector3 m_pushed =
		btVector3(0, 0, 0);  ///< on which the recovery of penetration has moved it beside its velocity [m]
	double m_work = 0;       ///< of its loads, gravity included, by mean velocities [J]
	/// What its kinetic energy has gained by a change of the time of its velocities [J]. Bullet's velocities belong to a time half a
	/// step before that of its places; a body that falls into inner steps gets the speed that gravity gives it in between, and one that
	/// is free afterwards gives it back.
	double m_shift = 0;
	double m_gravity = 0;  ///< of m_work and m_shift, what the body's weight has given to it [J]
	/// By how much more than others have given to its velocity before the step, what comes in each step alike has given to it as a load within it [J], see
	/// docs/theory.md#inner-steps: in m_work and m_shift, too.
	double m_pushes = 0;
	double m_contacts = 0;  ///< what contacts' normal impulses have given to it [J]
	double m_friction = 0;  ///< the same of their friction [J]
	double m_turning = 0;   ///< the same of the time integration of its turn, gyroscopic torques included [J]
};

#endif  // BT_ELASTIC_PLASTIC_INNER_MOTION_H
