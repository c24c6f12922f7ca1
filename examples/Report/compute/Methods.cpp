// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "compute/Methods.h"

namespace ep
{
namespace
{
Scheme schemeOf(Joints joints)
{
	switch (joints)
	{
		case Joints::Paper:
			return Scheme::Paper;
		case Joints::Fixed:
			return Scheme::BulletFixed;
		case Joints::Springs:
			return Scheme::BulletSpring2;
		case Joints::ElasticPlastic:
		case Joints::None:
		case Joints::Breaking:
		case Joints::HingeMotor:
		case Joints::PlasticHinge:
			break;  // the last four are not compared
	}
	return Scheme::Default;
}

void addParts(std::vector<Setting>& settings)
{
	Setting whole = {Solver::Direct, Scheme::Everything};
	whole.method.without = parts::Nothing;
	settings.push_back(whole);
	const struct
	{
		unsigned part;
		Scheme scheme;
	} all[] = {{parts::Elasticity, Scheme::WithoutElasticity},
			   {parts::Shear, Scheme::WithoutShear},
			   {parts::Torsion, Scheme::WithoutTorsion},
			   {parts::ContactCoupling, Scheme::WithoutContactCoupling},
			   {parts::ContinuousCollision, Scheme::WithoutContinuousCollision}};
	for (const auto& p : all)
	{
		Setting setting = whole;
		setting.method.without = p.part;
		setting.scheme = p.scheme;
		settings.push_back(setting);
	}
	Setting iterative = whole;
	iterative.method.solver = Solver::Iterative;
	iterative.scheme = Scheme::WithoutDirectSolve;
	settings.push_back(iterative);
}

void addNumbersOfFibres(std::vector<Setting>& settings)
{
	Setting setting = {Solver::Direct, Scheme::WithoutInteraction};
	setting.method.without |= parts::Interaction;
	settings.push_back(setting);
	const struct
	{
		int count;
		Scheme scheme;
	} all[] = {{4, Scheme::Fibres4}, {8, Scheme::Fibres8}, {16, Scheme::Fibres16}, {60, Scheme::Fibres60}};
	for (const auto& some : all)
	{
		setting = {Solver::Direct, some.scheme};
		setting.method.fibres = some.count;
		settings.push_back(setting);
	}
}
}  // namespace

std::vector<int> iterationsToCompare(int stepsPerSecond, bool quick)
{
	if (quick)
		return {10};
	// More would take hours and teach nothing that fewer steps do not.
	std::vector<int> iterations = {10};
	if (stepsPerSecond <= 480)
		iterations.push_back(50);
	if (stepsPerSecond <= 240)
		iterations.push_back(250);
	return iterations;
}

std::vector<Setting> settingsToCompare(int rate, int substeps, bool hasFibres, bool quick)
{
	const int stepsPerSecond = rate * substeps;
	const std::vector<int> iterations = iterationsToCompare(stepsPerSecond, quick);
	const std::vector<JointClass> classes = quick ? std::vector<JointClass>{JointClass::Spring2}
												  : std::vector<JointClass>{JointClass::Spring2, JointClass::Spring};
	std::vector<Setting> settings;
	const bool hasMlcp = stepsPerSecond <= (quick ? 240 : 480);
	const auto add = [&](Joints joints, Solver solver, JointClass jointClass)
	{
		if (solver == Solver::Mlcp && !hasMlcp)
			return;
		for (const int n : iterations)
		{
			settings.push_back({Method(solver, {joints, jointClass}, n), schemeOf(joints)});
			if (!iterates(reportSolverOf(solver)))
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
	if (rate == 60 && substeps == 1)
		for (const double budget : {0.1, 0.01, 0.001})
			settings.push_back({Solver::Direct, Scheme::Profile, budget});
	if (rate == 60 && substeps == 8)
		addParts(settings);
	if (rate == 60 && substeps == 8 && hasFibres)
		addNumbersOfFibres(settings);
	// Errors are told over the step: each is as long as it says.
	for (Setting& setting : settings)
		setting.method = setting.method.alsoWithout(parts::InnerSteps);
	// But for the solver as it is by default, of which a game has what its step gives.
	if (substeps == 1 && rate <= 240)
		settings.push_back({Solver::Direct, Scheme::InnerSteps});
	return settings;
}
}  // namespace ep
