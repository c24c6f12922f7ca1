#include "Summary.h"

#include <nlohmann/json.hpp>

namespace ep
{
std::string toJson(const DemolisherSummary& s, const DemolisherSettings& settings)
{
	// Ordered: the reader finds what he looks for first.
	const nlohmann::ordered_json json = {
		{"joints_total", s.joints},
		{"joints_yielded", s.yielded},
		{"joints_broken", s.broken},
		{"plastic_energy_J", s.plasticEnergy},
		{"bridge_sag_m", s.sag},
		{"vehicle_position_m", {s.vehicle.x(), s.vehicle.y(), s.vehicle.z()}},
		{"vehicle_speed_m_s", s.speed},
		{"vehicle_mass_kg", settings.vehicle.mass},
		{"crossed", s.crossed},
		{"simulated_time_s", s.time},
		{"real_time_factor", s.realTimeFactor},
		{"substeps", settings.substeps},
		{"iterations", settings.iterations},
		{"steel_share", settings.bridge.steelShare},
	};
	return json.dump(2) + "\n";
}
}  // namespace ep
