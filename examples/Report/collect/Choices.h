// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_CHOICES_H
#define EP_REPORT_CHOICES_H

#include <optional>

#include "text/Named.h"
#include "world/Method.h"

namespace ep
{
// What a record may be of, each with the names that files have for it.

enum class Precision
{
	Double,
	Float
};
const std::vector<Named<Precision>>& precisions();

/// Bullet's, ours, and those of ODE.
enum class ReportSolver
{
	Stock,
	Nncg,
	Mlcp,
	Iterative,
	Direct,
	OdeStep,      ///< dWorldStep: direct
	OdeQuickStep  ///< dWorldQuickStep: iterative
};
const std::vector<Named<ReportSolver>>& reportSolvers();
ReportSolver reportSolverOf(Solver solver);
bool iterates(ReportSolver solver);

/// What is compared.
enum class Scheme
{
	Default,  ///< our joints
	Paper,
	BulletFixed,
	BulletSpring2,
	OdeFixed,
	OdeSoft,
	InnerSteps,  ///< our joints with the direct solver as it is by default
	Profile,     ///< substeps by btElasticPlasticStepControl
	Everything,  ///< to compare with those that leave something out
	WithoutElasticity,
	WithoutShear,
	WithoutTorsion,
	WithoutContactCoupling,
	WithoutContinuousCollision,
	WithoutDirectSolve,
	WithoutInteraction,  ///< of forces in sections with fibres; the rest with numbers of them
	Fibres4,
	Fibres8,
	Fibres16,
	Fibres60
};
const std::vector<Named<Scheme>>& schemes();

/// Joints of another engine have none.
const std::vector<Named<std::optional<JointClass>>>& jointClasses();
}  // namespace ep

#endif  // EP_REPORT_CHOICES_H
