// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BROWSER_H
#define EP_BROWSER_H

#include "Samples.h"

namespace ep
{
/// A list of what there is to see, and what has been opened of it.
class Browser : public ViewedScene
{
public:
	/// \param pictures  their folder
	explicit Browser(const std::vector<SampleGroup>& groups, const std::string& pictures = EP_SAMPLE_PICTURES)
		: m_groups(groups), m_pictures(pictures)
	{
	}

	std::string title() const override { return "Examples"; }
	btScalar stepTime() const override { return m_scene ? m_scene->stepTime() : btScalar(1) / 60; }
	void step(const Controls& controls) override;
	void restart() override;
	Drawing draw() const override;
	Bounds bounds() const override;
	btVector3 sight() const override { return m_scene ? m_scene->sight() : ViewedScene::sight(); }
	bool isDriven() const override { return m_scene && m_scene->isDriven(); }
	btScalar closeness() const override { return m_scene ? m_scene->closeness() : 0; }
	std::vector<std::string> panels() const override;
	int panelWidth() const override { return m_scene ? ViewedScene::panelWidth() : 2 * ViewedScene::panelWidth(); }
	void panel(size_t number, Panel& panel) override;
	void jump(int number) override;
	bool grab(const Ray& ray) override { return m_scene && m_scene->grab(ray); }
	void drag(const Ray& ray) override;
	void release() override;
	void throwBall(const Ray& ray) override;
	void blowCharge(const Ray& ray) override;
	std::vector<Burst> bursts() const override { return m_scene ? m_scene->bursts() : ViewedScene::bursts(); }
	bool goBack() override { return m_scene && m_scene->goBack(); }
	bool isBreaking() const override { return m_scene && m_scene->isBreaking(); }
	void key(char key) override;
	std::vector<std::string> keyHelp() const override;

private:
	void list(Panel& panel);
	void open();

	const std::vector<SampleGroup> m_groups;
	const std::string m_pictures;
	const Sample* m_wanted = nullptr;  ///< opened in the next frame: before that the window says so
	const Sample* m_opened = nullptr;
	std::string m_complaint;
	std::unique_ptr<ViewedScene> m_scene;
};
}  // namespace ep

#endif  // EP_BROWSER_H
