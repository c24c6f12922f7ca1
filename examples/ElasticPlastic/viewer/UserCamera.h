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
	/// \param isDriven  whether there is something to chase: else it begins where it sees the whole structure
	UserCamera(bool views, bool isDriven) : m_views(views), m_isDriven(isDriven), m_mode(own()) {}

	/// The same of the scene that there is now: if that has changed it begins anew.
	void offer(bool views, bool isDriven);

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

	Mode own() const { return m_views ? VIEWS : m_isDriven ? CHASE : SIDE; }
	void setOrbit();
	Camera chase(const Camera& wanted, btScalar seconds);
	Camera orbit(Bounds bounds, float aspect, const Margins& margins) const;

	bool m_views, m_isDriven;
	Mode m_mode;
	btScalar m_azimuth = btScalar(2.2), m_elevation = btScalar(.3);
	btScalar m_zoom = 1;  ///< of what the free camera sees over what it would
	Camera m_shown, m_chase;
	bool m_chasing = false;
};
}  // namespace ep

#endif  // EP_VIEWER_USER_CAMERA_H
