// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The compiled part of the package: Run as Python sees it. What users call is in scene.py, which says what it does.

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "Run.h"
#include "scenefile/Complaints.h"
#include "simulation/SectionStrength.h"
#include "world/JointReading.h"

namespace py = pybind11;

namespace
{
using Three = std::array<double, 3>;
using Settings = std::vector<std::pair<std::string, std::string>>;

btVector3 vectorOf(const Three& v) { return btVector3(btScalar(v[0]), btScalar(v[1]), btScalar(v[2])); }
Three threeOf(const btVector3& v) { return {double(v.x()), double(v.y()), double(v.z())}; }

std::vector<ep::Setting> settingsOf(const Settings& pairs)
{
	std::vector<ep::Setting> settings;
	for (const auto& [path, value] : pairs)
		settings.push_back({path, value});
	return settings;
}

/// A view of what has been read: it owns a share of the block that it shows.
py::array viewOf(const ep::Column& column)
{
	using Block = std::shared_ptr<const double[]>;
	const py::capsule owner(new Block(column.values()), [](void* block) { delete static_cast<Block*>(block); });
	py::array_t<double> view(py::ssize_t(column.size()), column.values().get(), owner);
	view.attr("setflags")(py::arg("write") = false);
	return std::move(view);
}

template <class Thing>
std::vector<std::string> namesOf(const std::vector<Thing>& things)
{
	std::vector<std::string> names;
	for (const Thing& thing : things)
		names.push_back(thing.name);
	return names;
}

template <class Thing>
size_t checked(int index, const std::vector<Thing>& things)
{
	if (index < 0 || size_t(index) >= things.size())
		throw py::index_error("the scene has no such body or joint");
	return size_t(index);
}

py::dict bodyOf(const ep::Run& run, int number)
{
	const ep::Simulation& s = run.simulation();
	const int index = int(checked(number, s.scene().bodies));
	const btRigidBody* const body = s.body(index);
	const btTransform pose = s.poseOf(index);
	const btQuaternion turn = pose.getRotation();
	const btVector3 none(0, 0, 0);
	py::dict reading;
	reading["is_there"] = s.isThere(index);
	reading["mass"] = body && body->getInvMass() > 0 ? 1 / double(body->getInvMass()) : 0;
	reading["position"] = threeOf(pose.getOrigin());
	reading["rotation"] = std::array<double, 4>{double(turn.x()), double(turn.y()), double(turn.z()), double(turn.w())};
	reading["velocity"] = threeOf(body ? body->getLinearVelocity() : none);
	reading["spin"] = threeOf(body ? body->getAngularVelocity() : none);
	return reading;
}

py::dict jointOf(const ep::Run& run, int number)
{
	const ep::Simulation& s = run.simulation();
	const size_t index = checked(number, s.scene().joints);
	const btElasticPlasticJoint* const joint = s.joint(int(index));
	const ep::JointReading r = joint ? readJoint(s.world(), *joint) : ep::JointReading();
	std::array<double, BT_EP_DOF_COUNT> force, deformation, plastic;
	for (size_t dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
	{
		force[dof] = r.force[dof];
		deformation[dof] = r.deformation[dof];
		plastic[dof] = joint ? double(joint->getPlasticDeformation(int(dof))) : 0;
	}
	std::vector<std::string> bodies;
	for (int body : s.scene().joints[index].bodies)
		bodies.push_back(body == ep::SceneDescription::WORLD ? "world" : s.scene().bodies[size_t(body)].name);
	py::dict reading;
	reading["bodies"] = py::tuple(py::cast(bodies));
	reading["is_broken"] = s.isBroken(int(index));
	reading["is_cut"] = s.isCut(int(index));
	reading["has_yielded"] = r.hasYielded;
	reading["utilisation"] = r.utilisation;
	reading["damage"] = r.damage;
	reading["elastic_energy"] = r.elasticEnergy;
	reading["plastic_energy"] = r.plasticEnergy;
	reading["damping_energy"] = r.dampingEnergy;
	reading["force"] = force;
	reading["deformation"] = deformation;
	reading["plastic_deformation"] = plastic;
	return reading;
}

/// The corners of the line, a row each: N and M.
py::array_t<double> strengthOf(const ep::Run& run, int number, bool isAboutZ, bool isNow)
{
	const ep::Simulation& s = run.simulation();
	const btElasticPlasticJoint* const joint = s.joint(int(checked(number, s.scene().joints)));
	const auto line = joint ? ep::sectionStrength(*joint, isAboutZ, isNow) : std::vector<std::pair<double, double>>();
	py::array_t<double> corners({py::ssize_t(line.size()), py::ssize_t(2)});
	for (size_t i = 0; i < line.size(); ++i)
	{
		corners.mutable_at(py::ssize_t(i), 0) = line[i].first;
		corners.mutable_at(py::ssize_t(i), 1) = line[i].second;
	}
	return corners;
}

py::tuple eventOf(const ep::Run& run, size_t number)
{
	const ep::Simulation& s = run.simulation();
	if (number >= s.events().size())
		throw py::index_error("there is no such event");
	const ep::SceneEvent& event = s.events()[number];
	const bool isBody = event.type == ep::SceneEvent::Type::Remove || event.type == ep::SceneEvent::Type::Push;
	const std::string& name =
		isBody ? s.scene().bodies[size_t(event.index)].name : s.scene().joints[size_t(event.index)].name;
	const py::object dof = event.dof < 0 ? py::object(py::none()) : py::str(btElasticPlasticDofName(event.dof));
	return py::make_tuple(event.time, ep::nameOf(ep::sceneEventTypes(), event.type), name, dof, event.energy,
						  py::tuple(py::cast(threeOf(event.place))),
						  event.part < 0 ? py::object(py::none()) : py::object(py::int_(event.part)));
}

int addLoad(ep::Run& run, const std::string& on, const Three& at, bool turnsAlong)
{
	ep::SceneDescription::Load load;
	load.bodies = run.bodiesLike("on", on);
	load.at = vectorOf(at);
	load.turnsAlong = turnsAlong;
	return run.addLoad(load);
}
}  // namespace

PYBIND11_MODULE(_core, m)
{
	m.doc() = "What bullet_elastic_plastic is made of: use that.";
	m.attr("PRECISION") = sizeof(btScalar) == sizeof(double) ? "double" : "float";
	py::register_exception<ep::SceneError>(m, "SceneError", PyExc_ValueError).doc() =
		"What is wrong with a scene or with what is asked of it: all of it, a line each, as ep-run tells it.";
	m.def("unknown_name", &ep::unknownName);

	py::class_<ep::Run>(m, "Run")
		.def_static("read", [](const std::string& file, const Settings& settings)
					{ return std::make_unique<ep::Run>(ep::SceneText::read(file, settingsOf(settings))); })
		.def_static(
			"parse",
			[](const std::string& text, const std::string& name, const Settings& settings, const std::string& folder)
			{ return std::make_unique<ep::Run>(ep::SceneText::parse(text, name, settingsOf(settings), folder)); })
		.def("scene_json", &ep::Run::sceneJson)
		.def("summary_json", &ep::Run::summaryJson)
		.def("body_names", [](const ep::Run& run) { return namesOf(run.simulation().scene().bodies); })
		.def("joint_names", [](const ep::Run& run) { return namesOf(run.simulation().scene().joints); })
		.def("bodies_like", &ep::Run::bodiesLike)
		.def("joints_like", &ep::Run::jointsLike)
		.def("body", &bodyOf)
		.def("joint", &jointOf)
		.def("strength", &strengthOf)
		.def("column_titles",
			 [](const ep::Run& run)
			 {
				 std::vector<std::string> titles;
				 for (const ep::Column& column : run.columns())
					 titles.push_back(column.title());
				 return titles;
			 })
		.def("column", [](const ep::Run& run, size_t index) { return viewOf(run.columns().at(index)); })
		.def("time", [](const ep::Run& run) { return run.simulation().time(); })
		.def("step_length", [](const ep::Run& run) { return run.simulation().scene().world.step; })
		.def("num_broken", [](const ep::Run& run) { return run.simulation().numBroken(); })
		.def("ending", [](const ep::Run& run) { return ep::nameOf(ep::endings(), run.simulation().ending()); })
		.def("num_events", [](const ep::Run& run) { return run.simulation().events().size(); })
		.def("event", &eventOf)
		.def("step", &ep::Run::step)
		.def("add_load", &addLoad)
		.def("remove_load", &ep::Run::removeLoad)
		.def("set_load", [](ep::Run& run, int number, const Three& force, const Three& moment)
			 { run.setLoad(number, vectorOf(force), vectorOf(moment)); })
		.def("remove_body", &ep::Run::removeBody)
		.def("cut_joint", &ep::Run::cutJoint)
		.def("push_body",
			 [](ep::Run& run, int index, const Three& velocity) { run.pushBody(index, vectorOf(velocity)); })
		.def("write", &ep::Run::write)
		.def("save", [](ep::Run& run) { return py::bytes(run.save()); })
		.def("restore", [](ep::Run& run, const py::bytes& state) { run.restore(state); })
		.def_static("scene_of", [](const py::bytes& state) { return ep::Run::sceneOf(state); });
}
