// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The Cholesky factor of the sparse block matrix, against dense ones.

#include <math.h>
#include <string.h>
#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "linear/BlockMatrices.h"
#include "BulletDynamics/ConstraintSolver/ElasticPlastic/linear/BlockFactor.h"

namespace testBlockFactor
{
using namespace ep;
using Factor = btElasticPlastic::BlockFactor;

const int Widths[] = {1, 2, 4, 8};

Values solved(const Factor& factor, Values x)
{
	factor.solve(x.data());
	return x;
}

bool sameBits(const Values& a, const Values& b)
{
	return a.size() == b.size() && (a.empty() || memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0);
}

/// Textbook Cholesky.
Values denseSolution(Values a, Values x)
{
	const size_t n = x.size();
	for (size_t i = 0; i < n; ++i)
		for (size_t j = 0; j <= i; ++j)
		{
			double sum = a[i * n + j];
			for (size_t k = 0; k < j; ++k)
				sum -= a[i * n + k] * a[j * n + k];
			a[i * n + j] = i == j ? sqrt(sum) : sum / a[j * n + j];
		}
	for (size_t i = 0; i < n; ++i)
	{
		for (size_t k = 0; k < i; ++k)
			x[i] -= a[i * n + k] * x[k];
		x[i] /= a[i * n + i];
	}
	for (size_t i = n; i-- > 0;)
	{
		for (size_t k = i + 1; k < n; ++k)
			x[i] -= a[k * n + i] * x[k];
		x[i] /= a[i * n + i];
	}
	return x;
}

TEST(BlockFactor, SolvesLikeADenseOne)
{
	for (const auto& [name, graph] : smallGraphs())
	{
		SCOPED_TRACE(name);
		Matrix matrix = matrixOf(graph);
		const Values b = randomValues(graph.m_numBodies);
		const Values expected = denseSolution(dense(matrix, graph), b);
		for (const int width : Widths)
		{
			Factor factor;
			factor.setMaxVectorWidth(width);
			factor.analyse(matrix);
			ASSERT_TRUE(factor.factorise(matrix));
			EXPECT_LT(difference(expected, solved(factor, b)), 1e-10) << "width " << factor.getVectorWidth();
		}
	}
}

TEST(BlockFactor, SolvesLargeGraphs)
{
	for (const BlockGraph& graph : {ep::wall(), ep::frame(), ep::chains(500, 20), ep::grid(40, 40, 1), ep::star(3000)})
	{
		const Matrix matrix = matrixOf(graph);
		const Values x = randomValues(graph.m_numBodies);
		Factor factor;
		factor.analyse(matrix);
		ASSERT_TRUE(factor.factorise(matrix));
		EXPECT_LT(difference(x, solved(factor, product(matrix, x))), 1e-10);
	}
}

TEST(BlockFactor, StaysAccurateOnAStiffChain)
{
	// Free at both ends, joints 1e9 times as stiff as the bodies are heavy: the condition number is 1e10 and more.
	const BlockGraph graph = ep::chains(1, 200);
	const Matrix matrix = matrixOf(graph, 1e9);
	const Values b = randomValues(graph.m_numBodies);
	Factor factor;
	factor.analyse(matrix);
	ASSERT_TRUE(factor.factorise(matrix));
	const Values x = solved(factor, b);
	const Values residual = product(matrix, x);
	EXPECT_LT(difference(b, residual) * norm(b), 1e-14 * 1e10 * norm(x) + 1e-14);
}

TEST(BlockFactor, WidthsAgreeToTheBit)
{
	std::vector<std::pair<std::string, BlockGraph>> graphs = smallGraphs();
	graphs.push_back({"grid", ep::grid(8, 8, 3)});
	graphs.push_back({"frame", ep::frame()});
	for (const auto& [name, graph] : graphs)
	{
		SCOPED_TRACE(name);
		const Matrix matrix = matrixOf(graph);
		const Values b = randomValues(graph.m_numBodies);
		Values plain, fused;
		for (const int width : Widths)
		{
			Factor factor;
			factor.setMaxVectorWidth(width);
			EXPECT_LE(factor.getVectorWidth(), width);
			factor.analyse(matrix);
			ASSERT_TRUE(factor.factorise(matrix));
			const Values x = solved(factor, b);
			if (factor.getVectorWidth() == 1)
				plain = x;
			else if (fused.empty())
				fused = x;
			else
				EXPECT_TRUE(sameBits(fused, x)) << width;
			// Rounded products differ by their rounding, times the condition.
			EXPECT_LT(difference(plain, x), 1e-12);
		}
	}
}

TEST(BlockFactor, HalvesOfSolutionsMultiplyToWhatWholeOnesGive)
{
	std::vector<std::pair<std::string, BlockGraph>> graphs = smallGraphs();
	graphs.push_back({"grid", ep::grid(8, 8, 3)});
	graphs.push_back({"frame", ep::frame()});
	for (const auto& [name, graph] : graphs)
	{
		SCOPED_TRACE(name);
		const int n = graph.m_numBodies;
		const Matrix matrix = matrixOf(graph);
		const Values elements = randomValues(4);
		// Between the ends, between one of them and the ground, and between neighbours.
		const int bodies[3][2] = {{0, n - 1}, {n - 1, -1}, {n / 2, std::min(n / 2 + 1, n - 1)}};
		std::vector<double> fused;
		for (const int width : Widths)
		{
			Factor factor;
			factor.setMaxVectorWidth(width);
			factor.analyse(matrix);
			ASSERT_TRUE(factor.factorise(matrix));
			btElasticPlastic::HalfSolution halves[3];
			std::vector<double> products;
			for (int i = 0; i < 3; ++i)
			{
				factor.solveHalf(bodies[i], elements.data() + i, halves[i]);
				Values whole(6 * size_t(n), 0.);
				for (int side = 0; side < 2; ++side)
					for (int k = 0; k < 6 && bodies[i][side] >= 0; ++k)
						whole[size_t(6 * bodies[i][side] + k)] += elements[size_t(i + 6 * side + k)];
				whole = solved(factor, whole);
				for (int j = 0; j <= i; ++j)
				{
					double expected = 0;
					for (int side = 0; side < 2; ++side)
						for (int k = 0; k < 6 && bodies[j][side] >= 0; ++k)
							expected += elements[size_t(j + 6 * side + k)] * whole[size_t(6 * bodies[j][side] + k)];
					products.push_back(btElasticPlastic::HalfSolution::multiply(halves[i], halves[j]));
					// Rounding, times the condition.
					EXPECT_NEAR(expected, products.back(), 1e-12) << i << " " << j;
				}
			}
			if (factor.getVectorWidth() == 1)
				continue;
			if (fused.empty())
				fused = products;
			EXPECT_TRUE(sameBits(fused, products)) << width;
		}
	}
}

TEST(BlockFactor, EmptyMatrix)
{
	Matrix matrix;
	Factor factor;
	factor.solve(nullptr);
	for (int i = 0; i < 2; ++i)
	{
		factor.analyse(matrix);
		EXPECT_TRUE(factor.factorise(matrix));
		EXPECT_TRUE(factor.factorise(matrix, nullptr, 0));
		factor.solve(nullptr);
		matrix.multiply(nullptr, nullptr);
		matrix.setZero();
		EXPECT_EQ(factor.getNumBodies(), 0);
		EXPECT_EQ(factor.getNumBlocks(), 0);
		EXPECT_EQ(factor.getNumOperations(), 0);
		matrix.setPattern(0, nullptr, 0);
	}
}

TEST(BlockFactor, RefusesWhatIsNotPositiveDefinite)
{
	const double infinity = std::numeric_limits<double>::infinity();
	const double nan = std::numeric_limits<double>::quiet_NaN();
	for (const auto& [name, graph] : smallGraphs())
		for (const int width : Widths)
			for (const double bad : {-1.0, 0.0, 1e-17, infinity, -infinity, nan})
				for (const int body : {0, graph.m_numBodies / 2, graph.m_numBodies - 1})
				{
					SCOPED_TRACE(name + ", body " + std::to_string(body) + ": " + std::to_string(bad));
					Matrix matrix = matrixOf(graph);
					const Values b = randomValues(graph.m_numBodies);
					Factor factor;
					factor.setMaxVectorWidth(width);
					factor.analyse(matrix);
					ASSERT_TRUE(factor.factorise(matrix));
					const Values x = solved(factor, b);

					const double good = matrix.diagonal(body)[7 * 4];
					// Small but positive is zero only where neighbours take more than it has.
					if (bad != 1e-17 ||
						std::any_of(graph.m_edges.begin(), graph.m_edges.end(),
									[body = body](const auto& e) { return e[0] == body || e[1] == body; }))
					{
						matrix.diagonal(body)[7 * 4] = bad;
						EXPECT_FALSE(body % 2 ? factor.factorise(matrix) : factor.factorise(matrix, &body, 1));
						EXPECT_FALSE(factor.hasFactor());
						EXPECT_TRUE(sameBits(solved(factor, b), b));
					}
					matrix.diagonal(body)[7 * 4] = good;
					EXPECT_TRUE(factor.factorise(matrix, nullptr, 0));
					EXPECT_TRUE(sameBits(solved(factor, b), x));
				}
}

TEST(BlockFactor, RefusesWhatIsSingularButForRounding)
{
	// Springs between bodies without mass: rigid motion costs nothing.
	for (const BlockGraph& graph : {ep::chains(1, 2), ep::chains(1, 25), ep::grid(5, 5, 1)})
	{
		Matrix matrix;
		matrix.setPattern(graph.m_numBodies, graph.edges(), int(graph.m_edges.size()));
		matrix.setZero();
		for (int e = 0; e < int(graph.m_edges.size()); ++e)
			for (int c = 0; c < 6; ++c)
			{
				bool transposed;
				matrix.offDiagonal(e, transposed)[7 * c] -= 3;
				for (const int body : graph.m_edges[e])
					matrix.diagonal(body)[7 * c] += 3;
			}
		Factor factor;
		factor.analyse(matrix);
		EXPECT_FALSE(factor.factorise(matrix));
		for (int c = 0; c < 6; ++c)
			matrix.diagonal(0)[7 * c] += 1e-6;
		EXPECT_TRUE(factor.factorise(matrix));
	}
}

TEST(BlockFactor, RefusesNotANumberBesideTheDiagonal)
{
	const BlockGraph graph = ep::grid(4, 4, 1);
	for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
		for (int e = 0; e < int(graph.m_edges.size()); ++e)
		{
			Matrix matrix = matrixOf(graph);
			Factor factor;
			factor.analyse(matrix);
			bool transposed;
			matrix.offDiagonal(e, transposed)[e % 36] = bad;
			EXPECT_FALSE(factor.factorise(matrix));
		}
}

TEST(BlockFactor, IsRepeatable)
{
	const BlockGraph graph = ep::randomGraph(300, 500, 8);
	const Values b = randomValues(graph.m_numBodies);
	const Matrix matrix = matrixOf(graph);
	Factor first, second;
	first.analyse(matrixOf(ep::frame()));  // what an object did before leaves no trace
	for (Factor* factor : {&first, &second})
	{
		factor->analyse(matrix);
		ASSERT_TRUE(factor->factorise(matrix));
	}
	EXPECT_TRUE(sameBits(solved(first, b), solved(second, b)));
	const Factor copy = first;
	EXPECT_TRUE(sameBits(solved(copy, b), solved(second, b)));
	ASSERT_TRUE(first.factorise(matrix));
	EXPECT_TRUE(sameBits(solved(first, b), solved(second, b)));
}

TEST(BlockFactor, OrderAndDirectionOfEdgesDoNotMatter)
{
	BlockGraph graph = ep::frame();
	graph.m_edges.resize(3000);
	const Values b = randomValues(graph.m_numBodies);
	Matrix matrix = matrixOf(graph);
	Factor factor;
	factor.analyse(matrix);
	ASSERT_TRUE(factor.factorise(matrix));

	// The same matrix from a shuffled list.
	std::vector<int> from(graph.m_edges.size());
	std::iota(from.begin(), from.end(), 0);
	std::mt19937 random(9);
	for (size_t i = from.size(); i > 1; --i)
		std::swap(from[i - 1], from[random() % i]);
	BlockGraph shuffled = graph;
	for (size_t i = 0; i < from.size(); ++i)
	{
		shuffled.m_edges[i] = graph.m_edges[from[i]];
		if (random() % 2)
			std::swap(shuffled.m_edges[i][0], shuffled.m_edges[i][1]);
	}
	Matrix other;
	other.setPattern(shuffled.m_numBodies, shuffled.edges(), int(shuffled.m_edges.size()));
	other.setZero();
	for (int i = 0; i < graph.m_numBodies; ++i)
		memcpy(other.diagonal(i), matrix.diagonal(i), 36 * sizeof(double));
	for (size_t i = 0; i < from.size(); ++i)
	{
		bool transposed, otherTransposed;
		const double* block = matrix.offDiagonal(from[i], transposed);
		double* otherBlock = other.offDiagonal(int(i), otherTransposed);
		const bool turned = graph.m_edges[from[i]] != shuffled.m_edges[i];
		EXPECT_EQ(turned, transposed != otherTransposed);
		memcpy(otherBlock, block, 36 * sizeof(double));
	}
	Factor otherFactor;
	otherFactor.analyse(other);
	ASSERT_TRUE(otherFactor.factorise(other));
	EXPECT_TRUE(sameBits(solved(factor, b), solved(otherFactor, b)));
}

TEST(BlockFactor, PartOfItIsRecomputedToTheBit)
{
	std::mt19937 random(10);
	std::vector<std::pair<std::string, BlockGraph>> graphs = smallGraphs();
	graphs.push_back({"frame", ep::frame()});
	for (const auto& [name, graph] : graphs)
		for (const int width : Widths)
		{
			SCOPED_TRACE(name);
			Matrix matrix = matrixOf(graph);
			const Values b = randomValues(graph.m_numBodies);
			Factor part, whole;
			for (Factor* factor : {&part, &whole})
			{
				factor->setMaxVectorWidth(width);
				factor->analyse(matrix);
			}
			ASSERT_TRUE(part.factorise(matrix));
			const Matrix changed = matrixOf(graph, 12, 2);
			for (int round = 0; round < 4; ++round)
			{
				std::vector<int> bodies;
				for (int k = 0; k < round; ++k)
					bodies.push_back(int(random() % graph.m_numBodies));
				for (const int body : bodies)
					matrix.diagonal(body)[7 * (round % 6)] += 1;
				for (int e = 0; e < int(graph.m_edges.size()); ++e)
				{
					const auto has = [&](int body) { return std::count(bodies.begin(), bodies.end(), body) > 0; };
					bool transposed;
					if (has(graph.m_edges[e][0]) && has(graph.m_edges[e][1]))
						matrix.offDiagonal(e, transposed)[round] += 0.01;
				}
				ASSERT_TRUE(part.factorise(matrix, bodies.data(), int(bodies.size())));
				ASSERT_TRUE(whole.factorise(matrix));
				EXPECT_TRUE(sameBits(solved(part, b), solved(whole, b))) << round;
			}
		}
}

TEST(BlockFactor, IsAPreconditionerWhenStale)
{
	// Conjugate gradients on a matrix of which a few joints have changed since it was factorised.
	const BlockGraph graph = ep::frame();
	Matrix matrix = matrixOf(graph);
	Factor factor;
	factor.analyse(matrix);
	ASSERT_TRUE(factor.factorise(matrix));
	for (int i = 0; i < 4; ++i)
		matrix.diagonal(1000 * i)[0] *= 2;

	const Values x = randomValues(graph.m_numBodies);
	Values residual = product(matrix, x), solution(x.size()), z = solved(factor, residual), direction = z;
	const auto dot = [](const Values& a, const Values& b)
	{ return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); };
	for (int i = 0; i < 8; ++i)
	{
		const double before = dot(residual, z);
		const Values h = product(matrix, direction);
		const double step = before / dot(direction, h);
		for (size_t k = 0; k < x.size(); ++k)
		{
			solution[k] += step * direction[k];
			residual[k] -= step * h[k];
		}
		z = solved(factor, residual);
		const double ratio = dot(residual, z) / before;
		for (size_t k = 0; k < x.size(); ++k)
			direction[k] = z[k] + ratio * direction[k];
	}
	EXPECT_LT(difference(x, solution), 1e-9);
}

TEST(BlockFactor, CostOfTreesIsLinear)
{
	for (const BlockGraph& graph :
		 {ep::chains(1, 20000), ep::randomTree(20000, 11), ep::star(20000), ep::grid(2, 1, 10000)})
	{
		const Matrix matrix = matrixOf(graph);
		Factor factor;
		factor.analyse(matrix);
		ASSERT_TRUE(factor.factorise(matrix));
		EXPECT_LT(factor.getNumBlocks(), 5 * graph.m_numBodies);
		EXPECT_LT(factor.getNumOperations(), 4000 * int64_t(graph.m_numBodies));
		EXPECT_LT(factor.getMemory(), 2500 * int64_t(graph.m_numBodies));
		const Values x = randomValues(graph.m_numBodies);
		EXPECT_LT(difference(x, solved(factor, product(matrix, x))), 1e-9);
	}
}
}  // namespace testBlockFactor
