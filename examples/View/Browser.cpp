// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Browser.h"

#include <exception>

namespace ep
{
void Browser::step(const Controls& controls)
{
	if (m_scene)
		m_scene->step(controls);
}

void Browser::restart()
{
	if (m_scene)
		m_scene->restart();
}

Drawing Browser::draw() const { return m_scene ? m_scene->draw() : Drawing(); }

Bounds Browser::bounds() const
{
	if (m_scene)
		return m_scene->bounds();
	Bounds bounds;
	bounds.add(btVector3(-20, 0, -20));
	bounds.add(btVector3(20, 10, 20));
	return bounds;
}

/// The first panel is the list's, and what is open has its own one below it.
std::vector<std::string> Browser::panels() const
{
	std::vector<std::string> titles = {"Examples"};
	if (m_scene && m_scene->panels().size() > 1)
		titles.push_back(m_scene->panels()[1]);
	return titles;
}

void Browser::panel(size_t number, Panel& panel)
{
	if (number > 0)
		return m_scene->panel(number, panel);
	if (m_wanted)
		open();
	if (!m_complaint.empty())
		panel.text(m_complaint);
	list(panel);
	if (m_wanted)
		panel.text("Computing " + m_wanted->name + " ...");
	if (!m_scene)
		return;
	if (!m_scene->panels().empty())
		m_scene->panel(0, panel);
	else
		for (const std::string& line : m_scene->draw().text)
			panel.text(line);
}

void Browser::list(Panel& panel)
{
	if (m_scene && !panel.section("Open another one", false))
		return;
	for (const SampleGroup& group : m_groups)
	{
		// The first ones fill a window, others are opened by a click.
		if (!panel.section(group.title.c_str(), &group - m_groups.data() < 2))
			continue;
		std::vector<Panel::Row> rows;
		int selected = -1;
		for (const Sample& sample : group.samples)
		{
			if (&sample == m_opened)
				selected = int(rows.size());
			rows.push_back({{.3f, .5f, .9f},
							{sample.name + (sample.what.empty() ? "" : "\n" + sample.what)},
							m_pictures + "/" + sample.picture()});
		}
		const int clicked = panel.table(group.title.c_str(), {"click to open"}, rows, selected);
		if (clicked >= 0)
			m_wanted = &group.samples[size_t(clicked)];
	}
}

void Browser::open()
{
	const Sample* const wanted = m_wanted;
	m_wanted = nullptr;
	m_complaint.clear();
	try
	{
		m_scene = wanted->open();
		m_opened = wanted;
	}
	catch (const std::exception& error)
	{
		m_complaint = wanted->name + ": " + error.what();
	}
}

void Browser::jump(int number)
{
	if (m_scene)
		m_scene->jump(number);
}

void Browser::drag(const Ray& ray)
{
	if (m_scene)
		m_scene->drag(ray);
}

void Browser::release()
{
	if (m_scene)
		m_scene->release();
}

void Browser::throwBall(const Ray& ray)
{
	if (m_scene)
		m_scene->throwBall(ray);
}

void Browser::blowCharge(const Ray& ray)
{
	if (m_scene)
		m_scene->blowCharge(ray);
}

void Browser::key(char key)
{
	if (m_scene)
		m_scene->key(key);
}

std::vector<std::string> Browser::keyHelp() const { return m_scene ? m_scene->keyHelp() : std::vector<std::string>(); }
}  // namespace ep
