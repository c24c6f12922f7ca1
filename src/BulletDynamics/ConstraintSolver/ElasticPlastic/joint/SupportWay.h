// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SUPPORT_WAY_H
#define BT_ELASTIC_PLASTIC_SUPPORT_WAY_H

#include "JointModel.h"

namespace btElasticPlastic
{
/// In how many substeps a kinematic body goes the way to where Bullet shows it.
/// \param from  where it was
/// \param step  length of a substep [s]
/// \return 0 if its velocity does not take it there
int countSubsteps(const btTransform& from, const btRigidBody& body, btScalar step);

/// Where a kinematic body is some time before it is at a place.
btTransform placeBefore(const btTransform& place, const btRigidBody& body, btScalar time);

/// The way of the static or kinematic body that a joint stands on.
///
/// A game moves a kinematic body once for all substeps of a frame. Bullet shows it where the last of them will leave it, in each of them, with the velocity
/// that takes it there in all of them together: in all but the last one it is shown ahead of its way, by a time that is found here.
///
/// What was seen last is kept in the joint's state.
class SupportWay
{
public:
	explicit SupportWay(JointModel& model) : m_model(model) {}

	/// Looks where the support is between steps: a game may move it before the next one.
	void find();

	/// Whether there was a support as it was looked for last, or it was not looked for yet.
	static bool mayBe(const btElasticPlasticState& state);

	/// At the beginning of a substep, by which time it is shown ahead of where that will leave it [s]. The joint's last deformation tells it where a support has not been
	/// seen, and that a structure has been put elsewhere as a whole.
	/// \param step  length of the substep [s]
	btScalar findLead(btScalar step) const;

	/// By which time the joint follows it late, since it has moved while the joint slept [s].
	btScalar getLate() const;

	/// Follows it, as each substep has ended.
	/// \param lead  that the joint's step has begun with [s]; below 0: the joint has had no part in the substep
	/// \return whether it is elsewhere than before
	bool follow(btScalar step, btScalar lead);

	/// Keeps one that moves from falling asleep, as Bullet lets it if it is slow: it would be left where it is.
	/// \param hasMoved  in the last substep
	void keepAwake(bool hasMoved);

private:
	bool isShownAnew(const btRigidBody& body) const;
	int countSubsteps(const btRigidBody& body, btScalar step) const;
	btScalar leadLeft(btScalar step) const;
	btScalar substepsTo(const btRigidBody& support, btScalar step, btScalar& left) const;
	btScalar leadBesideStep(const btRigidBody& body, btScalar step) const;

	JointModel& m_model;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SUPPORT_WAY_H
