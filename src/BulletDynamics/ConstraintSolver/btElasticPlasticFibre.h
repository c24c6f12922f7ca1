// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FIBRE_H
#define BT_ELASTIC_PLASTIC_FIBRE_H

#include "LinearMath/btScalar.h"

/// One of the strips of which a joint's section consists where axial force and bending moments yield together: a spring along the
/// joint's x axis that yields by itself. With the elongation e and the turns a_y, a_z of the section, it is stretched by
/// e + z a_y - y a_z, and its force f gives N = f, M_y = z f, M_z = -y f.
struct btElasticPlasticFibre
{
	btScalar
		m_y = 0,
		m_z =
			0;  ///< its place in the section, in the joint's frame [m], at most btElasticPlasticCapacity::greatestLength()
	btScalar m_stiffness = 0;  ///< [N/m], btElasticPlasticCapacity::leastStiffness() to 1e24
	btScalar m_tension =
		0;  ///< force at which it flows when it is stretched [N], finite, >= 0; 0: it opens, and closes again
	btScalar m_compression = 0;  ///< the same when it is pressed [N]; not both 0
	/// Plastic elongation at which it ruptures [m], > 0. If it is weaker in tension than in compression it cracks there: all of this is the width
	/// of the crack, which opens further without a force, and bears again where it is closed. A joint all of whose fibres gape wider than this is
	/// broken, of fibres that had to be torn for it twice as wide.
	btScalar m_stretchLimit = btScalar(BT_LARGE_FLOAT);
	btScalar m_crushLimit = btScalar(BT_LARGE_FLOAT);  ///< plastic shortening at which it is crushed [m], > 0
	/// Its strength in tension falls linearly as its damage grows, to 0 at 1. \pre m_stretchLimit is given
	bool m_softens = false;
	/// How its strength changes as it flows to and fro, points m_firstPoint to m_firstPoint + m_numPoints - 1 of
	/// btElasticPlasticCapacity::m_curvePoints; none: it stays.
	int m_firstPoint = 0, m_numPoints = 0;
	/// Rate of its plastic elongation at which it is twice as strong as at rest [m/s], >= 0, by 1 + (rate / m_rateReference)^(1 / m_rateExponent); 0:
	/// its strength knows no rate.
	btScalar m_rateReference = 0;
	btScalar m_rateExponent = 5;  ///< >= 1
	/// Of the section, by which events name it: 0 is the section itself, i the i-th bar or part that was added; an added part's bars come after
	/// it. A layer of the fibre before, as hardening makes them, has its part and its place.
	int m_part = 0;
	/// Whether the shears and the torsion of the joint take of its strength, if the lesser of m_tension and m_compression is a tenth of the greater
	/// one at least, and, where both differ, the capacity has no m_friction. The rest below is of one that does.
	bool m_bearsShear = false;
	/// Direction of the wall along which it is sheared, a unit vector of y and z; 0: in any direction.
	btScalar m_wall[2] = {0, 0};
	/// Along y and z, its slip by a twist of 1, which turns it about x [m]. Fibres share torsion by what they have of it by comparison. Those on walls
	/// around the axis that slip as they turn about it are of a closed section, and warp.
	btScalar m_twist[2] = {0, 0};

	/// Whether its strength stays as it is until it cracks or ruptures: neither flow nor rate changes it.
	bool isSteady() const { return m_numPoints == 0 && !m_softens && !(m_rateReference > 0); }

	bool isSameAs(const btElasticPlasticFibre& other) const
	{
		return m_y == other.m_y && m_z == other.m_z && m_stiffness == other.m_stiffness &&
			   m_tension == other.m_tension && m_compression == other.m_compression &&
			   m_stretchLimit == other.m_stretchLimit && m_crushLimit == other.m_crushLimit &&
			   m_firstPoint == other.m_firstPoint && m_numPoints == other.m_numPoints &&
			   m_rateReference == other.m_rateReference && m_rateExponent == other.m_rateExponent &&
			   m_softens == other.m_softens && m_part == other.m_part && m_bearsShear == other.m_bearsShear &&
			   m_wall[0] == other.m_wall[0] && m_wall[1] == other.m_wall[1] && m_twist[0] == other.m_twist[0] &&
			   m_twist[1] == other.m_twist[1];
	}

	/// Whether the two are layers of one piece of the section, which fails when all of them have.
	bool isLayerOf(const btElasticPlasticFibre& other) const
	{
		return m_part == other.m_part && m_y == other.m_y && m_z == other.m_z;
	}
};

/// A point of a fibre's strength over its plastic path. Between points it is linear, from 1 at the path 0 on; beyond the last it stays.
struct btElasticPlasticCurvePoint
{
	btScalar m_path;    ///< sum of plastic elongations and shortenings [m], > 0, more than the point before
	btScalar m_factor;  ///< strength over that of a fibre that has not flowed, > 0

	bool isSameAs(const btElasticPlasticCurvePoint& other) const
	{
		return m_path == other.m_path && m_factor == other.m_factor;
	}
};

/// What a fibre remembers from step to step.
struct btElasticPlasticFibreState
{
	btScalar m_force = 0;      ///< tension is positive [N]
	btScalar m_forceRate = 0;  ///< by the last step [N/s]
	btScalar m_offset = 0;     ///< plastic elongation beside what the joint's plastic deformation gives its place [m]
	btScalar m_damage =
		0;  ///< share of its ductility that is spent, by the sum of both directions; from 1 on it bears nothing
	btScalar m_path = 0;  ///< sum of its plastic elongations and shortenings [m]
	btScalar m_rate = 0;  ///< of its elongation at the beginning of the last step, if its strength knows a rate [m/s]
	btScalar m_rateShare = 0;  ///< by which it was stronger in that step than at rest
	/// Its ductility was spent, and it is weaker in tension than in compression: it opens without a force now, and bears where it has closed.
	bool m_isCracked = false;

	bool isRuptured() const { return m_damage >= 1; }
	bool isTorn() const { return isRuptured() || m_isCracked; }  ///< bears no tension
};

/// What a fibre shows at the end of a step.
struct btElasticPlasticFibreReading
{
	btScalar m_force = 0;  ///< with what the material's damping adds; tension is positive [N]
	btScalar m_elongation =
		0;                   ///< elastic and plastic, since it was without force; with the gap of one that is open [m]
	btScalar m_plastic = 0;  ///< what of it would stay if the force went [m]
	btScalar m_utilisation = 0;  ///< force over its present strength in the force's direction
	btScalar m_damage = 0;       ///< share of its ductility that is spent; 1: it bears nothing
	bool m_isCracked = false;    ///< bears pressure only
};

#endif  // BT_ELASTIC_PLASTIC_FIBRE_H
