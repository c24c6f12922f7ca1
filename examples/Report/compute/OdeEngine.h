// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_ODE_ENGINE_H
#define EP_REPORT_ODE_ENGINE_H

#include <string>
#include <vector>

#include "compute/Methods.h"

// The Open Dynamics Engine as an outside competitor, on scenes of bodies and joints that hang by their own weight.
//
// Springs come about by ODE's manual: a row of error reduction ERP = h kp / (h kp + kd) and constraint force mixing
// CFM = 1 / (h kp + kd) is a spring kp with a damper kd, integrated implicitly with the step h. Here kd = 0.

namespace ep
{
enum class OdeSolver
{
	Step,      ///< dWorldStep: direct
	QuickStep  ///< dWorldQuickStep: iterative
};

enum class OdeJoints
{
	/// Fixed joints with ODE's ERP (0.2) and CFM (1e-10 in double precision): as good as rigid.
	Fixed,
	/// Springs of the joint's stiffness. A fixed joint cannot be that: it shifts the centre of mass of its second body, wherever
	/// the joint is, and takes ERP and CFM of its own for shifts alone, but the world's for rotations. So a ball joint bears
	/// the forces, with one stiffness for all directions, that along gravity; and an angular motor whose stops are both at 0
	/// bears the moments, each with its stiffness.
	Soft
};

/// Steps a scene by ODE.
MakeEngine makeOde(OdeSolver solver, OdeJoints joints);

/// What the report compares on a problem; nothing if ODE cannot pose it, or computes in another precision than this program.
std::vector<Setting> odeSettings(const std::string& problem, int rate, int substeps, bool quick);
}  // namespace ep

#endif  // EP_REPORT_ODE_ENGINE_H
