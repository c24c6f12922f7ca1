// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "studies/Report.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "text/OutputFiles.h"

namespace ep::charpy
{
std::string toJson(const Result& r, const Settings& s)
{
	// As on the command line.
	nlohmann::ordered_json settings = {{"joint", nameOf(joints(), s.way)},
									   {"geometry", nameOf(geometries(), s.geometry)},
									   {"solver", nameOf(solvers(), s.solver)},
									   {"precision", sizeof(btScalar) == sizeof(double) ? "double" : "float"}};
	for (const Number& n : numbers())
		if (n.whole)
			settings[n.name] = s.*n.whole;
		else
			settings[n.name] = n.of(s);
	// Ordered: the reader finds what he looks for first.
	const nlohmann::ordered_json json = {
		{"outcome", nameOf(r.outcome)},
		{"broken", r.broken},
		{"loss_J", r.loss()},
		{"plastic_work_J", r.plasticWork},
		{"hinge_angle_rad", r.hingeAngle},
		{"greatest_hinge_angle_rad", r.greatestAngle},
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
		{"settings", settings},
	};
	return json.dump(2) + "\n";
}

std::string toLine(const Result& r)
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

Table energyTable()
{
	Table t;
	t.name = "energy";
	t.title = "Where the hammer's energy goes";
	t.yTitle = "energy [J]";
	t.columns = {"time_s",           "hammer_energy_J", "plastic_work_J",   "specimen_kinetic_energy_J",
				 "friction_work_J",  "contact_work_J",  "elastic_energy_J", "numerical_dissipation_J",
				 "hammer_angle_rad", "hinge_angle_rad"};
	for (size_t column = 1; column <= 7; ++column)
		t.series.push_back({column, true});
	return t;
}

void addEnergies(Table& table, const ImpactTest& charpy)
{
	const Result r = charpy.result();
	table.add({charpy.time(), r.hammerAfter, r.plasticWork, r.specimenEnergy, r.frictionWork, r.contactWork,
			   r.elasticEnergy, r.numericalDissipation, charpy.angle(), r.hingeAngle});
}

std::string writeTable(const Table& table, const std::string& directory)
{
	std::string names = writeFile(directory, table.name + ".csv", table.toCsv());
	const std::string picture = table.toSvg();
	if (!picture.empty())
		names += ", " + writeFile(directory, table.name + ".svg", picture);
	return names;
}

Result runAndReport(const Settings& settings, const std::string& directory)
{
	ImpactTest charpy(settings);
	makeDirectory(directory);
	Table energies = energyTable();
	addEnergies(energies, charpy);
	while (!charpy.isOver() && charpy.time() < ImpactTest::LONGEST)
	{
		charpy.step();
		addEnergies(energies, charpy);
	}
	const Result result = charpy.result();
	writeFile(directory, "energy.csv", energies.toCsv());
	// The picture shows the impact, not the swing.
	const double from = charpy.time() - 1.2 * result.duration;
	while (!energies.rows.empty() && energies.rows.front()[0] < from)
		energies.rows.erase(energies.rows.begin());
	writeFile(directory, "energy.svg", energies.toSvg());
	writeFile(directory, "summary.json", toJson(result, settings));
	return result;
}
}  // namespace ep::charpy
