// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_DRIVE_H
#define BT_ELASTIC_PLASTIC_DRIVE_H

class btTypedConstraint;

namespace btElasticPlastic
{
class JointWorks;

/// Whether a constraint has rows of Bullet's that give energy to its bodies and take it back: springs or motors.
/// \param joint  that it is, null: none of ours
bool isDrive(btTypedConstraint& constraint, const JointWorks* joint);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_DRIVE_H
