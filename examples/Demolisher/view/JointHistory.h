// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_JOINT_HISTORY_H
#define EP_JOINT_HISTORY_H

#include "simulation/Demolisher.h"

namespace ep
{
/// What a joint did in the last seconds, a value a step.
class JointHistory
{
public:
	static constexpr double LENGTH = 10;  ///< [s]

	/// The number of the joint in the log, and the degree of freedom to follow.
	void follow(size_t joint, int dof);
	size_t joint() const { return m_joint; }
	int dof() const { return m_dof; }

	void clear();
	void step(const Demolisher& demolisher);

	const std::vector<float>& force() const { return m_force; }              ///< [kN] or [kN m]
	const std::vector<float>& deformation() const { return m_deformation; }  ///< [mm] or [mrad]
	const std::vector<float>& energy() const { return m_energy; }            ///< elastic and plastic [kJ]

private:
	size_t m_joint = 0;
	int m_dof = BT_EP_BENDING_Z;
	std::vector<float> m_force, m_deformation, m_energy;
};
}  // namespace ep

#endif  // EP_JOINT_HISTORY_H
