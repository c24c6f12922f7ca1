// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/Probes.h"

#include <algorithm>
#include <limits>

#include "text/Format.h"
#include "world/JointReading.h"

namespace ep
{
namespace
{
using Measure = SceneDescription::Measure;
using Gather = SceneDescription::Gather;

/// An axis, or the length.
double partOf(const btVector3& v, int part) { return double(part < 3 ? v[part] : v.length()); }

double readBody(const Simulation& s, Measure measure, int index, int part)
{
	const btRigidBody& body = *s.body(index);
	const btTransform pose = s.poseOf(index), start = s.startOf(index);
	switch (measure)
	{
		case Measure::Displacement:
			return partOf(pose.getOrigin() - start.getOrigin(), part);
		case Measure::Velocity:
			return partOf(body.getLinearVelocity(), part);
		case Measure::Spin:
			return partOf(body.getAngularVelocity(), part);
		case Measure::Turn:
		{
			btQuaternion turn = pose.getRotation() * start.getRotation().inverse();
			if (turn.getW() < 0)
				turn = -turn;
			return partOf(turn.getAxis() * turn.getAngle(), part);
		}
		case Measure::KineticEnergy:
			return kineticEnergy(body, body.getCenterOfMassTransform().getBasis());
		default:
			return partOf(pose.getOrigin(), part);
	}
}

double readJointAt(const Simulation& s, Measure measure, int index, int dof)
{
	const btElasticPlasticJoint* const joint = s.joint(index);
	if (measure == Measure::Broken)
		return s.isBroken(index);
	if (!joint)
		return 0;
	const JointReading reading = readJoint(s.world(), *joint);
	switch (measure)
	{
		case Measure::Force:
			return reading.force[dof];
		case Measure::Deformation:
			return reading.deformation[dof];
		case Measure::PlasticDeformation:
			return double(joint->getPlasticDeformation(dof));
		case Measure::Utilisation:
			return reading.utilisation;
		case Measure::Damage:
			return reading.damage;
		case Measure::ElasticEnergy:
			return reading.elasticEnergy;
		default:
			return reading.plasticEnergy;
	}
}

/// The force in contacts between two groups of bodies, normal parts only, as a vector on the first.
double readContacts(Simulation& s, const SceneDescription::Probe& probe)
{
	const auto has = [&](const std::vector<int>& group, const btCollisionObject* object)
	{ return std::any_of(group.begin(), group.end(), [&](int index) { return s.body(index) == object; }); };
	btVector3 sum(0, 0, 0);
	btDispatcher* const dispatcher = s.world().bullet().getDispatcher();
	for (int i = 0; i < dispatcher->getNumManifolds(); ++i)
	{
		const btPersistentManifold& manifold = *dispatcher->getManifoldByIndexInternal(i);
		for (int side = 0; side < 2; ++side)
		{
			const btCollisionObject *const own = side ? manifold.getBody1() : manifold.getBody0(),
										   *const other = side ? manifold.getBody0() : manifold.getBody1();
			if (!has(probe.things, own) || (!probe.others.empty() && !has(probe.others, other)))
				continue;
			// Bullet's normal points to the first body.
			for (int k = 0; k < manifold.getNumContacts(); ++k)
			{
				const btManifoldPoint& point = manifold.getContactPoint(k);
				sum += point.m_normalWorldOnB * point.getAppliedImpulse() * btScalar(side ? -1 : 1);
			}
		}
	}
	return partOf(sum, probe.part) / s.lastSubstep();
}
}  // namespace

double readProbe(Simulation& s, const SceneDescription::Probe& probe)
{
	if (probe.measure == Measure::ContactForce)
		return readContacts(s, probe);
	const bool isJoint = probe.measure >= Measure::Force;
	std::vector<double> values;
	for (int index : probe.things)
		if (isJoint)
			values.push_back(readJointAt(s, probe.measure, index, probe.part));
		else if (s.isThere(index))
			values.push_back(readBody(s, probe.measure, index, probe.part));
	if (values.empty())
		return std::numeric_limits<double>::quiet_NaN();
	double sum = 0;
	for (double value : values)
		sum += value;
	switch (probe.gather)
	{
		case Gather::Sum:
			break;
		case Gather::Mean:
			return sum / double(values.size());
		case Gather::Least:
			return *std::min_element(values.begin(), values.end());
		case Gather::Most:
			return *std::max_element(values.begin(), values.end());
	}
	return sum;
}

std::vector<std::string> unmetExpectations(const Simulation& s, const std::vector<double>& values)
{
	std::vector<std::string> unmet;
	for (const SceneDescription::Expectation& e : s.scene().expectations)
	{
		double value = s.numBroken();
		for (size_t i = 0; i < values.size() && !e.probe.empty(); ++i)
			if (s.scene().probes[i].name == e.probe)
				value = values[i];
		if (!(value >= e.least && value <= e.most))
			unmet.push_back(format("%s is %g; it is to be from %g to %g",
								   e.probe.empty() ? "the number of broken joints" : e.probe.c_str(), value, e.least,
								   e.most));
	}
	return unmet;
}
}  // namespace ep
