// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/DemolisherScene.h"

#include <algorithm>
#include <cmath>

#include "text/Format.h"
#include "world/Charge.h"

namespace ep
{
namespace
{
const double LONGEST_PAST = 10, MOMENTS_APART = .25;  // [s]

bool isOfSteel(const Structure& structure, const btElasticPlasticJoint& joint)
{
	for (const Beam& beam : structure.beams())
		for (const btElasticPlasticJoint* own : beam.joints())
			if (own == &joint)
				return beam.settings().material.m_loadBearingShare >= 1;
	return false;
}

void addRoad(Drawing& drawing, btScalar width)
{
	drawing.parts.push_back(
		boxPart(btTransform::getIdentity(), btVector3(1800, btScalar(.02), width), {.075f, .075f, .08f}));
}
}  // namespace

void DemolisherScene::step(const Controls& controls)
{
	m_effects.beforeStep(m_demolisher->world());
	if (m_autopilot)
		m_demolisher->stepByAutopilot();
	else
		m_demolisher->step(controls);
	addBreaks();
	m_effects.afterStep(m_demolisher->world(), m_settings.step);
	m_history.step(*m_demolisher);
	remember();
}

void DemolisherScene::addBreaks()
{
	const JointLog& log = m_demolisher->joints();
	for (const JointRecord& record : log.records())
		if (record.breakTime == m_demolisher->time())
			m_effects.add({Burst::Kind::Break, record.joint->getPosition(), log.read(record).plasticEnergy,
						   isOfSteel(*m_demolisher->structure(record.scene), *record.joint)});
}

/// Not while the hand pulls: what it has in the world is not there when one goes back.
void DemolisherScene::remember()
{
	if (!m_remembers || m_hand->holds() ||
		(!m_past.empty() && m_demolisher->time() < m_past.back().time + MOMENTS_APART))
		return;
	m_past.push_back(m_demolisher->moment());
	while (m_past.front().time < m_demolisher->time() - LONGEST_PAST)
		m_past.pop_front();
}

/// A second before the first break that is remembered, else by two seconds.
bool DemolisherScene::goBack()
{
	double crash = HUGE_VAL;
	for (const JointRecord& record : m_demolisher->joints().records())
		if (!m_past.empty() && record.breakTime > m_past.front().time)
			crash = std::min(crash, record.breakTime);
	const double to = crash < HUGE_VAL ? crash - 1 : m_demolisher->time() - 2;
	while (m_past.size() > 1 && m_past.back().time > to)
		m_past.pop_back();
	m_hand->release();
	if (m_past.empty() || !m_demolisher->goBack(m_past.back()))
		return false;
	m_history.clear();
	m_effects.clear();
	return true;
}

bool DemolisherScene::isBreaking() const
{
	const double now = m_demolisher->time();
	for (const JointRecord& record : m_demolisher->joints().records())
		if (record.breakTime > now - .3)
			return true;
	return false;
}

bool DemolisherScene::grab(const Ray& ray)
{
	const btRigidBody* const body = m_hand->grab(ray.from, ray.direction);
	if (!body)
		return false;
	// The joint of this body that is nearest is chosen.
	const JointLog& log = m_demolisher->joints();
	size_t nearest = log.records().size();
	btScalar least = BT_LARGE_FLOAT;
	for (size_t i = 0; i < log.records().size(); ++i)
	{
		const btElasticPlasticJoint& joint = *log.records()[i].joint;
		const btTypedConstraint& constraint = joint.getConstraint();
		const btScalar distance = (joint.getPosition() - m_hand->place()).length();
		if ((&constraint.getRigidBodyA() != body && &constraint.getRigidBodyB() != body) || distance >= least)
			continue;
		nearest = i;
		least = distance;
	}
	if (nearest < log.records().size())
		m_history.follow(nearest, log.read(log.records()[nearest]).limitingDof);
	return true;
}

void DemolisherScene::throwBall(const Ray& ray)
{
	const btScalar speed = 30, ahead = 3;
	const btVector3 direction = ray.direction.normalized();
	m_demolisher->throwBall(ray.from + direction * ahead, direction * speed);
}

void DemolisherScene::blowCharge(const Ray& ray)
{
	const double mass = 200, heat = 4.2e6;  // [kg] of TNT, [J/kg]
	const RayHit hit = castRay(m_demolisher->world(), ray.from, ray.direction);
	if (!hit.hasHit)
		return;
	ep::blowCharge(m_demolisher->world(), hit.place, mass);
	m_effects.add({Burst::Kind::Charge, hit.place, mass * heat, false});
}

void DemolisherScene::restart()
{
	m_effects.clear();
	m_past.clear();
	m_hand.reset();
	m_demolisher.reset(new Demolisher(m_settings));
	m_hand.reset(new Hand(m_demolisher->world()));
	for (Scene scene : m_settings.onTheWay())
		m_built[size_t(scene)] = wreckOf(scene);
	m_history.clear();
	if (m_history.joint() == 0 && m_demolisher->bridge())
		m_history.follow(m_demolisher->joints().numberOf(*m_demolisher->bridge()->joints().front()), BT_EP_BENDING_Z);
}

void DemolisherScene::jump(int number)
{
	const Scene scene = scenes()[size_t(number)].value;
	if (!m_settings.has(scene))
		return;
	m_demolisher->jumpTo(scene);
	m_autopilot = false;
}

void DemolisherScene::key(char key)
{
	if (key == 'g')
		m_autopilot = !m_autopilot;
	if (key == 'b')
		m_style.skin = !m_style.skin;
	if (key == 'j')
		m_style.joints = !m_style.joints;
}

std::vector<std::string> DemolisherScene::keyHelp() const
{
	return {"G  autopilot on or off", "B  bent members smooth or block by block", "J  joints marked or not"};
}

Drawing DemolisherScene::draw() const
{
	Drawing drawing;
	const World& world = m_demolisher->world();
	for (Scene scene : m_settings.onTheWay())
		if (scene != Scene::Bridge)
			addParts(drawing, world, *m_demolisher->structure(scene), m_style);
	if (m_demolisher->bridge())
		addParts(drawing, world, *m_demolisher->bridge(), m_style);
	else
		addRoad(drawing, m_settings.bridge.width + 1);
	for (const btRigidBody* ball : m_demolisher->balls())
		addSphere(drawing.parts, ball->getCenterOfMassTransform(),
				  static_cast<const btSphereShape*>(ball->getCollisionShape())->getRadius(), {.05f, .05f, .06f});
	addParts(drawing.parts, m_demolisher->vehicle());
	drawing.puffs = m_effects.puffs();
	drawing.subject = m_demolisher->vehicle().pose();

	const DemolisherSummary s = m_demolisher->summary();
	drawing.text = {
		format("Speed  %.0f km/h%s", std::fabs(s.speed) * 3.6, m_autopilot ? "  (autopilot)" : ""),
		format("Joints  %d yielded, %d broken of %d", s.yielded, s.broken, s.joints),
		format("Plastic energy  %.1f kJ", s.plasticEnergy / 1000),
	};
	if (m_demolisher->bridge())
		drawing.text.push_back(format("Sag of the bridge  %.2f m", s.sag));
	// How fast it is computed is in the panel: pictures are the same whenever they are made.
	drawing.text.push_back(format("Time  %.1f s", s.time));
	drawing.legend = {{jointColour(0, 0), "unloaded"},
					  {jointColour(.5, 0), "half of yield"},
					  {jointColour(1, 0), "yields"},
					  {jointColour(1, 1), "worn"},
					  {TORN, "broken"}};
	return drawing;
}

Scene DemolisherScene::ahead() const
{
	const std::vector<Scene> way = m_settings.onTheWay();
	for (Scene scene : way)
	{
		const btScalar length = scene == Scene::Bridge ? m_settings.rampFoot() : btScalar(8);
		if (m_demolisher->vehicle().pose().getOrigin().x() < m_settings.placeOf(scene) + length)
			return scene;
	}
	return way.back();
}

/// The bridge is driven on: it is seen from behind.
btScalar DemolisherScene::closeness() const
{
	const btScalar far = 22, near = 10;
	btScalar least = far;
	for (Scene scene : m_settings.onTheWay())
		if (scene != Scene::Bridge)
			least = btMin(least, btFabs(m_demolisher->vehicle().pose().getOrigin().x() - m_settings.placeOf(scene)));
	const btScalar share = btMin(btScalar(1), (far - least) / (far - near));
	return share * share * (3 - 2 * share);
}

Bounds DemolisherScene::bounds() const
{
	const Scene scene = ahead();
	const btScalar x = m_settings.placeOf(scene), vehicle = btScalar(3.6);
	Bounds bounds = m_built[size_t(scene)];
	if (scene == Scene::Bridge)
	{
		const BridgeSettings& s = m_settings.bridge;
		const btVector3 half(s.span / 2 + s.supportLength, s.height, s.width / 2);
		bounds.add(btVector3(x, s.height, 0) - half);
		bounds.add(btVector3(x, vehicle, 0) + half);
		return bounds;
	}
	bounds.add(btVector3(x - 6, 0, -4));
	bounds.add(btVector3(x + 6, vehicle, 4));
	return bounds;
}

Bounds DemolisherScene::wreckOf(Scene scene) const
{
	const btVector3 place(m_settings.placeOf(scene), 0, 0);
	std::vector<Bounds> parts;
	const auto add = [&](const btRigidBody& body)
	{
		parts.emplace_back();
		body.getAabb(parts.back().low, parts.back().high);
	};
	const Structure& structure = *m_demolisher->structure(scene);
	for (const btRigidBody* box : structure.boxes())
		add(*box);
	for (const Beam& beam : structure.beams())
		for (const btRigidBody* part : beam.m_parts)
			add(*part);
	// What was carried along is left out, unless nothing else is left.
	const btScalar near = 20, furthest = 1000;
	Bounds bounds;
	for (btScalar far = near; bounds.isEmpty() && far < furthest; far *= 2)
		for (const Bounds& part : parts)
			if ((part.centre() - place).length() < far)
				bounds.add(part);
	if (bounds.isEmpty() || (bounds.centre() - place).length() < near)
		bounds.add(place);
	else
	{
		// By the vehicle.
		Bounds carrier;
		m_demolisher->vehicle().chassis().getAabb(carrier.low, carrier.high);
		bounds.add(carrier);
	}
	return bounds;
}

Scene DemolisherScene::mostDamaged() const
{
	double energies[SCENE_COUNT] = {};
	for (const JointRecord& record : m_demolisher->joints().records())
		energies[size_t(record.scene)] += m_demolisher->joints().read(record).plasticEnergy;
	const std::vector<Scene> way = m_settings.onTheWay();
	return *std::max_element(way.begin(), way.end(),
							 [&](Scene a, Scene b) { return energies[size_t(a)] < energies[size_t(b)]; });
}

btVector3 DemolisherScene::sightOf(Scene scene)
{
	// From beside the bridge; else from ahead of the vehicle, which would hide what it strikes, and of the gate from its box's side.
	if (scene == Scene::Bridge)
		return btVector3(btScalar(.2), btScalar(-.16), -1);
	return btVector3(btScalar(-.75), btScalar(-.45), scene == Scene::Gate ? 1 : -1);
}
}  // namespace ep
