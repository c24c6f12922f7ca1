// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticDebugDraw.h"

#include "LinearMath/btIDebugDraw.h"
#include "btElasticPlasticJoint.h"

bool btElasticPlasticDrawing::isInRange() const
{
	const btVector3 sum = m_unloaded + m_half + m_yielding;
	return btElasticPlasticIsFinite(sum.x() + sum.y() + sum.z()) && btElasticPlasticIsFinite(m_spent + m_size) &&
		   m_spent >= 0 && m_size >= 0;
}

btVector3 btElasticPlasticColour(btScalar utilisation, btScalar damage, const btElasticPlasticDrawing& drawing)
{
	const btScalar u = btMax(btScalar(0), btMin(btScalar(1), utilisation)),
				   d = btMax(btScalar(0), btMin(btScalar(1), damage));
	const btVector3 colour = u < btScalar(0.5) ? drawing.m_unloaded.lerp(drawing.m_half, 2 * u)
											   : drawing.m_half.lerp(drawing.m_yielding, 2 * u - 1);
	return colour * (1 - (1 - drawing.m_spent) * d);
}

static void drawCross(btIDebugDraw& drawer, const btTransform& frame, btScalar size, const btVector3& colour)
{
	for (int i = 0; i < 3; ++i)
	{
		const btVector3 arm = frame.getBasis().getColumn(i) * size;
		drawer.drawLine(frame.getOrigin() - arm, frame.getOrigin() + arm, colour);
	}
}

void btElasticPlasticDrawJoint(btIDebugDraw& drawer, const btElasticPlasticJoint& joint,
							   const btElasticPlasticDrawing& drawing)
{
	const btTransform frameA = joint.getFrameA(), frameB = joint.getFrameB();
	const btVector3 &a = joint.getConstraint().getRigidBodyA().getCenterOfMassPosition(),
					&b = joint.getConstraint().getRigidBodyB().getCenterOfMassPosition();
	// One that was broken on purpose has ductility left, and bears as little.
	const btScalar damage = joint.isBroken() ? btScalar(1) : joint.getDamage();
	const btVector3 colour = btElasticPlasticColour(joint.getUtilisation(), damage, drawing);
	// A body's centre may be far away, or that of the fixed world body: a tenth of the nearer one is a size that shows.
	const btScalar byBodies =
		btScalar(0.1) * btSqrt(btMin((frameA.getOrigin() - a).length2() + 1, (frameB.getOrigin() - b).length2() + 1));
	const btScalar size = drawing.m_size > 0 ? drawing.m_size : byBodies;
	drawCross(drawer, frameA, size, colour);
	if (joint.isBroken())
	{
		drawCross(drawer, frameB, size, colour);
		return;
	}
	if (!joint.getConstraint().getRigidBodyA().isStaticObject())
		drawer.drawLine(a, joint.getPosition(), colour);
	if (!joint.getConstraint().getRigidBodyB().isStaticObject())
		drawer.drawLine(b, joint.getPosition(), colour);
}
