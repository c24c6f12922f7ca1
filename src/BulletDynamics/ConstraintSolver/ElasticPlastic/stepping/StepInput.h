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

/// What a game has done to bodies before a step, for all of the step's substeps: forces, which Bullet takes off after the first,
/// and the way of kinematic bodies, which Bullet lets them go within the first, at as many times their speed.
class StepInput
{
public:
	/// For a step of dt > 0 [s]. Kinematic bodies get the velocity at which they will go.
	StepInput(btDynamicsWorld& world, btScalar dt);
	~StepInput();

	/// Before the substep that ends at this share of the step, 1 is all of it. Bodies may have been deleted since the last one.
	void apply(btScalar share);

private:
	/// By the proxy a body is told from one that was made later at the same address.
	struct Load
	{
		int m_proxy;
		btVector3 m_force, m_torque;
	};

	/// From where Bullet saw a kinematic body last to where the game wants it. For one reading it is the body's motion state.
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
		bool m_isReady = true;  ///< for Bullet to read; it has then read it
	};

	const btDynamicsWorld& m_world;
	btHashMap<btHashPtr, Load> m_loads;
	btHashMap<btHashPtr, Way> m_ways;
	bool m_hasBegun = false;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STEP_INPUT_H
