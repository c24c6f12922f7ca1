#include "CharpyScene.h"

namespace ep
{
void CharpyScene::step(const Controls&)
{
	// Near the specimen a picture shows 0.1 ms: the impact of 16 ms takes 3 s.
	const bool near = std::fabs(m_charpy->angle()) < 2 * m_settings.impactAngle;
	const double until = m_charpy->time() + (near ? 0.1e-3 : double(stepTime()));
	while (m_charpy->time() < until - 1e-9 && !m_charpy->isOver())
		m_charpy->step(btMin(m_charpy->stepAt(m_charpy->angle()), until - m_charpy->time()));
}

void CharpyScene::key(char key)
{
	if (key == 'x')
		m_cut = !m_cut;
	const std::vector<CharpyName<CharpyWay>>& ways = charpyWays();
	if (key >= '0' && key <= '9')
		m_settings.way = ways[size_t(key - '0') % ways.size()].value;
	else if (key == '+' || key == '-')
		m_settings.step = btMax(1e-6, btMin(m_settings.swingStep, m_settings.step * (key == '+' ? 2 : 0.5)));
	else if (key == 'g')
		m_settings.geometry =
			m_settings.geometry == CharpyGeometry::Paper ? CharpyGeometry::Repeatable : CharpyGeometry::Paper;
	else
		return;
	restart();
}

std::vector<std::string> CharpyScene::keyHelp() const
{
	std::vector<std::string> lines = {"X  hammer and anvils cut or whole", "G  geometry: paper's or repeatable",
									  "+ -  step in the impact, and again"};
	for (size_t i = 0; i < charpyWays().size(); ++i)
		lines.push_back(std::to_string(i) + "  " + charpyWays()[i].name);
	return lines;
}
}  // namespace ep
