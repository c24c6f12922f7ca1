#include "CharpyReport.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ep
{
std::string toJson(const CharpyResult& r, const CharpySettings& s)
{
	// Ordered: the reader finds what he looks for first.
	const nlohmann::ordered_json json = {
		{"outcome", nameOf(r.outcome)},
		{"broken", r.broken},
		{"loss_J", r.loss()},
		{"plastic_work_J", r.plasticWork},
		{"hinge_angle_rad", r.hingeAngle},
		{"specimen_kinetic_energy_J", r.specimenEnergy},
		{"friction_work_J", r.frictionWork},
		{"contact_work_J", r.contactWork},
		{"elastic_energy_J", r.elasticEnergy},
		{"numerical_dissipation_J", r.numericalDissipation},
		{"audit_error", r.auditError()},
		{"hammer_energy_before_J", r.hammerBefore},
		{"hammer_energy_after_J", r.hammerAfter},
		{"blow_speed_m_s", r.blowSpeed},
		{"plastic_moment_Nm", r.plasticMoment},
		{"passing_angle_rad", r.passingAngle},
		{"passing_energy_J", r.plasticMoment * r.passingAngle},
		{"deepest_penetration_m", r.deepest},
		{"impact_time_s", r.duration},
		{"substeps", r.substeps},
		{"settings",
		 {{"joint", charpyNameOf(charpyWays(), s.way)},
		  {"geometry", charpyNameOf(charpyGeometries(), s.geometry)},
		  {"solver", charpyNameOf(charpySolvers(), s.solver)},
		  {"precision", sizeof(btScalar) == sizeof(double) ? "double" : "float"},
		  {"iterations", s.iterations},
		  {"step_s", s.step},
		  {"hinge_step_rad", s.hingeStep},
		  {"friction", s.friction},
		  {"restitution", s.restitution},
		  {"pieces", s.pieces},
		  {"yield_stress_Pa", s.yieldStress},
		  {"notch_m", s.notch},
		  {"width_m", s.width},
		  {"max_rotation_rad", s.maxRotation},
		  {"release_rad", s.release},
		  {"shift_m", s.shift}}},
	};
	return json.dump(2) + "\n";
}

std::string toLine(const CharpyResult& r)
{
	char text[320];
	std::snprintf(text, sizeof text,
				  "%s%s: loss %.2f J = plastic %.2f + kinetic %.2f + friction %.2f + contacts %.2f + elastic %.2f + "
				  "numerical %.2f J (audit %+.3f %%); hinge %.3f rad, by geometry %.3f rad and %.1f J",
				  nameOf(r.outcome), r.broken ? ", broken" : "", r.loss(), r.plasticWork, r.specimenEnergy,
				  r.frictionWork, r.contactWork, r.elasticEnergy, r.numericalDissipation, 100 * r.auditError(),
				  r.hingeAngle, r.passingAngle, r.plasticMoment * r.passingAngle);
	return text;
}

std::string charpyCsvHead()
{
	return "time_s,hammer_angle_rad,hammer_energy_J,hinge_angle_rad,plastic_work_J,specimen_kinetic_energy_J,"
		   "friction_work_J,contact_work_J,elastic_energy_J,numerical_dissipation_J\n";
}

std::string charpyCsvLine(const Charpy& charpy)
{
	const CharpyResult r = charpy.result();
	char text[320];
	std::snprintf(text, sizeof text, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", charpy.time(),
				  charpy.angle(), r.hammerAfter, r.hingeAngle, r.plasticWork, r.specimenEnergy, r.frictionWork,
				  r.contactWork, r.elasticEnergy, r.numericalDissipation);
	return text;
}

void makeDirectory(const std::string& directory)
{
	std::error_code error;
	std::filesystem::create_directories(directory, error);
	if (error)
		throw std::runtime_error("cannot make the directory '" + directory + "' (--out): " + error.message());
}

std::string writeFile(const std::string& directory, const std::string& name, const std::string& text)
{
	const std::string file = (std::filesystem::path(directory) / name).string();
	std::ofstream stream(file);
	if (!(stream << text << std::flush))
		throw std::runtime_error("cannot write the file '" + file + "'");
	return file;
}

CharpyResult runAndReport(const CharpySettings& settings, const std::string& directory)
{
	Charpy charpy(settings);
	makeDirectory(directory);
	std::string curve = charpyCsvHead() + charpyCsvLine(charpy);
	while (!charpy.isOver() && charpy.time() < Charpy::LONGEST)
	{
		charpy.step();
		curve += charpyCsvLine(charpy);
	}
	const CharpyResult result = charpy.result();
	writeFile(directory, "energy.csv", curve);
	writeFile(directory, "summary.json", toJson(result, settings));
	return result;
}
}  // namespace ep
