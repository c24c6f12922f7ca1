// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_JOINT_BOOK_H
#define EP_JOINT_BOOK_H

#include "world/JointReading.h"

namespace ep
{
/// A joint, and when what happened to it.
struct JointRecord
{
	std::string scene;
	const btElasticPlasticJoint* joint;
	double yieldTime =
		-1;  ///< first step after it had yielded, or, of Bullet's own, borne more than yield; -1: not yet [s]
	double breakTime = -1;  ///< the same [s]

	/// "intact", "yielded", "broken", or "none"; of one of Bullet's own "overloaded" too.
	const char* state(const JointReading& reading) const;
};

/// Follows all joints of a world.
class JointBook
{
public:
	explicit JointBook(const World& world) : m_world(world) {}

	void add(const std::string& scene, const btElasticPlasticJoint& joint) { m_records.push_back({scene, &joint}); }

	/// After a step that ended at a time [s].
	void update(double time);

	const std::vector<JointRecord>& records() const { return m_records; }
	/// In the records, their number if it is not there.
	size_t numberOf(const btElasticPlasticJoint& joint) const;
	JointReading read(const JointRecord& record) const { return readJoint(m_world, *record.joint); }

private:
	const World& m_world;
	std::vector<JointRecord> m_records;
};
}  // namespace ep

#endif  // EP_JOINT_BOOK_H
