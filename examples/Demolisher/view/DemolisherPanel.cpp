// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <algorithm>
#include <cmath>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticFault.h"
#include "view/DemolisherScene.h"
#include "text/Format.h"

namespace ep
{
namespace
{
const size_t MOST_USED = 10;  // joints in the table

/// A slider for a setting of Bullet's precision, shown in another unit.
bool slider(Panel& panel, const char* label, btScalar& value, double unit, double low, double high, const char* pattern)
{
	double shown = double(value) / unit;
	const bool changed = panel.slider(label, shown, low, high, pattern);
	// Only what a person has moved: a round trip through the unit would change the rest.
	if (shown != double(value) / unit)
		value = btScalar(shown * unit);
	return changed;
}

double load(const JointReading& reading) { return reading.isThere && !reading.isBroken ? reading.utilisation : -1; }

bool isAngular(int dof) { return dof >= BT_EP_TORSION; }
}  // namespace

void DemolisherScene::panel(size_t number, Panel& panel)
{
	if (number == 1)
	{
		jointTable(panel);
		jointPlots(panel);
		brokenTable(panel);
		return;
	}
	dashboard(panel);
	bool anew = false;
	if (panel.section("How it is joined and solved", true))
		anew = methodSettings(panel);
	if (panel.section("What it is built of", true))
		anew = buildSettings(panel) || anew;
	if (panel.section("View", true))
		view(panel);
	if (anew)
		restart();
}

void DemolisherScene::dashboard(Panel& panel)
{
	const DemolisherSummary s = m_demolisher->summary();
	panel.text(format("%.0f km/h   %.1f s   %.0f times real time", std::fabs(s.speed) * 3.6, s.time, s.realTimeFactor));
	panel.text(format("Of %d joints %d yielded, %d broken", s.joints, s.yielded, s.broken));
	if (m_demolisher->bridge())
		panel.text(format("The bridge sags by %.3f m", s.sag));
	if (!s.isFinite())
		panel.text("Something has flown apart: these joints\ndo not bear this step.\nChoose others, or smaller steps.");
	panel.check("autopilot", m_autopilot);
	panel.shares(
		{{"kinetic", {.05f, .25f, .55f}, s.kineticEnergy / 1000, "of all bodies, the vehicle's too"},
		 {"elastic", {.05f, .45f, .10f}, s.elasticEnergy / 1000, "stored in joints: given back when they are unloaded"},
		 {"plastic", {.75f, .30f, .01f}, s.plasticEnergy / 1000, "spent on bending joints for good"},
		 {"numerical",
		  {.35f, .35f, .35f},
		  s.numericalEnergy / 1000,
		  "what joints took from bodies beyond that: an error of steps that are\nnot short. Below 0 they gave more. "
		  "After a blow it is some per cent of\nthe plastic energy; more substeps and a smaller error of blows make "
		  "it\nless, but for a wreck that is dragged along"}},
		"kJ");
}

bool DemolisherScene::methodSettings(Panel& panel)
{
	DemolisherSettings& s = m_settings;
	JointKind kind = s.method.kind();
	panel.text("A change begins anew:");
	bool anew = choice(panel, "joints", kind, jointKinds());
	s.method.joints = kind.joints;
	s.method.jointClass = kind.jointClass;
	anew = choice(panel, "solver", s.method.solver, solvers()) || anew;
	anew = slider(panel, "step [ms]", s.step, 1e-3, 1, 50, "%.2f") || anew;
	panel.text("Without beginning anew:");
	bool changed = panel.slider("substeps", s.substeps, 1, 50);
	changed = slider(panel, "error of blows [%]", s.innerError, .01, 0, 10, "%.1f") || changed;
	if (panel.slider("iterations", s.method.iterations, 1, 1000) || changed)
		m_demolisher->setEffort(s.substeps, s.method.iterations, s.innerError);
	return anew;
}

bool DemolisherScene::buildSettings(Panel& panel)
{
	DemolisherSettings& s = m_settings;
	panel.text("A change begins anew:");
	bool anew = slider(panel, "bridge steel [%]", s.bridge.steelShare, .01, .5, 10, "%.2f");
	anew = slider(panel, "fence steel [%]", s.fence.steelShare, .01, .1, 10, "%.2f") || anew;
	anew = slider(panel, "boom [mm]", s.gate.thickness, 1e-3, 30, 150, "%.0f") || anew;
	anew = slider(panel, "gate box [m]", s.gate.box, 1, .5, 3, "%.2f") || anew;
	anew = slider(panel, "rod radius [mm]", s.rod.radius, 1e-3, 20, 150, "%.0f") || anew;
	anew = slider(panel, "ductility [%]", s.materials.ductility, .01, .1, 100, "%.1f") || anew;
	anew = slider(panel, "yield stress [MPa]", s.materials.yieldStress, 1e6, 50, 1000, "%.0f") || anew;
	anew = slider(panel, "concrete [kg/m3]", s.materials.concreteDensity, 1, 500, 5000, "%.0f") || anew;
	anew = slider(panel, "vehicle [t]", s.vehicle.mass, 1000, 5, 200, "%.1f") || anew;
	anew = panel.check("gate with two supports", s.gate.twoSupports) || anew;
	if (!panel.button("Reset all"))
		return anew;
	s = m_asGiven;
	return true;
}

void DemolisherScene::jointTable(Panel& panel)
{
	const std::vector<JointRecord>& records = m_demolisher->joints().records();
	std::vector<JointReading> readings;
	std::vector<size_t> order;
	for (const JointRecord& record : records)
	{
		order.push_back(readings.size());
		readings.push_back(m_demolisher->joints().read(record));
	}
	// Those that bear most now; a broken one bears nothing.
	std::stable_sort(order.begin(), order.end(),
					 [&readings](size_t a, size_t b) { return load(readings[a]) > load(readings[b]); });
	while (!order.empty() && load(readings[order.back()]) < 0)
		order.pop_back();
	order.resize(std::min(order.size(), MOST_USED));
	std::vector<Panel::Row> rows;
	int selected = -1;
	for (size_t i : order)
	{
		const JointReading& r = readings[i];
		if (i == m_history.joint())
			selected = int(rows.size());
		rows.push_back({jointColour(r.utilisation, 0),
						{records[i].joint->getName(), format("%.0f %%", 100 * r.utilisation),
						 btElasticPlasticDofName(r.limitingDof), format("%.0f %%", 100 * r.damage)}});
	}
	const int clicked = panel.table("joints", {"joint", "load", "by", "worn"}, rows, selected);
	if (clicked >= 0)
		m_history.follow(order[size_t(clicked)], readings[order[size_t(clicked)]].limitingDof);
}

void DemolisherScene::jointPlots(Panel& panel)
{
	const JointRecord& record = m_demolisher->joints().records()[m_history.joint()];
	const JointReading reading = m_demolisher->joints().read(record);
	panel.text(nameOf(scenes(), record.scene) + ", " + record.joint->getName() + ": " +
			   nameOf(jointStates(), record.state(reading)));
	std::vector<std::string> names;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		names.push_back(btElasticPlasticDofName(i));
	size_t dof = size_t(m_history.dof());
	if (panel.choice("direction", dof, names))
		m_history.follow(m_history.joint(), int(dof));
	const bool angular = isAngular(m_history.dof());
	const double step = double(m_settings.step),
				 yield = double(record.joint->getCapacity().m_yield[m_history.dof()]) / 1000;
	panel.plot(angular ? "moment" : "force", {m_history.force(), step, angular ? "kN m" : "kN", yield});
	panel.plot("deformation", {m_history.deformation(), step, angular ? "mrad" : "mm"});
	panel.plot("energy", {m_history.energy(), step, "kJ"});
}

/// The last ones first.
void DemolisherScene::brokenTable(Panel& panel)
{
	std::vector<JointRecord> broken;
	for (const JointRecord& record : m_demolisher->joints().records())
		if (record.breakTime >= 0)
			broken.push_back(record);
	if (broken.empty() || !panel.section("Broken", true))
		return;
	std::stable_sort(broken.begin(), broken.end(),
					 [](const JointRecord& a, const JointRecord& b) { return a.breakTime > b.breakTime; });
	broken.resize(std::min(broken.size(), MOST_USED));
	std::vector<Panel::Row> rows;
	for (const JointRecord& record : broken)
		rows.push_back({TORN, {record.joint->getName(), format("%.2f s", record.breakTime)}});
	panel.table("broken", {"joint", "at"}, rows, -1);
}

void DemolisherScene::view(Panel& panel)
{
	panel.check("bent members smooth", m_style.skin);
	panel.check("joints marked", m_style.joints);
	for (size_t i = 0; i < scenes().size(); ++i)
	{
		if (i > 0)
			panel.beside();
		if (panel.button(scenes()[i].name))
			jump(int(i));
	}
}
}  // namespace ep
