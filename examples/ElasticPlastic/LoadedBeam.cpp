#include "LoadedBeam.h"

namespace ep
{
namespace
{
/// Lets a degree of freedom go, in Bullet's class too: there linear ones are locked unless told otherwise.
void release(btElasticPlasticJoint& joint, int dof, JointClass jointClass)
{
	btElasticPlasticCapacity capacity = joint.getCapacity();
	capacity.clear(dof);
	joint.setCapacity(capacity);
	if (jointClass == JointClass::Spring)
		static_cast<btElasticPlastic6DofSpringConstraint&>(joint.getConstraint()).setLimit(dof, 1, -1);
	else
		static_cast<btElasticPlastic6DofSpring2Constraint&>(joint.getConstraint()).setLimit(dof, 1, -1);
}
}  // namespace

LoadedBeam::Settings::Settings() { member.material.m_yieldStress = btScalar(250e6); }

btRigidBody* LoadedBeam::support(btScalar x)
{
	return m_world.body(0, m_world.box(btVector3(1, 1, 1)), btTransform(btQuaternion(0, 0, 0, 1), btVector3(x, 0, 0)),
						false);
}

LoadedBeam::LoadedBeam(const Settings& s)
	: m_world(s.solver, btVector3(0, 0, 0)),
	  m_left(support(btScalar(-0.5))),
	  m_right(support(s.length + btScalar(0.5))),
	  m_member(m_world, s.member, btTransform::getIdentity(), s.length),
	  m_leftEnd(m_member.joinStart(m_world, *m_left)),
	  m_rightEnd(m_member.joinEnd(m_world, *m_right)),
	  m_middle(m_member.m_joints[s.member.parts / 2 - 1]),
	  m_settings(s)
{
	release(*m_rightEnd, BT_EP_AXIAL, s.member.jointClass);
	if (s.supports != Supports::Fixed)
		release(*m_rightEnd, BT_EP_BENDING_Z, s.member.jointClass);
	if (s.supports == Supports::Simple)
		release(*m_leftEnd, BT_EP_BENDING_Z, s.member.jointClass);
}

double LoadedBeam::collapseLoad() const
{
	const int hinges = m_settings.supports == Supports::Fixed ? 8 : m_settings.supports == Supports::Propped ? 6 : 4;
	return hinges * plasticMoment() / double(m_settings.length);
}
}  // namespace ep
