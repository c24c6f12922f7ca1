// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/JointLog.h"

namespace ep
{
const std::vector<Named<JointState>>& jointStates()
{
	static const std::vector<Named<JointState>> all = {{"none", JointState::None},
													   {"intact", JointState::Intact},
													   {"overloaded", JointState::Overloaded},
													   {"yielded", JointState::Yielded},
													   {"broken", JointState::Broken}};
	return all;
}

JointState JointRecord::state(const JointReading& reading) const
{
	if (!reading.isThere)
		return JointState::None;
	if (reading.isBroken)
		return JointState::Broken;
	if (reading.hasYielded)
		return JointState::Yielded;
	return yieldTime >= 0 ? JointState::Overloaded : JointState::Intact;
}

size_t JointLog::numberOf(const btElasticPlasticJoint& joint) const
{
	size_t number = 0;
	while (number < m_records.size() && m_records[number].joint != &joint)
		++number;
	return number;
}

void JointLog::update(double time)
{
	// Ours remember; only Bullet's own have to be read.
	const bool remembers = m_world.method().kind().isElasticPlastic();
	for (JointRecord& record : m_records)
	{
		if (record.breakTime >= 0)
			continue;
		bool yielded = record.joint->hasYielded(), broken = record.joint->isBroken();
		if (!remembers)
		{
			const JointReading reading = read(record);
			yielded = reading.hasYielded || reading.utilisation > 1;
			broken = reading.isBroken;
		}
		if (yielded && record.yieldTime < 0)
			record.yieldTime = time;
		if (broken)
			record.breakTime = time;
	}
}
}  // namespace ep
