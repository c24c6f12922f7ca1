// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DEMOLISHER_SCENE_H
#define EP_DEMOLISHER_SCENE_H

#include <deque>

#include "drawing/ViewedScene.h"
#include "effects/Effects.h"
#include "view/JointHistory.h"
#include "view/Parts.h"
#include "world/Hand.h"

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
	/// Keeps the last seconds to go back to. What is saved changes results by rounding, so nothing is unless a person asks for it.
	void setRemembers(bool on) { m_remembers = on; }

	/// What is left of a structure, where it was built or as near to that as there is any.
	Bounds wreckOf(Scene scene) const;
	/// The one that has taken up most energy.
	Scene mostDamaged() const;
	/// From where a structure and what strikes it are seen well.
	static btVector3 sightOf(Scene scene);

	void setStyle(const PartStyle& style) { m_style = style; }

	std::string title() const override { return "Demolisher"; }
	btScalar stepTime() const override { return m_settings.step; }
	void step(const Controls& controls) override;
	void restart() override;
	Drawing draw() const override;
	/// The structure that the vehicle is at or comes to, as it was built, with room for the blow.
	Bounds bounds() const override;
	btVector3 sight() const override { return sightOf(ahead()); }
	bool isDriven() const override { return true; }
	btScalar closeness() const override;
	bool grab(const Ray& ray) override;
	void drag(const Ray& ray) override { m_hand->drag(ray.from, ray.direction); }
	void release() override { m_hand->release(); }
	void throwBall(const Ray& ray) override;
	void blowCharge(const Ray& ray) override;
	std::vector<Burst> bursts() const override { return m_effects.bursts(); }
	bool goBack() override;
	bool isBreaking() const override;
	void key(char key) override;
	std::vector<std::string> keyHelp() const override;
	void jump(int number) override;
	std::vector<std::string> panels() const override { return {"Demolisher", "Joints"}; }
	void panel(size_t number, Panel& panel) override;

private:
	Scene ahead() const;
	void remember();
	void addBreaks();
	void dashboard(Panel& panel);
	void jointTable(Panel& panel);
	void jointPlots(Panel& panel);
	void brokenTable(Panel& panel);
	/// \return whether the scene has to be built anew
	bool methodSettings(Panel& panel);
	bool buildSettings(Panel& panel);
	void view(Panel& panel);

	const DemolisherSettings m_asGiven;
	DemolisherSettings m_settings;
	std::unique_ptr<Demolisher> m_demolisher;
	std::unique_ptr<Hand> m_hand;           ///< in its world
	std::deque<Demolisher::Moment> m_past;  ///< of the last seconds
	bool m_autopilot = false, m_remembers = false;
	Bounds m_built[SCENE_COUNT];  ///< structures before anything has struck them, by scene
	PartStyle m_style;
	Effects m_effects;
	JointHistory m_history;  ///< of the joint that a person has chosen
};
}  // namespace ep

#endif  // EP_DEMOLISHER_SCENE_H
