#include "CharpyScene.h"

namespace ep
{
namespace
{
// Energies over time on a board behind the test: a column a picture, what the hammer has lost in the colours of where it went.
const Colour PLASTIC = {.75f, .42f, .01f}, FRICTION = {.45f, .05f, .03f}, REST = {.05f, .25f, .45f};
const size_t COLUMNS = 90;
const double COLUMN_WIDTH = 0.085, HEIGHT_PER_JOULE = 0.05;

void addColumn(Drawing& drawing, size_t column, const CharpyResult& r)
{
	double low = CHARPY_DRAWN_LEVEL - 2;
	const auto add = [&](double energy, const Colour& colour)
	{
		const double height = energy * HEIGHT_PER_JOULE;
		if (height < 0.01)
			return;
		const btVector3 place(-18, btScalar(low + height / 2), btScalar(-6 - COLUMN_WIDTH * double(column)));
		const btVector3 size(btScalar(0.1), btScalar(height), btScalar(COLUMN_WIDTH));
		drawing.parts.push_back(boxPart(btTransform(btQuaternion(0, 0, 0, 1), place), size, colour));
		low += height;
	};
	add(r.plasticWork, PLASTIC);
	add(r.frictionWork, FRICTION);
	add(r.loss() - r.plasticWork - r.frictionWork, REST);
}
}  // namespace

void CharpyScene::restart()
{
	m_charpy.reset(new Charpy(m_settings));
	m_history.clear();
}

Drawing CharpyScene::draw() const
{
	Drawing drawing = drawCharpy(*m_charpy, m_cut);
	for (size_t i = 0; i < m_history.size(); ++i)
		addColumn(drawing, i, m_history[i]);
	drawing.legend = {
		{PLASTIC, "plastic work"}, {FRICTION, "friction"}, {REST, "kinetic, contacts, elastic, numerical"}};
	return drawing;
}

void CharpyScene::step(const Controls&)
{
	// Near the specimen a picture shows 0.1 ms: the impact of 16 ms takes 3 s.
	const bool near = std::fabs(m_charpy->angle()) < 2 * m_settings.impactAngle;
	const double until = m_charpy->time() + (near ? 0.1e-3 : double(stepTime()));
	while (m_charpy->time() < until - 1e-9 && !m_charpy->isOver())
		m_charpy->step(btMin(m_charpy->stepAt(m_charpy->angle()), until - m_charpy->time()));
	if (m_charpy->hasStruck() && m_history.size() < COLUMNS && !m_charpy->isOver())
		m_history.push_back(m_charpy->result());
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
