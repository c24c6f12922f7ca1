// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Run.h"

#include <algorithm>
#include <exception>

#include "scenefile/Complaints.h"
#include "scenefile/SceneFile.h"
#include "simulation/StateFile.h"

namespace ep
{
namespace
{
using nlohmann::json;

template <class Thing>
Names namesOf(const std::vector<Thing>& things)
{
	Names names;
	for (size_t i = 0; i < things.size(); ++i)
		names[things[i].name] = int(i);
	return names;
}

std::vector<int> like(const std::string& what, const std::string& pattern, const Names& names, const char* kind)
{
	std::vector<int> found = placesOf(pattern, names);
	if (found.empty())
		throw SceneError(what + " is no " + kind + ": " + unknownName(pattern, namesIn(names)));
	std::sort(found.begin(), found.end());
	return found;
}

json read(const std::string& state)
{
	try
	{
		json packed = json::from_cbor(state);
		packed.at("scene").get_ref<const std::string&>();
		packed.at("state");
		packed.at("columns").get<std::vector<std::vector<double>>>();
		return packed;
	}
	catch (const json::exception& error)
	{
		throw SceneError(std::string("this is no state that can be read: ") + error.what());
	}
}
}  // namespace

Run::Run(const SceneText& text)
	: m_json(text.root.json()),
	  m_simulation(std::make_unique<Simulation>(describeScene(text))),
	  m_bodies(namesOf(m_simulation->scene().bodies)),
	  m_joints(namesOf(m_simulation->scene().joints)),
	  m_files(std::make_unique<RunFiles>(*m_simulation))
{
}

void Run::refuseInStep(const char* what) const
{
	if (m_isInStep)
		throw SceneError(std::string(what) +
						 " is not possible within a step, where loads are asked for: do it between steps, "
						 "or when a listener is told of an event");
}

std::vector<int> Run::bodiesLike(const std::string& what, const std::string& pattern) const
{
	return like(what, pattern, m_bodies, "body");
}

std::vector<int> Run::jointsLike(const std::string& what, const std::string& pattern) const
{
	return like(what, pattern, m_joints, "joint");
}

void Run::step(const std::function<void(double)>& beforeSubstep)
{
	refuseInStep("a step");
	if (m_simulation->ending() == Ending::NotFinite)
		throw SceneError("the scene cannot go on: since " + std::to_string(m_simulation->time()) +
						 " s there are numbers that are not finite");
	std::exception_ptr error;
	if (beforeSubstep)
		m_simulation->beforeSubsteps(
			[&](double time)
			{
				try
				{
					if (!error)
						beforeSubstep(time);
				}
				catch (...)
				{
					error = std::current_exception();
				}
			});
	m_isInStep = true;
	m_simulation->step();
	m_isInStep = false;
	m_simulation->beforeSubsteps(nullptr);
	m_files->step();
	if (error)
		std::rethrow_exception(error);
}

SceneDescription::Load& Run::load(int number)
{
	auto& loads = m_simulation->addedLoads();
	if (number < 0 || size_t(number) >= loads.size())
		throw SceneError("the scene has no such load");
	return loads[size_t(number)];
}

int Run::addLoad(const SceneDescription::Load& load)
{
	refuseInStep("to add a load");
	m_simulation->addedLoads().push_back(load);
	return int(m_simulation->addedLoads().size()) - 1;
}

/// Its number stays taken: others keep theirs.
void Run::removeLoad(int number) { load(number).bodies.clear(); }

void Run::setLoad(int number, const btVector3& force, const btVector3& moment)
{
	load(number).force = force;
	load(number).moment = moment;
}

void Run::removeBody(int index)
{
	refuseInStep("to remove a body");
	m_simulation->remove(index);
}

void Run::cutJoint(int index)
{
	refuseInStep("to cut a joint");
	m_simulation->cut(index);
}

void Run::pushBody(int index, const btVector3& velocity)
{
	refuseInStep("to push a body");
	m_simulation->push(index, velocity);
}

std::string Run::save()
{
	refuseInStep("to save the state");
	json all = json::array();
	for (const Column& column : columns())
		all.push_back(std::vector<double>(column.values().get(), column.values().get() + column.size()));
	std::string bytes;
	json::to_cbor({{"scene", m_json}, {"state", packState(m_simulation->save())}, {"columns", all}}, bytes);
	return bytes;
}

void Run::restore(const std::string& state)
{
	refuseInStep("to load a state");
	const json packed = read(state);
	if (packed.at("scene") != m_json)
		throw SceneError("the state is of another scene");
	auto simulation = std::make_unique<Simulation>(m_simulation->scene(), unpackState(packed.at("state")));
	auto files = std::make_unique<RunFiles>(*simulation, packed.at("columns").get<std::vector<std::vector<double>>>());
	simulation->addedLoads() = m_simulation->addedLoads();
	m_files = std::move(files);
	m_simulation = std::move(simulation);
}

std::string Run::sceneOf(const std::string& state) { return read(state).at("scene").get<std::string>(); }
}  // namespace ep
