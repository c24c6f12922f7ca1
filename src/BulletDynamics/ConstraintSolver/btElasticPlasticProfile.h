// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_PROFILE_H
#define BT_ELASTIC_PLASTIC_PROFILE_H

// The former name of btElasticPlasticStepper, for code written for version 0.1.

#include "btElasticPlasticStepper.h"

typedef btElasticPlasticStepper btElasticPlasticProfile;

#endif  // BT_ELASTIC_PLASTIC_PROFILE_H
