// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "world/World.h"

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticSnapshot.h"
#include "BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h"
#include "BulletDynamics/MLCPSolvers/btDantzigSolver.h"
#include "BulletDynamics/MLCPSolvers/btMLCPSolver.h"

namespace ep
{
namespace
{
/// Solves contacts after all else: what a comparison leaves out.
class ContactsApart : public btElasticPlasticConstraintSolver
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	btScalar solveGroup(btCollisionObject** bodies, int numBodies, btPersistentManifold** manifolds, int numManifolds,
						btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info,
						btIDebugDraw* drawer, btDispatcher* dispatcher) override
	{
		btElasticPlasticConstraintSolver::solveGroup(bodies, numBodies, nullptr, 0, constraints, numConstraints, info,
													 drawer, dispatcher);
		if (numManifolds == 0)
			return 0;
		// Loads have been given already.
		for (int i = 0; i < numBodies; ++i)
			if (btRigidBody* body = btRigidBody::upcast(bodies[i]))
				body->clearForces();
		return m_contacts.solveGroup(bodies, numBodies, manifolds, numManifolds, nullptr, 0, info, drawer, dispatcher);
	}

private:
	btSequentialImpulseConstraintSolver m_contacts;
};

/// What a joint is to bear without the parts that are left out.
btElasticPlasticCapacity without(btElasticPlasticCapacity capacity, const Method& method)
{
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		if (!capacity.isElasticPlastic(dof))
			continue;
		else if ((!method.has(parts::Shear) && (dof == BT_EP_SHEAR_Y || dof == BT_EP_SHEAR_Z)) ||
				 (!method.has(parts::Torsion) && dof == BT_EP_TORSION))
			capacity.clear(dof);
		else if (!method.has(parts::Elasticity))
			capacity.setRigidPlastic(dof, capacity.m_yield[dof], capacity.m_ductility[dof]);
	if (!method.has(parts::Interaction))
		capacity.m_fibres.clear();
	return capacity;
}
}  // namespace

std::unique_ptr<btConstraintSolver> World::makeSolver()
{
	switch (m_method.solver)
	{
		case Solver::Stock:
			return std::make_unique<btSequentialImpulseConstraintSolver>();
		case Solver::Nncg:
			return std::make_unique<btNNCGConstraintSolver>();
		case Solver::Mlcp:
			m_mlcp = std::make_unique<btDantzigSolver>();
			return std::make_unique<btMLCPSolver>(m_mlcp.get());
		case Solver::Iterative:
		case Solver::Direct:
			break;
	}
	auto ours = m_method.has(parts::ContactCoupling) ? std::make_unique<btElasticPlasticConstraintSolver>()
													 : std::make_unique<ContactsApart>();
	ours->setForm(m_method.solver == Solver::Direct ? BT_EP_DIRECT : BT_EP_ITERATIVE);
	if (!m_method.has(parts::InnerSteps))
	{
		btElasticPlasticSolverSettings settings = ours->getSettings();
		settings.m_innerError = 0;
		ours->setSettings(settings);
	}
	return ours;
}

World::World(const Method& method, const btVector3& gravity, std::unique_ptr<btConstraintSolver> own)
	: m_method(method), m_dispatcher(&m_configuration), m_solver(std::move(own))
{
	if (!m_solver)
		m_solver = makeSolver();
	m_world.reset(new btDiscreteDynamicsWorld(&m_dispatcher, &m_broadphase, m_solver.get(), &m_configuration));
	m_world->setGravity(gravity);
	m_world->getSolverInfo().m_numIterations = method.iterations;
	m_world->addAction(&m_action);
}

World::~World()
{
	for (HeldJoint& held : m_joints)
		m_world->removeConstraint(held.inPlace ? &held.inPlace->constraint() : held.owner.get());
	for (auto& constraint : m_constraints)
		m_world->removeConstraint(constraint.get());
	for (auto& body : m_bodies)
		m_world->removeRigidBody(body.get());
	m_joints.clear();
	m_constraints.clear();
	m_world->removeAction(&m_action);
}

btRigidBody* World::body(btScalar mass, btCollisionShape* shape, const btTransform& pose, bool collides)
{
	btVector3 inertia(0, 0, 0);
	if (mass > 0)
		shape->calculateLocalInertia(mass, inertia);
	btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
	info.m_startWorldTransform = pose;
	m_bodies.emplace_back(new btRigidBody(info));
	btRigidBody* body = m_bodies.back().get();
	// Bullet rounds an orientation when it first moves the body. It does so now, before joints are measured by it, and by its own
	// functions: the same ones compiled with other options here would round otherwise.
	for (int i = 0; i < 3; ++i)
	{
		btTransform rounded;
		body->predictIntegratedTransform(0, rounded);
		body->setCenterOfMassTransform(rounded);
	}
	body->setActivationState(DISABLE_DEACTIVATION);
	if (collides && mass > 0 && m_method.has(parts::ContinuousCollision))
	{
		btVector3 low, high;
		shape->getAabb(btTransform::getIdentity(), low, high);
		const btScalar least = (high - low)[(high - low).minAxis()];
		body->setCcdMotionThreshold(least / 2);
		body->setCcdSweptSphereRadius(least / 5);
	}
	if (collides)
		m_world->addRigidBody(body);
	else
		m_world->addRigidBody(body, 0, 0);
	return body;
}

void World::allowSleep(btScalar speed)
{
	for (auto& body : m_bodies)
	{
		body->setSleepingThresholds(speed, speed);
		body->forceActivationState(ACTIVE_TAG);
	}
}

void World::keepAwake()
{
	for (auto& body : m_bodies)
		body->setDeactivationTime(0);
}

btElasticPlasticJoint* World::joint(btRigidBody& a, btRigidBody& b, const btTransform& frame,
									const btElasticPlasticCapacity& capacity, JointClass jointClass)
{
	const btTransform inA = a.getCenterOfMassTransform().inverse() * frame,
					  inB = b.getCenterOfMassTransform().inverse() * frame;
	btElasticPlasticJoint* joint;
	if (jointClass == JointClass::Spring)
		joint = new btElasticPlastic6DofSpringConstraint(a, b, inA, inB);
	else
		joint = new btElasticPlastic6DofSpring2Constraint(a, b, inA, inB);
	HeldJoint held = {joint, std::unique_ptr<btTypedConstraint>(&joint->getConstraint()), nullptr, capacity};
	// What it refuses is not its capacity, with or without parts.
	if (!joint->setCapacity(without(capacity, m_method)))
		held.nominal = joint->getCapacity();
	const JointKind kind = {m_method.joints, jointClass};
	if (kind.isElasticPlastic())
	{
		joint->setScheme(m_method.joints == Joints::Paper ? BT_EP_SCHEME_PAPER : BT_EP_SCHEME_IMPLICIT);
		m_world->addConstraint(held.owner.get(), true);
		m_action.addJoint(joint);
	}
	else if ((held.inPlace = BulletJoint::make(kind, a, b, frame, capacity)))
		m_world->addConstraint(&held.inPlace->constraint(), true);
	m_joints.push_back(std::move(held));
	return joint;
}

std::vector<btElasticPlasticJoint*> World::joints() const
{
	std::vector<btElasticPlasticJoint*> joints;
	joints.reserve(m_joints.size());
	for (const HeldJoint& held : m_joints)
		joints.push_back(held.joint);
	return joints;
}

const World::HeldJoint* World::find(const btElasticPlasticJoint& joint) const
{
	for (const HeldJoint& held : m_joints)
		if (held.joint == &joint)
			return &held;
	return nullptr;
}

const BulletJoint* World::inPlaceOf(const btElasticPlasticJoint& joint) const
{
	const HeldJoint* const held = find(joint);
	return held ? held->inPlace.get() : nullptr;
}

const btElasticPlasticCapacity& World::nominal(const btElasticPlasticJoint& joint) const
{
	const HeldJoint* const held = find(joint);
	return held && !m_method.has(parts::OfJoints) ? held->nominal : joint.getCapacity();
}

void World::release(btElasticPlasticJoint& joint, int dof)
{
	btElasticPlasticCapacity capacity = joint.getCapacity();
	capacity.clear(dof);
	joint.setCapacity(capacity);
	// In Bullet's class too: there translations are locked unless told otherwise.
	btTypedConstraint& constraint = joint.getConstraint();
	if (constraint.getConstraintType() == D6_SPRING_CONSTRAINT_TYPE)
		static_cast<btGeneric6DofSpringConstraint&>(constraint).setLimit(dof, 1, -1);
	else
		static_cast<btGeneric6DofSpring2Constraint&>(constraint).setLimit(dof, 1, -1);
	if (const HeldJoint* const held = find(joint))
		if (held->inPlace)
			held->inPlace->release(dof);
}

void World::add(btTypedConstraint* constraint, bool disableCollisions)
{
	m_constraints.emplace_back(constraint);
	m_world->addConstraint(constraint, disableCollisions);
}

void World::start()
{
	if (m_method.engine && !m_engine)
		m_engine = m_method.engine(*this);
}

void World::step(btScalar dt, int substeps)
{
	for (int i = 0; i < substeps; ++i)
		substep(dt / substeps);
}

void World::substep(btScalar dt)
{
	start();
	if (m_beforeSubstep)
		m_beforeSubstep(dt);
	if (m_engine)
		return m_engine->step(dt);
	for (HeldJoint& held : m_joints)
		if (held.inPlace && !held.letGo)
			held.inPlace->beforeStep(dt);
	m_world->stepSimulation(dt, 0);
	for (HeldJoint& held : m_joints)
	{
		if (!held.inPlace || held.letGo)
			continue;
		held.inPlace->afterStep(dt);
		held.letGo = held.inPlace->isBroken();
		if (held.letGo)
			m_world->removeConstraint(&held.inPlace->constraint());
	}
}

std::vector<char> World::save()
{
	std::vector<char> bytes;
	for (const HeldJoint& held : m_joints)
		if (held.inPlace)
			return bytes;
	bytes.resize(size_t(btElasticPlasticSave(*m_world, m_broadphase, m_action, nullptr, 0)));
	btElasticPlasticSave(*m_world, m_broadphase, m_action, bytes.data(), int(bytes.size()));
	return bytes;
}

bool World::restore(const std::vector<char>& saved)
{
	return !saved.empty() &&
		   !btElasticPlasticRestore(*m_world, m_broadphase, m_action, saved.data(), int(saved.size()));
}

double kineticEnergy(const btRigidBody& body, const btMatrix3x3& basis)
{
	if (body.getInvMass() == 0)
		return 0;
	double energy = 0.5 * double(body.getLinearVelocity().length2()) / double(body.getInvMass());
	const btVector3 spin = basis.transpose() * body.getAngularVelocity();
	for (int i = 0; i < 3; ++i)
		if (body.getInvInertiaDiagLocal()[i] > 0)
			energy += 0.5 * double(spin[i]) * double(spin[i]) / double(body.getInvInertiaDiagLocal()[i]);
	return energy;
}

double World::kineticEnergy() const
{
	double energy = 0;
	for (const auto& body : m_bodies)
		energy += ep::kineticEnergy(*body, body->getCenterOfMassTransform().getBasis());
	return energy;
}
}  // namespace ep
