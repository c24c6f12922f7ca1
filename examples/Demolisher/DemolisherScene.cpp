#include "DemolisherScene.h"

#include <cmath>
#include <cstdio>

#include "Parts.h"

namespace ep
{
namespace
{
template <class... Values>
std::string format(const char* pattern, Values... values)
{
	char text[128];
	std::snprintf(text, sizeof text, pattern, values...);
	return text;
}
}  // namespace

void DemolisherScene::step(const Controls& controls)
{
	if (m_autopilot)
		m_demolisher->stepByAutopilot();
	else
		m_demolisher->step(controls);
}

void DemolisherScene::restart() { m_demolisher.reset(new Demolisher(m_settings)); }

void DemolisherScene::key(char key)
{
	if (key == 'g')
		m_autopilot = !m_autopilot;
}

Drawing DemolisherScene::draw() const
{
	Drawing drawing;
	addParts(drawing.parts, m_demolisher->bridge());
	addParts(drawing.parts, m_demolisher->vehicle());
	drawing.subject = m_demolisher->vehicle().pose();

	const DemolisherSummary s = m_demolisher->summary();
	drawing.text = {
		format("Speed  %.0f km/h%s", std::fabs(s.speed) * 3.6, m_autopilot ? "  (autopilot)" : ""),
		format("Joints  %d yielded, %d broken of %d", s.yielded, s.broken, s.joints),
		format("Plastic energy  %.1f kJ", s.plasticEnergy / 1000),
		format("Sag of the bridge  %.2f m", s.sag),
		format("Time  %.1f s, real time factor %.0f", s.time, s.realTimeFactor),
	};
	drawing.legend = {{jointColour(0, 0), "unloaded"},
					  {jointColour(btScalar(.5), 0), "half of yield"},
					  {jointColour(1, 0), "yields"},
					  {jointColour(1, 1), "breaks"}};
	return drawing;
}

btVector3 DemolisherScene::centre() const { return btVector3(0, m_settings.bridge.height * btScalar(.8), 0); }

btScalar DemolisherScene::extent() const { return m_settings.bridge.span + 2 * m_settings.bridge.supportLength + 4; }
}  // namespace ep
