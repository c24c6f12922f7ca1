// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_EVENT_H
#define BT_ELASTIC_PLASTIC_EVENT_H

#include "LinearMath/btVector3.h"

class btElasticPlasticJoint;
class btRigidBody;

/// What happened to a joint in a substep.
enum btElasticPlasticEventType
{
	BT_EP_EVENT_YIELD,  ///< it flowed for the first time
	BT_EP_EVENT_BREAK,  ///< its ductility is spent, or it was broken on purpose; it has left the world
	BT_EP_EVENT_LEVEL,  ///< a quantity has passed the level set by btElasticPlasticJoint::setLevel
	BT_EP_EVENT_CRACK,  ///< a fibre that is weaker in tension than in compression has torn: it bears again where it closes
	BT_EP_EVENT_RUPTURE  ///< a fibre has torn or was crushed: it bears nothing any more
};

/// What a joint watches for the user.
enum btElasticPlasticQuantity
{
	BT_EP_QUANTITY_FORCE,        ///< length of the applied force, axial and shear [N]
	BT_EP_QUANTITY_MOMENT,       ///< length of the applied moment, torsion and bending [N m]
	BT_EP_QUANTITY_UTILISATION,  ///< btElasticPlasticJoint::getUtilisation(), 1 is yield
	BT_EP_QUANTITY_DAMAGE,       ///< btElasticPlasticJoint::getDamage(), 1 breaks
	BT_EP_QUANTITY_COUNT
};

/// An event. The bodies it points to may have been deleted when it is read from the queue.
struct alignas(16) btElasticPlasticEvent
{
	BT_DECLARE_ALIGNED_ALLOCATOR();

	btVector3 m_position;  ///< of the joint, or of the fibre that the event is about, world coordinates [m]
	btVector3 m_force;     ///< by the joint's axes [N], see btElasticPlasticJoint::getForce and getJointAxis
	btVector3 m_moment;    ///< by the joint's axes [N m]
	btVector3
		m_impulse;  ///< of the joint on body A in the substep, along the world's axes; on body B the opposite [N s]
	btVector3 m_velocity;  ///< of body B against body A at the joint after the substep, along the world's axes [m/s]
	double m_time;         ///< sum of the substeps the action has seen [s]
	double m_energy;       ///< taken up by the joint so far, elastic and plastic [J]
	btElasticPlasticJoint*
		m_joint;  ///< null if a listener that was told before has deleted it or taken it from its action
	btRigidBody* m_bodyA;
	btRigidBody* m_bodyB;
	btElasticPlasticEventType m_type;
	int m_dof;  ///< the most used degree of freedom; of a break and of damage the one with the largest share of ductility spent
	btElasticPlasticQuantity m_quantity;  ///< that has passed its level
	btScalar m_value;                     ///< of that quantity [N], [N m], 1
	/// That has cracked or ruptured, by its index in btElasticPlasticCapacity::m_fibres, and the part of the section that it belongs to
	/// (btElasticPlasticFibre::m_part); -1 of other events.
	int m_fibre, m_part;
};

/// Derive from it to hear of events; give it to btElasticPlasticAction::addListener.
/// The methods for events, onYield() to onRupture(), are called at the end of the action's update, when the substep's bookkeeping is done, or from
/// btElasticPlasticAction::breakJoint: joints, bodies, constraints and the action may be added, removed and deleted there.
class btElasticPlasticListener
{
public:
	virtual ~btElasticPlasticListener() {}
	virtual void onYield(const btElasticPlasticEvent&) {}
	virtual void onBreak(const btElasticPlasticEvent&) {}
	virtual void onLevel(const btElasticPlasticEvent&) {}
	virtual void onCrack(const btElasticPlasticEvent&) {}
	virtual void onRupture(const btElasticPlasticEvent&) {}

	/// A joint was refused; text names it, the value and the valid range. Called from btElasticPlasticAction::addJoint, from
	/// btElasticPlasticJoint::setCapacity of a joint that the action knows, from btElasticPlasticJoint::setState, and, once a fault,
	/// while the world is stepped, by threads of a solver, too: leave bodies, joints and the settings of solvers as they are here.
	/// The default prints the text to the standard error output. So it is without a listener, and for joints that no action knows.
	virtual void onRefused(btElasticPlasticJoint& joint, const char* text);

	/// The world was stepped by a time that is not finite or not above 0, told once by each action; joints do nothing in such a
	/// step. The default prints the text to the standard error output.
	virtual void onBadStep(btScalar timeStep, const char* text);
};

#endif  // BT_ELASTIC_PLASTIC_EVENT_H
