// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/Scene.h"

#include "text/Format.h"

namespace ep::charpy
{
namespace
{
/// Where the energy goes that the hammer loses.
const struct
{
	Colour colour;
	const char* name;
	double (*energy)(const Result&);
} SHARES[] = {
	{{.75f, .42f, .01f}, "plastic work", [](const Result& r) { return r.plasticWork; }},
	{{.10f, .45f, .12f}, "elastic", [](const Result& r) { return r.elasticEnergy; }},
	{{.45f, .05f, .03f}, "friction", [](const Result& r) { return r.frictionWork; }},
	{{.05f, .25f, .45f}, "pieces' motion", [](const Result& r) { return r.specimenEnergy; }},
	{{.25f, .25f, .25f}, "contacts, numerical", [](const Result& r) { return r.contactWork + r.numericalDissipation; }},
};

const double LEAST_SLOWNESS = 1, MOST_SLOWNESS = 4000;
}  // namespace

void Scene::restart()
{
	// What a person asks for while it runs may not go: then it stays as it was.
	m_fault = m_charpy ? m_settings.fault() : std::string();
	if (!m_fault.empty())
		m_settings = m_charpy->settings();
	m_charpy.reset(new ImpactTest(m_settings));
	m_history.clear();
}

bool Scene::isNear() const { return std::fabs(m_charpy->angle()) < 2 * m_settings.impactAngle; }

void Scene::step(const Controls&)
{
	const double until = m_charpy->time() + double(stepTime()) / (isNear() ? m_slowness : 1);
	while (m_charpy->time() < until - 1e-9 && !m_charpy->isOver())
		m_charpy->step(btMin(m_charpy->stepAt(m_charpy->angle()), until - m_charpy->time()));
	if (m_charpy->hasStruck() && !m_charpy->isOver())
		m_history.push_back(m_charpy->result());
}

Drawing Scene::draw() const
{
	Drawing drawing;
	drawing.parts = partsOf(*m_charpy, m_cut);
	drawing.views = viewsOf(*m_charpy, m_cut);
	// The first one has the panel on its left: the specimen stands right of it.
	Camera& beside = drawing.views[0].camera;
	const btVector3 aside = (beside.target - beside.eye).cross(btVector3(0, 1, 0)).normalized() * btScalar(-2.5);
	beside.eye += aside;
	beside.target += aside;
	// Looking against the blow.
	drawing.subject = btTransform(btQuaternion(btVector3(0, 1, 0), SIMD_PI), btVector3(-5, btScalar(DRAWN_LEVEL), 0));
	drawing.text = text();

	drawing.chart.title = "Energy lost by the hammer [J]";
	drawing.chart.xUnit = "ms";
	for (const Result& r : m_history)
		drawing.chart.x.push_back(float(r.duration * 1e3));
	for (const auto& share : SHARES)
	{
		Chart::Series band = {share.colour, {}};
		for (const Result& r : m_history)
			band.values.push_back(float(share.energy(r)));
		drawing.chart.bands.push_back(band);
		drawing.legend.push_back({share.colour, share.name});
	}
	return drawing;
}

/// Of the machine, with the hammer as it swings through.
Bounds Scene::bounds() const
{
	Bounds bounds;
	bounds.add(btVector3(-25, 0, -12));
	bounds.add(btVector3(25, btScalar(DRAWN_LEVEL) + 12, 12));
	return bounds;
}

std::vector<std::string> Scene::text() const
{
	const Settings& s = m_settings;
	const Result r = m_charpy->result();
	return {
		format("%s, %s", nameOf(joints(), s.way).c_str(), nameOf(geometries(), s.geometry).c_str()),
		format("Step in the impact  %g ms", s.step * 1e3),
		format("Hammer  %.1f J at %.3f rad, lost %.1f J", r.hammerAfter, m_charpy->angle(),
			   m_charpy->hasStruck() ? r.loss() : 0.),
		format("Hinge  %.2f rad%s", r.hingeAngle, r.broken ? ", broken" : ""),
		format("Plastic work  %.1f J of %.1f J to pass", r.plasticWork, s.passingEnergy()),
		format("Friction  %.1f J, pieces %.1f J, contacts %.1f J", r.frictionWork, r.specimenEnergy, r.contactWork),
		format("Time  %.2f ms, %s", m_charpy->time() * 1e3,
			   m_charpy->isOver() || !m_charpy->hasStruck() ? nameOf(r.outcome) : "impact") +
			(isNear() ? format(", %.0fx slower", m_slowness) : ""),
	};
}

void Scene::key(char key)
{
	const std::vector<Named<JointKind>>& kinds = joints();
	switch (key)
	{
		case 'x':
			m_cut = !m_cut;
			return;
		case ',':
			m_slowness = btMin(MOST_SLOWNESS, m_slowness * 2);
			return;
		case '.':
			m_slowness = btMax(LEAST_SLOWNESS, m_slowness / 2);
			return;
		case 'g':
			m_settings.geometry = m_settings.geometry == Geometry::Paper ? Geometry::Repeatable : Geometry::Paper;
			break;
		case '+':
			m_settings.step = btMin(m_settings.swingStep, m_settings.step * 2);
			break;
		case '-':
			m_settings.step = btMax(1e-6, m_settings.step / 2);
			break;
		default:
			if (key < '0' || key > '9')
				return;
			m_settings.way = kinds[size_t(key - '0') % kinds.size()].value;
	}
	restart();
}

std::vector<std::string> Scene::keyHelp() const
{
	std::vector<std::string> lines = {",  .  impact in slower or faster slow motion",
									  "X  hammer and anvils cut or whole",
									  "Again from the start with:", "+  -  a longer, shorter step in the impact",
									  "G  geometry: paper's or repeatable"};
	for (size_t i = 0; i < joints().size(); ++i)
		lines.push_back(std::to_string(i) + "  " + joints()[i].name);
	return lines;
}
}  // namespace ep::charpy
