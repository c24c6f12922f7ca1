// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEADY_PUSHES_H
#define BT_ELASTIC_PLASTIC_STEADY_PUSHES_H

#include "../../btElasticPlasticState.h"
#include "../joint/LoadHistory.h"
#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btVector3.h"

class btRigidBody;

namespace btElasticPlastic
{
/// What others give to the velocities of joined bodies before each step alike, as the wheels of a btRaycastVehicle or a game's impulses do.
///
/// A force acts in the whole step. So does what comes again and again in its place: all of it at the step's beginning would be a blow to shorter steps within it.
/// What a body gets once, or more than before, is one.
class SteadyPushes
{
public:
	/// Begins anew, for a step of dt [s].
	void clear(btScalar dt);

	/// Looks at what a body has been given since it was moved.
	/// \param loads  of the body until the last step; null: none
	/// \return an index for addJoint(), -1: nothing
	int addBody(btRigidBody& body, const LoadHistory* loads);

	/// Compares that with what it was given before the last step, as its joint remembers it, which remembers the new one instead.
	/// \param given  of bodies A and B, by addBody(), -1 too for a body that does not move
	void addJoint(btElasticPlasticState& state, const int given[2]);

	/// Whether a body has been given anything before both steps.
	bool isAny() const;

	/// Takes it from the bodies' velocities, and has it act as loads on them.
	void begin();

	/// Takes the loads away again.
	void end();

	/// What begin() has given to a body's kinetic energy [J].
	double getEnergy(int given) const { return given < 0 ? 0 : m_bodies[given].m_energy; }

	/// What they do as loads on a body on a way [m] and a turn [rad] [J].
	double getWork(int given, const btVector3& way, const btVector3& turn) const;

private:
	struct Body
	{
		btRigidBody* m_body;
		btVector3 m_linear, m_angular;              ///< given, by the step's length [m/s^2], [rad/s^2]
		btScalar m_swayLinear, m_swayAngular;       ///< by how much that may change as a load does
		btVector3 m_steadyLinear, m_steadyAngular;  ///< of that what was given before the last step, too
		btVector3 m_pushForce, m_pushTorque;        ///< with which it acts as a load [N], [N m]
		btVector3 m_force, m_torque;                ///< that others have applied [N], [N m]
		double m_energy;
	};

	btScalar m_dt = 0;
	btAlignedObjectArray<Body> m_bodies;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STEADY_PUSHES_H
