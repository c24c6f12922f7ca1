// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_LOAD_WATCH_H
#define BT_ELASTIC_PLASTIC_LOAD_WATCH_H

#include "JointModel.h"

namespace btElasticPlastic
{
/// Whether something happens to a joint that its bodies must not sleep through. Bullet lets bodies sleep by their speed alone, and
/// a joint may be loaded, flow and break at a speed at which nobody sees its bodies move.
///
/// What was seen last is kept in the joint's state, so that one that is put back sleeps and wakes as it did.
class LoadWatch
{
public:
	explicit LoadWatch(JointModel& model) : m_model(model) {}

	/// Whether a deformation, elastic and plastic, has changed since the last change by what loads the joint with a share of its
	/// yield value. It sees slow loading and slow flow, and overlooks a vibration that is smaller.
	/// \param strain  at which the joint was evaluated [m], [rad]
	/// \param share   of the yield value, >= 0
	bool hasDeformed(const btScalar strain[BT_EP_DOF_COUNT], btScalar share);

	/// Whether it stood on a static or kinematic body when hasSupportMoved() was asked last, or was not asked yet.
	static bool mayHaveSupport(const btElasticPlasticState& state);

	/// Whether the static or kinematic body that the joint stands on is elsewhere than when it was asked last, as each substep has ended.
	/// \param step  length of the substep [s]
	/// \param lead  by which time it was shown ahead in it, as the joint's step has found [s]; below 0: it has not
	bool hasSupportMoved(btScalar step, btScalar lead);

private:
	JointModel& m_model;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LOAD_WATCH_H
