// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_ENERGY_H
#define EP_CHARPY_ENERGY_H

#include <deque>

#include "test/Parts.h"

namespace ep::charpy
{
/// Where energy goes in each step, from impulses: one that changes the velocity of its row from u0 to u1 does the work
/// lambda (u0 + u1) / 2 on the bodies, exactly. All sums are in Bullet's unit of length.
class Energy
{
public:
	explicit Energy(World& world) : m_world(world) {}

	/// Sums the work of a constraint of Bullet's from now on. \return its number
	int watch(btTypedConstraint& constraint);

	/// Around each step of the world.
	void beforeStep();
	void afterStep(btScalar dt);

	/// Sums begin anew.
	void reset();

	double work(int constraint) const { return m_constraints[size_t(constraint)].work; }
	double contactWork() const { return m_contact; }
	double frictionWork() const { return m_friction; }
	/// What time integration gives to the bodies: it takes weight along the end's velocity instead of the mean one, and
	/// turns bodies at constant angular velocity instead of constant angular momentum.
	double integrationWork() const { return m_integration; }

	static double kinetic(const btRigidBody& body) { return kineticEnergy(body, body.getWorldTransform().getBasis()); }
	static double potential(const btRigidBody& body);

private:
	struct Before
	{
		btVector3 linear, angular, centre;
		btMatrix3x3 basis;
	};
	struct Constraint
	{
		btTypedConstraint* constraint;
		btJointFeedback feedback;
		double work;
	};

	btVector3 meanVelocity(const btRigidBody* body, const btVector3& point) const;
	double workOn(const btRigidBody& body, const btVector3& force, const btVector3& torque, btScalar dt) const;
	void addContacts();

	World& m_world;
	std::vector<Before> m_before;  ///< by the body's user index
	std::deque<Constraint> m_constraints;
	double m_contact = 0, m_friction = 0, m_integration = 0;
};
}  // namespace ep::charpy

#endif  // EP_CHARPY_ENERGY_H
