// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_PRECISION_H
#define BT_ELASTIC_PLASTIC_PRECISION_H

#include "LinearMath/btScalar.h"

/// A game and the library it links have to be built with the same precision of Bullet (BT_USE_DOUBLE_PRECISION). What a
/// program begins with, constructors and btElasticPlasticJoint::from(), takes this tag without being given it, so that its type is a
/// part of their names: mixed precisions do not link.
template <class Scalar>
struct btElasticPlasticPrecision
{
};
typedef btElasticPlasticPrecision<btScalar> btElasticPlasticOwnPrecision;

#endif  // BT_ELASTIC_PLASTIC_PRECISION_H
