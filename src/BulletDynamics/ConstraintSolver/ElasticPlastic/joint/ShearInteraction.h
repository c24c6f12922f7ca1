// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SHEAR_INTERACTION_H
#define BT_ELASTIC_PLASTIC_SHEAR_INTERACTION_H

#include <vector>

#include "JointModel.h"

namespace btElasticPlastic
{
/// What shears and torsion leave of the fibres' strength, and the fibres and each other of theirs, for a step.
///
/// Where a fibre bears a normal stress s and a shear stress t, it flows at (s / s_y)^2 + (t / t_y)^2 = 1 (von Mises). With an elongation and
/// turns q_n and slips and a twist q_s of the whole section, which give fibre i the elongation a_i q_n and the slip b_i q_s, a section of such
/// fibres bears in the direction q at most
///
///     h(q) = sum w_i n_i,   n_i^2 = (a_i q_n)^2 + |b_i q_s|^2,
///
/// w_i its strength, with b_i such that each of shears and torsion alone comes to its yield value. The forces F with which the step begins are
/// at the share g = max F q / h(q) of what the section bears in their direction. There fibre i is flowing by the share |b_i q_s| / n_i = u_i in
/// shear: so much of its strength is taken once F has grown by 1 / g. Now it is g u_i, and sqrt(1 - (g u_i)^2) is left for its
/// normal force. What F leaves of shears and torsion is found in an ellipsoid that touches the surface where F grows to. On the surface the bounds'
/// corner is F itself.
///
/// A fibre that flows at -f_c when it is pressed and at f_t when it is pulled has its shear on an ellipse about the middle c = (f_t - f_c) / 2 with the half axis
/// a = (f_t + f_c) / 2,
///
///     ((s - c) / a)^2 + (t / t_m)^2 = 1,   t_m = t_y / sqrt(1 - c^2 / a^2),
///
/// so that without a normal stress it bears t_y, which the section's yield values are for, and under pressure up to t_m. That is where the paraboloid of Stassi
/// and of Raghava, Caddell and Yeh (1973), s^2 + 3 t^2 + (f_c - f_t) s = f_c f_t, cuts s and t, with a t_y of its own. Forces are counted from the
/// middle of all fibres, and w_i = a. A fibre that would have to be pressed to bear its shear is left without tension: slip needs no room, and presses nothing.
/// A section in which nothing moves along the axis slips under the pressure that it has. What pressure adds by friction is another law: with it, fibres of
/// unequal strengths leave shears and torsion alone.
///
/// In a section that flows the bounds go on from there to where the surface's normal is the way in which the section moves, by as much as that
/// would load it in the step if it was elastic: so flow comes to follow the normal, as von Mises' does.
///
/// Where next to none of the section's work is by slip, shears and torsion have room to grow: a hinge whose shear rises would else slip in each
/// step by what the one before did not know.
///
/// The maximum is searched by weighted least squares: F is borne by springs w_i / n_i with the n_i of the search before. Each
/// search makes h less.
///
/// What slips elastically, by the rate of the forces in the last step, is no flow: light parts that rock between stiff joints slip to and fro.
///
/// All of this follows from the forces, their rates and the velocities with which the step begins, and bounds are fixed within the step, as they are for any other
/// row. Its error is of the first order of the step: in one step forces may grow beyond the surface, and in the next one they flow back to it.
class ShearInteraction
{
public:
	/// \param stepYield  yield values in the step
	/// \param rate       of strain, with which the step begins
	void find(const JointModel& model, const btScalar stepYield[BT_EP_DOF_COUNT], const btScalar rate[BT_EP_DOF_COUNT],
			  btScalar dt);

	/// Whether anything is taken of the fibres' strength.
	bool isAny() const { return m_left.size() > 0; }

	/// What is left of a fibre's strength in tension and in compression, as shares of these.
	struct Left
	{
		btScalar m_tension, m_compression;
	};
	/// \param strength  both, or what they are to each other
	Left getLeft(int fibre, const JointModel::FibreStrength& strength) const
	{
		if (m_left.size() == 0)
			return {1, 1};
		const btScalar left = m_left[fibre];
		const bool isEven = strength.m_tension == strength.m_compression || left == 1;
		return isEven ? Left{left, left} : leftAboutMiddle(left, strength);
	}

	/// The same of the yield value of a shear or torsion.
	btScalar getShare(int dof) const
	{
		return dof >= BT_EP_SHEAR_Y && dof <= BT_EP_TORSION ? m_share[dof - BT_EP_SHEAR_Y] : btScalar(1);
	}

	/// What a step uses where nothing is taken ends here.
	const void* getEndWithoutShear() const { return &m_alone; }

	/// Takes from a fibre's strength what is not left of it.
	void lessen(int fibre, JointModel::FibreStrength& strength) const
	{
		if (m_left.size() == 0)
			return;
		const Left left = getLeft(fibre, strength);
		strength.m_tension *= left.m_tension;
		strength.m_compression *= left.m_compression;
	}

private:
	struct Fibre
	{
		double m_strength;    ///< half of what is between its bounds
		double m_middle;      ///< force halfway between them, 0 if it is as strong in tension as in compression
		double m_normal[3];   ///< elongation by e, a_y, a_z
		double m_slip[2][4];  ///< slip along y and z, or along a wall and nothing, by slips, the twist and a warping
		int m_numSlips;
		double m_flow;  ///< n
	};
	struct Matrix
	{
		double m_elements[6];  ///< xx, xy, xz, yy, yz, zz

		void add(double weight, const double row[3]);
		Matrix inverse() const;
		void multiply(const double x[3], double result[3]) const;
	};

	bool collect(const JointModel& model);
	double search(const double force[6], double q[6]);
	void warp(double least, Matrix& slip);
	double shearAlone(int along, double least) const;
	double flowOf(const Fibre& fibre, const double q[6], bool withNormal) const;
	void findShares(const double force[6], double share, double bears);
	double shareOf(const double force[6], const double q[6], double share) const;
	void follow(const JointModel& model, const double q[6], double amount);
	static Left leftAboutMiddle(btScalar left, const JointModel::FibreStrength& strength);

	// What all steps ask for, close together.
	btAlignedObjectArray<btScalar> m_left;  ///< none: all of it
	btScalar m_share[3] = {1, 1, 1};
	// The rest.
	double m_alone[6];  ///< what the section bears of N, M_y, M_z, V_y, V_z, T by itself, about the middle [N], [N m]
	std::vector<Fibre> m_fibres;
	/// Of shears and torsion, over what each could be by itself: above 1 where another one lets it, as of angles with unequal legs, or pressure does.
	double m_mostShare[3];
	double m_middle[3];       ///< N, M_y, M_z in the middle of fibres of unequal strengths
	bool m_isUneven = false;  ///< fibres that bear shear have unequal strengths
	bool m_mayWarp = false;   ///< they may slip unevenly by a warping
	Matrix m_matrix;          ///< of the last search, of shears and torsion, inverted
	double m_warping[3];      ///< by slips and the twist, in that search
	double m_most = 0;        ///< sum of w n with which it was made
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SHEAR_INTERACTION_H
