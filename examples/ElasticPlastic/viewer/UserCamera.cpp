// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/UserCamera.h"

#include "drawing/Cameras.h"
#include "LinearMath/btMinMax.h"

namespace ep
{
void UserCamera::next()
{
	m_mode = Mode((m_mode + 1) % MODES);
	if (m_mode == VIEWS && !m_views)
		m_mode = CHASE;
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
			m_mode = m_views ? VIEWS : CHASE;
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

void UserCamera::turn(int dx, int dy)
{
	m_mode = ORBIT;
	m_azimuth += dx * btScalar(.006);
	m_elevation = btMax(btScalar(.02), btMin(btScalar(1.5), m_elevation + dy * btScalar(.006)));
}

void UserCamera::zoom(int steps)
{
	m_mode = ORBIT;
	m_distance = btMax(btScalar(6), btMin(btScalar(150), m_distance * btPow(btScalar(.9), btScalar(steps))));
}

/// Follows with a little delay, so that the picture does not shake with the vehicle.
Camera UserCamera::chase(const btTransform& subject, btScalar seconds)
{
	const Camera wanted = chaseCamera(subject);
	const btScalar share = m_chasing ? 1 - btExp(-seconds * 6) : btScalar(1);
	const bool jumped = (wanted.eye - m_chase.eye).length() > 30;
	m_chase.eye = jumped ? wanted.eye : m_chase.eye.lerp(wanted.eye, share);
	m_chase.target = jumped ? wanted.target : m_chase.target.lerp(wanted.target, btMin(btScalar(1), 2 * share));
	m_chase.eye.setY(btMax(btScalar(.5), m_chase.eye.y()));
	m_chasing = true;
	return m_chase;
}

Camera UserCamera::orbit(const btTransform& subject) const
{
	Camera camera;
	camera.target = subject.getOrigin();
	const btScalar flat = btCos(m_elevation);
	camera.eye =
		camera.target + btVector3(flat * btCos(m_azimuth), btSin(m_elevation), flat * btSin(m_azimuth)) * m_distance;
	camera.eye.setY(btMax(btScalar(.5), camera.eye.y()));
	return camera;
}

Camera UserCamera::camera(const ViewedScene& scene, const btTransform& subject, float aspect, btScalar seconds)
{
	if (m_mode == CHASE)
		return chase(subject, seconds);
	m_chasing = false;
	return m_mode == ORBIT ? orbit(subject) : sideCamera(scene.centre(), scene.extent(), aspect);
}
}  // namespace ep
