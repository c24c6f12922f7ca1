#ifndef EP_VIEWER_CAMERA_H
#define EP_VIEWER_CAMERA_H

#include "ViewedScene.h"
#include "pictureView.h"

namespace ep
{
/// The camera that a person moves: behind the subject, free around it, or fixed at the side.
class ViewerCamera
{
public:
	void next() { m_mode = Mode((m_mode + 1) % MODES); }
	void select(const std::string& name);
	const char* name() const;

	/// Mouse movements, pixels; the free camera obeys.
	void turn(int dx, int dy);
	void zoom(int steps);

	Camera camera(const ViewedScene& scene, const btTransform& subject, float aspect, btScalar seconds);

private:
	enum Mode
	{
		CHASE,
		ORBIT,
		SIDE,
		MODES
	};

	Camera chase(const btTransform& subject, btScalar seconds);
	Camera orbit(const btTransform& subject) const;

	Mode m_mode = CHASE;
	btScalar m_azimuth = btScalar(2.2), m_elevation = btScalar(.3), m_distance = 22;
	Camera m_chase;
	bool m_chasing = false;
};
}  // namespace ep

#endif  // EP_VIEWER_CAMERA_H
