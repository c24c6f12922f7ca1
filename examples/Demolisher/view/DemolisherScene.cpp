// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/DemolisherScene.h"

#include <cmath>

#include "text/Format.h"

namespace ep
{
namespace
{
void addRoad(Drawing& drawing, btScalar width)
{
	drawing.parts.push_back(
		boxPart(btTransform::getIdentity(), btVector3(1800, btScalar(.02), width), {.075f, .075f, .08f}));
}
}  // namespace

void DemolisherScene::step(const Controls& controls)
{
	if (m_autopilot)
		m_demolisher->stepByAutopilot();
	else
		m_demolisher->step(controls);
	m_history.step(*m_demolisher);
}

void DemolisherScene::restart()
{
	m_demolisher.reset(new Demolisher(m_settings));
	m_history.clear();
	if (m_history.joint() == 0 && m_demolisher->bridge())
		m_history.follow(m_demolisher->joints().numberOf(*m_demolisher->bridge()->joints().front()), BT_EP_BENDING_Z);
	if (!m_settings.has(m_looksAt))
		m_looksAt = m_settings.onTheWay().front();
}

void DemolisherScene::jump(int number)
{
	const Scene scene = scenes()[size_t(number)].value;
	if (!m_settings.has(scene))
		return;
	m_demolisher->jumpTo(scene);
	m_looksAt = scene;
	m_autopilot = false;
}

void DemolisherScene::key(char key)
{
	if (key == 'g')
		m_autopilot = !m_autopilot;
	if (key == 'b')
		m_style.skin = !m_style.skin;
	if (key == 'j')
		m_style.joints = !m_style.joints;
}

std::vector<std::string> DemolisherScene::keyHelp() const
{
	return {"G  autopilot on or off", "B  bent members smooth or block by block", "J  joints marked or not"};
}

Drawing DemolisherScene::draw() const
{
	Drawing drawing;
	const World& world = m_demolisher->world();
	for (Scene scene : m_settings.onTheWay())
		if (scene != Scene::Bridge)
			addParts(drawing, world, *m_demolisher->structure(scene), m_style);
	if (m_demolisher->bridge())
		addParts(drawing, world, *m_demolisher->bridge(), m_style);
	else
		addRoad(drawing, m_settings.bridge.width + 1);
	addParts(drawing.parts, m_demolisher->vehicle());
	drawing.subject = m_demolisher->vehicle().pose();

	const DemolisherSummary s = m_demolisher->summary();
	drawing.text = {
		format("Speed  %.0f km/h%s", std::fabs(s.speed) * 3.6, m_autopilot ? "  (autopilot)" : ""),
		format("Joints  %d yielded, %d broken of %d", s.yielded, s.broken, s.joints),
		format("Plastic energy  %.1f kJ", s.plasticEnergy / 1000),
	};
	if (m_demolisher->bridge())
		drawing.text.push_back(format("Sag of the bridge  %.2f m", s.sag));
	drawing.text.push_back(format("Time  %.1f s, real time factor %.0f", s.time, s.realTimeFactor));
	drawing.legend = {{jointColour(0, 0), "unloaded"},
					  {jointColour(.5, 0), "half of yield"},
					  {jointColour(1, 0), "yields"},
					  {jointColour(1, 1), "worn"},
					  {TORN, "broken"}};
	return drawing;
}

btVector3 DemolisherScene::centre() const
{
	const btScalar x = m_settings.placeOf(m_looksAt);
	return btVector3(x, m_looksAt == Scene::Bridge ? m_settings.bridge.height * btScalar(.8) : btScalar(1.5), 0);
}

btScalar DemolisherScene::extent() const
{
	return m_looksAt == Scene::Bridge ? m_settings.bridge.span + 2 * m_settings.bridge.supportLength + 4 : btScalar(14);
}
}  // namespace ep
