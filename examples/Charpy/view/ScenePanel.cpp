// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/Scene.h"

namespace ep::charpy
{
namespace
{
/// Numbers that a person may want to turn while he watches; ranges are narrower than what is valid, in the option's unit.
const struct
{
	const char *option, *label, *format;
	double low, high;
} SLIDERS[] = {
	{"friction", "friction", "%.2f", 0, 0.5},
	{"yield", "yield stress [MPa]", "%.0f", 50, 1000},
	{"max-rotation", "breaks at [rad]", "%.2f", 0.05, 3},
	{"notch", "notch [mm]", "%.1f", 0, 6},
	{"width", "width [mm]", "%.1f", 2, 20},
	{"release", "release [rad]", "%.2f", 0.3, 2.5},
};

const Number& numberOf(const std::string& option)
{
	size_t i = 0;
	while (numbers()[i].name != option)
		++i;
	return numbers()[i];
}
}  // namespace

void Scene::panel(size_t, Panel& panel)
{
	for (const std::string& line : text())
		panel.text(line);
	panel.text("A change begins the test anew:");
	bool anew = choice(panel, "joint", m_settings.way, joints());
	anew = choice(panel, "geometry", m_settings.geometry, geometries()) || anew;
	anew = choice(panel, "solver", m_settings.solver, solvers()) || anew;
	for (const auto& s : SLIDERS)
	{
		const Number& number = numberOf(s.option);
		const double before = number.of(m_settings);
		double value = before;
		anew = panel.slider(s.label, value, s.low, s.high, s.format) || anew;
		if (value != before)
			number.set(m_settings, value);
	}
	if (panel.button("As given"))
	{
		m_settings = m_asGiven;
		anew = true;
	}
	if (anew)
		restart();
	if (!m_fault.empty())
		panel.text(m_fault);
}
}  // namespace ep::charpy
