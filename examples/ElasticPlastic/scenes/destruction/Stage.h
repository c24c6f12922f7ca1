// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_STAGE_H
#define EP_STAGE_H

#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "world/World.h"

namespace ep
{
inline btVector3 vector(double x, double y, double z) { return btVector3(btScalar(x), btScalar(y), btScalar(z)); }

/// The ground on which a game's scenes of destruction stand, what they are built with, and the script of what happens to them.
///
/// The same scene is built with our joints and the direct form, or as games do it with Bullet alone: fixed constraints with a breaking
/// threshold and sequential impulses, of which broken constraints are taken out.
class Stage
{
public:
	static constexpr double GAP = 0.005;      ///< round each part of what is built [m]
	static constexpr double FRAME = 1. / 60;  ///< [s]
	static constexpr double GRAVITY = 9.81;

	struct Settings
	{
		bool isBulletsWay = false;
		int iterations = 10;    ///< of sequential impulses and of swept contacts
		btScalar strength = 1;  ///< factor on yield stresses
		bool sleeps = true;     ///< bodies at rest fall asleep, as is Bullet's default
		bool takesInnerSteps = true;
		int fibres = 0;  ///< of the sections of members; 0: none, their forces yield each by itself
	};

	/// The direction of a joint's x axis, and with it of the member that it stands for.
	enum class Along
	{
		X,
		Y,
		Z
	};

	struct Ball
	{
		btScalar radius, mass;
		btVector3 place, velocity;
	};

	Stage() : Stage(Settings()) {}
	explicit Stage(const Settings& settings);

	World& world() { return m_world; }

	/// Top at height 0.
	btRigidBody& ground() { return *m_ground; }

	/// \return null with Bullet's way
	btElasticPlasticConstraintSolver* solver();

	// ---- building

	/// Of the given yield stress times the settings' strength [Pa], E = 30 GPa, 2400 kg/m^3.
	btElasticPlasticMaterial concrete(double yieldStress, double ultimateStrain) const;

	/// Capacity of the joint between two parts of a member with a rectangular section.
	btElasticPlasticCapacity rectangularMember(const btElasticPlasticMaterial& material, double width, double height,
											   double lengthA, double lengthB) const;

	/// A body that may sleep. \param friction  Bullet multiplies the two bodies' values
	btRigidBody& body(double mass, btCollisionShape* shape, const btVector3& place,
					  const btQuaternion& turn = btQuaternion(0, 0, 0, 1), double friction = 0.6);

	/// Joins two bodies at a place. Bullet's way has one threshold for forces and moments: the least yield force times the step.
	void join(btRigidBody& a, btRigidBody& b, const btVector3& place, Along along,
			  const btElasticPlasticCapacity& capacity);

	/// A wheel's hinge with a motor, along z. \param impulse  the most that it gives in a step [N m s]
	void drive(btRigidBody& chassis, btRigidBody& wheel, double speed, double impulse);

	/// Bodies that joints hold, each once, in the order of their first joint.
	const std::vector<btRigidBody*>& joined() const { return m_joined; }
	int numJoints() const { return m_numJoints; }

	// ---- the script

	/// Has something done before the given frame, the first is 0.
	void at(int frame, std::function<void(Stage&)> act);

	/// A ball appears before the given frame.
	void throwBall(int frame, const Ball& ball);

	/// Takes a body with its joints out of the world.
	void remove(btRigidBody& body);

	// ---- a frame

	/// What the script has for the frame that comes next. Empties the queue of events.
	void playScript();

	/// The frame. The joints that have broken in Bullet's way leave the world, and their bodies wake, as ours do by themselves.
	void step();

	int frame() const { return m_frame; }
	int numBroken();

private:
	struct Event
	{
		int frame;
		std::function<void(Stage&)> act;
	};

	void removeBroken();

	Settings m_settings;
	World m_world;
	btRigidBody* m_ground;
	std::vector<btTypedConstraint*> m_held;  // in Bullet's way: joints that are whole
	std::vector<btRigidBody*> m_joined;
	std::deque<btJointFeedback> m_feedbacks;  // of motors: what they give can be audited
	std::vector<Event> m_script;
	int m_frame = 0, m_numJoints = 0, m_numBroken = 0;
};
}  // namespace ep

#endif  // EP_STAGE_H
