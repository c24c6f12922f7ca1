/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#ifndef BT_ELASTIC_PLASTIC_DEBUG_DRAW_H
#define BT_ELASTIC_PLASTIC_DEBUG_DRAW_H

#include "LinearMath/btVector3.h"

class btIDebugDraw;
class btElasticPlasticJoint;

/// Colour of a joint: from green (no load) over yellow to red (yield) by utilisation, both >= 0;
/// what damage it has (0 to 1) fades it to black.
btVector3 btElasticPlasticColour(btScalar utilisation, btScalar damage);

/// Draws a joint as lines from its position to its bodies' centres and its axes' cross there, in its colour;
/// a broken one as two dark marks, where it was on either body.
void btElasticPlasticDrawJoint(btIDebugDraw& drawer, const btElasticPlasticJoint& joint);

#endif  // BT_ELASTIC_PLASTIC_DEBUG_DRAW_H
