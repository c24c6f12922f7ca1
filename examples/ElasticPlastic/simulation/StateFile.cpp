// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/StateFile.h"

#include "scenefile/Complaints.h"

namespace ep
{
namespace
{
using nlohmann::json;

const int STATE_VERSION = 7;
const char* const PRECISION = sizeof(btScalar) == sizeof(double) ? "double" : "float";

/// What is read or written of a joint's state: one list for both directions.
template <class State, class Act>
void forEachNumber(State& s, Act act)
{
	for (int i = 0; i < 4; ++i)
	{
		act(s.m_plasticRotation[i]);
		act(s.m_plasticMiddle[i]);
	}
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		for (auto* list : {&s.m_plastic, &s.m_force, &s.m_forceRate, &s.m_withheld, &s.m_applied, &s.m_appliedBefore,
						   &s.m_branch[0], &s.m_branch[1], &s.m_branch[2], &s.m_plasticPath, &s.m_watched, &s.m_load[0],
						   &s.m_load[1], &s.m_given[0], &s.m_given[1]})
			act((*list)[i]);
	for (auto& initial : s.m_initial)
		act(initial);
	act(s.m_lastStep);
	act(s.m_withheldStep);
	for (auto& spin : s.m_spin)
		act(spin);
	act(s.m_work);
	act(s.m_storedEnergy);
	act(s.m_placeEnergy);
	act(s.m_plasticEnergy);
	act(s.m_dampingEnergy);
	act(s.m_isGiven);
	act(s.m_solvedExactly);
	act(s.m_yielded);
	act(s.m_broken);
	act(s.m_passedLevels);
	for (auto& strain : s.m_fibreStrain)
		act(strain);
	for (auto* number :
		 {&s.m_innerRhythm.m_level, &s.m_innerRhythm.m_calm, &s.m_innerRhythm.m_spare, &s.m_innerRhythm.m_quiet})
		act(*number);
	act(s.m_innerRhythm.m_ringing);
}

/// The same of a fibre's state.
template <class State, class Act>
void forEachNumberOfFibre(State& s, Act act)
{
	for (auto* number : {&s.m_force, &s.m_forceRate, &s.m_offset, &s.m_damage, &s.m_path, &s.m_rate, &s.m_rateShare})
		act(*number);
	act(s.m_isCracked);
}

json packJoint(const btElasticPlasticState& state)
{
	json numbers = json::array(), fibres = json::array();
	forEachNumber(state, [&](const auto& value) { numbers.push_back(value); });
	for (int i = 0; i < state.m_fibres.size(); ++i)
		forEachNumberOfFibre(state.m_fibres[i], [&](const auto& value) { fibres.push_back(value); });
	return {{"numbers", numbers}, {"fibres", fibres}};
}

btElasticPlasticState unpackJoint(const json& packed)
{
	btElasticPlasticState state;
	size_t i = 0;
	forEachNumber(state, [&](auto& value) { packed.at("numbers").at(i++).get_to(value); });
	const json& fibres = packed.at("fibres");
	for (i = 0; i < fibres.size();)
	{
		btElasticPlasticFibreState fibre;
		forEachNumberOfFibre(fibre, [&](auto& value) { fibres.at(i++).get_to(value); });
		state.m_fibres.push_back(fibre);
	}
	return state;
}

json packEvents(const std::vector<SceneEvent>& events)
{
	json all = json::array();
	for (const SceneEvent& e : events)
		all.push_back({e.time, int(e.type), e.index, e.dof, e.energy, e.place.x(), e.place.y(), e.place.z(), e.part});
	return all;
}

/// Of an enumeration whose first is 0.
template <class Choice>
Choice unpackChoice(const json& packed, Choice last)
{
	const int number = packed.get<int>();
	if (number < 0 || number > int(last))
		throw SceneError("a choice that is none");
	return Choice(number);
}

std::vector<SceneEvent> unpackEvents(const json& all)
{
	std::vector<SceneEvent> events;
	for (const json& e : all)
		events.push_back({e.at(0), unpackChoice(e.at(1), SceneEvent::Type::Push), e.at(2), e.at(3), e.at(4),
						  btVector3(e.at(5), e.at(6), e.at(7)), e.at(8)});
	return events;
}

json packVehicles(const std::vector<SimulationState::Vehicle>& vehicles)
{
	json all = json::array();
	for (const auto& v : vehicles)
	{
		json wheels = json::array();
		for (const auto& w : v.wheels)
			wheels.push_back({w.turn, w.lastTurn, w.suspension, w.force, w.ground});
		const Autopilot::Progress& p = v.progress;
		all.push_back({wheels, v.steer, p.leg, p.facing, p.direction, p.waited});
	}
	return all;
}

std::vector<SimulationState::Vehicle> unpackVehicles(const json& all)
{
	std::vector<SimulationState::Vehicle> vehicles;
	for (const json& v : all)
	{
		SimulationState::Vehicle vehicle = {{}, v.at(1), {v.at(2), v.at(3), v.at(4), v.at(5)}};
		for (const json& w : v.at(0))
			vehicle.wheels.push_back({w.at(0), w.at(1), w.at(2), w.at(3), w.at(4)});
		vehicles.push_back(vehicle);
	}
	return vehicles;
}

SimulationState unpack(const json& packed)
{
	if (packed.at("version") != STATE_VERSION || packed.at("precision") != PRECISION)
		throw SceneError("it is of version " + packed.at("version").dump() + " in " +
						 packed.at("precision").get<std::string>() + ", not of version " +
						 std::to_string(STATE_VERSION) + " in " + PRECISION);
	SimulationState s;
	packed.at("time").get_to(s.time);
	packed.at("calm").get_to(s.calm);
	packed.at("last_substep").get_to(s.lastSubstep);
	s.ending = unpackChoice(packed.at("ending"), Ending::NotFinite);
	const json& e = packed.at("energies");
	s.energies = {e.at(0), e.at(1), e.at(2), e.at(3), e.at(4), e.at(5), e.at(6), e.at(7)};
	packed.at("played").get_to(s.played);
	s.events = unpackEvents(packed.at("events"));
	for (const json& change : packed.at("changes"))
		s.changes.push_back({unpackChoice(change.at(0), SimulationState::Change::Type::Cut), change.at(1)});
	const auto& bytes = packed.at("world").get_binary();
	s.world.assign(bytes.begin(), bytes.end());
	for (const json& joint : packed.at("cut"))
		s.cut.emplace_back(joint.at(0).get<int>(), unpackJoint(joint.at(1)));
	packed.at("broken_bullets_own").get_to(s.brokenBulletsOwn);
	s.vehicles = unpackVehicles(packed.at("vehicles"));
	return s;
}
}  // namespace

json packState(const SimulationState& s)
{
	const SceneEnergies& e = s.energies;
	json changes = json::array(), cut = json::array();
	for (const auto& change : s.changes)
		changes.push_back({int(change.type), change.index});
	for (const auto& [index, joint] : s.cut)
		cut.push_back({index, packJoint(joint)});
	return {{"version", STATE_VERSION},
			{"precision", PRECISION},
			{"time", s.time},
			{"calm", s.calm},
			{"last_substep", s.lastSubstep},
			{"ending", int(s.ending)},
			{"energies", {e.kinetic, e.elastic, e.plastic, e.damping, e.numerical, e.turnover, e.gained, e.isAudited}},
			{"played", s.played},
			{"events", packEvents(s.events)},
			{"changes", changes},
			{"world", json::binary({s.world.begin(), s.world.end()})},
			{"cut", cut},
			{"broken_bullets_own", s.brokenBulletsOwn},
			{"vehicles", packVehicles(s.vehicles)}};
}

SimulationState unpackState(const json& packed)
{
	try
	{
		return unpack(packed);
	}
	catch (const std::exception& error)
	{
		throw SceneError(std::string("this is no state that can be read: ") + error.what());
	}
}
}  // namespace ep
