// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_WORLD_H
#define EP_WORLD_H

#include <functional>
#include <memory>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpringConstraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticAction.h"
#include "BulletDynamics/MLCPSolvers/btMLCPSolverInterface.h"
#include "world/BulletJoint.h"
#include "world/SmallPools.h"

namespace ep
{
/// With its velocities and the orientation given, which may be that of another time [J].
double kineticEnergy(const btRigidBody& body, const btMatrix3x3& basis);

class World;

/// Looks at a world: when a run begins, and after each of its steps.
typedef std::function<void(World& world, double time)> Watch;

/// A Bullet world with its parts, its elastic-plastic action, and all that scenes add to it. Owns everything.
class World
{
public:
	/// \param own  a solver in place of the method's, null: that one
	explicit World(const Method& method = Solver::Iterative, const btVector3& gravity = btVector3(0, -10, 0),
				   std::unique_ptr<btConstraintSolver> own = nullptr);
	~World();
	World(const World&) = delete;
	World& operator=(const World&) = delete;

	const Method& method() const { return m_method; }
	btDiscreteDynamicsWorld& bullet() { return *m_world; }
	btElasticPlasticAction& action() { return m_action; }

	/// Keeps a shape.
	template <class Shape>
	btCollisionShape* keep(Shape* shape)
	{
		m_shapes.emplace_back(shape);
		return shape;
	}
	btCollisionShape* box(const btVector3& size) { return keep(new btBoxShape(size / 2)); }

	/// Adds a body, mass 0 is static. Without damping and never asleep: reference problems want nothing but their physics.
	btRigidBody* body(btScalar mass, btCollisionShape* shape, const btTransform& pose, bool collides = true);

	/// Lets bodies that move slower than this for 2 s sleep, as Bullet does with 0.8 m/s and 1 rad/s, but not when they pass
	/// through the end of a slow swing. \param speed  [m/s] and [rad/s]
	void allowSleep(btScalar speed);

	/// Starts the 2 s anew.
	void keepAwake();

	/// Joins two bodies at a frame given in world coordinates, x along the member, by the method's joints.
	/// \return the joint, registered with the action; where one of Bullet's or nothing takes its place, it is not in the world and
	/// only tells its capacity
	btElasticPlasticJoint* joint(btRigidBody& a, btRigidBody& b, const btTransform& frame,
								 const btElasticPlasticCapacity& capacity)
	{
		return joint(a, b, frame, capacity, m_method.jointClass);
	}
	btElasticPlasticJoint* joint(btRigidBody& a, btRigidBody& b, const btTransform& frame,
								 const btElasticPlasticCapacity& capacity, JointClass jointClass);

	/// What stands in a joint's place. \return null if the joint itself is in the world
	const BulletJoint* inPlaceOf(const btElasticPlasticJoint& joint) const;

	/// A joint's capacity as it was given, with the parts that the method leaves out: what exact answers are made from.
	const btElasticPlasticCapacity& nominal(const btElasticPlasticJoint& joint) const;

	/// Lets a degree of freedom of a joint go.
	void release(btElasticPlasticJoint& joint, int dof);

	/// Keeps a constraint and adds it to the world.
	void add(btTypedConstraint* constraint, bool disableCollisions = true);

	const std::vector<std::unique_ptr<btRigidBody>>& bodies() const { return m_bodies; }

	/// Those that were added beside joints.
	const std::vector<std::unique_ptr<btTypedConstraint>>& constraints() const { return m_constraints; }

	/// In the order in which they were asked for.
	std::vector<btElasticPlasticJoint*> joints() const;

	/// All is built: another engine takes over, if the method names one. The first step does it too.
	void start();

	/// One step of dt, in the given number of equal substeps. Joints of Bullet's that let go leave the world: else their
	/// bodies would not collide.
	void step(btScalar dt, int substeps = 1);

	/// Has something done before each substep: what pushes bodies then has its share in the solution, and their velocities
	/// after the substep are true ones. (What an action pushes waits for the next one, and looks like motion.) Null: nothing.
	void beforeSubsteps(std::function<void(btScalar dt)> act) { m_beforeSubstep = std::move(act); }

	/// Kinetic energy of all bodies [J].
	double kineticEnergy() const;

	/// As it is between two steps, to go back to. \return empty with joints of Bullet's own, whose state nobody can set
	std::vector<char> save();
	/// \return whether it is as it was; not if bodies or constraints have come or gone since
	bool restore(const std::vector<char>& saved);

private:
	/// A joint that holds two bodies.
	struct HeldJoint
	{
		btElasticPlasticJoint* joint;
		std::unique_ptr<btTypedConstraint> owner;  ///< of the joint: the constraint that it is
		std::unique_ptr<BulletJoint> inPlace;      ///< one of Bullet's own that holds in its place, else null
		btElasticPlasticCapacity nominal;          ///< as it was given, with the parts that the method leaves out
		bool letGo = false;                        ///< the one in its place has left the world
	};

	std::unique_ptr<btConstraintSolver> makeSolver();
	void substep(btScalar dt);
	const HeldJoint* find(const btElasticPlasticJoint& joint) const;

	Method m_method;
	btDefaultCollisionConfiguration m_configuration{smallPools()};
	btCollisionDispatcher m_dispatcher;
	btDbvtBroadphase m_broadphase;
	std::unique_ptr<btMLCPSolverInterface> m_mlcp;
	std::unique_ptr<btConstraintSolver> m_solver;
	std::unique_ptr<btDiscreteDynamicsWorld> m_world;
	btElasticPlasticAction m_action;
	std::vector<std::unique_ptr<btCollisionShape>> m_shapes;
	std::vector<std::unique_ptr<btRigidBody>> m_bodies;
	std::vector<std::unique_ptr<btTypedConstraint>> m_constraints;
	std::vector<HeldJoint> m_joints;
	std::function<void(btScalar)> m_beforeSubstep;
	std::unique_ptr<Engine> m_engine;  // null: Bullet
};
}  // namespace ep

#endif  // EP_WORLD_H
