// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Slips.h"

#include <math.h>

#include "LinearMath/btMinMax.h"

namespace btElasticPlastic
{
namespace
{
/// Of the grid along the longer side of the figure.
const int CELLS = 8, NODES = 2 * CELLS + 1, NODES_OF_A_CELL = 9;
/// Of the mean diagonal of the matrix, what holds warpings of which few points know.
const double HOLD = 1e-9;

typedef std::vector<double> NodeValues;

double product(const NodeValues& a, const NodeValues& b)
{
	double sum = 0;
	for (size_t i = 0; i < a.size(); ++i)
		sum += a[i] * b[i];
	return sum;
}

void add(double factor, const NodeValues& a, NodeValues& sum)
{
	for (size_t i = 0; i < a.size(); ++i)
		sum[i] += factor * a[i];
}

/// Warpings of a point's cell, each of which is 1 at one node: their values and gradients there.
struct Shape
{
	double m_values[NODES_OF_A_CELL], m_alongY[NODES_OF_A_CELL], m_alongZ[NODES_OF_A_CELL];

	/// \param y, z  in the cell, 0 to 1  \param size  of the cell
	Shape(double y, double z, double size)
	{
		const double ofY[3] = {(1 - y) * (1 - 2 * y), 4 * y * (1 - y), y * (2 * y - 1)},
					 ofZ[3] = {(1 - z) * (1 - 2 * z), 4 * z * (1 - z), z * (2 * z - 1)},
					 slopesY[3] = {4 * y - 3, 4 - 8 * y, 4 * y - 1}, slopesZ[3] = {4 * z - 3, 4 - 8 * z, 4 * z - 1};
		for (int i = 0; i < NODES_OF_A_CELL; ++i)
		{
			m_values[i] = ofY[i % 3] * ofZ[i / 3];
			m_alongY[i] = slopesY[i % 3] * ofZ[i / 3] / size;
			m_alongZ[i] = ofY[i % 3] * slopesZ[i / 3] / size;
		}
	}
};

/// The figure's warpings, by their values at a grid's nodes.
class Grid
{
public:
	explicit Grid(const std::vector<SectionPoint>& points)
	{
		double low[2] = {points[0].m_y, points[0].m_z}, high[2] = {low[0], low[1]};
		for (const SectionPoint& p : points)
		{
			low[0] = btMin(low[0], p.m_y);
			low[1] = btMin(low[1], p.m_z);
			high[0] = btMax(high[0], p.m_y);
			high[1] = btMax(high[1], p.m_z);
		}
		m_size = btMax(high[0] - low[0], high[1] - low[1]) / CELLS;
		for (const SectionPoint& p : points)
		{
			const double y = (p.m_y - low[0]) / m_size, z = (p.m_z - low[1]) / m_size;
			const int column = btMin(int(y), CELLS - 1), row = btMin(int(z), CELLS - 1);
			m_places.push_back({2 * (row * NODES + column), y - column, z - row, p.m_area});
		}
	}

	static NodeValues zero() { return NodeValues(size_t(NODES) * NODES, 0.); }

	/// A warping's gradient at a point.
	Region::Point gradientAt(size_t point, const NodeValues& warping) const
	{
		const Place& p = m_places[point];
		const Shape shape(p.m_y, p.m_z, m_size);
		Region::Point gradient = {0, 0};
		for (int i = 0; i < NODES_OF_A_CELL; ++i)
		{
			gradient.m_y += shape.m_alongY[i] * warping[nodeOf(p.m_node, i)];
			gradient.m_z += shape.m_alongZ[i] * warping[nodeOf(p.m_node, i)];
		}
		return gradient;
	}

	/// Adds the integral of a slip times the gradient of each node's own warping, of a point.
	void add(size_t point, const Region::Point& slip, NodeValues& sums) const
	{
		const Place& p = m_places[point];
		const Shape shape(p.m_y, p.m_z, m_size);
		for (int i = 0; i < NODES_OF_A_CELL; ++i)
			sums[nodeOf(p.m_node, i)] += p.m_area * (shape.m_alongY[i] * slip.m_y + shape.m_alongZ[i] * slip.m_z);
	}

	/// The same of a number and the warpings themselves.
	void add(size_t point, double number, NodeValues& sums) const
	{
		const Place& p = m_places[point];
		const Shape shape(p.m_y, p.m_z, m_size);
		for (int i = 0; i < NODES_OF_A_CELL; ++i)
			sums[nodeOf(p.m_node, i)] += p.m_area * shape.m_values[i] * number;
	}

	/// The integrals of the products of nodes' own gradients, row by row.
	std::vector<double> matrix() const
	{
		const size_t n = zero().size();
		std::vector<double> elements(n * n, 0.);
		for (const Place& p : m_places)
		{
			const Shape shape(p.m_y, p.m_z, m_size);
			for (int i = 0; i < NODES_OF_A_CELL; ++i)
				for (int k = 0; k < NODES_OF_A_CELL; ++k)
					elements[nodeOf(p.m_node, i) * n + nodeOf(p.m_node, k)] +=
						p.m_area * (shape.m_alongY[i] * shape.m_alongY[k] + shape.m_alongZ[i] * shape.m_alongZ[k]);
		}
		return elements;
	}

private:
	/// Where a point is.
	struct Place
	{
		int m_node;       ///< the first of its cell
		double m_y, m_z;  ///< in the cell, 0 to 1
		double m_area;
	};
	static size_t nodeOf(int first, int i) { return size_t(first + i / 3 * NODES + i % 3); }

	double m_size;  ///< of a cell
	std::vector<Place> m_places;
};

/// Solves for the warping with the least slip.
class Warping
{
public:
	explicit Warping(const std::vector<SectionPoint>& points) : m_grid(points), m_factor(m_grid.matrix())
	{
		factorise();
		for (NodeValues& plane : m_planes)
			plane = Grid::zero();
		for (size_t i = 0; i < points.size(); ++i)
		{
			m_grid.add(i, points[i].m_y, m_planes[0]);
			m_grid.add(i, points[i].m_z, m_planes[1]);
		}
		for (int k = 0; k < 2; ++k)
			m_solvedPlanes[k] = solved(m_planes[k]);
	}

	/// Adds the warping to slips.
	/// \param keepsStraight  it has no part of a plane that turns
	void lessen(std::vector<Region::Point>& slips, bool keepsStraight) const
	{
		NodeValues sums = Grid::zero();
		for (size_t i = 0; i < slips.size(); ++i)
			m_grid.add(i, {-slips[i].m_y, -slips[i].m_z}, sums);
		NodeValues warping = solved(sums);
		if (keepsStraight)
			straighten(warping);
		for (size_t i = 0; i < slips.size(); ++i)
		{
			const Region::Point gradient = m_grid.gradientAt(i, warping);
			slips[i].m_y += gradient.m_y;
			slips[i].m_z += gradient.m_z;
		}
	}

private:
	/// Cholesky's.
	void factorise()
	{
		const size_t n = Grid::zero().size();
		double trace = 0;
		for (size_t i = 0; i < n; ++i)
			trace += m_factor[i * n + i];
		for (size_t i = 0; i < n; ++i)
			m_factor[i * n + i] += HOLD * trace / double(n);
		for (size_t i = 0; i < n; ++i)
			for (size_t k = 0; k <= i; ++k)
			{
				double sum = m_factor[i * n + k];
				for (size_t j = 0; j < k; ++j)
					sum -= m_factor[i * n + j] * m_factor[k * n + j];
				m_factor[i * n + k] = k < i ? sum / m_factor[k * n + k] : sqrt(sum);
			}
	}

	NodeValues solved(NodeValues nodes) const
	{
		const size_t n = nodes.size();
		for (size_t i = 0; i < n; ++i)
		{
			for (size_t k = 0; k < i; ++k)
				nodes[i] -= m_factor[i * n + k] * nodes[k];
			nodes[i] /= m_factor[i * n + i];
		}
		for (size_t i = n; i-- > 0;)
		{
			nodes[i] /= m_factor[i * n + i];
			for (size_t k = 0; k < i; ++k)
				nodes[k] -= m_factor[i * n + k] * nodes[i];
		}
		return nodes;
	}

	void straighten(NodeValues& warping) const
	{
		const double yy = product(m_planes[0], m_solvedPlanes[0]), yz = product(m_planes[0], m_solvedPlanes[1]),
					 zz = product(m_planes[1], m_solvedPlanes[1]), y = product(m_planes[0], warping),
					 z = product(m_planes[1], warping), determinant = yy * zz - yz * yz;
		add((yz * z - zz * y) / determinant, m_solvedPlanes[0], warping);
		add((yz * y - yy * z) / determinant, m_solvedPlanes[1], warping);
	}

	const Grid m_grid;
	std::vector<double> m_factor;  ///< lower, row by row
	NodeValues m_planes[2],
		m_solvedPlanes[2];  ///< of nodes' own warpings, the integral times y and z; and what it solves to
};
}  // namespace

void addPointsOf(const Region::Moments& piece, std::vector<SectionPoint>& points)
{
	const PrincipalMoments own = principalMoments(piece.centred());
	const double c = own.m_axis[0], s = own.m_axis[1], along = sqrt(own.m_greater / piece.m_area),
				 across = sqrt(own.m_lesser / piece.m_area);
	for (const double i : {-along, along})
		for (const double k : {-across, across})
			points.push_back(
				{piece.m_y / piece.m_area + c * i - s * k, piece.m_z / piece.m_area + s * i + c * k, piece.m_area / 4});
}

std::vector<Slips> slipsOf(const std::vector<SectionPoint>& points)
{
	const Warping warping(points);
	std::vector<Region::Point> alongY(points.size(), {1, 0}), alongZ(points.size(), {0, 1}), twist;
	for (const SectionPoint& p : points)
		twist.push_back({-p.m_z, p.m_y});
	warping.lessen(alongY, true);
	warping.lessen(alongZ, true);
	warping.lessen(twist, false);
	std::vector<Slips> slips;
	for (size_t i = 0; i < points.size(); ++i)
		slips.push_back({alongY[i], alongZ[i], twist[i]});
	return slips;
}
}  // namespace btElasticPlastic
