#include "Methods.h"

namespace ep
{
const char* nameOf(Solver solver)
{
	switch (solver)
	{
		case Solver::Stock:
			return "stock";
		case Solver::Nncg:
			return "nncg";
		case Solver::Mlcp:
			return "mlcp";
		case Solver::Iterative:
			return "iterative";
		case Solver::Direct:
			return "direct";
	}
	return "?";
}

const char* nameOf(Joints joints)
{
	switch (joints)
	{
		case Joints::ElasticPlastic:
			return "default";
		case Joints::Paper:
			return "paper";
		case Joints::Fixed:
			return "bullet-fixed";
		case Joints::Springs:
			return "bullet-spring2";
		case Joints::None:
		case Joints::Breaking:
		case Joints::HingeMotor:
		case Joints::PlasticHinge:
			break;  // not compared
	}
	return "?";
}

const char* nameOf(JointClass jointClass) { return jointClass == JointClass::Spring ? "spring" : "spring2"; }

namespace
{
bool iterates(Solver solver) { return solver != Solver::Mlcp && solver != Solver::Direct; }
}  // namespace

std::vector<Method> methodsToCompare(bool quick)
{
	const std::vector<int> iterations = quick ? std::vector<int>{10} : std::vector<int>{10, 50, 250};
	const std::vector<JointClass> classes = quick ? std::vector<JointClass>{JointClass::Spring2}
												  : std::vector<JointClass>{JointClass::Spring2, JointClass::Spring};
	std::vector<Method> methods;
	const auto add = [&](Joints joints, Solver solver, JointClass jointClass)
	{
		for (const int n : iterations)
		{
			Method method(solver);
			method.joints = joints;
			method.jointClass = jointClass;
			method.iterations = n;
			methods.push_back(method);
			if (!iterates(solver))
				break;
		}
	};
	for (const JointClass jointClass : classes)
	{
		for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock, Solver::Nncg, Solver::Mlcp})
			add(Joints::ElasticPlastic, solver, jointClass);
		// The paper's scheme is for Bullet's own solver.
		add(Joints::Paper, Solver::Stock, jointClass);
	}
	for (const Joints joints : {Joints::Fixed, Joints::Springs})
		for (const Solver solver : {Solver::Stock, Solver::Mlcp})
			add(joints, solver, JointClass::Spring2);
	return methods;
}
}  // namespace ep
