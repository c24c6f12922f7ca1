// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_LIVE_SCENE_H
#define EP_LIVE_SCENE_H

#include <filesystem>
#include <memory>

#include "drawing/ViewedScene.h"
#include "effects/Effects.h"
#include "sceneview/SectionFigure.h"
#include "simulation/Simulation.h"
#include "world/Hand.h"

namespace ep
{
/// A scene's file, computed while it is looked at. When the file changes, or one that it includes, it is read and computed anew; if it
/// is not right then, what is wrong is shown, and the last one that was goes on.
class LiveScene : public ViewedScene
{
public:
	/// Throws a SceneError if the file is not right to begin with.
	explicit LiveScene(const std::string& file);

	std::string title() const override;
	btScalar stepTime() const override { return btScalar(m_simulation->scene().world.step); }
	void step(const Controls& controls) override;
	void restart() override { reload(); }
	Drawing draw() const override;
	Bounds bounds() const override { return m_bounds; }
	btVector3 sight() const override;
	std::vector<std::string> panels() const override { return {"What happens", "Joints"}; }
	void panel(size_t number, Panel& panel) override;
	bool grab(const Ray& ray) override;
	void drag(const Ray& ray) override { m_hand->drag(ray.from, ray.direction); }
	void release() override { m_hand->release(); }
	void throwBall(const Ray& ray) override;
	void blowCharge(const Ray& ray) override;
	std::vector<Burst> bursts() const override { return m_effects.bursts(); }
	bool isBreaking() const override;
	void key(char key) override;
	std::vector<std::string> keyHelp() const override;

	const Simulation& simulation() const { return *m_simulation; }

private:
	struct Watched
	{
		std::string file;
		std::filesystem::file_time_type changed;
	};

	void build(const SceneDescription& scene);
	bool hasChanged() const;
	void reload();
	void watch(const std::vector<std::string>& files);
	void record();
	void addBreaks();
	void measure();
	void happenings(Panel& panel);
	void joints(Panel& panel);
	void broken(Panel& panel);
	void section(Panel& panel);
	void selectFirstToYield();
	std::string shortName(int joint) const;
	void select(int joint);

	std::string m_file, m_complaint;
	std::vector<Watched> m_watched;
	std::unique_ptr<Simulation> m_simulation;
	std::unique_ptr<Hand> m_hand;              // in its world
	std::vector<std::vector<float>> m_probes;  // of each, its values at all steps
	Effects m_effects;
	Bounds m_bounds;  // at the start
	int m_untilLook = 0, m_selected = -1, m_balls = 0;
	size_t m_numLookedAt = 0, m_numBurst = 0;  // of the simulation's events
	std::vector<float> m_history;              // utilisation of the selected joint
	std::vector<SectionForces> m_way;          // of its forces, if it has fibres
};
}  // namespace ep

#endif  // EP_LIVE_SCENE_H
