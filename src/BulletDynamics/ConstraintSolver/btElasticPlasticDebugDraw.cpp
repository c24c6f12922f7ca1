// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticDebugDraw.h"

#include "LinearMath/btIDebugDraw.h"
#include "btElasticPlasticJoint.h"

btVector3 btElasticPlasticColour(btScalar utilisation, btScalar damage)
{
	const btScalar u = btMax(btScalar(0), btMin(btScalar(1), utilisation)),
				   d = btMax(btScalar(0), btMin(btScalar(1), damage));
	const btVector3 colour(btMin(btScalar(1), 2 * u), btMin(btScalar(1), 2 - 2 * u), 0);
	return colour * (1 - btScalar(0.8) * d);
}

static void drawCross(btIDebugDraw& drawer, const btTransform& frame, btScalar size, const btVector3& colour)
{
	for (int i = 0; i < 3; ++i)
	{
		const btVector3 arm = frame.getBasis().getColumn(i) * size;
		drawer.drawLine(frame.getOrigin() - arm, frame.getOrigin() + arm, colour);
	}
}

void btElasticPlasticDrawJoint(btIDebugDraw& drawer, const btElasticPlasticJoint& joint)
{
	const btTransform frameA = joint.getFrameA(), frameB = joint.getFrameB();
	const btVector3 &a = joint.getConstraint().getRigidBodyA().getCenterOfMassPosition(),
					&b = joint.getConstraint().getRigidBodyB().getCenterOfMassPosition();
	const btVector3 colour = btElasticPlasticColour(joint.getUtilisation(), joint.getDamage());
	// A body's centre may be far away, or that of the fixed world body: a tenth of the nearer one is a size that shows.
	const btScalar size =
		btScalar(0.1) * btSqrt(btMin((frameA.getOrigin() - a).length2() + 1, (frameB.getOrigin() - b).length2() + 1));
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
