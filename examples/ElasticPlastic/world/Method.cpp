// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "world/Method.h"

namespace ep
{
const std::vector<Named<JointKind>>& jointKinds()
{
	static const std::vector<Named<JointKind>> kinds = {
		{"none", kinds::None, "nothing holds the blocks"},
		{"rigid", kinds::Rigid, "btFixedConstraint: bears everything"},
		{"breaking", kinds::Breaking, "btFixedConstraint with a breaking threshold: brittle"},
		{"spring", kinds::Spring, "btGeneric6DofSpringConstraint: springs back"},
		{"spring2", kinds::Spring2, "btGeneric6DofSpring2Constraint: springs back"},
		{"hinge-motor", kinds::HingeMotor, "btHingeConstraint, its motor brakes with the plastic moment"},
		{"plastic-hinge", kinds::PlasticHinge, "the same, and it lets go when its ductility is spent"},
		{"ep1", kinds::Ep1, "btElasticPlastic6DofSpringConstraint"},
		{"ep2", kinds::Ep2, "btElasticPlastic6DofSpring2Constraint"},
		{"ep1-paper", kinds::Ep1Paper, "ep1 with the paper's scheme"},
		{"ep2-paper", kinds::Ep2Paper, "ep2 with the paper's scheme"}};
	return kinds;
}

const std::vector<Named<Solver>>& solvers()
{
	static const std::vector<Named<Solver>> all = {
		{"stock", Solver::Stock, "Bullet's sequential impulses"},
		{"iterative", Solver::Iterative, "the same with exact soft rows"},
		{"direct", Solver::Direct, "sparse and exact; joints of Bullet's own are left to its iterations"}};
	return all;
}
}  // namespace ep
