// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/Simulation.h"

#include <algorithm>
#include <set>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "scenefile/Complaints.h"
#include "simulation/Course.h"
#include "text/Format.h"
#include "world/Place.h"
#include "world/ShownArea.h"

namespace ep
{
using JointType = SceneDescription::JointType;
using Motion = SceneDescription::Motion;

const std::vector<Named<SceneEvent::Type>>& sceneEventTypes()
{
	using Type = SceneEvent::Type;
	static const std::vector<Named<Type>> all = {
		{"yield", Type::Yield},   {"break", Type::Break}, {"crack", Type::Crack}, {"rupture", Type::Rupture},
		{"remove", Type::Remove}, {"cut", Type::Cut},     {"push", Type::Push}};
	return all;
}

const std::vector<Named<Ending>>& endings()
{
	static const std::vector<Named<Ending>> all = {{"none", Ending::None},
												   {"time", Ending::Time},
												   {"standstill", Ending::Standstill},
												   {"first break", Ending::FirstBreak},
												   {"not finite", Ending::NotFinite}};
	return all;
}

namespace
{
const int UNKNOWN_HEAT = -1000;  ///< of a fire that has not begun [degrees]

const double CALM = 0.5;  // what stands still for so long has come to rest [s]
const btVector3 GROUND_SIZE(400, 2, 400);

Method methodOf(const SceneDescription::WorldSettings& w) { return Method(w.solver, w.joints, w.iterations); }

/// Nothing of the script comes after it.
double lastDeedOf(const SceneDescription& scene)
{
	double last = scene.world.ramp;
	for (const auto& event : scene.events)
		last = std::max(last, event.time);
	for (const auto& body : scene.bodies)
		last = std::max({last, body.appears, body.path.empty() ? 0. : body.path.back().first});
	for (const auto& blast : scene.blasts)
		last = std::max(last, blast.time);
	for (const auto& load : scene.loads)
		last = std::max(last, load.course.table.empty() ? 0. : load.course.table.back().first);
	for (const auto& fire : scene.fires)
		last = std::max(last, fire.temperature.back().first);
	return last;
}

/// Whether somebody but gravity and the loads does work that is not counted.
bool isDriven(const SceneDescription& scene)
{
	return std::any_of(scene.bodies.begin(), scene.bodies.end(),
					   [](const auto& body) { return body.motion == Motion::Kinematic; }) ||
		   std::any_of(scene.joints.begin(), scene.joints.end(),
					   [](const auto& joint)
					   {
						   return (joint.type == JointType::Slider && joint.motorForce > 0) ||
								  std::any_of(std::begin(joint.freedoms), std::end(joint.freedoms),
											  [](const auto& freedom)
											  { return freedom.stiffness > 0 || freedom.damping > 0; });
					   });
}

bool isFinite(const btVector3& v)
{
	return btElasticPlasticIsFinite(double(v.x())) && btElasticPlasticIsFinite(double(v.y())) &&
		   btElasticPlasticIsFinite(double(v.z()));
}
}  // namespace

Simulation::Simulation(const SceneDescription& scene)
	: m_scene(scene),
	  m_world(std::make_unique<World>(methodOf(scene.world),
									  scene.world.ramp > 0 ? btVector3(0, 0, 0) : scene.world.gravity)),
	  m_lastDeed(lastDeedOf(scene))
{
	const SceneDescription::WorldSettings& w = m_scene.world;
	m_run.played.resize(m_scene.events.size());
	if (w.solver == Solver::Direct || w.solver == Solver::Iterative)
	{
		auto& solver = *static_cast<btElasticPlasticConstraintSolver*>(m_world->bullet().getConstraintSolver());
		btElasticPlasticSolverSettings settings = solver.getSettings();
		settings.m_contacts = w.contacts;
		settings.m_innerError = w.innerError;
		settings.m_keepsSwings = w.keepsSwings;
		settings.m_numThreads = w.threads;
		solver.setSettings(settings);
	}
	if (w.ground)
		m_world->body(0, m_world->box(GROUND_SIZE), at(0, -GROUND_SIZE.y() / 2))
			->setFriction(btScalar(w.groundFriction));
	m_anchor = m_world->body(0, m_world->box(btVector3(1, 1, 1)), at(0), false);
	buildBodies();
	buildVehicles();
	for (size_t i = 0; i < m_scene.joints.size(); ++i)
		buildJoint(i);
	refuseOverlaps();
	beginControl();
	m_audit = std::make_unique<EnergyAudit>(*m_world);
	m_run.energies.isAudited = !isDriven(m_scene);
	playScript();
}

Simulation::Simulation(const SceneDescription& scene, const SimulationState& state) : Simulation(scene)
{
	restore(state);
}

Simulation::~Simulation() = default;

void Simulation::beginControl()
{
	if (m_scene.world.error > 0)
		m_control = std::make_unique<btElasticPlasticStepControl>(m_scene.world.error);
}

// ---- building

void Simulation::buildBodies()
{
	Complaints complaints;
	m_bodies.resize(m_scene.bodies.size());
	for (size_t i = 0; i < m_bodies.size(); ++i)
	{
		m_bodies[i].shape = makeShape(*m_world, m_scene.bodies[i].shape, m_meshes);
		m_bodies[i].start = m_scene.bodies[i].pose;
		if (!m_bodies[i].shape.fault.empty())
			complaints.add({}, "bodies." + m_scene.bodies[i].name, m_bodies[i].shape.fault);
	}
	complaints.check();
	for (const SceneDescription::Vehicle& v : m_scene.vehicles)
		m_bodies[size_t(v.body)].shape = makeChassis(*m_world, v.settings.size);
	for (size_t i = 0; i < m_bodies.size(); ++i)
		if (m_scene.bodies[i].appears <= 0)
			addBody(i);
}

void Simulation::buildVehicles()
{
	for (const SceneDescription::Vehicle& v : m_scene.vehicles)
		m_vehicles.push_back({std::make_unique<Vehicle>(*m_world, v.settings, *body(v.body)), Autopilot(v.route)});
}

void Simulation::addBody(size_t index)
{
	const SceneDescription::Body& b = m_scene.bodies[index];
	BuiltBody& built = m_bodies[index];
	const double density = b.mass > 0 ? b.mass / built.shape.volume : b.density;
	const bool isMoved = b.motion == Motion::Dynamic;
	built.body = m_world->body(isMoved ? btScalar(density * built.shape.volume) : 0, built.shape.shape,
							   b.pose * built.shape.centre, b.collides);
	btRigidBody& body = *built.body;
	body.setFriction(btScalar(b.friction));
	body.setRestitution(btScalar(b.restitution));
	body.setRollingFriction(btScalar(b.rollingFriction));
	if (isMoved)
	{
		body.setMassProps(btScalar(density * built.shape.volume), built.shape.inertia * btScalar(density));
		body.updateInertiaTensor();
		body.setDamping(btScalar(m_scene.world.damping), btScalar(m_scene.world.damping));
		body.setLinearVelocity(b.velocity);
		body.setAngularVelocity(b.spin);
		if (m_scene.world.sleeps)
			body.forceActivationState(ACTIVE_TAG);
	}
	if (b.motion == Motion::Kinematic)
		body.setCollisionFlags((body.getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT) |
							   btCollisionObject::CF_KINEMATIC_OBJECT);
	if (b.isOfLattice)
	{
		const int lattice = 1 << 10;
		m_world->bullet().removeRigidBody(&body);
		m_world->bullet().addRigidBody(&body, lattice, btBroadphaseProxy::AllFilter & ~lattice);
	}
}

void Simulation::add(const SceneDescription::Body& body)
{
	m_scene.bodies.push_back(body);
	m_bodies.emplace_back();
	m_bodies.back().shape = makeShape(*m_world, body.shape, m_meshes);
	m_bodies.back().start = body.pose;
	addBody(m_bodies.size() - 1);
}

namespace
{
btTypedConstraint* makeSixDof(const SceneDescription::Joint& j, btRigidBody& a, btRigidBody& b, const btTransform& inA,
							  const btTransform& inB)
{
	auto* const joint = new btGeneric6DofSpring2Constraint(a, b, inA, inB);
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
	{
		const SceneDescription::Freedom& freedom = j.freedoms[dof];
		if (!freedom.isGiven)
			joint->setLimit(dof, 0, 0);
		// Bullet counts turns the other way round.
		else if (freedom.isLimited() && dof >= BT_EP_TORSION)
			joint->setLimit(dof, btScalar(-freedom.to), btScalar(-freedom.from));
		else if (freedom.isLimited())
			joint->setLimit(dof, btScalar(freedom.from), btScalar(freedom.to));
		else
			joint->setLimit(dof, 1, -1);
		if (freedom.stiffness > 0 || freedom.damping > 0)
		{
			joint->enableSpring(dof, true);
			joint->setStiffness(dof, btScalar(freedom.stiffness));
			joint->setDamping(dof, btScalar(freedom.damping));
			joint->setEquilibriumPoint(dof);
		}
	}
	return joint;
}
}  // namespace

btTypedConstraint* Simulation::makeBulletsOwn(const SceneDescription::Joint& j, btRigidBody& a, btRigidBody& b)
{
	const btTransform inA = a.getCenterOfMassTransform().inverse() * j.frame,
					  inB = b.getCenterOfMassTransform().inverse() * j.frame;
	switch (j.type)
	{
		case JointType::Hinge:
		{
			const btVector3 axis = j.frame.getBasis().getColumn(0);
			auto* const hinge = new btHingeConstraint(a, b, inA.getOrigin(), inB.getOrigin(),
													  a.getCenterOfMassTransform().getBasis().transpose() * axis,
													  b.getCenterOfMassTransform().getBasis().transpose() * axis);
			const SceneDescription::Freedom& turn = j.freedoms[BT_EP_TORSION];
			// Bullet counts a hinge's angle the other way round.
			if (turn.isLimited())
				hinge->setLimit(btScalar(-turn.to), btScalar(-turn.from));
			if (j.motorForce > 0)
				hinge->enableAngularMotor(true, btScalar(j.motorSpeed), btScalar(j.motorForce * m_scene.world.step));
			m_feedbacks.push_back(std::make_unique<btJointFeedback>());
			hinge->setJointFeedback(m_feedbacks.back().get());
			return hinge;
		}
		case JointType::Ball:
			return new btPoint2PointConstraint(a, b, inA.getOrigin(), inB.getOrigin());
		case JointType::Slider:
		{
			auto* const slider = new btSliderConstraint(a, b, inA, inB, true);
			const SceneDescription::Freedom& way = j.freedoms[BT_EP_AXIAL];
			slider->setLowerLinLimit(btScalar(way.isLimited() ? way.from : 1));
			slider->setUpperLinLimit(btScalar(way.isLimited() ? way.to : -1));
			slider->setPoweredLinMotor(j.motorForce > 0);
			slider->setTargetLinMotorVelocity(btScalar(j.motorSpeed));
			slider->setMaxLinMotorForce(btScalar(j.motorForce));
			return slider;
		}
		case JointType::ConeTwist:
		{
			auto* const cone = new btConeTwistConstraint(a, b, inA, inB);
			const auto span = [&](int dof) { return btScalar(j.freedoms[dof].isGiven ? j.freedoms[dof].to : 0); };
			cone->setLimit(span(BT_EP_BENDING_Z), span(BT_EP_BENDING_Y), span(BT_EP_TORSION));
			return cone;
		}
		case JointType::SixDof:
			return makeSixDof(j, a, b, inA, inB);
		case JointType::Fixed:
		case JointType::World:
		case JointType::Spring:
		case JointType::Paper:
			break;
	}
	return new btFixedConstraint(a, b, inA, inB);
}

void Simulation::buildJoint(size_t index)
{
	const SceneDescription::Joint& j = m_scene.joints[index];
	btRigidBody* const a = j.bodies[0] == SceneDescription::WORLD ? m_anchor : body(j.bodies[0]);
	btRigidBody* const b = j.bodies[1] == SceneDescription::WORLD ? m_anchor : body(j.bodies[1]);
	BuiltJoint built;
	if (j.type < JointType::Fixed)
	{
		built.joint =
			m_world->joint(*a, *b, j.frame, j.capacity,
						   j.type == JointType::Spring ? JointClass::Spring : m_scene.world.joints.jointClass);
		if (j.type == JointType::Paper)
			built.joint->setScheme(BT_EP_SCHEME_PAPER);
		else if (m_scene.world.scheme != BT_EP_SCHEME_IMPLICIT)
			built.joint->setScheme(m_scene.world.scheme);
		built.joint->setName(j.name.c_str());
		// Bullet's class would lock translations that have no capacity.
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			if (!j.capacity.isElasticPlastic(dof))
				m_world->release(*built.joint, dof);
		built.constraint = &built.joint->getConstraint();
		m_indexOf[built.joint] = int(index);
	}
	else
	{
		built.constraint = makeBulletsOwn(j, *a, *b);
		if (j.breaksAt > 0)
			built.constraint->setBreakingImpulseThreshold(btScalar(j.breaksAt * m_scene.world.step));
		m_world->add(built.constraint, !j.collides);
	}
	m_joints.push_back(built);
}

/// Bodies that stand in each other would be shot apart.
void Simulation::refuseOverlaps()
{
	const btScalar share = btScalar(.05);  // of the smaller one's least size
	std::unordered_map<const btCollisionObject*, const std::string*> names;
	for (size_t i = 0; i < m_bodies.size(); ++i)
		names[m_bodies[i].body] = &m_scene.bodies[i].name;
	const std::string ground = "the ground";
	const auto nameOf = [&](const btCollisionObject* object)
	{
		const auto found = names.find(object);
		return found == names.end() ? ground : *found->second;
	};
	const auto leastSize = [](const btCollisionObject* object)
	{
		btVector3 low, high;
		object->getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
		return (high - low)[(high - low).minAxis()];
	};
	m_world->bullet().performDiscreteCollisionDetection();
	Complaints complaints;
	btDispatcher& dispatcher = *m_world->bullet().getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
	{
		const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
		const btCollisionObject *const a = manifold.getBody0(), *const b = manifold.getBody1();
		btScalar depth = 0;
		for (int k = 0; k < manifold.getNumContacts(); ++k)
			depth = btMax(depth, -manifold.getContactPoint(k).getDistance());
		if (depth > share * btMin(leastSize(a), leastSize(b)))
			complaints.add(
				{}, "bodies." + nameOf(a),
				format("stands %.3g m deep in %s; move one, or join them", double(depth), nameOf(b).c_str()));
	}
	complaints.check();
}

// ---- stepping

void Simulation::step()
{
	const double dt = m_scene.world.step;
	if (m_control)
	{
		m_control->begin(btScalar(dt));
		for (btScalar length; (length = m_control->next(m_world->bullet())) > 0;)
		{
			substep(length);
			m_control->observe(m_world->bullet(), m_world->action());
		}
	}
	else
		for (int i = 0; i < m_scene.world.substeps; ++i)
			substep(btScalar(dt / m_scene.world.substeps));
	for (const Driven& driven : m_vehicles)
		driven.vehicle->turnWheels();
	takeEvents();
	checkEnd();
	playScript();
}

void Simulation::substep(btScalar dt)
{
	if (m_beforeSubstep)
		m_beforeSubstep(m_run.time + double(dt) / 2);
	setGravity();
	heatJoints(m_run.time);
	moveKinematic(m_run.time + double(dt));
	applyLoads(m_scene.loads, m_run.time + double(dt) / 2);
	applyLoads(m_addedLoads, m_run.time + double(dt) / 2);
	applyBlasts(m_run.time, double(dt));
	driveVehicles(double(dt));
	m_audit->begin();
	m_world->step(dt);
	m_audit->end(dt);
	m_run.time += double(dt);
	m_run.lastSubstep = double(dt);
	m_run.energies.gained += std::max(0., m_audit->gain() - m_audit->bulletsRecovery());
	m_run.energies.turnover = std::max(m_run.energies.turnover, m_audit->turnover());
}

void Simulation::setGravity()
{
	const SceneDescription::WorldSettings& w = m_scene.world;
	if (w.ramp > 0 && m_run.time < 2 * w.ramp)
		m_world->bullet().setGravity(w.gravity * btScalar(std::min(1., m_run.time / w.ramp)));
}

/// They wait until gravity is there.
void Simulation::driveVehicles(double dt)
{
	for (size_t i = 0; i < m_vehicles.size(); ++i)
	{
		const SceneDescription::Vehicle& v = m_scene.vehicles[i];
		Vehicle& vehicle = *m_vehicles[i].vehicle;
		if (!isThere(v.body))
			continue;
		Controls controls;
		controls.handbrake = !v.route.empty();
		if (!v.route.empty() && m_run.time >= m_scene.world.ramp)
			controls = m_vehicles[i].autopilot.drive(vehicle.pose(), vehicle.speed(), btScalar(dt));
		vehicle.drive(controls, btScalar(dt));
		vehicle.updateVehicle(btScalar(dt));
	}
}

void Simulation::moveKinematic(double time)
{
	for (size_t i = 0; i < m_bodies.size(); ++i)
	{
		const auto& path = m_scene.bodies[i].path;
		if (path.empty())
			continue;
		btTransform pose = m_scene.bodies[i].pose;
		pose.setOrigin(onPath(path, time));
		m_bodies[i].body->setWorldTransform(pose * m_bodies[i].shape.centre);
	}
}

void Simulation::applyLoads(const std::vector<SceneDescription::Load>& loads, double time)
{
	for (const SceneDescription::Load& load : loads)
	{
		const btScalar factor = btScalar(factorAt(load.course, time));
		if (factor == 0)
			continue;
		for (int index : load.bodies)
		{
			if (!isThere(index) || body(index)->getInvMass() == 0)
				continue;
			btRigidBody& body = *this->body(index);
			const btTransform pose = poseOf(index);
			const btMatrix3x3 turn = load.turnsAlong ? pose.getBasis() : btMatrix3x3::getIdentity();
			body.activate();
			body.applyForce(turn * load.force * factor, pose * load.at - body.getCenterOfMassPosition());
			body.applyTorque(turn * load.moment * factor);
		}
	}
}

/// A joint's capacity in all fires that it is in.
btElasticPlasticCapacity Simulation::heatedCapacity(int index) const
{
	const btElasticPlasticCapacity& cold = m_scene.joints[size_t(index)].capacity;
	int last = 0;
	for (int i = 0; i < cold.m_fibres.size(); ++i)
		last = std::max(last, cold.m_fibres[i].m_part);
	std::vector<btElasticPlasticHeat> heats(size_t(last) + 1);
	bool isEven = true;
	for (size_t i = 0; i < m_degrees.size(); ++i)
	{
		const SceneDescription::Fire& fire = m_scene.fires[i];
		if (m_degrees[i] == UNKNOWN_HEAT ||
			std::find(fire.joints.begin(), fire.joints.end(), index) == fire.joints.end())
			continue;
		const btElasticPlasticHeat heat = fire.law(btScalar(m_degrees[i]));
		isEven = fire.parts.empty();
		for (size_t part = 0; part < heats.size(); ++part)
			if (isEven || std::find(fire.parts.begin(), fire.parts.end(), int(part)) != fire.parts.end())
				heats[part] = heat;
	}
	return isEven ? cold.heated(heats[0]) : cold.heated(heats.data(), int(heats.size()));
}

/// By whole degrees: each change of a capacity costs.
void Simulation::heatJoints(double time)
{
	m_degrees.resize(m_scene.fires.size(), UNKNOWN_HEAT);
	for (size_t i = 0; i < m_degrees.size(); ++i)
	{
		SceneDescription::Course course;
		course.table = m_scene.fires[i].temperature;
		const int degrees = int(std::lround(factorAt(course, time)));
		if (degrees == m_degrees[i])
			continue;
		m_degrees[i] = degrees;
		double change = 0;
		for (int index : m_scene.fires[i].joints)
			if (joint(index) && !isCut(index) && !isBroken(index))
			{
				change -= joint(index)->getElasticEnergy();
				joint(index)->setCapacity(heatedCapacity(index));
				change += joint(index)->getElasticEnergy();
			}
		m_audit->takeChange(change);
	}
}

void Simulation::applyBlasts(double time, double dt)
{
	const double nearest = 0.1;  // [m]
	for (const SceneDescription::Blast& blast : m_scene.blasts)
		for (size_t i = 0; i < m_bodies.size(); ++i)
		{
			if (!isThere(int(i)) || m_bodies[i].body->getInvMass() == 0)
				continue;
			btRigidBody& body = *m_bodies[i].body;
			const btVector3 way = body.getCenterOfMassPosition() - blast.at;
			const double distance = std::max(nearest, double(way.length())),
						 arrival = blast.time + distance / blast.speed;
			const double share = meanOfPulse(arrival, blast.duration, time, dt);
			if (share <= 0 || way.length() < SIMD_EPSILON)
				continue;
			const btVector3 direction = way.normalized();
			const double area = shownArea(*body.getCollisionShape(),
										  body.getCenterOfMassTransform().getBasis().transpose() * direction);
			body.activate();
			body.applyCentralForce(direction *
								   btScalar(blast.pressure * std::pow(distance, -blast.decay) * share * area));
		}
}

// ---- what the scene does, and what comes of it

void Simulation::playScript()
{
	const double now = m_run.time + m_scene.world.step / 2;
	for (size_t i = 0; i < m_bodies.size(); ++i)
		if (!m_bodies[i].body && m_scene.bodies[i].appears <= now)
			appear(int(i));
	for (size_t i = 0; i < m_scene.events.size(); ++i)
	{
		const SceneDescription::Event& event = m_scene.events[i];
		if (m_run.played[i] || event.time > now)
			continue;
		m_run.played[i] = true;
		for (int index : event.cut)
			cut(index);
		for (int index : event.removed)
			remove(index);
		for (int index : event.pushed)
			push(index, event.velocity);
	}
}

void Simulation::note(SceneEvent::Type type, int index, const btVector3& place)
{
	m_run.events.push_back({m_run.time, type, index, -1, 0, place});
}

void Simulation::appear(int index)
{
	m_run.changes.push_back({SimulationState::Change::Type::Appear, index});
	addBody(size_t(index));
}

void Simulation::remove(int index)
{
	if (!isThere(index))
		return;
	btRigidBody& body = *this->body(index);
	note(SceneEvent::Type::Remove, index, body.getCenterOfMassPosition());
	m_run.changes.push_back({SimulationState::Change::Type::Remove, index});
	for (size_t i = 0; i < m_joints.size(); ++i)
		if (m_scene.joints[i].bodies[0] == index || m_scene.joints[i].bodies[1] == index)
			m_joints[i].isCut = true;
	for (int i = 0; i < body.getNumConstraintRefs(); ++i)
	{
		body.getConstraintRef(i)->getRigidBodyA().activate();
		body.getConstraintRef(i)->getRigidBodyB().activate();
	}
	m_world->action().removeBody(m_world->bullet(), body);
	body.setLinearVelocity(btVector3(0, 0, 0));
	body.setAngularVelocity(btVector3(0, 0, 0));
}

void Simulation::cut(int index)
{
	BuiltJoint& built = m_joints[size_t(index)];
	if (built.isCut || isBroken(index))
		return;
	built.isCut = true;
	m_run.changes.push_back({SimulationState::Change::Type::Cut, index});
	btTypedConstraint* constraint = built.constraint;
	if (built.joint)
	{
		note(SceneEvent::Type::Cut, index, built.joint->getPosition());
		m_world->action().removeJoint(built.joint);
		if (const BulletJoint* const own = m_world->inPlaceOf(*built.joint))
			constraint = &own->constraint();
	}
	else
		note(SceneEvent::Type::Cut, index, m_scene.joints[size_t(index)].frame.getOrigin());
	constraint->getRigidBodyA().activate();
	constraint->getRigidBodyB().activate();
	m_world->bullet().removeConstraint(constraint);
}

void Simulation::push(int index, const btVector3& velocity)
{
	if (!isThere(index) || body(index)->getInvMass() == 0)
		return;
	note(SceneEvent::Type::Push, index, body(index)->getCenterOfMassPosition());
	body(index)->activate();
	body(index)->setLinearVelocity(velocity);
	if (m_control)
		m_control->expectBlow();
}

namespace
{
SceneEvent::Type typeOf(const btElasticPlasticEvent& event)
{
	switch (event.m_type)
	{
		case BT_EP_EVENT_BREAK:
			return SceneEvent::Type::Break;
		case BT_EP_EVENT_CRACK:
			return SceneEvent::Type::Crack;
		case BT_EP_EVENT_RUPTURE:
			return SceneEvent::Type::Rupture;
		default:
			return SceneEvent::Type::Yield;
	}
}
}  // namespace

void Simulation::takeEvents()
{
	btElasticPlasticEvent e;
	while (m_world->action().popEvent(e))
	{
		const auto found = m_indexOf.find(e.m_joint);
		if (found != m_indexOf.end())
			m_run.events.push_back({e.m_time, typeOf(e), found->second, e.m_dof, e.m_energy, e.m_position, e.m_part});
	}
	SceneEnergies& sum = m_run.energies;
	sum.kinetic = m_world->kineticEnergy();
	sum.elastic = sum.plastic = sum.damping = sum.numerical = 0;
	for (size_t i = 0; i < m_joints.size(); ++i)
	{
		BuiltJoint& built = m_joints[i];
		if (!built.isBroken && !built.isCut && isBroken(int(i)))
		{
			built.isBroken = true;
			// Of ours the queue has told.
			if (!built.joint || !m_scene.world.joints.isElasticPlastic())
				note(SceneEvent::Type::Break, int(i), m_scene.joints[i].frame.getOrigin());
		}
		if (!built.joint)
			continue;
		sum.elastic += isBroken(int(i)) || built.isCut ? 0 : built.joint->getElasticEnergy();
		sum.plastic += built.joint->getPlasticEnergy();
		sum.damping += built.joint->getDampingEnergy();
		sum.numerical += built.joint->getNumericalEnergy();
	}
}

double Simulation::fastest() const
{
	double most = 0;
	for (size_t i = 0; i < m_bodies.size(); ++i)
		if (isThere(int(i)) && m_bodies[i].body->getInvMass() > 0)
			most = std::max(most, double(m_bodies[i].body->getLinearVelocity().length()));
	return most;
}

void Simulation::checkEnd()
{
	for (const BuiltBody& built : m_bodies)
		if (built.body && !(isFinite(built.body->getCenterOfMassPosition()) &&
							isFinite(built.body->getLinearVelocity()) && isFinite(built.body->getAngularVelocity())))
		{
			m_run.ending = Ending::NotFinite;
			return;
		}
	const SceneDescription::End& end = m_scene.end;
	const bool isWaiting = std::any_of(m_vehicles.begin(), m_vehicles.end(),
									   [](const Driven& driven) { return driven.autopilot.isWaiting(); });
	const bool isCalm = end.standstill > 0 && m_run.time > m_lastDeed && !isWaiting && fastest() < end.standstill;
	m_run.calm = isCalm ? m_run.calm + m_scene.world.step : 0;
	if (end.firstBreak && numBroken() > 0)
		m_run.ending = Ending::FirstBreak;
	else if (m_run.calm > CALM)
		m_run.ending = Ending::Standstill;
	else if (m_run.time + m_scene.world.step / 2 > end.time)
		m_run.ending = Ending::Time;
}

// ---- states

SimulationState Simulation::save()
{
	SimulationState state = m_run;
	state.world = m_world->save();
	if (state.world.empty())
		throw SceneError(
			"the state cannot be saved: in place of elastic-plastic joints stand others, of which Bullet does "
			"not tell the state; give world.joints one of the elastic-plastic kinds");
	for (size_t i = 0; i < m_joints.size(); ++i)
		if (m_joints[i].isCut && m_joints[i].joint)
			state.cut.push_back({int(i), m_joints[i].joint->getState()});
		else if (m_joints[i].isBroken && !m_joints[i].joint)
			state.brokenBulletsOwn.push_back(int(i));
	state.vehicles = vehicleStates();
	beginControl();
	return state;
}

std::vector<SimulationState::Vehicle> Simulation::vehicleStates() const
{
	std::unordered_map<const btRigidBody*, int> places;
	for (size_t i = 0; i < m_bodies.size(); ++i)
		places[m_bodies[i].body] = int(i);
	std::vector<SimulationState::Vehicle> states;
	for (const Driven& driven : m_vehicles)
	{
		const Vehicle::Memory memory = driven.vehicle->memory();
		SimulationState::Vehicle state = {{}, double(memory.steer), driven.autopilot.progress()};
		for (const Vehicle::Memory::Wheel& w : memory.wheels)
		{
			const auto ground = w.ground ? places.find(w.ground) : places.end();
			state.wheels.push_back({double(w.turn), double(w.lastTurn), double(w.suspension), double(w.force),
									ground == places.end() ? SceneDescription::WORLD : ground->second});
		}
		states.push_back(state);
	}
	return states;
}

/// Throws nothing: what does not fit has been refused.
void Simulation::restoreVehicles(const std::vector<SimulationState::Vehicle>& states)
{
	for (size_t i = 0; i < m_vehicles.size(); ++i)
	{
		Vehicle::Memory memory;
		memory.steer = btScalar(states[i].steer);
		for (const SimulationState::Vehicle::Wheel& w : states[i].wheels)
			memory.wheels.push_back(
				{btScalar(w.turn), btScalar(w.lastTurn), btScalar(w.suspension), btScalar(w.force), body(w.ground)});
		m_vehicles[i].vehicle->restore(memory);
		m_vehicles[i].autopilot.setProgress(states[i].progress);
	}
}

/// Into a simulation that has just been built.
void Simulation::restore(const SimulationState& state)
{
	using Type = SimulationState::Change::Type;
	const SceneError other("the state is of another scene, or of another build of this program");
	// What the script does at time 0 has been done.
	for (size_t i = m_run.changes.size(); i < state.changes.size(); ++i)
	{
		const auto [type, index] = state.changes[i];
		if (index < 0 || size_t(index) >= (type == Type::Cut ? m_joints.size() : m_bodies.size()) ||
			(type == Type::Appear && body(index)))
			throw other;
		if (type == Type::Appear)
			appear(index);
		else if (type == Type::Remove)
			remove(index);
		else
			cut(index);
	}
	if (m_scene.world.ramp > 0)
		m_world->bullet().setGravity(m_scene.world.gravity * btScalar(std::min(1., state.time / m_scene.world.ramp)));
	if (!m_world->restore(state.world))
		throw other;
	for (const auto& [index, joint] : state.cut)
		if (index < 0 || size_t(index) >= m_joints.size() || !m_joints[size_t(index)].isCut ||
			!m_joints[size_t(index)].joint || !m_joints[size_t(index)].joint->setState(joint))
			throw other;
	for (int index : state.brokenBulletsOwn)
		if (index < 0 || size_t(index) >= m_joints.size() || m_joints[size_t(index)].joint)
			throw other;
		else
			m_joints[size_t(index)].constraint->setEnabled(false);
	if (state.played.size() != m_run.played.size() || state.vehicles.size() != m_vehicles.size())
		throw other;
	for (size_t i = 0; i < m_vehicles.size(); ++i)
	{
		const auto& wheels = state.vehicles[i].wheels;
		if (int(wheels.size()) != m_vehicles[i].vehicle->getNumWheels() ||
			state.vehicles[i].progress.leg > m_scene.vehicles[i].route.size() ||
			std::any_of(wheels.begin(), wheels.end(), [&](const auto& w) { return w.ground >= int(m_bodies.size()); }))
			throw other;
	}
	restoreVehicles(state.vehicles);
	m_run = state;
	m_run.world.clear();
	m_run.cut.clear();
	m_run.vehicles.clear();
	for (size_t i = 0; i < m_joints.size(); ++i)
		m_joints[i].isBroken = isBroken(int(i));
	beginControl();
}

// ---- readings

btTransform Simulation::poseOf(int index) const
{
	const BuiltBody& built = m_bodies[size_t(index)];
	return built.body ? built.body->getCenterOfMassTransform() * built.shape.centre.inverse() : built.start;
}

std::vector<Simulation::Wheel> Simulation::wheels() const
{
	const btScalar width = btScalar(.75);  // over the radius
	// The axle is a wheel's x axis, and a cylinder's y.
	const btTransform turn(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI));
	std::vector<Wheel> wheels;
	for (size_t i = 0; i < m_vehicles.size(); ++i)
		for (int k = 0; k < m_vehicles[i].vehicle->getNumWheels(); ++k)
		{
			const int body = m_scene.vehicles[i].body;
			const btScalar radius = m_scene.vehicles[i].settings.wheelRadius;
			SceneDescription::Shape shape;
			shape.kind = SceneDescription::ShapeKind::Cylinder;
			shape.size.setValue(radius, radius * width, 0);
			wheels.push_back({m_scene.bodies[size_t(body)].name + "/wheel-" + std::to_string(k + 1), shape,
							  m_vehicles[i].vehicle->getWheelInfo(k).m_worldTransform * turn, body});
		}
	return wheels;
}

bool Simulation::isBroken(int index) const
{
	const BuiltJoint& built = m_joints[size_t(index)];
	if (!built.joint)
		return !built.constraint->isEnabled();
	const BulletJoint* const own = m_world->inPlaceOf(*built.joint);
	return own ? own->isBroken() : built.joint->isBroken();
}

int Simulation::numBroken() const
{
	return int(std::count_if(m_joints.begin(), m_joints.end(), [](const BuiltJoint& joint) { return joint.isBroken; }));
}
}  // namespace ep
