// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/ProblemScene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ep
{
namespace
{
const Colour STEEL = {.32f, .36f, .42f}, SUPPORT = {.45f, .43f, .40f};
const double FRAME = 1. / 60;

/// A little more than what it joins is thick.
btScalar markOf(const btElasticPlasticJoint& joint)
{
	const btRigidBody *const a = &joint.getConstraint().getRigidBodyA(), *const b =
																			 &joint.getConstraint().getRigidBodyB();
	btVector3 low, high;
	(b->getInvMass() > 0 ? b : a)->getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
	const btVector3 size = high - low;
	return btMin(size.y(), size.z()) * btScalar(1.15);
}
}  // namespace

ProblemScene::ProblemScene(const Problem& problem, const Method& method, const Stepping& stepping) : m_problem(problem)
{
	Stepping watched = stepping;
	watched.watch = [this](World& world, double time) { record(world, time); };
	m_outcome = problem.solve(method, watched);
	measure();
}

void ProblemScene::record(World& world, double time)
{
	// A problem may take several runs: the last one stays.
	if (time == 0)
	{
		m_frames.clear();
		m_bodies.clear();
		for (const auto& body : world.bodies())
		{
			btVector3 low, high;
			body->getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
			m_bodies.push_back({high - low, body->getInvMass() == 0});
		}
	}
	if (!m_frames.empty() && time < m_frames.back().time + FRAME * 0.999)
		return;
	m_frames.push_back({time, {}, {}});
	for (const auto& body : world.bodies())
		m_frames.back().poses.push_back(body->getCenterOfMassTransform());
	for (const btElasticPlasticJoint* joint : world.joints())
		m_frames.back().joints.push_back({joint->getPosition(), markOf(*joint), float(joint->getUtilisation()),
										  float(joint->getDamage()), joint->isBroken()});
}

/// Where it is, and by which power of ten its displacements are to be magnified to be a twentieth of its size.
void ProblemScene::measure()
{
	m_low.setValue(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
	m_high = -m_low;
	for (size_t i = 0; i < m_bodies.size(); ++i)
		if (!m_bodies[i].isFixed)
		{
			m_low.setMin(m_frames.front().poses[i].getOrigin() - m_bodies[i].size / 2);
			m_high.setMax(m_frames.front().poses[i].getOrigin() + m_bodies[i].size / 2);
		}
	const btScalar size = (m_high - m_low).length();
	btScalar displacement = 0;
	for (const Frame& frame : m_frames)
		for (size_t i = 0; i < m_bodies.size(); ++i)
		{
			const btVector3& place = frame.poses[i].getOrigin();
			const btScalar way = (place - m_frames.front().poses[i].getOrigin()).length();
			// What flies off may leave the picture.
			if (m_bodies[i].isFixed || !(way < size))
				continue;
			displacement = std::max(displacement, way);
			m_low.setMin(place);
			m_high.setMax(place);
		}
	if (displacement > 0 && displacement < size / 20)
		m_magnification = std::pow(10, std::floor(std::log10(double(size / 20 / displacement))));
}

std::string ProblemScene::title() const { return std::string(m_problem.name) + ": " + m_problem.what; }
btScalar ProblemScene::stepTime() const { return btScalar(FRAME); }

void ProblemScene::step(const Controls&)
{
	// At its end it stands for a second.
	m_frame = m_frame < m_frames.size() + 60 ? m_frame + 1 : 0;
}

btTransform ProblemScene::magnified(size_t body) const
{
	const btTransform &start = m_frames.front().poses[body],
					  &now = m_frames[std::min(m_frame, m_frames.size() - 1)].poses[body];
	const btScalar by = btScalar(m_magnification);
	const btQuaternion turn = now.getRotation() * start.getRotation().inverse();
	const btScalar angle = turn.getAngleShortestPath() * by;
	btTransform pose = now;
	pose.setOrigin(start.getOrigin() + (now.getOrigin() - start.getOrigin()) * by);
	if (by != 1 && angle > SIMD_EPSILON)
		pose.setRotation(btQuaternion(turn.getW() < 0 ? -turn.getAxis() : turn.getAxis(), angle) * start.getRotation());
	return pose;
}

Drawing ProblemScene::draw() const
{
	Drawing drawing;
	const Frame& frame = m_frames[std::min(m_frame, m_frames.size() - 1)];
	// The ground is no part of the problem: it lies well below.
	const btVector3 up(0, extent() - m_low.y(), 0);
	for (size_t i = 0; i < m_bodies.size(); ++i)
	{
		btTransform pose = magnified(i);
		pose.setOrigin(pose.getOrigin() + up);
		// What is much larger than the structure is but where it lies on.
		if (m_bodies[i].size.length() < 3 * extent() && std::isfinite(pose.getOrigin().length()))
			drawing.parts.push_back(
				boxPart(pose, m_bodies[i].size * btScalar(.98), m_bodies[i].isFixed ? SUPPORT : STEEL, .4f));
	}
	for (size_t i = 0; i < frame.joints.size(); ++i)
	{
		const Joint& joint = frame.joints[i];
		if (!std::isfinite(joint.place.length()))
			continue;
		const btVector3& start = m_frames.front().joints[i].place;
		const btTransform pose(btQuaternion(0, 0, 0, 1),
							   start + (joint.place - start) * btScalar(m_magnification) + up);
		const Colour broken = {.6f, .02f, .4f};
		drawing.parts.push_back(boxPart(pose, btVector3(joint.size, joint.size, joint.size),
										joint.isBroken ? broken : jointColour(joint.utilisation, joint.damage)));
	}
	char text[160];
	const Quantity& quantity = m_outcome.quantities.front();
	snprintf(text, sizeof text, "%s: %.6g, exact %.6g", quantity.name.c_str(), quantity.value, quantity.exact);
	drawing.text = {title(), text};
	snprintf(text, sizeof text, "%.2f s, displacements x %g", frame.time, m_magnification);
	drawing.text.push_back(text);
	drawing.legend = {
		{jointColour(0, 0), "unloaded"}, {jointColour(.5, 0), "half of yield"}, {jointColour(1, 0), "yields"}};
	drawing.subject.setOrigin(centre());
	return drawing;
}

btVector3 ProblemScene::centre() const { return (m_low + m_high) / 2 + btVector3(0, extent() - m_low.y(), 0); }

btScalar ProblemScene::extent() const { return (m_high - m_low).length() * btScalar(1.3); }

void ProblemScene::key(char key)
{
	if (key == '+' && m_magnification < 1e9)
		m_magnification *= 10;
	else if (key == '-' && m_magnification > 1)
		m_magnification /= 10;
}

std::vector<std::string> ProblemScene::keyHelp() const { return {"+ -  displacements larger, smaller"}; }
}  // namespace ep
