// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "runs/RunLog.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticFault.h"

namespace ep
{
namespace
{
using Json = nlohmann::ordered_json;  // the reader finds what he looks for first

const double SAMPLE = 0.1;  // [s]

Json timeOrNull(double time) { return time < 0 ? Json(nullptr) : Json(time); }

Json toJson(const JointRecord& record, const JointReading& r)
{
	return {{"name", record.joint->getName()},
			{"scene", nameOf(scenes(), record.scene)},
			{"state", nameOf(jointStates(), record.state(r))},
			{"utilisation", r.utilisation},
			{"limiting_dof", btElasticPlasticDofName(r.limitingDof)},
			{"damage", r.damage},
			{"elastic_energy_J", r.elasticEnergy},
			{"plastic_energy_J", r.plasticEnergy},
			{"numerical_energy_J", r.numericalEnergy},
			{"yield_time_s", timeOrNull(record.yieldTime)},
			{"break_time_s", timeOrNull(record.breakTime)}};
}

Json toJson(const DemolisherSummary& s, const DemolisherSettings& settings)
{
	Json built;
	for (Scene scene : settings.onTheWay())
		built.push_back(nameOf(scenes(), scene));
	return {
		{"joints_total", s.joints},
		{"joints_yielded", s.yielded},
		{"joints_broken", s.broken},
		{"plastic_energy_J", s.plasticEnergy},
		{"elastic_energy_J", s.elasticEnergy},
		{"numerical_energy_J", s.numericalEnergy},
		{"kinetic_energy_J", s.kineticEnergy},
		{"bridge_sag_m", settings.has(Scene::Bridge) ? Json(s.sag) : Json(nullptr)},
		{"vehicle_position_m", {s.vehicle.x(), s.vehicle.y(), s.vehicle.z()}},
		{"vehicle_speed_m_s", s.speed},
		{"vehicle_mass_kg", settings.vehicle.mass},
		{"crossed", s.crossed},
		{"bodies_asleep", s.asleep},
		{"simulated_time_s", s.time},
		{"real_time_factor", s.realTimeFactor},
		{"scenes", built},
		{"joint", nameOf(jointKinds(), settings.method.kind())},
		{"solver", nameOf(solvers(), settings.method.solver)},
		{"step_s", settings.step},
		{"substeps", settings.substeps},
		{"inner_error", settings.innerError},
		{"iterations", settings.method.iterations},
		{"steel_share", settings.bridge.steelShare},
		{"ductility", settings.materials.ductility},
	};
}
}  // namespace

void RunLog::step()
{
	if (m_demolisher.time() + 1e-9 > m_samples * SAMPLE)
		sample();
}

void RunLog::sample()
{
	if (m_samples == 0)
		m_joints =
			"time_s,scene,joint,state,utilisation,limiting_dof,damage,"
			"axial_N,shear_y_N,shear_z_N,torsion_Nm,bending_y_Nm,bending_z_Nm,"
			"elastic_energy_J,plastic_energy_J\n";
	++m_samples;
	const Vehicle& vehicle = m_demolisher.vehicle();
	m_track.push_back({m_demolisher.time(), vehicle.pose().getOrigin(), double(vehicle.speed())});
	for (const JointRecord& record : m_demolisher.joints().records())
	{
		const JointReading r = m_demolisher.joints().read(record);
		char line[320];
		std::snprintf(line, sizeof line, "%.4f,%s,%s,%s,%.5g,%s,%.5g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n",
					  m_demolisher.time(), nameOf(scenes(), record.scene).c_str(), record.joint->getName(),
					  nameOf(jointStates(), record.state(r)).c_str(), r.utilisation,
					  btElasticPlasticDofName(r.limitingDof), r.damage, r.force[BT_EP_AXIAL], r.force[BT_EP_SHEAR_Y],
					  r.force[BT_EP_SHEAR_Z], r.force[BT_EP_TORSION], r.force[BT_EP_BENDING_Y],
					  r.force[BT_EP_BENDING_Z], r.elasticEnergy, r.plasticEnergy);
		m_joints += line;
	}
}

std::string RunLog::summary() const
{
	Json json = toJson(m_demolisher.summary(), m_demolisher.settings());
	json["joints"] = Json::array();
	for (const JointRecord& record : m_demolisher.joints().records())
		json["joints"].push_back(toJson(record, m_demolisher.joints().read(record)));
	json["vehicle_track"] = Json::array();
	for (const Place& place : m_track)
		json["vehicle_track"].push_back({{"time_s", place.time},
										 {"position_m", {place.position.x(), place.position.y(), place.position.z()}},
										 {"speed_m_s", place.speed}});
	return json.dump(2) + "\n";
}
}  // namespace ep
