// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_USER_CAMERA_H
#define EP_VIEWER_USER_CAMERA_H

#include "cli/WindowOptions.h"
#include "drawing/Cameras.h"
#include "drawing/ViewedScene.h"

namespace ep
{
/// The camera that a person moves: behind the subject, free around it, or fixed where it sees the whole structure. Or the scene's own
/// ones.
class UserCamera
{
public:
	/// \param views  whether the scene has cameras of its own; then it begins with them
	explicit UserCamera(bool views) : m_views(views), m_mode(views ? VIEWS : CHASE) {}

	/// Whether the scene has cameras of its own now: those that come are shown.
	void offerViews(bool views);

	void next();
	void select(WindowCamera camera);
	const char* name() const;

	/// Mouse movements, pixels; the free camera obeys.
	void turn(int dx, int dy);
	void zoom(int steps);

	const Camera& shown() const { return m_shown; }
	bool showsViews() const { return m_mode == VIEWS; }
	/// \param margins  what panels cover
	Camera camera(const ViewedScene& scene, const btTransform& subject, float aspect, const Margins& margins,
				  btScalar seconds);

private:
	enum Mode
	{
		VIEWS,
		CHASE,
		ORBIT,
		SIDE,
		MODES
	};

	void setOrbit();
	Camera chase(const btTransform& subject, btScalar seconds);
	Camera orbit(Bounds bounds, float aspect, const Margins& margins) const;

	bool m_views;
	Mode m_mode;
	btScalar m_azimuth = btScalar(2.2), m_elevation = btScalar(.3);
	btScalar m_zoom = 1;  ///< of what the free camera sees over what it would
	Camera m_shown, m_chase;
	bool m_chasing = false;
};
}  // namespace ep

#endif  // EP_VIEWER_USER_CAMERA_H
