// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "sceneview/SectionFigure.h"

#include <algorithm>
#include <cmath>

#include "simulation/SectionStrength.h"
#include "text/Format.h"

namespace ep
{
namespace
{
const Colour WHITE = {.8f, .8f, .8f}, GREY = {.15f, .15f, .15f}, MARK = {.9f, .5f, .02f};

float mixed(float from, float to, float share) { return from + share * (to - from); }

Colour fibreColour(const btElasticPlasticFibreReading& fibre)
{
	const Colour full = fibre.m_force > 0 ? Colour{.8f, .02f, .02f} : Colour{.02f, .12f, .8f};
	const float used = std::min(float(fibre.m_utilisation), 1.f), left = 1 - float(fibre.m_damage);
	return {left * mixed(.6f, full.r, used), left * mixed(.6f, full.g, used), left * mixed(.6f, full.b, used)};
}

std::vector<std::pair<float, float>> outline(const btElasticPlasticJoint& joint, bool isAboutZ, bool isNow)
{
	std::vector<std::pair<float, float>> points;
	for (const auto& point : sectionStrength(joint, isAboutZ, isNow))
		points.emplace_back(float(point.first), float(point.second));
	return points;
}
}  // namespace

SectionForces SectionForces::of(const btElasticPlasticJoint& joint)
{
	return {float(joint.getForce(BT_EP_AXIAL)),
			{float(joint.getForce(BT_EP_BENDING_Y)), float(joint.getForce(BT_EP_BENDING_Z))}};
}

Figure drawSection(const btElasticPlasticJoint& joint)
{
	const btElasticPlasticCapacity& capacity = joint.getCapacity();
	Figure figure;
	figure.title = "red pulled, blue pressed, dark worn";
	figure.isTrue = true;
	// Of those of the section itself: bars are as small as can be seen.
	double stiffness = 0, low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
	for (int i = 0; i < capacity.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = capacity.m_fibres[i];
		stiffness += fibre.m_part == 0 ? double(fibre.m_stiffness) : 0;
		const double place[2] = {double(fibre.m_y), double(fibre.m_z)};
		for (int k = 0; k < 2; ++k)
		{
			low[k] = std::min(low[k], place[k]);
			high[k] = std::max(high[k], place[k]);
		}
	}
	const double area = (high[0] - low[0]) * (high[1] - low[1]), spread = .7;  // of it, as walls leave room
	// The first of a fibre's layers is the largest: it comes last.
	for (const bool isBar : {false, true})
		for (int i = capacity.m_fibres.size(); i-- > 0;)
		{
			const btElasticPlasticFibre& fibre = capacity.m_fibres[i];
			if ((fibre.m_part > 0) != isBar)
				continue;
			const double side = isBar ? 0 : spread * std::sqrt(area * double(fibre.m_stiffness) / stiffness);
			figure.squares.push_back({float(fibre.m_z), float(fibre.m_y), float(side), fibreColour(joint.getFibre(i))});
		}
	return figure;
}

Figure drawForces(const btElasticPlasticJoint& joint, const std::vector<SectionForces>& way)
{
	float most[2] = {};
	for (const SectionForces& forces : way)
		for (int k = 0; k < 2; ++k)
			most[k] = std::max(most[k], std::fabs(forces.moment[k]));
	const bool isAboutZ = most[1] >= most[0];
	Figure figure;
	figure.title = "forces in what it bore and bears";
	figure.xName = "N";
	figure.yName = isAboutZ ? "M z" : "M y";
	figure.lines.push_back({outline(joint, isAboutZ, false), GREY});
	figure.lines.push_back({outline(joint, isAboutZ, true), WHITE});
	figure.lines.push_back({{}, MARK});
	for (const SectionForces& forces : way)
		figure.lines.back().points.emplace_back(forces.axial, forces.moment[isAboutZ]);
	if (!way.empty())
		figure.squares.push_back({way.back().axial, way.back().moment[isAboutZ], 0, MARK});
	return figure;
}

std::string describeRulingFibre(const btElasticPlasticJoint& joint)
{
	const int ruling = joint.getRulingFibre();
	if (ruling < 0)
		return "no fibre is loaded";
	const btElasticPlasticFibre& fibre = joint.getCapacity().m_fibres[ruling];
	const btElasticPlasticFibreReading reading = joint.getFibre(ruling);
	const std::string what = fibre.m_part == 0 ? "the section's fibre" : format("part %d", fibre.m_part);
	return format("%s at y %.3g, z %.3g m rules:\n%.0f %% used, %.0f %% worn, %.3g mm %s", what.c_str(),
				  double(fibre.m_y), double(fibre.m_z), 100 * double(reading.m_utilisation),
				  100 * double(reading.m_damage), 1000 * std::fabs(double(reading.m_elongation)),
				  reading.m_elongation < 0 ? "shorter" : "longer");
}
}  // namespace ep
