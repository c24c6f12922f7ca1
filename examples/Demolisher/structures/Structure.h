// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_STRUCTURE_H
#define EP_STRUCTURE_H

#include <deque>

#include "structures/Beam.h"

namespace ep
{
/// What a scene has put into a world: beams with their joints, and boxes that hold them. The vehicle comes along the x axis.
class Structure
{
public:
	virtual ~Structure() = default;

	const std::deque<Beam>& beams() const { return m_beams; }

	/// Supports that are boxes.
	const std::vector<btRigidBody*>& boxes() const { return m_boxes; }

	/// Of all beams, one after the other.
	std::vector<btElasticPlasticJoint*> joints() const
	{
		std::vector<btElasticPlasticJoint*> all;
		for (const Beam& beam : m_beams)
			for (btElasticPlasticJoint* joint : beam.joints())
				all.push_back(joint);
		return all;
	}

protected:
	std::deque<Beam> m_beams;
	std::vector<btRigidBody*> m_boxes;
};
}  // namespace ep

#endif  // EP_STRUCTURE_H
