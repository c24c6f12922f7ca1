// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_JOINT_LOG_H
#define EP_JOINT_LOG_H

#include "simulation/DemolisherSettings.h"
#include "world/JointReading.h"

namespace ep
{
/// What has become of a joint.
enum class JointState
{
	None,  ///< there is none
	Intact,
	Overloaded,  ///< one of Bullet's own, which has borne more than yield
	Yielded,
	Broken
};
const std::vector<Named<JointState>>& jointStates();

/// A joint, and when what happened to it.
struct JointRecord
{
	Scene scene;
	const btElasticPlasticJoint* joint;
	double yieldTime =
		-1;  ///< first step after it had yielded, or, of Bullet's own, borne more than yield; -1: not yet [s]
	double breakTime = -1;  ///< the same [s]

	JointState state(const JointReading& reading) const;
};

/// When each joint of a world yielded and broke.
class JointLog
{
public:
	explicit JointLog(const World& world) : m_world(world) {}

	void add(Scene scene, const btElasticPlasticJoint& joint) { m_records.push_back({scene, &joint}); }

	/// After a step that ended at a time [s].
	void update(double time);

	const std::vector<JointRecord>& records() const { return m_records; }
	/// As they have been.
	void restore(const std::vector<JointRecord>& records) { m_records = records; }
	/// In the records, their number if it is not there.
	size_t numberOf(const btElasticPlasticJoint& joint) const;
	JointReading read(const JointRecord& record) const { return readJoint(m_world, *record.joint); }

private:
	const World& m_world;
	std::vector<JointRecord> m_records;
};
}  // namespace ep

#endif  // EP_JOINT_LOG_H
