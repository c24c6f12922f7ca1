// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_DEBUG_DRAW_H
#define BT_ELASTIC_PLASTIC_DEBUG_DRAW_H

#include "LinearMath/btVector3.h"

class btIDebugDraw;
class btElasticPlasticJoint;

/// How joints are drawn.
struct btElasticPlasticDrawing
{
	btVector3 m_unloaded = btVector3(0, 1, 0);  ///< red, green and blue, 0 to 1, without load: green
	btVector3 m_half = btVector3(1, 1, 0);      ///< half way to yield: yellow
	btVector3 m_yielding = btVector3(1, 0, 0);  ///< at yield: red
	btScalar m_spent = btScalar(0.2);           ///< by which colours are multiplied when the ductility is spent, >= 0
	/// Length of the cross's arms [m], >= 0. 0: a tenth of the way to the nearer body's centre, and at least 0.1 m.
	btScalar m_size = 0;

	bool isInRange() const;
};

/// Colour of a joint by its utilisation, with that of its damage (0 to 1). Both are >= 0.
btVector3 btElasticPlasticColour(btScalar utilisation, btScalar damage,
								 const btElasticPlasticDrawing& drawing = btElasticPlasticDrawing());

/// Draws a joint as lines from its position to the centres of its bodies, but for static ones, and a cross of its axes on body A, in its colour;
/// a broken one as two crosses, where it was on either body, as dark as what is spent.
void btElasticPlasticDrawJoint(btIDebugDraw& drawer, const btElasticPlasticJoint& joint,
							   const btElasticPlasticDrawing& drawing = btElasticPlasticDrawing());

#endif  // BT_ELASTIC_PLASTIC_DEBUG_DRAW_H
