// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_LOADED_BEAM_H
#define EP_LOADED_BEAM_H

#include "scenes/Member.h"

namespace ep
{
/// A steel beam under a load at mid span, without weight: limit analysis says that it collapses at 8, 6 or 4 Mp/L; under a
/// uniform one at 16, 11.66 or 8 Mp/L^2. The right end is free to slide lengthwise, or else the beam would hang on as a cable.
struct LoadedBeam
{
	enum class Supports
	{
		Fixed,    ///< both ends clamped
		Propped,  ///< left end clamped
		Simple    ///< both ends hinged
	};

	struct Settings
	{
		Method method = Solver::Direct;
		Supports supports = Supports::Fixed;
		btScalar length = 4;      ///< [m]
		Member::Settings member;  ///< default: 10 parts, 0.1 x 0.1 m, 250 MPa; an even number has a joint at mid span

		Settings();
	};

	explicit LoadedBeam(const Settings& settings);

	/// Mp [N m]
	double plasticMoment() const { return m_middle->getCapacity().m_yield[BT_EP_BENDING_Z]; }

	/// The load at which it becomes a mechanism [N].
	double collapseLoad() const;

	/// Puts a force on mid span, downwards, for the next step [N].
	void load(double force) { loadJoint(*m_middle, btVector3(0, btScalar(-force), 0)); }

	/// The same for a load spread evenly [N/m]: 16, 6 + 4 sqrt(2), 8 Mp/L^2.
	double uniformCollapseLoad() const;
	void loadUniformly(double forcePerLength);

	/// How far mid span has sunk [m].
	btScalar sag() const { return -m_middle->getPosition().y(); }

	World m_world;
	btRigidBody* m_left;
	btRigidBody* m_right;
	Member m_member;
	btElasticPlasticJoint* m_leftEnd;
	btElasticPlasticJoint* m_rightEnd;
	btElasticPlasticJoint* m_middle;

private:
	btRigidBody* support(btScalar x);

	Settings m_settings;
};
}  // namespace ep

#endif  // EP_LOADED_BEAM_H
