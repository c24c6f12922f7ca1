// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWED_SCENE_H
#define EP_VIEWED_SCENE_H

#include "drawing/Bounds.h"
#include "drawing/Burst.h"
#include "drawing/Drawing.h"
#include "drawing/Panel.h"
#include "vehicle/Controls.h"

namespace ep
{
/// What the viewer shows. It knows nothing of windows or OpenGL, the viewer nothing of physics.
class ViewedScene
{
public:
	virtual ~ViewedScene() = default;

	virtual std::string title() const = 0;
	virtual btScalar stepTime() const = 0;  ///< [s]
	virtual void step(const Controls& controls) = 0;
	virtual void restart() = 0;
	virtual Drawing draw() const = 0;

	/// What a camera that stands still keeps in the picture: the structure and what strikes it, without the ground. And the
	/// direction in which it looks.
	virtual Bounds bounds() const = 0;
	virtual btVector3 sight() const { return btVector3(btScalar(.3), btScalar(-.25), -1); }

	/// Whether controls do something.
	virtual bool isDriven() const { return false; }
	/// From 0, far away, to 1: how close what is driven is to what it strikes, and hides from whoever follows.
	virtual btScalar closeness() const { return 0; }
	/// Titles of what stands beside the picture: at most two, on the left and on the right.
	virtual std::vector<std::string> panels() const { return {}; }
	/// Of each, in lines of text.
	virtual int panelWidth() const { return 17; }
	virtual void panel(size_t, Panel&) {}
	/// F1 to F4, from 0 on.
	virtual void jump(int) {}
	/// Where the mouse points: from the eye into the picture.
	struct Ray
	{
		btVector3 from, direction;
	};
	/// Takes hold of what the ray meets. \return whether there is something to pull: else the mouse turns the camera
	virtual bool grab(const Ray&) { return false; }
	virtual void drag(const Ray&) {}
	virtual void release() {}
	virtual void throwBall(const Ray&) {}
	/// A charge goes off where the ray meets something.
	virtual void blowCharge(const Ray&) {}
	/// What broke, struck and went off in the last step, to be heard.
	virtual std::vector<Burst> bursts() const { return {}; }
	/// To before the last crash. \return whether there was one to go back from
	virtual bool goBack() { return false; }
	/// Whether something is breaking just now: a person may want to see it slowly.
	virtual bool isBreaking() const { return false; }
	/// A key that the viewer has no use for.
	virtual void key(char) {}
	/// Help on such keys, a line each.
	virtual std::vector<std::string> keyHelp() const { return {}; }
};
}  // namespace ep

#endif  // EP_VIEWED_SCENE_H
