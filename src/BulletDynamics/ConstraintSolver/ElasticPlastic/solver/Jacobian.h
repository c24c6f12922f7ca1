// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JACOBIAN_H
#define BT_ELASTIC_PLASTIC_JACOBIAN_H

#include <vector>

#include "SystemInput.h"

namespace btElasticPlastic
{
// Products with the Jacobian J and the mass M of a SystemInput. Velocities and momenta have 6 doubles by body, impulses one by
// row.

/// along = J v of all rows.
void project(const SystemInput& input, const std::vector<double>& velocity, std::vector<double>& along);

/// What the rows of a system ask for as long as nobody else moves its bodies, as far as solutions and takeFromTargets() change it.
struct AskedRows
{
	std::vector<double> m_targets;                   ///< by row
	std::vector<SystemInput::Bounded> m_singleRows;  ///< by single row

	void read(const SystemInput& input);
};

/// Takes J v from the targets of rows, and puts single rows back to what they were before a solution.
/// \param isChanged  by body: whether its v is another one than the last time
/// \param asked      for v = 0
void takeFromTargets(SystemInput& input, const std::vector<double>& velocity, const std::vector<char>& isChanged,
					 const AskedRows& asked);

/// momentum += sum J^T lambda.
void addImpulses(const SystemInput& input, const double* impulses, std::vector<double>& momentum);

/// The Jacobian of any row, and its bodies.
void getJacobian(const SystemInput& input, int row, int body[2], double J[12]);

/// momentum += J^T lambda of a row of these bodies.
void addImpulse(const int body[2], const double J[12], double impulse, std::vector<double>& momentum);

/// momentum += what eliminated bodies leave.
void addCondensedMomentum(const SystemInput& input, std::vector<double>& momentum);

/// y = M x
void multiplyMass(const SystemInput& input, const std::vector<double>& x, std::vector<double>& y);

/// x = M^-1 x; without eliminated bodies only.
void divideByMass(const SystemInput& input, std::vector<double>& x);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JACOBIAN_H
