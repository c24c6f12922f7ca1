// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Cost of a step over the size of a structure, the direct solver's and that of Bullet's own with 10 iterations:
// ep-solver-cost DIR writes solver-cost.csv, solver-cost.svg (a joint's share of a step) and solver-parts.svg (where the
// direct solver's time goes) to a folder. Some minutes; the machine should have nothing else to do.

#include <cstdio>
#include <exception>
#include <sstream>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "StiffStructure.h"
#include "text/OutputFiles.h"
#include "plot/Plot.h"

namespace
{
using namespace ep;

struct Cost
{
	int m_joints;
	double m_stock, m_direct, m_collapsing;  // of a step [s]
	btElasticPlasticStatistics m_parts;      // of m_steps elastic steps
	int m_steps;
};

btElasticPlasticConstraintSolver& solverOf(StiffStructure& structure)
{
	return static_cast<btElasticPlasticConstraintSolver&>(*structure.world().bullet().getConstraintSolver());
}

Cost measure(StiffStructure::Shape shape, int size)
{
	StiffStructure::Settings settings;
	settings.shape = shape;
	settings.size = size;
	StiffStructure direct(settings);
	settings.collapsing = true;
	StiffStructure collapsing(settings);
	settings.collapsing = false;
	settings.joints = Joints::Springs;
	settings.solver = Solver::Stock;
	StiffStructure stock(settings);

	std::vector<double> times[3];
	const int warm = 3, steps = direct.joints() < 300 ? 300 : direct.joints() < 3000 ? 60 : 20;
	for (int i = 0; i < warm + steps; ++i)
	{
		const double s = stock.step(), d = direct.step();
		// It yields all over for some ten steps only.
		const double c = i < warm + 12 ? collapsing.step() : 0;
		if (i < warm)
			continue;
		times[0].push_back(s);
		times[1].push_back(d);
		if (c > 0)
			times[2].push_back(c);
	}
	btElasticPlasticSolverSettings timed = solverOf(direct).getSettings();
	timed.m_measuresTime = true;
	solverOf(direct).setSettings(timed);
	solverOf(direct).resetStatistics();
	for (int i = 0; i < steps; ++i)
		direct.step();
	return {direct.joints(),
			medianOf(times[0]),
			medianOf(times[1]),
			medianOf(times[2]),
			solverOf(direct).getStatistics(),
			steps};
}

struct Family
{
	const char* m_name;
	StiffStructure::Shape m_shape;
	std::vector<int> m_sizes;
};

void run(const std::string& folder)
{
	const Family families[] = {
		{"chain", StiffStructure::Shape::Chain, {10, 30, 100, 300, 1000, 3000, 10000, 20000}},
		{"frame", StiffStructure::Shape::Frame, {2, 3, 4, 6, 8, 10, 11}},
		{"wall", StiffStructure::Shape::Wall, {4, 7, 14, 28, 49, 70, 105}},
	};
	Plot cost, parts;
	cost.m_title = "A joint's share of a step";
	parts.m_title = "Where the direct solver's time goes (wall, elastic)";
	cost.m_xLabel = parts.m_xLabel = "joints";
	cost.m_yLabel = parts.m_yLabel = "microseconds per joint and step";
	cost.m_logX = cost.m_logY = parts.m_logX = true;
	std::ostringstream csv;
	csv << "structure,joints,stock_10_iterations_us,direct_elastic_us,direct_collapsing_us,set_up_us,analysis_us,"
		   "assembly_us,factorisation_us,solution_us,search_us\n";
	int color = 0;
	for (const Family& family : families)
	{
		const std::string name = family.m_name;
		Plot::Curve stock{name + ", Bullet's (wrong)", {}, Plot::DASHED, color};
		Plot::Curve direct{name + ", direct", {}, Plot::SOLID, color};
		Plot::Curve collapsing{name + ", direct, collapsing", {}, Plot::DOTTED, color};
		Plot::Curve part[5];
		const char* const names[] = {"joints' rows", "matrix", "factor", "solution", "search"};
		for (const int size : family.m_sizes)
		{
			const Cost c = measure(family.m_shape, size);
			const double perJoint = 1e6 / c.m_joints, each = 1e6 / c.m_steps;
			stock.m_points.emplace_back(c.m_joints, c.m_stock * perJoint);
			direct.m_points.emplace_back(c.m_joints, c.m_direct * perJoint);
			collapsing.m_points.emplace_back(c.m_joints, c.m_collapsing * perJoint);
			const double times[] = {c.m_parts.m_setUpTime, c.m_parts.m_analysisTime + c.m_parts.m_assemblyTime,
									c.m_parts.m_factorisationTime, c.m_parts.m_solutionTime, c.m_parts.m_searchTime};
			for (int i = 0; i < 5; ++i)
			{
				part[i].m_name = names[i];
				part[i].m_points.emplace_back(c.m_joints, times[i] * each / c.m_joints);
			}
			csv << family.m_name << "," << c.m_joints << "," << 1e6 * c.m_stock << "," << 1e6 * c.m_direct << ","
				<< 1e6 * c.m_collapsing << "," << c.m_parts.m_setUpTime * each << "," << c.m_parts.m_analysisTime * each
				<< "," << c.m_parts.m_assemblyTime * each << "," << c.m_parts.m_factorisationTime * each << ","
				<< c.m_parts.m_solutionTime * each << "," << c.m_parts.m_searchTime * each << "\n";
			printf("%-6s %6d joints: Bullet's 10 iterations %9.1f us, direct %9.1f us (%.2f), collapsing %9.1f us\n",
				   family.m_name, c.m_joints, 1e6 * c.m_stock, 1e6 * c.m_direct, c.m_direct / c.m_stock,
				   1e6 * c.m_collapsing);
			fflush(stdout);
		}
		cost.m_curves.push_back(stock);
		cost.m_curves.push_back(direct);
		cost.m_curves.push_back(collapsing);
		if (family.m_shape == StiffStructure::Shape::Wall)
			parts.m_curves.assign(part, part + 5);
		++color;
	}
	writeText(folder + "/solver-cost.csv", csv.str());
	writeText(folder + "/solver-cost.svg", cost.svg());
	writeText(folder + "/solver-parts.svg", parts.svg());
}
}  // namespace

int main(int argc, char** argv)
{
	if (argc != 2 || argv[1][0] == '-')
	{
		fprintf(stderr, "Usage: ep-solver-cost DIR\nWrites solver-cost.csv and plots to a folder that exists.\n");
		return 1;
	}
	try
	{
		run(argv[1]);
	}
	catch (const std::exception& error)
	{
		fprintf(stderr, "ep-solver-cost: %s\n", error.what());
		return 1;
	}
	return 0;
}
