// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/JointHistory.h"

namespace ep
{
void JointHistory::follow(size_t joint, int dof)
{
	m_joint = joint;
	m_dof = dof;
	clear();
}

void JointHistory::clear()
{
	m_force.clear();
	m_deformation.clear();
	m_energy.clear();
}

void JointHistory::step(const Demolisher& demolisher)
{
	const std::vector<JointRecord>& records = demolisher.joints().records();
	if (m_joint >= records.size())
		m_joint = 0;
	const JointReading r = demolisher.joints().read(records[m_joint]);
	m_force.push_back(float(r.force[m_dof] / 1000));
	m_deformation.push_back(float(r.deformation[m_dof] * 1000));
	m_energy.push_back(float((r.elasticEnergy + r.plasticEnergy) / 1000));
	const size_t most = size_t(LENGTH / double(demolisher.settings().step));
	for (std::vector<float>* values : {&m_force, &m_deformation, &m_energy})
		if (values->size() > most)
			values->erase(values->begin(), values->end() - long(most));
}
}  // namespace ep
