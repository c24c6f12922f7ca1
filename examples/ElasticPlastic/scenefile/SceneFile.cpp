// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/SceneFile.h"

#include <algorithm>

#include "scenefile/FieldReader.h"
#include "scenefile/FieldSchema.h"
#include "scenefile/SceneBuilder.h"
#include "scenefile/generators/Assembly.h"

namespace ep
{
namespace
{
const std::vector<Named<btElasticPlasticContacts>>& contactKinds()
{
	static const std::vector<Named<btElasticPlasticContacts>> all = {
		{"by-island", BT_EP_CONTACTS_BY_ISLAND}, {"exact", BT_EP_EXACT_CONTACTS}, {"swept", BT_EP_SWEPT_CONTACTS}};
	return all;
}

const std::vector<Named<btElasticPlasticScheme>>& schemes()
{
	static const std::vector<Named<btElasticPlasticScheme>> all = {{"implicit", BT_EP_SCHEME_IMPLICIT},
																   {"by-mode", BT_EP_SCHEME_BY_MODE}};
	return all;
}

void worldFields(Fields& f, SceneDescription::WorldSettings& w)
{
	f.vector("gravity", w.gravity, "m/s^2", "acceleration", Need::Optional, {-1e4, 1e4});
	f.number("ramp", w.ramp, {0, 1e4}, "s", "in which gravity grows from 0");
	f.number("step", w.step, {1e-6, 1}, "s", "of the game");
	f.whole("substeps", w.substeps, 1, 10000, "of each step");
	f.number("error", w.error, {0, 1}, "", "allowed in how much flows, by which substeps are chosen; 0: as given");
	f.number("inner_error", w.innerError, {0, 1}, "",
			 "at which the direct solver takes a blow through inner steps; 0: it takes none");
	f.flag("keeps_swings", w.keepsSwings,
		   "the direct solver does, of what nothing touches: for loads that come on at once, and bases that shake");
	f.named("solver", w.solver, solvers(), "how it is solved");
	f.whole("iterations", w.iterations, 1, 10000, "of solvers that iterate, and of swept contacts");
	f.named("joints", w.joints, jointKinds(), "what stands for elastic-plastic joints");
	f.named("scheme", w.scheme, schemes(),
			"of elastic-plastic joints: what the step does not resolve is damped by the row or by the mode");
	if (w.scheme != BT_EP_SCHEME_IMPLICIT && w.joints.joints != Joints::ElasticPlastic)
		f.refuse("scheme", "is for the joints ep1 and ep2");
	f.named("contacts", w.contacts, contactKinds(), "how the direct solver treats them");
	f.whole("threads", w.threads, 1, btElasticPlasticSolverSettings::MAX_THREADS, "that solve islands");
	f.flag("sleeps", w.sleeps, "bodies at rest fall asleep");
	f.number("damping", w.damping, {0, 1}, "", "share of its velocity that a body loses in a second");
	f.flag("ground", w.ground, "there is one, at height 0");
	f.number("ground_friction", w.groundFriction, {0, 100}, "", "is multiplied with that of what it touches");
}

void expectationFields(Fields& f, SceneDescription& scene)
{
	SceneDescription::Expectation e;
	std::vector<std::string> probes;
	for (const SceneDescription::Probe& probe : scene.probes)
		probes.push_back(probe.name);
	if (f.text("probe", e.probe, "whose last value it is; else the number of broken joints") &&
		std::find(probes.begin(), probes.end(), e.probe) == probes.end())
		f.refuse("probe", "is a probe that is not there: " + unknownName(e.probe, probes));
	f.number("least", e.least, Range::any(), "", "value", Need::Required);
	f.number("most", e.most, Range::any(), "", "value", Need::Required);
	if (e.most < e.least)
		f.refuse("most", "is less than the least");
	scene.expectations.push_back(e);
}

void cameraFields(Fields& f, SceneDescription& scene)
{
	f.vector("from", scene.camera.from, "m", "the eye's place", Need::Required);
	f.vector("to", scene.camera.to, "m", "what it looks at", Need::Required);
	f.number("time", scene.pictureTime, {-1, 1e5}, "s", "of the gallery's picture; below 0: the end");
	scene.camera.isGiven = true;
}

void materialList(Fields& f, SceneBuilder& b)
{
	f.named("materials", "by their names; what is left out is as steel has it",
			[&](const std::string& name, Fields& in) { materialFields(in, b.m_materials[name]); });
}

void structureList(Fields& f, SceneBuilder& builder)
{
	const std::vector<std::pair<const char*, void (*)(Fields&, SceneBuilder&)>> generators = {
		{"beam", beamStructure}, {"chain", chainStructure}, {"frame", frameStructure}, {"wall", wallStructure},
		{"slab", slabStructure}, {"mast", mastStructure},   {"grid", gridStructure}};
	std::vector<std::string> keys;
	for (const auto& generator : generators)
	{
		f.object(generator.first, "a structure with its joints",
				 [&](Fields& inner) { generator.second(inner, builder); });
		keys.push_back(generator.first);
	}
	f.oneOf(keys);
}

/// In the order in which one needs another, whatever the file's.
void sceneFields(Fields& f, SceneBuilder& b)
{
	SceneDescription& s = b.scene();
	int version = SCENE_VERSION;
	f.whole("version", version, 1, SCENE_VERSION, "of this format", Need::Required);
	f.text("title", s.title, "in a few words");
	f.text("about", s.about, "what there is to see");
	f.known("parameters");
	f.known("include");
	f.object("world", "how it is computed", [&](Fields& in) { worldFields(in, s.world); });
	materialList(f, b);
	f.named("sections", "by their names",
			[&](const std::string& name, Fields& in)
			{
				// Not one of itself.
				SceneDescription::Section section;
				sectionFields(in, b, section);
				b.m_sections[name] = section;
			});
	f.list("bodies", 10000, "rigid bodies", [&](Fields& in) { bodyFields(in, b); });
	f.list("vehicles", 100, "bodies on four wheels", [&](Fields& in) { vehicleFields(in, b); });
	f.list("structures", 1000, "what is made of many bodies and joints", [&](Fields& in) { structureList(in, b); });
	f.list("joints", 10000, "between bodies", [&](Fields& in) { jointFields(in, b); });
	f.list("loads", 1000, "forces and moments over time", [&](Fields& in) { loadFields(in, b); });
	f.list("fires", 1000, "heat over time", [&](Fields& in) { fireFields(in, b); });
	f.list("blasts", 100, "waves of pressure from a point",
		   [&](Fields& in) { blastFields(in, s.blasts.emplace_back()); });
	f.list("events", 1000, "what happens at a time", [&](Fields& in) { eventFields(in, b); });
	f.list("probes", 1000, "what is read and written down", [&](Fields& in) { probeFields(in, b); });
	f.object("end", "of the simulation, whatever comes first",
			 [&](Fields& in)
			 {
				 in.number("time", s.end.time, {0, 1e5}, "s", "simulated");
				 in.number("standstill", s.end.standstill, {0, 1e3}, "m/s",
						   "no body has been faster for half a second; 0: does not end it");
				 in.flag("first_break", s.end.firstBreak, "a joint has broken");
			 });
	f.list("expect", 100, "what is to come of it at the end", [&](Fields& in) { expectationFields(in, s); });
	f.object("camera", "of the gallery's picture", [&](Fields& in) { cameraFields(in, s); });
	if (s.bodies.empty() && !f.hasFailed())
		f.refuse("", "has no bodies and no structures");
	if (s.end.time / s.world.step > 1e8)
		f.refuse("end", "comes after more than 1e8 steps");
}

/// Types that are read before all others, and those that are not objects.
nlohmann::ordered_json plainTypes()
{
	using Json = nlohmann::ordered_json;
	const Json number = {{"anyOf", {{{"type", "number"}}, {{"$ref", "#/$defs/expression"}}}}};
	return {{"expression",
			 {{"type", "string"}, {"pattern", "^="}, {"description", "computed from parameters, such as =span / 2"}}},
			{"parameters",
			 {{"type", "object"},
			  {"description", "numbers by names, for expressions"},
			  {"additionalProperties",
			   {{"anyOf",
				 {number,
				  {{"type", "object"},
				   {"properties",
					{{"value", number},
					 {"unit", {{"type", "string"}}},
					 {"least", number},
					 {"most", number},
					 {"what", {{"type", "string"}}}}},
				   {"required", {"value"}},
				   {"additionalProperties", false}}}}}}}},
			{"include",
			 {{"type", "array"},
			  {"description", "files over which this one is put"},
			  {"items",
			   {{"anyOf",
				 {{{"type", "string"}},
				  {{"type", "object"},
				   {"properties", {{"file", {{"type", "string"}}}, {"set", {{"type", "object"}}}}},
				   {"required", {"file"}},
				   {"additionalProperties", false}}}}}}}}};
}
}  // namespace

SceneDescription describeScene(const SceneText& text)
{
	Complaints complaints;
	if (!text.root.isObject())
		complaints.add(text.root.place, "", "is " + text.root.shown() + "; a scene is an object");
	complaints.check();
	SceneDescription scene;
	SceneBuilder builder(scene);
	FieldReader reader(text.root, "", text.parameters, complaints);
	sceneFields(reader, builder);
	reader.finish();
	complaints.check();
	return scene;
}

std::map<std::string, SceneDescription::Material> describeMaterials(const SceneText& text)
{
	Complaints complaints;
	SceneDescription scene;
	SceneBuilder builder(scene);
	FieldReader reader(text.root, "", text.parameters, complaints);
	materialList(reader, builder);
	complaints.check();
	return builder.m_materials;
}

std::string sceneSchema()
{
	nlohmann::ordered_json types = plainTypes();
	FieldSchema fields(types);
	SceneDescription scene;
	SceneBuilder builder(scene);
	sceneFields(fields, builder);
	nlohmann::ordered_json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
									 {"title", "A scene of Bullet Elastic-Plastic"},
									 {"description", "SI units; see docs/scenes.md"}};
	schema.update(fields.schema());
	schema["$defs"] = types;
	return schema.dump(1, '\t') + "\n";
}
}  // namespace ep
