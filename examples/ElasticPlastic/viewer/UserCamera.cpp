// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/UserCamera.h"

#include "LinearMath/btMinMax.h"

namespace ep
{
void UserCamera::offer(bool views, bool isDriven)
{
	const bool isNew = views != m_views || isDriven != m_isDriven;
	m_views = views;
	m_isDriven = isDriven;
	if (isNew)
		m_mode = own();
}

void UserCamera::next()
{
	m_mode = Mode((m_mode + 1) % MODES);
	if (m_mode == VIEWS && !m_views)
		m_mode = CHASE;
	if (m_mode == CHASE && !m_isDriven)
		m_mode = ORBIT;
}

const char* UserCamera::name() const
{
	const char* const names[MODES] = {"views", "chase", "free", "side"};
	return names[m_mode];
}

void UserCamera::select(WindowCamera camera)
{
	switch (camera)
	{
		case WindowCamera::Own:
			m_mode = own();
			break;
		case WindowCamera::Chase:
			m_mode = CHASE;
			break;
		case WindowCamera::Free:
			m_mode = ORBIT;
			break;
		case WindowCamera::Side:
			m_mode = SIDE;
			break;
	}
}

/// The free camera goes on from where another one stands.
void UserCamera::setOrbit()
{
	if (m_mode != ORBIT)
	{
		const btVector3 back = (m_shown.eye - m_shown.target).normalized();
		m_azimuth = btAtan2(back.z(), back.x());
		m_elevation = btAsin(back.y());
	}
	m_mode = ORBIT;
}

void UserCamera::turn(int dx, int dy)
{
	setOrbit();
	m_azimuth += dx * btScalar(.006);
	m_elevation = btMax(btScalar(.02), btMin(btScalar(1.5), m_elevation + dy * btScalar(.006)));
}

void UserCamera::zoom(int steps)
{
	setOrbit();
	m_zoom = btMax(btScalar(.1), btMin(btScalar(10), m_zoom * btPow(btScalar(.9), btScalar(steps))));
}

/// Follows with a little delay, so that the picture does not shake with the vehicle.
Camera UserCamera::chase(const Camera& wanted, btScalar seconds)
{
	const btScalar share = m_chasing ? 1 - btExp(-seconds * 6) : btScalar(1);
	const bool jumped = (wanted.eye - m_chase.eye).length() > 30;
	m_chase.eye = jumped ? wanted.eye : m_chase.eye.lerp(wanted.eye, share);
	m_chase.target = jumped ? wanted.target : m_chase.target.lerp(wanted.target, btMin(btScalar(1), 2 * share));
	m_chase.eye.setY(btMax(btScalar(.5), m_chase.eye.y()));
	m_chasing = true;
	return m_chase;
}

Camera UserCamera::orbit(Bounds bounds, float aspect, const Margins& margins) const
{
	const btVector3 centre = bounds.centre(), half = bounds.size() * (m_zoom / 2);
	bounds.low = centre - half;
	bounds.high = centre + half;
	const btScalar flat = btCos(m_elevation);
	Camera camera = framingCamera(
		bounds, -btVector3(flat * btCos(m_azimuth), btSin(m_elevation), flat * btSin(m_azimuth)), aspect, margins);
	camera.eye.setY(btMax(btScalar(.5), camera.eye.y()));
	return camera;
}

Camera UserCamera::camera(const ViewedScene& scene, const btTransform& subject, float aspect, const Margins& margins,
						  btScalar seconds)
{
	if (m_mode == CHASE)
		return m_shown = movedAside(chase(chaseCamera(subject, scene.closeness()), seconds), aspect, margins);
	m_chasing = false;
	if (m_mode == SIDE)
		return m_shown = framingCamera(scene.bounds(), scene.sight(), aspect, margins);
	// What is driven stays in the middle.
	Bounds bounds;
	if (scene.isDriven())
		for (btScalar side : {btScalar(-1), btScalar(1)})
			bounds.add(subject.getOrigin() + btVector3(5, 3, 5) * side);
	return m_shown = orbit(scene.isDriven() ? bounds : scene.bounds(), aspect, margins);
}
}  // namespace ep
