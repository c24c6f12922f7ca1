// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "compute/OdeEngine.h"

#include <ode/ode.h>

#include <map>

namespace ep
{
namespace
{
/// Begins and ends ODE's life.
struct Ode
{
	Ode() { dInitODE(); }
	~Ode() { dCloseODE(); }
};

struct DestroyWorld
{
	void operator()(dWorldID world) const { dWorldDestroy(world); }
};

/// A joint with the stiffness of one of ours.
class SoftJoint
{
public:
	SoftJoint(dWorldID world, dBodyID a, dBodyID b, const btElasticPlasticJoint& joint,
			  const btElasticPlasticCapacity& capacity, const btVector3& gravity)
		: m_ball(dJointCreateBall(world, nullptr)), m_motor(dJointCreateAMotor(world, nullptr))
	{
		const btVector3 place = joint.getPosition();
		const btMatrix3x3 axes = joint.getFrameA().getBasis();
		dJointAttach(m_ball, a, b);
		dJointSetBallAnchor(m_ball, place.x(), place.y(), place.z());
		m_shift = capacity.m_stiffness[(gravity * axes).absolute().maxAxis()];

		// Three angles that follow one another: the first axis goes with A, the last with B.
		dJointAttach(m_motor, a, b);
		dJointSetAMotorMode(m_motor, dAMotorEuler);
		const btVector3 first = axes.getColumn(0), last = axes.getColumn(2);
		dJointSetAMotorAxis(m_motor, 0, 1, first.x(), first.y(), first.z());
		dJointSetAMotorAxis(m_motor, 2, 2, last.x(), last.y(), last.z());
		for (int i = 0; i < 3; ++i)
		{
			m_rotation[i] = capacity.m_stiffness[BT_EP_TORSION + i];
			dJointSetAMotorParam(m_motor, dParamGroup * i + dParamLoStop, 0);
			dJointSetAMotorParam(m_motor, dParamGroup * i + dParamHiStop, 0);
		}
	}

	void prepare(double dt)
	{
		dJointSetBallParam(m_ball, dParamERP, 1);
		dJointSetBallParam(m_ball, dParamCFM, 1 / (dt * m_shift));
		for (int i = 0; i < 3; ++i)
		{
			dJointSetAMotorParam(m_motor, dParamGroup * i + dParamStopERP, 1);
			dJointSetAMotorParam(m_motor, dParamGroup * i + dParamStopCFM, 1 / (dt * m_rotation[i]));
		}
	}

private:
	dJointID m_ball, m_motor;
	double m_shift, m_rotation[3];
};

class OdeEngine : public Engine
{
public:
	OdeEngine(World& scene, OdeSolver solver, OdeJoints joints)
		: m_world(dWorldCreate()), m_step(solver == OdeSolver::Step ? dWorldStep : dWorldQuickStep)
	{
		const btVector3 gravity = scene.bullet().getGravity();
		dWorldSetGravity(m_world.get(), gravity.x(), gravity.y(), gravity.z());
		dWorldSetQuickStepNumIterations(m_world.get(), scene.method().iterations);
		// QuickStep shuffles its rows.
		dRandSetSeed(0);
		std::map<const btRigidBody*, dBodyID> odeBodies;
		for (const auto& body : scene.bodies())
			odeBodies[body.get()] = add(*body);
		for (const btElasticPlasticJoint* joint : scene.joints())
		{
			const dBodyID a = odeBodies.at(&joint->getConstraint().getRigidBodyA()),
						  b = odeBodies.at(&joint->getConstraint().getRigidBodyB());
			if (joints == OdeJoints::Soft)
				m_springs.emplace_back(m_world.get(), a, b, *joint, scene.nominal(*joint), gravity);
			else
				fix(a, b);
		}
	}

	void step(btScalar dt) override
	{
		if (double(dt) != m_dt)
			for (SoftJoint& spring : m_springs)
				spring.prepare(double(dt));
		m_dt = double(dt);
		m_step(m_world.get(), m_dt);
		for (const auto& [body, odeBody] : m_moving)
			show(*body, odeBody);
	}

private:
	dBodyID add(btRigidBody& body)
	{
		const dBodyID odeBody = dBodyCreate(m_world.get());
		const btVector3 place = body.getCenterOfMassPosition();
		const btQuaternion turn = body.getOrientation();
		const dQuaternion q = {turn.w(), turn.x(), turn.y(), turn.z()};
		dBodySetPosition(odeBody, place.x(), place.y(), place.z());
		dBodySetQuaternion(odeBody, q);
		if (body.getInvMass() == 0)
		{
			dBodySetKinematic(odeBody);
			return odeBody;
		}
		const btVector3& inverse = body.getInvInertiaDiagLocal();
		dMass mass;
		dMassSetParameters(&mass, 1 / body.getInvMass(), 0, 0, 0, 1 / inverse.x(), 1 / inverse.y(), 1 / inverse.z(), 0,
						   0, 0);
		dBodySetMass(odeBody, &mass);
		m_moving.emplace_back(&body, odeBody);
		return odeBody;
	}

	void fix(dBodyID a, dBodyID b)
	{
		const dJointID joint = dJointCreateFixed(m_world.get(), nullptr);
		dJointAttach(joint, a, b);
		dJointSetFixed(joint);
	}

	static void show(btRigidBody& body, dBodyID odeBody)
	{
		const auto vector = [](const dReal* v) { return btVector3(btScalar(v[0]), btScalar(v[1]), btScalar(v[2])); };
		const dReal* const q = dBodyGetQuaternion(odeBody);
		body.setCenterOfMassTransform(
			btTransform(btQuaternion(btScalar(q[1]), btScalar(q[2]), btScalar(q[3]), btScalar(q[0])),
						vector(dBodyGetPosition(odeBody))));
		body.setLinearVelocity(vector(dBodyGetLinearVel(odeBody)));
		body.setAngularVelocity(vector(dBodyGetAngularVel(odeBody)));
	}

	std::unique_ptr<dxWorld, DestroyWorld> m_world;
	int (*m_step)(dWorldID, dReal);
	std::vector<std::pair<btRigidBody*, dBodyID>> m_moving;
	std::vector<SoftJoint> m_springs;
	double m_dt = 0;
};
}  // namespace

MakeEngine makeOde(OdeSolver solver, OdeJoints joints)
{
	static const Ode ode;
	return [=](World& scene) { return std::make_unique<OdeEngine>(scene, solver, joints); };
}

std::vector<Setting> odeSettings(const std::string& problem, int rate, int substeps, bool quick)
{
	if ((problem != "cantilever-at-rest" && problem != "hanging-chain") || sizeof(dReal) != sizeof(btScalar))
		return {};
	std::vector<Setting> settings;
	const auto add = [&](OdeSolver solver, OdeJoints joints, int iterations)
	{
		Setting setting = {Method(Solver::Direct, kinds::None, iterations),
						   joints == OdeJoints::Fixed ? Scheme::OdeFixed : Scheme::OdeSoft};
		setting.method.engine = makeOde(solver, joints);
		setting.engine = solver == OdeSolver::Step ? ReportSolver::OdeStep : ReportSolver::OdeQuickStep;
		settings.push_back(setting);
	};
	for (const OdeJoints joints : {OdeJoints::Fixed, OdeJoints::Soft})
	{
		add(OdeSolver::Step, joints, 10);
		for (const int n : iterationsToCompare(rate * substeps, quick))
			add(OdeSolver::QuickStep, joints, n);
	}
	return settings;
}
}  // namespace ep
