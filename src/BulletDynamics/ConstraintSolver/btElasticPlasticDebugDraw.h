// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_DEBUG_DRAW_H
#define BT_ELASTIC_PLASTIC_DEBUG_DRAW_H

#include "LinearMath/btVector3.h"

class btIDebugDraw;
class btElasticPlasticJoint;

/// Colour of a joint: from green (no load) over yellow to red (yield) by its utilisation, fading to black by its damage (0 to
/// 1). Both are >= 0.
btVector3 btElasticPlasticColour(btScalar utilisation, btScalar damage);

/// Draws a joint as lines from its position to its bodies' centres and its axes' cross there, in its colour;
/// a broken one as two dark marks, where it was on either body.
void btElasticPlasticDrawJoint(btIDebugDraw& drawer, const btElasticPlasticJoint& joint);

#endif  // BT_ELASTIC_PLASTIC_DEBUG_DRAW_H
