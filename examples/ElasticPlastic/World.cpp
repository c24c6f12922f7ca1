#include "World.h"

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h"
#include "BulletDynamics/MLCPSolvers/btDantzigSolver.h"
#include "BulletDynamics/MLCPSolvers/btMLCPSolver.h"

namespace ep
{
std::unique_ptr<btConstraintSolver> World::makeSolver(Solver solver)
{
	switch (solver)
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
	auto ours = std::make_unique<btElasticPlasticConstraintSolver>();
	ours->setForm(solver == Solver::Direct ? BT_EP_DIRECT : BT_EP_ITERATIVE);
	return ours;
}

World::World(Solver solver, const btVector3& gravity, std::unique_ptr<btConstraintSolver> own)
	: m_dispatcher(&m_configuration), m_solver(std::move(own))
{
	if (!m_solver)
		m_solver = makeSolver(solver);
	m_world.reset(new btDiscreteDynamicsWorld(&m_dispatcher, &m_broadphase, m_solver.get(), &m_configuration));
	m_world->setGravity(gravity);
	m_world->addAction(&m_action);
}

World::~World()
{
	for (auto& constraint : m_constraints)
		m_world->removeConstraint(constraint.get());
	for (auto& body : m_bodies)
		m_world->removeRigidBody(body.get());
	m_constraints.clear();
	m_world->removeAction(&m_action);
}

btRigidBody* World::body(btScalar mass, btCollisionShape* shape, const btTransform& pose, bool collides)
{
	btVector3 inertia(0, 0, 0);
	if (mass > 0)
		shape->calculateLocalInertia(mass, inertia);
	btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
	// Bullet rounds an orientation when it first moves the body: do it now, before joints are measured by it.
	info.m_startWorldTransform = pose;
	for (int i = 0; i < 3; ++i)
		info.m_startWorldTransform.setRotation(info.m_startWorldTransform.getRotation().normalized());
	m_bodies.emplace_back(new btRigidBody(info));
	btRigidBody* body = m_bodies.back().get();
	body->setActivationState(DISABLE_DEACTIVATION);
	if (collides)
		m_world->addRigidBody(body);
	else
		m_world->addRigidBody(body, 0, 0);
	return body;
}

btElasticPlasticJoint* World::joint(btRigidBody& a, btRigidBody& b, const btTransform& frame,
									const btElasticPlasticCapacity& capacity, JointClass jointClass)
{
	const btTransform inA = a.getCenterOfMassTransform().inverse() * frame,
					  inB = b.getCenterOfMassTransform().inverse() * frame;
	btElasticPlasticJoint* joint = nullptr;
	if (jointClass == JointClass::Spring)
	{
		auto* constraint = new btElasticPlastic6DofSpringConstraint(a, b, inA, inB);
		joint = constraint;
		add(constraint);
	}
	else
	{
		auto* constraint = new btElasticPlastic6DofSpring2Constraint(a, b, inA, inB);
		joint = constraint;
		add(constraint);
	}
	joint->setCapacity(capacity);
	m_action.addJoint(joint);
	m_joints.push_back(joint);
	return joint;
}

void World::add(btTypedConstraint* constraint, bool disableCollisions)
{
	m_constraints.emplace_back(constraint);
	m_world->addConstraint(constraint, disableCollisions);
}

void World::step(btScalar dt, int substeps)
{
	for (int i = 0; i < substeps; ++i)
		m_world->stepSimulation(dt / substeps, 0);
}

double World::kineticEnergy() const
{
	double energy = 0;
	for (const auto& body : m_bodies)
	{
		if (body->getInvMass() == 0)
			continue;
		energy += 0.5 * double(body->getLinearVelocity().length2()) / double(body->getInvMass());
		const btVector3 spin = body->getCenterOfMassTransform().getBasis().transpose() * body->getAngularVelocity();
		for (int i = 0; i < 3; ++i)
			if (body->getInvInertiaDiagLocal()[i] > 0)
				energy += 0.5 * double(spin[i]) * double(spin[i]) / double(body->getInvInertiaDiagLocal()[i]);
	}
	return energy;
}
}  // namespace ep
