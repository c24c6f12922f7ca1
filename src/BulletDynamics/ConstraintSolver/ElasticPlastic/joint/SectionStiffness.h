// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SECTION_STIFFNESS_H
#define BT_ELASTIC_PLASTIC_SECTION_STIFFNESS_H

#include <math.h>

#include "../../btElasticPlasticFibre.h"
#include "../Cancelled.h"

namespace btElasticPlastic
{
/// Elongation and turns of a section, e + z a_y - y a_z at each place.
template <class T>
struct SectionPlaneOf
{
	T m_elongation = 0, m_turnY = 0, m_turnZ = 0;

	/// \param fibre  whatever has a place in the section
	template <class Fibre>
	T at(const Fibre& fibre) const
	{
		return m_elongation + T(fibre.m_z) * m_turnY - T(fibre.m_y) * m_turnZ;
	}
	void add(T factor, const SectionPlaneOf& other)
	{
		m_elongation += factor * other.m_elongation;
		m_turnY += factor * other.m_turnY;
		m_turnZ += factor * other.m_turnZ;
	}

	/// As exactly as Bullet computes, for what is asked of many fibres and adds little to their forces.
	SectionPlaneOf<btScalar> rounded() const
	{
		SectionPlaneOf<btScalar> plane;
		plane.m_elongation = btScalar(m_elongation);
		plane.m_turnY = btScalar(m_turnY);
		plane.m_turnZ = btScalar(m_turnZ);
		return plane;
	}
};
typedef SectionPlaneOf<double> SectionPlane;

/// N, M_y and M_z of a section: what forces of its fibres add up to.
struct SectionForces
{
	double m_axial = 0, m_momentY = 0, m_momentZ = 0;

	template <class Fibre>
	void add(const Fibre& fibre, double force)
	{
		m_axial += force;
		m_momentY += double(fibre.m_z) * force;
		m_momentZ -= double(fibre.m_y) * force;
	}
	/// Their work over a plane.
	double along(const SectionPlane& plane) const
	{
		return m_axial * plane.m_elongation + m_momentY * plane.m_turnY + m_momentZ * plane.m_turnZ;
	}
};

/// The same, summed up fibre by fibre. What these have on both sides of an axis cancels.
class SectionSum
{
public:
	template <class Fibre>
	void add(const Fibre& fibre, double force)
	{
		m_sum.add(fibre, force);
		m_sizes.m_axial += fabs(force);
		m_sizes.m_momentY += fabs(double(fibre.m_z) * force);
		m_sizes.m_momentZ += fabs(double(fibre.m_y) * force);
	}
	SectionForces get() const
	{
		SectionForces sum;
		sum.m_axial = cancelled(m_sum.m_axial, m_sizes.m_axial);
		sum.m_momentY = cancelled(m_sum.m_momentY, m_sizes.m_momentY);
		sum.m_momentZ = cancelled(m_sum.m_momentZ, m_sizes.m_momentZ);
		return sum;
	}

private:
	SectionForces m_sum, m_sizes;
};

/// The plane that belongs to forces.
class SectionCompliance
{
public:
	SectionPlane of(const SectionForces& f) const
	{
		SectionPlane plane;
		plane.m_elongation = m_axial * f.m_axial + m_mixed[0] * f.m_momentY + m_mixed[1] * f.m_momentZ;
		plane.m_turnY = m_mixed[0] * f.m_axial + m_turns[0] * f.m_momentY + m_mixed[2] * f.m_momentZ;
		plane.m_turnZ = m_mixed[1] * f.m_axial + m_mixed[2] * f.m_momentY + m_turns[1] * f.m_momentZ;
		return plane;
	}

private:
	friend class SectionStiffness;
	double m_axial = 0, m_turns[2] = {0, 0};
	double m_mixed[3] = {0, 0, 0};  ///< of N with M_y, N with M_z, M_y with M_z
};

/// Stiffness of fibres side by side, about the joint's axis.
class SectionStiffness
{
public:
	void add(const btElasticPlasticFibre& fibre, double stiffness)
	{
		const double byZ = stiffness * double(fibre.m_z), byY = stiffness * double(fibre.m_y);
		m_axial += stiffness;
		m_turns[0] += byZ * double(fibre.m_z);
		m_turns[1] += byY * double(fibre.m_y);
		m_mixed[0] += byZ;
		m_mixed[1] -= byY;
		m_mixed[2] -= byZ * double(fibre.m_y);
	}

	/// Its inverse; 0 in what fibres on one line or at one place do not determine.
	SectionCompliance invert() const;

private:
	double m_axial = 0, m_turns[2] = {0, 0}, m_mixed[3] = {0, 0, 0};
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SECTION_STIFFNESS_H
