// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/SceneBuilder.h"

#include <cmath>

namespace ep
{
using Measure = SceneDescription::Measure;
using Gather = SceneDescription::Gather;

const std::vector<Named<Measure>>& measures()
{
	static const std::vector<Named<Measure>> all = {{"position", Measure::Position},
													{"displacement", Measure::Displacement},
													{"velocity", Measure::Velocity},
													{"spin", Measure::Spin},
													{"turn", Measure::Turn},
													{"kinetic_energy", Measure::KineticEnergy},
													{"force", Measure::Force},
													{"deformation", Measure::Deformation},
													{"plastic_deformation", Measure::PlasticDeformation},
													{"utilisation", Measure::Utilisation},
													{"damage", Measure::Damage},
													{"elastic_energy", Measure::ElasticEnergy},
													{"plastic_energy", Measure::PlasticEnergy},
													{"broken", Measure::Broken},
													{"contact_force", Measure::ContactForce}};
	return all;
}

const std::vector<Named<Gather>>& gathers()
{
	static const std::vector<Named<Gather>> all = {
		{"sum", Gather::Sum}, {"mean", Gather::Mean}, {"least", Gather::Least}, {"most", Gather::Most}};
	return all;
}

namespace
{
const std::vector<std::string> AXES = {"x", "y", "z", "length"};
const std::vector<std::string> DOFS = {"axial", "shear_y", "shear_z", "torsion", "bending_y", "bending_z"};

/// Pairs of a time and a value.
void tableField(Fields& f, std::vector<std::pair<double, double>>& table, const char* help, const char* value,
				Need need = Need::Optional)
{
	std::vector<double> v;
	if (!f.numbers("over", v, 2, 2000, {-1e12, 1e12}, "", help, need))
		return;
	if (v.size() % 2 != 0)
		f.refuse("over", std::string("has an odd number of numbers; each time has a ") + value);
	for (size_t i = 0; i + 1 < v.size(); i += 2)
	{
		if (i > 0 && v[i] <= v[i - 2])
			f.refuse("over", "has times that do not grow");
		table.emplace_back(v[i], v[i + 1]);
	}
}

void courseFields(Fields& f, SceneDescription::Course& course)
{
	tableField(f, course.table, "time [s], factor, time, factor ...: straight between them", "factor");
	f.number("frequency", course.frequency, {0, 1e4}, "Hz", "of a sine by which it is multiplied; 0: none");
	f.number("phase", course.phase, {-1e4, 1e4}, "degrees", "of this sine");
}
}  // namespace

void loadFields(Fields& f, SceneBuilder& builder)
{
	SceneDescription::Load load;
	std::string on;
	f.text("on", on, "name of a body, or a pattern with * for several that each bear it", Need::Required);
	const bool hasForce = f.vector("force", load.force, "N", "in the world's axes", Need::Optional, Range::any()),
			   hasMoment = f.vector("moment", load.moment, "N m", "in the world's axes", Need::Optional, Range::any());
	f.vector("at", load.at, "m", "where on the body, in its own axes");
	f.flag("turns_along", load.turnsAlong, "force and moment are in the body's own axes");
	courseFields(f, load.course);
	if (!hasForce && !hasMoment)
		f.refuse("", "must have the key force or moment");
	if (!on.empty())
		load.bodies = builder.bodies(f, "on", on);
	builder.scene().loads.push_back(load);
}

void fireFields(Fields& f, SceneBuilder& builder)
{
	typedef btElasticPlasticHeat Heat;
	static const std::vector<Named<SceneDescription::HeatLaw>> laws = {
		{"steel", &Heat::steel},
		{"hot-rolled-bars", [](btScalar t) { return Heat::reinforcement(t); }},
		{"cold-worked-bars", [](btScalar t) { return Heat::reinforcement(t, true); }},
		{"siliceous-concrete", [](btScalar t) { return Heat::concrete(t); }},
		{"calcareous-concrete", [](btScalar t) { return Heat::concrete(t, true); }},
		{"timber", &Heat::timber},
		{"6061-T6", &Heat::aluminium6061},
		{"6082-T6", &Heat::aluminium6082}};
	SceneDescription::Fire fire;
	fire.law = laws[0].value;
	std::string on;
	std::vector<double> parts;
	f.text("on", on, "name of a joint, or a pattern with * for several", Need::Required);
	tableField(f, fire.temperature,
			   "time [s], temperature of the material [degrees Celsius], time, ...: straight between them",
			   "temperature", Need::Required);
	f.named("law", fire.law, laws, "what heat leaves of the material's strength and stiffness");
	f.numbers("parts", parts, 1, 100, {0, 1000}, "",
			  "of sections with fibres that get hot: 0 the section itself, i its i-th bar or part; all where this is "
			  "missing");
	for (const double part : parts)
		fire.parts.push_back(int(std::lround(part)));
	if (!on.empty())
		fire.joints = builder.joints(f, "on", on);
	builder.scene().fires.push_back(fire);
}

void blastFields(Fields& f, SceneDescription::Blast& b)
{
	f.vector("at", b.at, "m", "its middle", Need::Required);
	f.number("time", b.time, {0, 1e5}, "s", "at which it goes off");
	f.number("pressure", b.pressure, {0, 1e10}, "Pa", "above that of the air, at a distance of 1 m");
	f.number("decay", b.decay, {0, 5}, "", "the pressure falls with this power of the distance");
	f.number("duration", b.duration, {1e-6, 100}, "s", "in which it falls to nothing, straight");
	f.number("speed", b.speed, {1, 1e5}, "m/s", "of the wave");
}

void eventFields(Fields& f, SceneBuilder& builder)
{
	SceneDescription::Event event;
	std::string removed, cut, pushed;
	f.number("time", event.time, {0, 1e5}, "s", "at which it happens", Need::Required);
	const bool hasRemove = f.text("remove", removed, "bodies that leave the world: a name or a pattern"),
			   hasCut = f.text("cut", cut, "joints that leave the world: a name or a pattern"),
			   hasPush = f.text("push", pushed, "bodies that get the velocity: a name or a pattern"),
			   hasVelocity =
				   f.vector("velocity", event.velocity, "m/s", "of what is pushed", Need::Optional, {-1e5, 1e5});
	if (hasRemove)
		event.removed = builder.bodies(f, "remove", removed);
	if (hasCut)
		event.cut = builder.joints(f, "cut", cut);
	if (hasPush)
		event.pushed = builder.bodies(f, "push", pushed);
	if (hasVelocity != hasPush)
		f.refuse("", "must have both of push and velocity, or none");
	if (!hasRemove && !hasCut && !hasPush)
		f.refuse("", "must have one of the keys remove, cut and push");
	builder.scene().events.push_back(event);
}

void probeFields(Fields& f, SceneBuilder& builder)
{
	SceneDescription::Probe probe;
	std::string of, with;
	size_t axis = 1, dof = 0;
	f.text("name", probe.name, "of its column", Need::Required);
	f.text("of", of, "name of a body or a joint, or a pattern with * for several", Need::Required);
	const bool isTold = f.named("measure", probe.measure, measures(), "what is read");
	const bool hasAxis = f.choice("axis", axis, AXES, "of what a body tells"),
			   hasDof = f.choice("dof", dof, DOFS, "of what a joint tells, in its own frame"),
			   hasWith = f.text("with", with, "bodies on the other side of a contact; else all");
	f.named("gather", probe.gather, gathers(), "what is made of several");
	const bool isJoint = SceneDescription::isOfJoint(probe.measure);
	if (!isTold)
		f.refuse("", "must have the key measure");
	if (hasAxis && isJoint)
		f.refuse("axis", "is for what a body tells; a joint has a dof");
	if (hasDof && !isJoint)
		f.refuse("dof", "is for what a joint tells; a body has an axis");
	if (hasWith && probe.measure != Measure::ContactForce)
		f.refuse("with", "is for the measure contact_force");
	probe.part = int(isJoint ? dof : axis);
	if (!of.empty())
		probe.things = isJoint ? builder.joints(f, "of", of) : builder.bodies(f, "of", of);
	if (!with.empty())
		probe.others = builder.bodies(f, "with", with);
	for (const SceneDescription::Probe& other : builder.scene().probes)
		if (other.name == probe.name)
			f.refuse("name", "is that of another probe");
	if (probe.name.find_first_of(",\"\n") != std::string::npos)
		f.refuse("name", "has one of , \" and a line end: it is the head of a column");
	builder.scene().probes.push_back(probe);
}
}  // namespace ep
