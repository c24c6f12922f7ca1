// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CELL_STRENGTH_H
#define BT_ELASTIC_PLASTIC_CELL_STRENGTH_H

#include <vector>

namespace btElasticPlastic
{
/// A part of a section that flows at one force when it is stretched, and at another when it is pressed.
struct Cell
{
	double m_y, m_z;
	double m_tension, m_compression;  ///< [N]
};

/// Axial force and moments about y and z.
enum SectionForce
{
	AXIAL_FORCE,
	MOMENT_Y,
	MOMENT_Z
};

/// The most that cells bear of one force while the other two are 0, in the stronger of its two directions. With n, m_y, m_z for the force's
/// factor of 1 and any factors of the others it is the least of sum of max(t s, -c s), s = n + m_y z - m_z y: of what the cells can take up at most
/// when they are deformed in that direction.
double strengthAlone(const std::vector<Cell>& cells, SectionForce force);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_CELL_STRENGTH_H
