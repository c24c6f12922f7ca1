// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "sceneview/LiveScene.h"

#include <algorithm>
#include <sstream>

#include "scenedrawing/SceneDrawing.h"
#include "scenefile/SceneFile.h"
#include "simulation/Probes.h"
#include "text/Format.h"
#include "world/Charge.h"
#include "world/JointReading.h"

namespace ep
{
namespace
{
const int LOOK_EVERY = 20;        // steps: whether the file has changed
const size_t MOST_JOINTS = 12;    // in the table
const size_t FEW_JOINTS = 4;      // the same above a section, which is to be seen as a whole
const size_t LONGEST_NAME = 13;   // of a joint there
const size_t MOST_VALUES = 2000;  // of a plot

/// Half of the values go when there are too many.
template <class Value>
void append(std::vector<Value>& values, const Value& value)
{
	if (values.size() >= MOST_VALUES)
		values.erase(values.begin(), values.begin() + MOST_VALUES / 2);
	values.push_back(value);
}

std::filesystem::file_time_type changeOf(const std::string& file)
{
	std::error_code error;
	const auto time = std::filesystem::last_write_time(file, error);
	return error ? std::filesystem::file_time_type::min() : time;
}
}  // namespace

LiveScene::LiveScene(const std::string& file) : m_file(file)
{
	const SceneText text = SceneText::read(m_file);
	watch(text.files);
	build(describeScene(text));
}

std::string LiveScene::title() const
{
	const std::string& own = m_simulation->scene().title;
	return own.empty() ? m_file : own;
}

void LiveScene::build(const SceneDescription& scene)
{
	auto simulation = std::make_unique<Simulation>(scene);  // what is there goes on if this one cannot be built
	m_hand.reset();
	m_simulation = std::move(simulation);
	m_hand = std::make_unique<Hand>(m_simulation->world());
	m_probes.assign(scene.probes.size(), {});
	m_history.clear();
	m_way.clear();
	m_selected = -1;
	m_numLookedAt = m_numBurst = 0;
	m_effects.clear();
	m_balls = 0;
	measure();
	record();
}

void LiveScene::watch(const std::vector<std::string>& files)
{
	m_watched.clear();
	for (const std::string& file : files)
		m_watched.push_back({file, changeOf(file)});
}

bool LiveScene::hasChanged() const
{
	return std::any_of(m_watched.begin(), m_watched.end(),
					   [](const Watched& watched) { return changeOf(watched.file) != watched.changed; });
}

void LiveScene::reload()
{
	for (Watched& watched : m_watched)
		watched.changed = changeOf(watched.file);
	m_complaint.clear();
	try
	{
		const SceneText text = SceneText::read(m_file);
		const SceneDescription scene = describeScene(text);
		build(scene);
		watch(text.files);
	}
	catch (const SceneError& error)
	{
		m_complaint = error.what();
	}
}

void LiveScene::step(const Controls&)
{
	if (--m_untilLook < 0)
	{
		m_untilLook = LOOK_EVERY;
		if (hasChanged())
			reload();
	}
	// It stands when it is over: but for its time, a person may want to look on.
	const Ending ending = m_simulation->ending();
	if (ending == Ending::NotFinite || ending == Ending::FirstBreak)
		return;
	m_effects.beforeStep(m_simulation->world());
	m_simulation->step();
	addBreaks();
	m_effects.afterStep(m_simulation->world(), stepTime());
	record();
}

void LiveScene::addBreaks()
{
	const double leastSteel = 5000;  // [kg/m^3]
	const std::vector<SceneEvent>& events = m_simulation->events();
	for (; m_numBurst < events.size(); ++m_numBurst)
	{
		const SceneEvent& event = events[m_numBurst];
		if (event.type != SceneEvent::Type::Break)
			continue;
		const int* const bodies = m_simulation->scene().joints[size_t(event.index)].bodies;
		const SceneDescription::Body& body = m_simulation->scene().bodies[size_t(std::max(bodies[0], bodies[1]))];
		m_effects.add({Burst::Kind::Break, event.place, event.energy, body.density > leastSteel});
	}
}

void LiveScene::record()
{
	for (size_t i = 0; i < m_probes.size(); ++i)
		append(m_probes[i], float(readProbe(*m_simulation, m_simulation->scene().probes[i])));
	if (m_selected >= 0 && m_simulation->joint(m_selected))
	{
		append(m_history, float(readJoint(m_simulation->world(), *m_simulation->joint(m_selected)).utilisation));
		append(m_way, SectionForces::of(*m_simulation->joint(m_selected)));
	}
	else
		selectFirstToYield();
}

/// Until a person has chosen a joint, the first with fibres that yields is looked at.
void LiveScene::selectFirstToYield()
{
	for (; m_numLookedAt < m_simulation->events().size() && m_selected < 0; ++m_numLookedAt)
	{
		const SceneEvent& event = m_simulation->events()[m_numLookedAt];
		if (event.type == SceneEvent::Type::Yield && m_simulation->joint(event.index) &&
			m_simulation->joint(event.index)->getCapacity().hasFibres())
			select(event.index);
	}
}

/// All but the ground, which is much larger than what moves.
void LiveScene::measure()
{
	m_bounds = Bounds();
	std::vector<Bounds> standing;
	const auto& bodies = m_simulation->scene().bodies;
	for (size_t i = 0; i < bodies.size(); ++i)
	{
		const btRigidBody* const body = m_simulation->body(int(i));
		if (!body)
			continue;
		Bounds own;
		body->getAabb(own.low, own.high);
		if (bodies[i].motion == SceneDescription::Motion::Static)
			standing.push_back(own);
		else
			m_bounds.add(own);
	}
	const btScalar largest = 2 * m_bounds.size().length();
	for (const Bounds& own : standing)
		if (own.size().length() < largest)
			m_bounds.add(own);
	if (m_bounds.isEmpty())
		for (btScalar side : {btScalar(-1), btScalar(1)})
			m_bounds.add(btVector3(side, side, side));
}

/// As the scene's camera looks.
btVector3 LiveScene::sight() const
{
	const Camera camera = cameraOf(*m_simulation);
	return camera.target - camera.eye;
}

Drawing LiveScene::draw() const
{
	Drawing drawing = drawSimulation(*m_simulation);
	drawing.puffs = m_effects.puffs();
	const Ending ending = m_simulation->ending();
	if (ending != Ending::None)
		drawing.text.push_back("ended by " + nameOf(endings(), ending));
	std::istringstream lines(m_complaint);
	for (std::string line; std::getline(lines, line);)
		drawing.text.push_back(line);
	return drawing;
}

void LiveScene::panel(size_t number, Panel& panel)
{
	if (number == 0)
		happenings(panel);
	else
		joints(panel);
}

void LiveScene::happenings(Panel& panel)
{
	const SceneEnergies& e = m_simulation->energies();
	panel.text(format("%.2f s, %d of %zu joints broken", m_simulation->time(), m_simulation->numBroken(),
					  m_simulation->scene().joints.size()));
	panel.shares({{"kinetic", {.05f, .25f, .55f}, e.kinetic / 1000},
				  {"elastic", {.05f, .45f, .10f}, e.elastic / 1000},
				  {"plastic", {.75f, .30f, .01f}, e.plastic / 1000}},
				 "kJ");
	if (panel.section("Probes", true))
		for (size_t i = 0; i < m_probes.size(); ++i)
			panel.plot(m_simulation->scene().probes[i].name.c_str(), {m_probes[i], double(stepTime()), ""});
}

void LiveScene::joints(Panel& panel)
{
	struct Used
	{
		int index;
		JointReading reading;
	};
	std::vector<Used> used;
	for (size_t i = 0; i < m_simulation->scene().joints.size(); ++i)
		if (m_simulation->joint(int(i)) && !m_simulation->isCut(int(i)) && !m_simulation->isBroken(int(i)))
			used.push_back({int(i), readJoint(m_simulation->world(), *m_simulation->joint(int(i)))});
	const btElasticPlasticJoint* const chosen = m_selected >= 0 ? m_simulation->joint(m_selected) : nullptr;
	const bool hasSection = chosen && chosen->getCapacity().hasFibres();
	const size_t shown = std::min(used.size(), hasSection ? FEW_JOINTS : MOST_JOINTS);
	std::partial_sort(used.begin(), used.begin() + long(shown), used.end(),
					  [](const Used& a, const Used& b) { return a.reading.utilisation > b.reading.utilisation; });
	used.resize(shown);
	std::vector<Panel::Row> rows;
	int selected = -1;
	for (const Used& u : used)
	{
		if (u.index == m_selected)
			selected = int(rows.size());
		rows.push_back({jointColour(u.reading.utilisation, u.reading.damage),
						{shortName(u.index), format("%.0f %%", 100 * u.reading.utilisation),
						 btElasticPlasticDofName(u.reading.limitingDof), format("%.0f %%", 100 * u.reading.damage)}});
	}
	const int clicked = panel.table("joints", {"joint", "used", "by", "worn"}, rows, selected);
	if (clicked >= 0)
		select(used[size_t(clicked)].index);
	if (m_selected >= 0)
		panel.plot(("used: " + m_simulation->scene().joints[size_t(m_selected)].name).c_str(),
				   {m_history, double(stepTime()), "", 1});
	if (hasSection)
		section(panel);
	if (m_simulation->numBroken() > 0 && panel.section("Broken", true))
		broken(panel);
}

void LiveScene::section(Panel& panel)
{
	const btElasticPlasticJoint& joint = *m_simulation->joint(m_selected);
	panel.text(describeRulingFibre(joint));
	panel.figure(drawSection(joint));
	panel.figure(drawForces(joint, m_way));
}

/// The last ones, the newest first.
void LiveScene::broken(Panel& panel)
{
	std::vector<Panel::Row> rows;
	const std::vector<SceneEvent>& events = m_simulation->events();
	for (size_t i = events.size(); i-- > 0 && rows.size() < MOST_JOINTS;)
		if (events[i].type == SceneEvent::Type::Break)
			rows.push_back({jointColour(1, 1),
							{shortName(events[i].index), btElasticPlasticDofName(events[i].dof),
							 format("%.2f s", events[i].time)}});
	panel.table("broken", {"joint", "by", "at"}, rows, -1);
}

/// What tells a joint from its neighbours stands at the end of its name.
std::string LiveScene::shortName(int joint) const
{
	const std::string& name = m_simulation->scene().joints[size_t(joint)].name;
	return name.size() > LONGEST_NAME ? ".." + name.substr(name.size() - LONGEST_NAME) : name;
}

void LiveScene::select(int joint)
{
	if (joint == m_selected)
		return;
	m_selected = joint;
	m_history.clear();
	m_way.clear();
}

/// The joint of the body that is nearest to where it is held is looked at.
bool LiveScene::grab(const Ray& ray)
{
	const btRigidBody* const body = m_hand->grab(ray.from, ray.direction);
	if (!body)
		return false;
	btScalar least = BT_LARGE_FLOAT;
	int nearest = m_selected;
	for (size_t i = 0; i < m_simulation->scene().joints.size(); ++i)
	{
		const auto& bodies = m_simulation->scene().joints[i].bodies;
		const btElasticPlasticJoint* const joint = m_simulation->joint(int(i));
		if (!joint || (m_simulation->body(bodies[0]) != body && m_simulation->body(bodies[1]) != body))
			continue;
		const btScalar distance = joint->getPosition().distance(m_hand->place());
		if (distance < least)
		{
			least = distance;
			nearest = int(i);
		}
	}
	select(nearest);
	return true;
}

void LiveScene::throwBall(const Ray& ray)
{
	SceneDescription::Body ball;
	ball.name = "ball " + std::to_string(++m_balls);
	ball.shape.kind = SceneDescription::ShapeKind::Sphere;
	ball.shape.size.setValue(m_bounds.size().length() / 40, 0, 0);
	ball.pose.setOrigin(ray.from);
	ball.velocity = ray.direction.normalized() * 25;
	ball.colour.setValue(btScalar(.05), btScalar(.05), btScalar(.06));
	m_simulation->add(ball);
}

void LiveScene::blowCharge(const Ray& ray)
{
	const RayHit hit = castRay(m_simulation->world(), ray.from, ray.direction);
	if (!hit.hasHit)
		return;
	// By the size of what there is: 1 kg of TNT where that is 2 m, 1 t where it is 20 m.
	const double size = double(m_bounds.size().length()) / 2, mass = size * size * size, heat = 4.2e6;  // [kg], [J/kg]
	ep::blowCharge(m_simulation->world(), hit.place, mass);
	m_effects.add({Burst::Kind::Charge, hit.place, mass * heat, false});
}

bool LiveScene::isBreaking() const
{
	const std::vector<SceneEvent>& events = m_simulation->events();
	for (size_t i = events.size(); i-- > 0 && events[i].time > m_simulation->time() - .3;)
		if (events[i].type == SceneEvent::Type::Break)
			return true;
	return false;
}

void LiveScene::key(char key)
{
	if (key != 'b')
		return;
	// From where the scene's camera stands, to what it looks at.
	const Camera camera = cameraOf(*m_simulation);
	const btVector3 way = camera.target - camera.eye;
	throwBall({camera.eye + way * btScalar(.3), way});
}

std::vector<std::string> LiveScene::keyHelp() const { return {"B  throws a ball"}; }
}  // namespace ep
