// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "replay/ReplayScene.h"

#include <cmath>
#include <stdexcept>

#include "text/Format.h"

namespace ep
{
namespace
{
const Colour STEEL = {.32f, .36f, .42f}, SUPPORT = {.45f, .43f, .40f};
const double FRAME = 1. / 60;        // played [s]
const size_t MOST_FRAMES = 60 * 60;  // a minute

/// A band round the thinner one of what it joins, in the joint's axes.
btVector3 markOf(const btElasticPlasticJoint& joint)
{
	const btTransform& frame = joint.getFrameA();
	btVector3 section(0, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
	for (const btRigidBody* body : {&joint.getConstraint().getRigidBodyA(), &joint.getConstraint().getRigidBodyB()})
	{
		if (body->getInvMass() == 0)
			continue;
		btVector3 low, high;
		body->getCollisionShape()->getAabb(frame.inverse() * body->getCenterOfMassTransform(), low, high);
		section.setMin(high - low);
	}
	section *= btScalar(1.03);
	section.setX(btMin(section.y(), section.z()) * btScalar(.12));
	return section;
}

void addTo(Bounds& bounds, const btVector3& place, const btVector3& size)
{
	bounds.add(place - size / 2);
	bounds.add(place + size / 2);
}
}  // namespace

ReplayScene::ReplayScene(const std::string& title, const std::function<std::string(const Watch& watch)>& run)
	: m_title(title)
{
	m_result = run([this](World& world, double time) { record(world, time); });
	if (m_frames.empty())
		throw std::runtime_error("there is nothing to see of '" + title + "'");
	measure();
}

void ReplayScene::begin()
{
	m_frames.clear();
	m_bodies.clear();
	m_interval = FRAME;
}

/// Bodies that are new: some appear on the way.
void ReplayScene::addBodies(const World& world)
{
	for (size_t i = m_bodies.size(); i < world.bodies().size(); ++i)
	{
		const btRigidBody& body = *world.bodies()[i];
		btVector3 low, high;
		body.getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
		m_bodies.push_back({high - low, body.getInvMass() == 0});
	}
}

void ReplayScene::record(World& world, double time)
{
	if (time == 0)
		begin();
	if (!m_frames.empty() && time < m_frames.back().time + m_interval * 0.999)
		return;
	// What takes hours is played faster: of every two frames one goes.
	if (m_frames.size() == MOST_FRAMES)
	{
		for (size_t i = 1; i < MOST_FRAMES / 2; ++i)
			m_frames[i] = std::move(m_frames[2 * i]);
		m_frames.resize(MOST_FRAMES / 2);
		m_interval *= 2;
	}
	addBodies(world);
	m_frames.push_back({time, {}, {}});
	for (const auto& body : world.bodies())
		m_frames.back().bodies.push_back({body->getCenterOfMassTransform(), body->isInWorld()});
	for (const btElasticPlasticJoint* joint : world.joints())
		m_frames.back().joints.push_back({joint->getFrameA(), markOf(*joint), float(joint->getUtilisation()),
										  float(joint->getDamage()), joint->isBroken()});
}

/// Where it is, by which power of ten it is to be drawn larger to be some metres long, and by which its displacements are
/// to be magnified to be a twentieth of its size.
void ReplayScene::measure()
{
	m_bounds = Bounds();
	const std::vector<Placed>& start = m_frames.front().bodies;
	for (size_t i = 0; i < start.size(); ++i)
		if (!m_bodies[i].isFixed)
			addTo(m_bounds, start[i].pose.getOrigin(), m_bodies[i].size);
	const btScalar size = m_bounds.size().length();
	btScalar displacement = 0;
	for (size_t f = 0; f < m_frames.size(); ++f)
		for (size_t i = 0; i < start.size(); ++i)
		{
			const btVector3& place = m_frames[f].bodies[i].pose.getOrigin();
			const btScalar way = (place - start[i].pose.getOrigin()).length();
			// What flies off may leave the picture.
			if (m_bodies[i].isFixed || !(way < size))
				continue;
			if (way > displacement)
			{
				displacement = way;
				m_furthest = f;
			}
			m_bounds.add(place);
		}
	// The viewer is made for things of a building's size.
	if (!m_bounds.isEmpty() && (size < 1 || size > 500))
		m_size = std::pow(10, 1 - std::floor(std::log10(double(size))));
	if (displacement > 0 && displacement < size / 20)
		m_magnification = std::pow(10, std::floor(std::log10(double(size / 20 / displacement))));
	bool hasGround = false;
	for (size_t i = 0; i < start.size(); ++i)
		if (isGround(m_bodies[i]))
			hasGround = true;
		else if (m_bodies[i].isFixed)
			addTo(m_bounds, start[i].pose.getOrigin(), m_bodies[i].size);
	// A structure that stands on nothing is drawn above the viewer's ground.
	m_clearance = hasGround ? 0 : m_bounds.size().length() / 4;
}

btScalar ReplayScene::stepTime() const { return btScalar(FRAME); }

void ReplayScene::step(const Controls&)
{
	// At its end it stands for a second.
	m_frame = m_frame < m_frames.size() + 60 ? m_frame + 1 : 0;
}

btTransform ReplayScene::magnified(const btTransform& start, const btTransform& now) const
{
	const btScalar by = btScalar(m_magnification);
	const btQuaternion turn = now.getRotation() * start.getRotation().inverse();
	const btScalar angle = turn.getAngleShortestPath() * by;
	btTransform pose = now;
	pose.setOrigin(start.getOrigin() + (now.getOrigin() - start.getOrigin()) * by);
	if (by != 1 && angle > SIMD_EPSILON)
		pose.setRotation(btQuaternion(turn.getW() < 0 ? -turn.getAxis() : turn.getAxis(), angle) * start.getRotation());
	pose.setOrigin(shown(pose.getOrigin()));
	return pose;
}

btVector3 ReplayScene::shown(const btVector3& place) const
{
	return (place - btVector3(0, m_bounds.low.y() - m_clearance, 0)) * btScalar(m_size);
}

Drawing ReplayScene::draw() const
{
	Drawing drawing;
	const Frame& first = m_frames.front();
	for (size_t i = 0; i < frame().bodies.size(); ++i)
	{
		const Placed& now = frame().bodies[i];
		if (!now.isThere || isGround(m_bodies[i]))
			continue;
		// What appears on the way is drawn where it is.
		const btTransform pose = magnified(i < first.bodies.size() ? first.bodies[i].pose : now.pose, now.pose);
		if (std::isfinite(pose.getOrigin().length()))
			drawing.parts.push_back(
				boxPart(pose, m_bodies[i].size * btScalar(m_size * .98), m_bodies[i].isFixed ? SUPPORT : STEEL, .4f));
	}
	for (size_t i = 0; i < frame().joints.size(); ++i)
	{
		const Joint& joint = frame().joints[i];
		if (joint.isBroken || !std::isfinite(joint.pose.getOrigin().length()))
			continue;
		drawing.parts.push_back(
			boxPart(magnified(i < first.joints.size() ? first.joints[i].pose : joint.pose, joint.pose),
					joint.size * btScalar(m_size), jointColour(joint.utilisation, joint.damage)));
	}
	drawing.text = {m_title, m_result, format("%.2f s, displacements x %g", frame().time, m_magnification)};
	if (m_size != 1)
		drawing.text.push_back(format("drawn %g times as large", m_size));
	if (m_interval > FRAME)
		drawing.text.push_back(format("played %g times as fast", m_interval / FRAME));
	drawing.legend = {
		{jointColour(0, 0), "unloaded"}, {jointColour(.5, 0), "half of yield"}, {jointColour(1, 0), "yields"}};
	drawing.subject.setOrigin(bounds().centre());
	return drawing;
}

Bounds ReplayScene::bounds() const
{
	Bounds drawn;
	drawn.add(shown(m_bounds.low));
	drawn.add(shown(m_bounds.high));
	return drawn;
}

void ReplayScene::key(char key)
{
	if (key == '+' && m_magnification < 1e9)
		m_magnification *= 10;
	else if (key == '-' && m_magnification > 1)
		m_magnification /= 10;
}

std::vector<std::string> ReplayScene::keyHelp() const { return {"+ -  displacements larger, smaller"}; }
}  // namespace ep
