// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DEMOLISHER_SCENE_H
#define EP_DEMOLISHER_SCENE_H

#include "drawing/ViewedScene.h"
#include "view/JointHistory.h"
#include "view/Parts.h"

namespace ep
{
/// The demolisher as something to look at and to drive.
class DemolisherScene : public ViewedScene
{
public:
	explicit DemolisherScene(const DemolisherSettings& settings) : m_asGiven(settings), m_settings(settings)
	{
		restart();
	}

	Demolisher& demolisher() { return *m_demolisher; }
	const Demolisher& demolisher() const { return *m_demolisher; }
	void setAutopilot(bool on) { m_autopilot = on; }

	/// Where a camera at the side looks.
	void lookAt(Scene scene) { m_looksAt = scene; }
	void setStyle(const PartStyle& style) { m_style = style; }

	std::string title() const override { return "Demolisher"; }
	btScalar stepTime() const override { return m_settings.step; }
	void step(const Controls& controls) override;
	void restart() override;
	Drawing draw() const override;
	btVector3 centre() const override;
	btScalar extent() const override;
	bool isDriven() const override { return true; }
	void key(char key) override;
	std::vector<std::string> keyHelp() const override;
	void jump(int number) override;
	std::vector<std::string> panels() const override { return {"Demolisher", "Joints"}; }
	void panel(size_t number, Panel& panel) override;

private:
	void dashboard(Panel& panel);
	void jointTable(Panel& panel);
	void jointPlots(Panel& panel);
	/// \return whether the scene has to be built anew
	bool methodSettings(Panel& panel);
	bool buildSettings(Panel& panel);
	void view(Panel& panel);

	const DemolisherSettings m_asGiven;
	DemolisherSettings m_settings;
	std::unique_ptr<Demolisher> m_demolisher;
	bool m_autopilot = false;
	Scene m_looksAt = Scene::Bridge;
	PartStyle m_style;
	JointHistory m_history;  ///< of the joint that a person has chosen
};
}  // namespace ep

#endif  // EP_DEMOLISHER_SCENE_H
