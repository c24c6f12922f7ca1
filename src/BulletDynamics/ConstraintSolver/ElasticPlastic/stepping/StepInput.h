// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEP_INPUT_H
#define BT_ELASTIC_PLASTIC_STEP_INPUT_H

#include "LinearMath/btHashMap.h"
#include "LinearMath/btMotionState.h"
#include "LinearMath/btTransform.h"

class btDynamicsWorld;
class btRigidBody;

namespace btElasticPlastic
{
/// Applies what a game has done to bodies before a step in all of its substeps.
///
/// Bullet takes forces off after the first substep; here they act in all of them. Bullet moves kinematic bodies all their way in
/// the first substep, at many times their speed; here they move evenly.
class StepInput
{
public:
	/// Notes loads and ways for a step of dt > 0 [s], and gives kinematic bodies the velocity at which they will move.
	StepInput(btDynamicsWorld& world, btScalar dt);
	~StepInput();

	/// Applies loads and moves kinematic bodies before a substep. Bodies may have been deleted since the last one.
	/// \param share  of the step that is over when the substep ends, 1 for the last one
	void apply(btScalar share);

private:
	/// The proxy's uid tells a body from another one that was made later at the same address.
	struct Load
	{
		int m_proxy;
		btVector3 m_force, m_torque;
	};

	/// The way of a kinematic body from where Bullet saw it last to where the game wants it. It takes the place of the body's
	/// motion state until Bullet has read it once.
	class Way : public btMotionState
	{
	public:
		Way(btRigidBody& body, const btTransform& end);

		int getProxy() const { return m_proxy; }
		void go(btScalar share);
		void stepAside() const;

		void getWorldTransform(btTransform& place) const override;
		void setWorldTransform(const btTransform&) override {}

	private:
		btRigidBody* m_body;
		btMotionState* m_motionState;  ///< the body's own
		int m_proxy;
		btTransform m_start, m_end, m_place;
		bool m_isReady =
			true;  ///< whether the next reading is the one after which the body gets its own motion state back
	};

	const btDynamicsWorld& m_world;
	btHashMap<btHashPtr, Load> m_loads;
	btHashMap<btHashPtr, Way> m_ways;
	bool m_hasBegun = false;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STEP_INPUT_H
