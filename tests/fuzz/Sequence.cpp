// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "fuzz/Sequence.h"

#include <algorithm>

#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpringConstraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticSnapshot.h"
#include "LinearMath/btIDebugDraw.h"
#include "world/Place.h"

namespace
{
const int MOST_BODIES = 14, MOST_JOINTS = 20;
const int OPERATIONS = 80;
const int GROUP = 1;  ///< of collisions

bool isFinite(const btVector3& v) { return btElasticPlasticIsFinite(double(v.x()) + double(v.y()) + double(v.z())); }

struct Canvas : btIDebugDraw
{
	void drawLine(const btVector3&, const btVector3&, const btVector3&) override {}
	void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
	void reportErrorWarning(const char*) override {}
	void draw3dText(const btVector3&, const char*) override {}
	void setDebugMode(int) override {}
	int getDebugMode() const override { return DBG_DrawWireframe | DBG_DrawConstraints | DBG_DrawConstraintLimits; }
};
}  // namespace

Sequence::Sequence(unsigned seed, bool isHostile, bool isPool)
	: m_chance(seed),
	  m_isHostile(isHostile),
	  m_form(m_chance.below(6)),
	  m_arena(m_form == 1, isPool),
	  m_twin(m_form == 1, isPool)
{
	if (m_form == 0)
		for (Arena* arena : {&m_arena, &m_twin})
			arena->setForm(BT_EP_ITERATIVE);
	// Other forms solve islands together.
	m_hasTwin = m_form > 1;
	setAction(std::make_unique<btElasticPlasticAction>());
	for (int i = 0; i < 4; ++i)
		addBody();
	for (int i = 0; i < 3; ++i)
		addJoint();
}

Sequence::~Sequence()
{
	while (!m_joints.empty())
		erase(m_joints.size() - 1);
	setAction(nullptr);
	while (!m_bodies.empty())
		eraseBody(m_bodies.size() - 1);
}

std::string Sequence::run()
{
	for (int i = 0; i < OPERATIONS && m_complaint.empty(); ++i)
	{
		const bool isHostile = m_isHostile && m_chance.oneIn(4);
		const std::vector<Operation>& operations = isHostile ? hostile() : legal();
		const int which = m_chance.below(int(operations.size()));
		(this->*operations[size_t(which)])();
		checkAll();
		if (!m_complaint.empty())
			m_complaint += std::string(" after ") + (isHostile ? "hostile" : "legal") + " operation " +
						   std::to_string(which) + ", the " + std::to_string(i + 1) + ". one";
	}
	return m_complaint;
}

const std::vector<Sequence::Operation>& Sequence::legal()
{
	static const std::vector<Operation> all = {
		&Sequence::step,          &Sequence::step,           &Sequence::step,
		&Sequence::step,          &Sequence::step,           &Sequence::addBody,
		&Sequence::removeBody,    &Sequence::addJoint,       &Sequence::addJoint,
		&Sequence::deleteJoint,   &Sequence::forgetJoint,    &Sequence::addAgain,
		&Sequence::repair,        &Sequence::repair,         &Sequence::changeCapacity,
		&Sequence::changeJoint,   &Sequence::saveAndRestore, &Sequence::push,
		&Sequence::move,          &Sequence::makeKinematic,  &Sequence::stepControlled,
		&Sequence::changeThreads, &Sequence::changeListener, &Sequence::replaceAction,
		&Sequence::readEvents,    &Sequence::readAll,        &Sequence::deleteBodyAsBulletUsersDo,
		&Sequence::takeSnapshot,  &Sequence::goBack,         &Sequence::changeSettings};
	return all;
}

const std::vector<Sequence::Operation>& Sequence::hostile()
{
	static const std::vector<Operation> all = {
		&Sequence::badCapacity,  &Sequence::badState,         &Sequence::badDofs,     &Sequence::badBody,
		&Sequence::badBody,      &Sequence::badStep,          &Sequence::badSettings, &Sequence::badFrames,
		&Sequence::joinToItself, &Sequence::joinWithoutWorld, &Sequence::takeBodyOut, &Sequence::putBodyIn,
		&Sequence::badSnapshot};
	return all;
}

// ---- what is there

void Sequence::makeBody(btScalar mass)
{
	btVector3 inertia(0, 0, 0);
	if (mass > 0)
		m_shape.calculateLocalInertia(mass, inertia);
	m_bodies.emplace_back(new btRigidBody(mass, nullptr, &m_shape, inertia));
	m_bodies.back()->setWorldTransform(
		ep::at(btScalar(1.1) * btScalar(m_chance.below(8)), btScalar(m_chance.below(3))));
	if (m_chance.oneIn(2))
		m_bodies.back()->setActivationState(DISABLE_DEACTIVATION);
}

btRigidBody* Sequence::anyBody()
{
	return m_bodies.empty() ? nullptr : m_bodies[size_t(m_chance.below(int(m_bodies.size())))].get();
}

Sequence::Joint* Sequence::anyJoint()
{
	if (m_joints.empty())
		return nullptr;
	Joint& joint = m_joints[size_t(m_chance.below(int(m_joints.size())))];
	return joint.m_isOrphan ? nullptr : &joint;
}

namespace
{
/// Sections that take some time to make.
const std::vector<btElasticPlasticSection>& drawnSections()
{
	typedef btElasticPlasticSection Section;
	static const btElasticPlasticSectionPoint corners[] = {{0, 0}, {0, 1}, {btScalar(0.7), btScalar(0.4)}};
	static const int count = 3;
	static const std::vector<Section> all = {
		Section::tSection(btScalar(0.2), btScalar(0.2), btScalar(0.02), btScalar(0.03)).withFibres(8),
		Section::channel(btScalar(0.1), btScalar(0.2), btScalar(0.01), btScalar(0.02)).withFibres(12),
		Section::angle(btScalar(0.1), btScalar(0.15), btScalar(0.01)).withFibres(8),
		Section::polygon(corners, &count).withFibres(10)};
	return all;
}
}  // namespace

btElasticPlasticMaterial Sequence::materialOfFibres()
{
	btElasticPlasticMaterial material = btElasticPlasticMaterial::steel(m_chance.power(1e7, 1e9));
	material.m_ultimatePlasticStrain = m_chance.power(1e-4, 1);
	if (m_chance.oneIn(3))
		material.m_tensileShare = m_chance.oneIn(3) ? btScalar(0) : m_chance.power(0.01, 1);
	if (m_chance.oneIn(4) && material.m_tensileShare > 0)
		material.m_fractureEnergy = m_chance.power(1, 1e6);
	else if (m_chance.oneIn(3))
	{
		// It rises less and less, as a kinematic curve has to.
		const btScalar strain = m_chance.power(1e-4, 0.1), rise = m_chance.between(0.05, 1) * material.m_yieldStress;
		material.m_hardening.push_back({strain, material.m_yieldStress + rise});
		material.m_hardening.push_back({3 * strain, material.m_yieldStress + rise * btScalar(1.5)});
		material.m_kinematicShare = m_chance.oneIn(2) ? btScalar(m_chance.below(2)) : m_chance.between(0, 1);
	}
	if (m_chance.oneIn(4))
		material.m_rate = btElasticPlasticRate::of(m_chance.power(1, 1e4), m_chance.between(1, 10));
	if (m_chance.oneIn(4))
		material.m_crushingStrain = m_chance.power(1e-4, 1);
	if (m_chance.oneIn(4))
	{
		material.m_friction = m_chance.between(0, 2);
		material.m_shearStrength = m_chance.power(1e4, 1e9);
		material.m_shearModulus = m_chance.power(1e8, 1e11);
	}
	return material;
}

btElasticPlasticCapacity Sequence::capacityWithFibres()
{
	btElasticPlasticSection section =
		m_chance.oneIn(3)
			? drawnSections()[size_t(m_chance.below(int(drawnSections().size())))]
			: btElasticPlasticSection::rectangle(m_chance.power(0.01, 0.5), m_chance.power(0.01, 0.5)).withFibres(12);
	if (m_chance.oneIn(4))
		section.addBar(m_chance.between(-0.1, 0.1), m_chance.between(-0.1, 0.1), m_chance.power(1e-5, 1e-3),
					   materialOfFibres());
	if (m_chance.oneIn(8))
		section.addPart(btElasticPlasticSection::circle(m_chance.power(0.01, 0.1)).withFibres(14),
						m_chance.between(-0.2, 0.2), 0, materialOfFibres());
	const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
		materialOfFibres(), section, m_chance.power(0.1, 3), m_chance.power(0.1, 3),
		m_chance.oneIn(2) ? btScalar(0) : m_chance.power(0.01, 1));
	return m_chance.oneIn(6) ? capacity.heated(btElasticPlasticHeat::steel(m_chance.between(0, 1300))) : capacity;
}

btElasticPlasticCapacity Sequence::capacity()
{
	btElasticPlasticCapacity capacity = m_chance.oneIn(5) ? capacityWithFibres() : capacityOfSprings();
	if (m_chance.oneIn(4))
		capacity.m_damping = m_chance.between(0, 0.1);
	if (m_chance.oneIn(6))
		capacity.m_friction = m_chance.between(0, 2);
	return capacity;
}

btElasticPlasticCapacity Sequence::capacityOfSprings()
{
	btElasticPlasticCapacity capacity;
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
	{
		if (m_chance.oneIn(8))
			continue;
		const btScalar yield = m_chance.power(1e2, 1e7),
					   ductility = m_chance.oneIn(2) ? m_chance.power(1e-5, 1) : btElasticPlasticCapacity::unlimited();
		if (m_chance.oneIn(6))
			capacity.setRigidPlastic(dof, yield, ductility);
		else
			capacity.set(dof, m_chance.power(1e3, 1e10), yield, ductility);
	}
	return capacity;
}

void Sequence::join(btRigidBody& a, btRigidBody& b, const btTransform& frameInA, const btTransform& frameInB,
					const btElasticPlasticCapacity& capacity)
{
	Joint joint = {nullptr, nullptr, &a, &b, false, false};
	if (m_chance.oneIn(3))
	{
		auto* const made = new btElasticPlastic6DofSpringConstraint(a, b, frameInA, frameInB, true);
		joint.m_constraint.reset(made);
		joint.m_joint = made;
	}
	else
	{
		auto* const made = new btElasticPlastic6DofSpring2Constraint(a, b, frameInA, frameInB);
		joint.m_constraint.reset(made);
		joint.m_joint = made;
	}
	joint.m_joint->setCapacity(capacity);
	m_arena.m_world.addConstraint(joint.m_constraint.get(), m_chance.oneIn(2));
	if (!m_chance.oneIn(10) && m_action->addJoint(joint.m_joint))
		m_known.insert(joint.m_joint);
	m_joints.push_back(std::move(joint));
}

void Sequence::erase(size_t index)
{
	Joint& joint = m_joints[index];
	if (!joint.m_isOrphan)
		m_arena.m_world.removeConstraint(joint.m_constraint.get());
	m_known.erase(joint.m_joint);
	m_joints.erase(m_joints.begin() + long(index));
}

/// Deletes a body; joints that are still there become orphans.
void Sequence::eraseBody(size_t index)
{
	btRigidBody* const body = m_bodies[index].get();
	for (Joint& joint : m_joints)
		if (!joint.m_isOrphan && (joint.m_a == body || joint.m_b == body))
		{
			m_arena.m_world.removeConstraint(joint.m_constraint.get());
			joint.m_isOrphan = true;
		}
	if (body->getBroadphaseHandle())
		m_arena.m_world.removeRigidBody(body);
	m_bodies.erase(m_bodies.begin() + long(index));
}

/// Null: none.
void Sequence::setAction(std::unique_ptr<btElasticPlasticAction> action)
{
	if (m_action)
		m_arena.m_world.removeAction(m_action.get());
	m_action = std::move(action);
	m_known.clear();
	if (!m_action)
		return;
	m_arena.m_world.addAction(m_action.get());
	m_action->setListener(this);
}

// ---- what a game may do

void Sequence::addBody()
{
	if (int(m_bodies.size()) >= MOST_BODIES)
		return;
	makeBody(m_chance.oneIn(4) ? btScalar(0) : m_chance.power(1, 1e4));
	m_arena.m_world.addRigidBody(m_bodies.back().get(), GROUP, GROUP);
}

void Sequence::removeBody()
{
	if (m_bodies.empty())
		return;
	const size_t index = size_t(m_chance.below(int(m_bodies.size())));
	btRigidBody* const body = m_bodies[index].get();
	if (!body->getBroadphaseHandle())
		return;
	m_action->removeBody(m_arena.m_world, *body);
	for (const Joint& joint : m_joints)
		if (joint.m_a == body || joint.m_b == body)
			m_known.erase(joint.m_joint);
	eraseBody(index);
}

void Sequence::deleteBodyAsBulletUsersDo()
{
	if (m_bodies.empty())
		return;
	eraseBody(size_t(m_chance.below(int(m_bodies.size()))));
	Canvas canvas;
	m_arena.m_world.setDebugDrawer(&canvas);
	m_arena.m_world.debugDrawWorld();
	m_arena.m_world.setDebugDrawer(nullptr);
}

void Sequence::addJoint()
{
	btRigidBody *const a = anyBody(), *const b = anyBody();
	if (!a || a == b || int(m_joints.size()) >= MOST_JOINTS || !a->getBroadphaseHandle() || !b->getBroadphaseHandle())
		return;
	const btVector3 middle = (a->getCenterOfMassPosition() + b->getCenterOfMassPosition()) / 2;
	btTransform frame(m_chance.frame(0).getBasis(), middle);
	if (m_chance.oneIn(10))
		frame.setOrigin(middle + m_chance.vector(3));
	join(*a, *b, a->getCenterOfMassTransform().inverse() * frame, b->getCenterOfMassTransform().inverse() * frame,
		 capacity());
}

void Sequence::deleteJoint()
{
	if (!m_joints.empty())
		erase(size_t(m_chance.below(int(m_joints.size()))));
}

void Sequence::forgetJoint()
{
	if (Joint* const joint = anyJoint())
	{
		m_action->removeJoint(joint->m_joint);
		m_known.erase(joint->m_joint);
	}
}

void Sequence::addAgain()
{
	Joint* const joint = anyJoint();
	// A broken one that was forgotten has left the world for good.
	if (!joint || joint->m_joint->isBroken())
		return;
	if (m_action->addJoint(joint->m_joint))
		m_known.insert(joint->m_joint);
}

void Sequence::repair()
{
	for (Joint& joint : m_joints)
		if (!joint.m_isOrphan && joint.m_joint->isBroken() && !m_chance.oneIn(3))
			m_action->repair(joint.m_joint);
}

void Sequence::changeCapacity()
{
	if (Joint* const joint = anyJoint())
	{
		joint->m_joint->setCapacity(capacity());
		joint->m_isWeakened = true;
	}
}

void Sequence::changeJoint()
{
	Joint* const joint = anyJoint();
	if (!joint)
		return;
	switch (m_chance.below(5))
	{
		case 4:
			joint->m_joint->setLevel(btElasticPlasticQuantity(m_chance.below(BT_EP_QUANTITY_COUNT)),
									 m_chance.power(1e-3, 1e6));
			break;
		case 0:
			joint->m_joint->setScheme(btElasticPlasticScheme(m_chance.below(3)));
			break;
		case 1:
			joint->m_joint->setReferenceToCurrentPose();
			break;
		case 2:
			joint->m_joint->setName("a name that is longer than what is kept of it");
			break;
		default:
			joint->m_constraint->setBreakingImpulseThreshold(m_chance.power(1, 1e9));
	}
}

void Sequence::saveAndRestore()
{
	Joint* const joint = anyJoint();
	if (!joint)
		return;
	btElasticPlasticJoint* const saved = joint->m_joint;
	const btElasticPlasticState state = saved->getState();
	step();
	// The listener may have deleted it.
	for (const Joint& j : m_joints)
		if (j.m_joint == saved)
			saved->setState(state);
}

void Sequence::push()
{
	btRigidBody* const body = anyBody();
	if (!body)
		return;
	if (m_chance.oneIn(2))
		body->applyImpulse(m_chance.vector(100) * m_chance.power(1, 100), m_chance.vector(0.5));
	else
		body->applyForce(m_chance.vector(1000) * m_chance.power(1, 100), m_chance.vector(0.5));
	body->activate(true);
}

void Sequence::move()
{
	btRigidBody* const body = anyBody();
	if (body && body->getBroadphaseHandle() && !m_chance.oneIn(3))
		body->setCenterOfMassTransform(
			btTransform(m_chance.frame(0).getBasis(), body->getCenterOfMassPosition() + m_chance.vector(0.3)));
}

void Sequence::makeKinematic()
{
	btRigidBody* const body = anyBody();
	if (!body)
		return;
	const int flags = body->getCollisionFlags(), kinematic = btCollisionObject::CF_KINEMATIC_OBJECT;
	body->setCollisionFlags(m_chance.oneIn(2) ? flags | kinematic : flags & ~kinematic);
}

void Sequence::stepWorlds(btScalar dt, int most, btScalar fixed)
{
	m_arena.m_world.stepSimulation(dt, most, fixed);
	m_twin.m_world.stepSimulation(dt, most, fixed);
}

void Sequence::step()
{
	const btScalar lengths[] = {btScalar(1) / 60, btScalar(1) / 60, btScalar(1) / 240, btScalar(1) / 30, btScalar(0.1)};
	const btScalar dt = lengths[m_chance.below(5)];
	for (int i = m_chance.below(6); i >= 0; --i)
		if (m_chance.oneIn(4))
			stepWorlds(dt, 3, btScalar(1) / 120);
		else
			stepWorlds(dt, 0, dt);
	// Bullet's own iterations may leave a force far beyond its bound.
	m_refusal.clear();
	for (const Joint& joint : m_joints)
		if (!m_isHostile && m_form > 1 && !joint.m_isOrphan && !joint.m_joint->fault() && !joint.m_isWeakened &&
			!joint.m_joint->setState(joint.m_joint->getState()))
			complain("a state that a step has left is refused: " + m_refusal);
}

void Sequence::stepControlled()
{
	if (!m_chance.oneIn(4))
		return;
	// How many substeps it takes depends on the rest of the world.
	m_hasTwin = false;
	m_control.setMaxSubsteps(16);
	m_control.step(m_arena.m_world, *m_action, btScalar(1) / 60);
}

void Sequence::changeThreads() { m_arena.setNumThreads(1 + m_chance.below(3)); }

/// The twin's quiet island has to be solved in the same way.
void Sequence::changeSettings()
{
	btElasticPlasticSolverSettings settings = m_arena.getSettings();
	switch (m_chance.below(4))
	{
		case 0:
			settings.m_innerError = double(m_chance.power(1e-4, 1e-1));
			settings.m_maxInnerSteps = 1 << m_chance.below(8);
			break;
		case 1:
			settings.m_innerError = 0;
			break;
		case 2:
			settings.m_maxWork = m_chance.oneIn(2) ? 0 : (long long)m_chance.power(1e3, 1e7);
			break;
		default:
			settings.m_contacts = m_chance.oneIn(2) ? BT_EP_SWEPT_CONTACTS : BT_EP_EXACT_CONTACTS;
	}
	for (Arena* arena : {&m_arena, &m_twin})
		if (!arena->setSettings(settings))
			complain("settings are refused");
}

void Sequence::changeListener()
{
	m_deletesInListener = m_chance.oneIn(3);
	m_action->setListener(m_chance.oneIn(3) ? nullptr : this);
}

void Sequence::replaceAction()
{
	if (!m_chance.oneIn(3))
		return;
	setAction(std::make_unique<btElasticPlasticAction>());
	for (Joint& joint : m_joints)
		if (!joint.m_isOrphan && !joint.m_joint->isBroken() && m_action->addJoint(joint.m_joint))
			m_known.insert(joint.m_joint);
}

void Sequence::readEvents()
{
	btElasticPlasticEvent event;
	for (int i = m_chance.below(30); i > 0 && m_action->popEvent(event); --i)
		check(event);
}

void Sequence::readAll()
{
	for (Joint& joint : m_joints)
	{
		if (joint.m_isOrphan)
			continue;
		const btElasticPlasticJoint& j = *joint.m_joint;
		const int dof = m_chance.below(BT_EP_DOF_COUNT);
		int limiting;
		char text[100];
		j.printFault(text, m_chance.below(int(sizeof text)) + 1);
		btScalar sum = j.getForce(dof) + j.getAppliedForce(dof) + j.getElasticDeformation(dof) +
					   j.getPlasticDeformation(dof) + j.getUtilisation(&limiting) + j.getPosition().x() +
					   j.getJointAxis(dof).x();
		for (int r = 0; r < j.getNumCommittedRows(); ++r)
		{
			int ofRow;
			btScalar before, after;
			j.getCommittedRow(r, ofRow, before, after);
			sum += before + after;
			if (!btElasticPlasticIsDof(ofRow))
				complain("a row of degree of freedom " + std::to_string(ofRow));
		}
		if (!m_isHostile && !btElasticPlasticIsFinite(double(sum)))
			complain("a reading is not finite");
		if (btElasticPlasticJoint::from(joint.m_constraint.get()) != joint.m_joint)
			complain("from() does not know a joint");
	}
}

std::vector<unsigned char> Sequence::snapshot()
{
	const auto save = [this](std::vector<unsigned char>& to) {
		return size_t(
			btElasticPlasticSave(m_arena.m_world, m_arena.m_broadphase, *m_action, to.data(), int(to.size())));
	};
	std::vector<unsigned char> bytes;
	bytes.resize(save(bytes));
	if (save(bytes) != bytes.size())
		complain("a snapshot has another length the second time");
	return bytes;
}

void Sequence::takeSnapshot() { m_snapshot = snapshot(); }

/// What has become of bodies and joints since may have made the snapshot a foreign one.
void Sequence::goBack()
{
	if (m_snapshot.empty())
		return;
	const std::vector<unsigned char> before = snapshot();
	const bool isRefused = bool(btElasticPlasticRestore(m_arena.m_world, m_arena.m_broadphase, *m_action,
														m_snapshot.data(), int(m_snapshot.size())));
	if (snapshot() != (isRefused ? before : m_snapshot))
		complain(isRefused ? "a snapshot that is refused has changed the world" : "a snapshot is not restored");
	// The quiet island goes back, too, but its action does not.
	m_hasTwin &= isRefused;
}

// ---- what makes no sense

void Sequence::badCapacity()
{
	Joint* const joint = anyJoint();
	if (!joint)
		return;
	btElasticPlasticCapacity bad = capacity();
	const int dof = m_chance.below(BT_EP_DOF_COUNT);
	if (bad.hasFibres() && m_chance.oneIn(2))
	{
		btElasticPlasticFibre& fibre = bad.m_fibres[m_chance.below(bad.m_fibres.size())];
		btScalar* const numbers[] = {&fibre.m_y,           &fibre.m_z,
									 &fibre.m_stiffness,   &fibre.m_tension,
									 &fibre.m_compression, &fibre.m_stretchLimit,
									 &fibre.m_crushLimit,  &fibre.m_rateReference,
									 &fibre.m_wall[0],     &fibre.m_twist[1],
									 &fibre.m_rateExponent};
		*numbers[m_chance.below(11)] = m_chance.bad();
		if (m_chance.oneIn(4))
			(m_chance.oneIn(2) ? fibre.m_firstPoint : fibre.m_numPoints) = m_chance.badDof();
		if (bad.m_curvePoints.size() > 0 && m_chance.oneIn(2))
			bad.m_curvePoints[m_chance.below(bad.m_curvePoints.size())] = {m_chance.bad(), m_chance.bad()};
	}
	switch (m_chance.below(5))
	{
		case 0:
			bad.m_stiffness[dof] = m_chance.bad();
			break;
		case 1:
			bad.m_yield[dof] = m_chance.bad();
			break;
		case 2:
			bad.m_ductility[dof] = m_chance.bad();
			break;
		case 3:
			bad.set(m_chance.badDof(), 1, 1);
			break;
		default:
			bad.scaleYield(m_chance.bad());
	}
	joint->m_joint->setCapacity(bad);
}

void Sequence::badState()
{
	Joint* const joint = anyJoint();
	if (!joint)
		return;
	btElasticPlasticState state = joint->m_joint->getState();
	btScalar* const numbers[] = {state.m_plastic,  state.m_force,   state.m_forceRate,
								 state.m_withheld, state.m_applied, state.m_plasticPath};
	if (state.m_fibres.size() > 0 && m_chance.oneIn(2))
	{
		btElasticPlasticFibreState& fibre = state.m_fibres[m_chance.below(state.m_fibres.size())];
		btScalar* const ofFibre[] = {&fibre.m_force, &fibre.m_forceRate, &fibre.m_offset,   &fibre.m_damage,
									 &fibre.m_path,  &fibre.m_rate,      &fibre.m_rateShare};
		*ofFibre[m_chance.below(7)] = m_chance.bad();
	}
	switch (m_chance.below(4))
	{
		case 0:
			state.m_plasticRotation = btQuaternion(m_chance.bad(), 0, 0, m_chance.bad());
			break;
		case 1:
			state.m_lastStep = m_chance.bad();
			break;
		case 2:
			state.m_plasticEnergy = double(m_chance.bad());
			break;
		default:
			numbers[m_chance.below(6)][m_chance.below(6)] = m_chance.bad();
	}
	joint->m_joint->setState(state);
}

void Sequence::badDofs()
{
	Joint* const joint = anyJoint();
	if (!joint)
		return;
	const int dof = m_chance.badDof();
	const btElasticPlasticJoint& j = *joint->m_joint;
	if (j.getForce(dof) != 0 || j.getAppliedForce(dof) != 0 || j.getElasticDeformation(dof) != 0 ||
		j.getPlasticDeformation(dof) != 0 || j.getPlasticPath(dof) != 0 || j.getUtilisation(dof) != 0 ||
		j.getDamage(dof) != 0 ||
		// Of a body that is not finite no axis is, and nothing equals it.
		(btElasticPlasticIsFinite(j.getJointAxis(0).length2()) && j.getJointAxis(dof) != j.getJointAxis(0)))
		complain("a reading of what is no degree of freedom");
}

void Sequence::badBody()
{
	btRigidBody* const body = anyBody();
	// Made static and then dynamic outside of a world, a body has no island that Bullet could look for.
	if (!body || !body->getBroadphaseHandle())
		return;
	switch (m_chance.below(8))
	{
		case 0:
			body->setLinearVelocity(m_chance.badVector());
			break;
		case 1:
			body->setAngularVelocity(m_chance.badVector());
			break;
		case 2:
			body->applyCentralForce(m_chance.badVector());
			break;
		case 3:
			body->applyTorque(m_chance.badVector());
			break;
		case 4:
			body->setMassProps(m_chance.bad(), m_chance.badVector());
			break;
		case 5:
		{
			btTransform pose = body->getCenterOfMassTransform();
			pose.getBasis()[m_chance.below(3)] = m_chance.badVector();
			body->setCenterOfMassTransform(pose);
			break;
		}
		case 6:
			body->setLinearFactor(m_chance.oneIn(2) ? m_chance.badVector() : btVector3(1, 0, 1));
			break;
		default:
			body->setAngularFactor(m_chance.oneIn(2) ? m_chance.badVector() : btVector3(0, 0, 0));
	}
}

void Sequence::badStep()
{
	const btScalar lengths[] = {-1, 0, btScalar(1e-30), btScalar(-1e-3), 1};
	const btScalar dt = lengths[m_chance.below(5)];
	stepWorlds(dt, 0, dt);
	m_action->updateAction(&m_arena.m_world, m_chance.bad());
}

void Sequence::badSettings()
{
	btElasticPlasticSolverSettings settings = m_arena.getSettings();
	const int threads[] = {0, -1, 65, 100000, 2147483647};
	switch (m_chance.below(5))
	{
		case 0:
			settings.m_numThreads = threads[m_chance.below(5)];
			break;
		case 1:
			settings.m_maxNewtonSteps = -1;
			break;
		case 2:
			settings.m_contactTolerance = -1;
			break;
		case 3:
			settings.m_maxVectorWidth = 3;
			break;
		default:
			settings.m_iterationTolerance = double(-m_chance.power(1e-3, 1));
	}
	if (m_arena.setSettings(settings))
		complain("settings that make no sense are taken");
}

void Sequence::badFrames()
{
	btRigidBody *const a = anyBody(), *const b = anyBody();
	if (!a || int(m_joints.size()) >= MOST_JOINTS || !a->getBroadphaseHandle() || !b->getBroadphaseHandle())
		return;
	btTransform bad = m_chance.frame(1);
	if (m_chance.oneIn(2))
		bad.setOrigin(m_chance.badVector());
	else
		bad.getBasis()[m_chance.below(3)] = m_chance.badVector();
	join(*a, *b, bad, m_chance.frame(1), capacity());
}

void Sequence::joinToItself()
{
	btRigidBody* const body = anyBody();
	if (body && int(m_joints.size()) < MOST_JOINTS && body->getBroadphaseHandle())
		join(*body, *body, m_chance.frame(1), m_chance.frame(1), capacity());
}

void Sequence::joinWithoutWorld()
{
	btRigidBody* const a = anyBody();
	if (!a || int(m_bodies.size()) >= MOST_BODIES || int(m_joints.size()) >= MOST_JOINTS || !a->getBroadphaseHandle())
		return;
	makeBody(10);
	btRigidBody& b = *m_bodies.back();
	if (m_chance.oneIn(2))
		join(*a, b, ep::at(btScalar(0.5)), ep::at(btScalar(-0.5)), capacity());
	else
		join(b, *a, ep::at(btScalar(0.5)), ep::at(btScalar(-0.5)), capacity());
	// Bullet's own search for islands crashes on such a constraint unless an action knows it.
	if (m_action->addJoint(m_joints.back().m_joint))
		complain("a joint of a body in no world is taken");
	m_known.erase(m_joints.back().m_joint);
}

void Sequence::takeBodyOut()
{
	btRigidBody* const body = anyBody();
	if (!body || !body->getBroadphaseHandle())
		return;
	// Bullet's search for islands reads past its arrays if a constraint of the body stays.
	for (const Joint& joint : m_joints)
		if (!joint.m_isOrphan && (joint.m_a == body || joint.m_b == body))
			m_arena.m_world.removeConstraint(joint.m_constraint.get());
	m_arena.m_world.removeRigidBody(body);
}

void Sequence::putBodyIn()
{
	for (const auto& body : m_bodies)
		if (!body->getBroadphaseHandle())
			m_arena.m_world.addRigidBody(body.get(), GROUP, GROUP);
}

void Sequence::badSnapshot()
{
	std::vector<unsigned char> bytes = snapshot();
	const std::vector<unsigned char> before = bytes;
	if (m_chance.oneIn(2))
		bytes.resize(size_t(m_chance.below(int(bytes.size()))));
	else
		bytes[size_t(m_chance.below(int(bytes.size())))] ^= static_cast<unsigned char>(1 << m_chance.below(8));
	if (!btElasticPlasticRestore(m_arena.m_world, m_arena.m_broadphase, *m_action, bytes.data(), int(bytes.size())))
		complain("a snapshot that has been spoilt is taken");
	if (snapshot() != before)
		complain("a snapshot that has been spoilt has changed the world");
}

// ---- what must be true

void Sequence::complain(const std::string& what)
{
	if (m_complaint.empty())
		m_complaint = what;
}

void Sequence::check(const btElasticPlasticEvent& event)
{
	if (!btElasticPlasticIsDof(event.m_dof))
		complain("an event of degree of freedom " + std::to_string(event.m_dof));
	if (!m_known.count(event.m_joint))
		complain("an event of a joint that is not known");
	if (!m_isHostile && !(btElasticPlasticIsFinite(event.m_energy) && event.m_energy >= 0))
		complain("an event with an energy of " + std::to_string(event.m_energy) + " J");
}

void Sequence::onBreak(const btElasticPlasticEvent& event)
{
	check(event);
	if (!m_deletesInListener)
		return;
	// The event may have waited in the queue until the joint's body was gone.
	const bool isOrphan = std::any_of(m_joints.begin(), m_joints.end(),
									  [&event](const Joint& j) { return j.m_joint == event.m_joint && j.m_isOrphan; });
	// Counted, not drawn: what seeds draw stays what it was.
	if (++m_numTold % 8 == 0)
		replaceAction();
	else if (m_chance.oneIn(3) && !isOrphan)
		m_action->repair(event.m_joint);
	else if (m_chance.oneIn(2))
		deleteJoint();
	else
		addJoint();
}

void Sequence::checkAll()
{
	if (m_action->getNumJoints() != int(m_known.size()))
		complain("the action knows " + std::to_string(m_action->getNumJoints()) + " joints of " +
				 std::to_string(m_known.size()));
	int broken = 0;
	for (int i = 0; i < m_action->getNumJoints(); ++i)
	{
		const btElasticPlasticJoint* const joint = m_action->getJoint(i);
		if (!m_known.count(joint))
			complain("the action knows a joint that it was not given");
		else
			broken += joint->isBroken();
	}
	if (broken != m_action->getNumBroken())
		complain("the action counts " + std::to_string(m_action->getNumBroken()) + " broken joints of " +
				 std::to_string(broken));
	for (const Joint& joint : m_joints)
	{
		// Whatever happens to bodies: what a joint keeps is in order.
		const btElasticPlasticState& state = joint.m_joint->getState();
		const auto mustBeFinite = [this](const char* what, double value)
		{
			if (!btElasticPlasticIsFinite(value))
				complain(std::string("a joint's ") + what + " is " + std::to_string(value));
		};
		mustBeFinite("plastic energy", state.m_plasticEnergy);
		mustBeFinite("work", state.m_work);
		mustBeFinite("plastic rotation", double(state.m_plasticRotation.length2() + state.m_plasticMiddle.length2()));
		mustBeFinite("last step", double(state.m_lastStep + state.m_withheldStep));
		for (int i = 0; i < state.m_fibres.size(); ++i)
		{
			const btElasticPlasticFibreState& fibre = state.m_fibres[i];
			for (const btScalar number : {fibre.m_force, fibre.m_forceRate, fibre.m_offset, fibre.m_damage,
										  fibre.m_path, fibre.m_rate, fibre.m_rateShare})
				mustBeFinite("fibre", double(number));
		}
		for (const btScalar number : {state.m_initial[0], state.m_initial[1], state.m_initial[2],
									  state.m_fibreStrain[0], state.m_fibreStrain[1], state.m_fibreStrain[2]})
			mustBeFinite("offset", double(number));
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			mustBeFinite("force", double(state.m_force[dof]));
			mustBeFinite("rate of force", double(state.m_forceRate[dof]));
			mustBeFinite("applied force", double(state.m_applied[dof]));
			mustBeFinite("withheld deformation", double(state.m_withheld[dof]));
			mustBeFinite("watched deformation", double(state.m_watched[dof]));
			mustBeFinite("plastic deformation", double(state.m_plastic[dof]));
			mustBeFinite("plastic path", double(state.m_plasticPath[dof]));
			if (!joint.m_joint->fault() && joint.m_joint->getDamage(dof) < 0)
				complain("a damage below 0");
		}
		if (state.m_plasticEnergy < 0)
			complain("a plastic energy below 0");
	}
	for (const auto& body : m_bodies)
		if (!m_isHostile && !(isFinite(body->getCenterOfMassPosition()) && isFinite(body->getLinearVelocity()) &&
							  isFinite(body->getAngularVelocity())))
			complain("a body is not finite");
	if (m_hasTwin && m_arena.m_quiet.hash() != m_twin.m_quiet.hash())
		complain("the quiet island differs from its twin's");
	if (!m_twin.m_quiet.isFinite())
		complain("the twin is not finite");
}
