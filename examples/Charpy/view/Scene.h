// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_SCENE_H
#define EP_CHARPY_SCENE_H

#include "view/Drawing.h"
#include "drawing/ViewedScene.h"

namespace ep::charpy
{
/// The Charpy test as something to look at: the swing at its speed, the impact in slow motion.
class Scene : public ViewedScene
{
public:
	explicit Scene(const Settings& settings) : m_settings(settings), m_asGiven(settings) { restart(); }

	const ImpactTest& charpy() const { return *m_charpy; }

	std::string title() const override { return "Charpy"; }
	btScalar stepTime() const override { return btScalar(1) / 60; }
	void step(const Controls& controls) override;
	void restart() override;
	Drawing draw() const override;
	Bounds bounds() const override;
	std::vector<std::string> panels() const override { return {"The test"}; }
	void panel(size_t number, Panel& panel) override;
	void key(char key) override;
	std::vector<std::string> keyHelp() const override;

private:
	bool isNear() const;
	std::vector<std::string> text() const;

	Settings m_settings, m_asGiven;
	std::string m_fault;  ///< of what a person last asked for
	std::unique_ptr<ImpactTest> m_charpy;
	double m_slowness = 167;  ///< of the impact: how many times slower than it is
	bool m_cut = true;
	std::vector<Result> m_history;  ///< from the blow on, a picture each
};
}  // namespace ep::charpy

#endif  // EP_CHARPY_SCENE_H
