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

private:
	JointModel& m_model;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LOAD_WATCH_H
