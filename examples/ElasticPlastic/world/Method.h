// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_METHOD_H
#define EP_METHOD_H

#include "world/Engine.h"
#include "text/Named.h"

namespace ep
{
/// The solvers a scene can run with.
enum class Solver
{
	Stock,      ///< btSequentialImpulseConstraintSolver
	Nncg,       ///< btNNCGConstraintSolver
	Mlcp,       ///< btMLCPSolver with btDantzigSolver
	Iterative,  ///< btElasticPlasticConstraintSolver, iterative
	Direct,     ///< btElasticPlasticConstraintSolver, direct
};

/// Which of the two six-dof-spring classes a joint is, or is derived from.
enum class JointClass
{
	Spring,  ///< btGeneric6DofSpringConstraint
	Spring2  ///< btGeneric6DofSpring2Constraint
};

/// What holds bodies together.
enum class Joints
{
	ElasticPlastic,  ///< ours, default scheme
	Paper,           ///< ours, the paper's scheme
	Fixed,           ///< btFixedConstraint
	Springs,         ///< one of Bullet's two classes: springs of the same stiffness, which never yield
	None,            ///< nothing
	Breaking,        ///< btFixedConstraint that goes at a threshold: brittle
	HingeMotor,      ///< btHingeConstraint whose motor brakes with the plastic moment: the paper's basic idea
	PlasticHinge     ///< the same, and it lets go when its ductility is spent
};

/// What holds bodies together, as a person chooses it.
struct JointKind
{
	Joints joints;
	JointClass jointClass = JointClass::Spring2;

	bool isElasticPlastic() const { return joints == Joints::ElasticPlastic || joints == Joints::Paper; }
	bool operator==(const JointKind& other) const { return joints == other.joints && jointClass == other.jointClass; }
	bool operator!=(const JointKind& other) const { return !(*this == other); }
};

namespace kinds
{
constexpr JointKind None = {Joints::None}, Rigid = {Joints::Fixed}, Breaking = {Joints::Breaking},
					Spring = {Joints::Springs, JointClass::Spring}, Spring2 = {Joints::Springs, JointClass::Spring2},
					HingeMotor = {Joints::HingeMotor}, PlasticHinge = {Joints::PlasticHinge},
					Ep1 = {Joints::ElasticPlastic, JointClass::Spring},
					Ep2 = {Joints::ElasticPlastic, JointClass::Spring2}, Ep1Paper = {Joints::Paper, JointClass::Spring},
					Ep2Paper = {Joints::Paper, JointClass::Spring2};
}

const std::vector<Named<JointKind>>& jointKinds();

/// Those that demonstrations offer: Bullet's, and ours in its two forms.
const std::vector<Named<Solver>>& solvers();

/// What a scene can be computed without. Bits.
namespace parts
{
enum : unsigned
{
	Nothing = 0,
	Elasticity = 1,            ///< joints are rigid up to yield
	Shear = 2,                 ///< left to Bullet's class, which locks it
	Torsion = 4,               ///< left to Bullet's class, which lets it go
	ContactCoupling = 8,       ///< contacts are solved after the joints, by themselves (direct solver)
	ContinuousCollision = 16,  ///< Bullet's sweep of bodies that move further than their size
	Interaction = 32,          ///< of forces in a section with fibres: each yields by itself
	InnerSteps = 64,           ///< of the direct solver under a blow: each step of the world is one
	OfJoints = Elasticity | Shear | Torsion | Interaction
};
}

/// How a scene is solved: what comparisons vary, but for the step.
struct Method
{
	Solver solver = Solver::Iterative;
	Joints joints = Joints::ElasticPlastic;
	JointClass jointClass = JointClass::Spring2;
	int iterations = 10;                            ///< of iterative solvers, Bullet's default
	unsigned without = parts::ContinuousCollision;  ///< what is left out
	int fibres = 0;     ///< of sections that are cut into some, about how many; 0: as many as are right within 3 %
	MakeEngine engine;  ///< of another engine than Bullet

	/// All of the parts?
	bool has(unsigned these) const { return (without & these) == 0; }

	Method(Solver s) : solver(s) {}
	Method(Solver s, const JointKind& kind, int n)
		: solver(s), joints(kind.joints), jointClass(kind.jointClass), iterations(n)
	{
	}
	JointKind kind() const { return {joints, jointClass}; }

	Method alsoWithout(unsigned these) const
	{
		Method method = *this;
		method.without |= these;
		return method;
	}
};
}  // namespace ep

#endif  // EP_METHOD_H
