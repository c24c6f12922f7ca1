// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Slips.h"

#include <math.h>

#include "LinearMath/btMinMax.h"

namespace btElasticPlastic
{
namespace
{
/// Of the grid along the longer side of the figure, as many as leave all but a little of its area in cells with many points. Few do not tell what warpings of
/// second degree do between them: these would slip for nothing.
const int MOST_CELLS = 32, LEAST_CELLS = 8, MANY_POINTS = 42;
const double MOST_WITH_FEW = 0.02;
const int NODES_OF_A_CELL = 9;
/// What a row of cells has of a cell at least: rounding adds none.
const double LEAST_OF_A_CELL = 1e-6;
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

/// A symmetric matrix with nothing further than its band from the diagonal: rows up to there.
class BandMatrix
{
public:
	BandMatrix(size_t size, size_t band) : m_size(size), m_band(band), m_elements(size * (band + 1), 0.) {}

	/// \param column  at most \p row
	double& at(size_t row, size_t column) { return m_elements[row * m_band + m_band + column]; }
	double at(size_t row, size_t column) const { return m_elements[row * m_band + m_band + column]; }

	size_t size() const { return m_size; }
	/// The first column of a row.
	size_t firstOf(size_t row) const { return row > m_band ? row - m_band : 0; }

	/// Cholesky's, in its place.
	void factorise()
	{
		for (size_t i = 0; i < size(); ++i)
			for (size_t k = firstOf(i); k <= i; ++k)
			{
				double sum = at(i, k);
				for (size_t j = firstOf(i); j < k; ++j)
					sum -= at(i, j) * at(k, j);
				at(i, k) = k < i ? sum / at(k, k) : sqrt(sum);
			}
	}

	/// By the factor.
	NodeValues solved(NodeValues nodes) const
	{
		for (size_t i = 0; i < size(); ++i)
		{
			for (size_t k = firstOf(i); k < i; ++k)
				nodes[i] -= at(i, k) * nodes[k];
			nodes[i] /= at(i, i);
		}
		for (size_t i = size(); i-- > 0;)
		{
			nodes[i] /= at(i, i);
			for (size_t k = firstOf(i); k < i; ++k)
				nodes[k] -= at(i, k) * nodes[i];
		}
		return nodes;
	}

private:
	size_t m_size, m_band;
	std::vector<double> m_elements;
};

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
		double high[2] = {points[0].m_y, points[0].m_z}, area = 0;
		m_low[0] = high[0];
		m_low[1] = high[1];
		for (const SectionPoint& p : points)
		{
			m_low[0] = btMin(m_low[0], p.m_y);
			m_low[1] = btMin(m_low[1], p.m_z);
			high[0] = btMax(high[0], p.m_y);
			high[1] = btMax(high[1], p.m_z);
			area += p.m_area;
		}
		const double sides[2] = {high[0] - m_low[0], high[1] - m_low[1]};
		for (int cells = MOST_CELLS; cells >= LEAST_CELLS; cells /= 2)
		{
			divide(sides, cells);
			if (areaWithFew(points) <= MOST_WITH_FEW * area)
				break;
		}
		for (const SectionPoint& p : points)
		{
			const Cell cell = cellOf(p);
			m_places.push_back({2 * (cell.m_column * m_strideY + cell.m_row * m_strideZ),
								(p.m_y - m_low[0]) / m_size - cell.m_column, (p.m_z - m_low[1]) / m_size - cell.m_row,
								p.m_area});
		}
	}

	NodeValues zero() const { return NodeValues(size_t((2 * m_columns + 1) * (2 * m_rows + 1)), 0.); }

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

	/// The integrals of the products of nodes' own gradients.
	BandMatrix matrix() const
	{
		BandMatrix matrix(zero().size(), size_t(2 * (m_strideY + m_strideZ)));
		for (const Place& p : m_places)
		{
			const Shape shape(p.m_y, p.m_z, m_size);
			for (int i = 0; i < NODES_OF_A_CELL; ++i)
				for (int k = 0; k <= i; ++k)
				{
					const size_t a = nodeOf(p.m_node, i), b = nodeOf(p.m_node, k);
					matrix.at(btMax(a, b), btMin(a, b)) +=
						p.m_area * (shape.m_alongY[i] * shape.m_alongY[k] + shape.m_alongZ[i] * shape.m_alongZ[k]);
				}
		}
		return matrix;
	}

private:
	/// Where a point is.
	struct Place
	{
		int m_node;       ///< the first of its cell
		double m_y, m_z;  ///< in the cell, 0 to 1
		double m_area;
	};
	struct Cell
	{
		int m_column, m_row;  ///< along y, along z
	};

	/// Nodes are counted along the shorter side first, by which those of a cell are not far from each other.
	void divide(const double sides[2], int cells)
	{
		m_size = btMax(sides[0], sides[1]) / cells;
		m_columns = btMax(1, int(ceil(sides[0] / m_size - LEAST_OF_A_CELL)));
		m_rows = btMax(1, int(ceil(sides[1] / m_size - LEAST_OF_A_CELL)));
		m_strideY = m_columns <= m_rows ? 1 : 2 * m_rows + 1;
		m_strideZ = m_columns <= m_rows ? 2 * m_columns + 1 : 1;
	}

	Cell cellOf(const SectionPoint& p) const
	{
		return {btMin(int((p.m_y - m_low[0]) / m_size), m_columns - 1),
				btMin(int((p.m_z - m_low[1]) / m_size), m_rows - 1)};
	}

	/// Area in cells with few points.
	double areaWithFew(const std::vector<SectionPoint>& points) const
	{
		const size_t n = size_t(m_columns * m_rows);
		std::vector<int> counts(n, 0);
		std::vector<double> areas(n, 0.);
		for (const SectionPoint& p : points)
		{
			const Cell cell = cellOf(p);
			const size_t index = size_t(cell.m_row * m_columns + cell.m_column);
			++counts[index];
			areas[index] += p.m_area;
		}
		double sum = 0;
		for (size_t i = 0; i < n; ++i)
			sum += counts[i] < MANY_POINTS ? areas[i] : 0;
		return sum;
	}

	size_t nodeOf(int first, int i) const { return size_t(first + i % 3 * m_strideY + i / 3 * m_strideZ); }

	double m_low[2];                   ///< where the grid begins
	double m_size = 0;                 ///< of a cell
	int m_columns = 0, m_rows = 0;     ///< cells along y, along z
	int m_strideY = 0, m_strideZ = 0;  ///< from a node to its neighbour
	std::vector<Place> m_places;
};

/// Solves for the warping with the least slip.
class Warping
{
public:
	explicit Warping(const std::vector<SectionPoint>& points) : m_grid(points), m_factor(m_grid.matrix())
	{
		hold();
		m_factor.factorise();
		for (NodeValues& plane : m_planes)
			plane = m_grid.zero();
		for (size_t i = 0; i < points.size(); ++i)
		{
			m_grid.add(i, points[i].m_y, m_planes[0]);
			m_grid.add(i, points[i].m_z, m_planes[1]);
		}
		for (int k = 0; k < 2; ++k)
			m_solvedPlanes[k] = m_factor.solved(m_planes[k]);
	}

	/// Adds the warping to slips.
	/// \param keepsStraight  it has no part of a plane that turns
	void lessen(std::vector<Region::Point>& slips, bool keepsStraight) const
	{
		NodeValues sums = m_grid.zero();
		for (size_t i = 0; i < slips.size(); ++i)
			m_grid.add(i, {-slips[i].m_y, -slips[i].m_z}, sums);
		NodeValues warping = m_factor.solved(sums);
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
	void hold()
	{
		double trace = 0;
		for (size_t i = 0; i < m_factor.size(); ++i)
			trace += m_factor.at(i, i);
		for (size_t i = 0; i < m_factor.size(); ++i)
			m_factor.at(i, i) += HOLD * trace / double(m_factor.size());
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
	BandMatrix m_factor;
	NodeValues m_planes[2],
		m_solvedPlanes[2];  ///< of nodes' own warpings, the integral times y and z; and what it solves to
};
}  // namespace

Region::Moments shearProducts(const Slips& slips)
{
	const Region::Point &a = slips.m_alongY, &b = slips.m_alongZ;
	return {1, 0, 0, a.m_y * a.m_y + b.m_y * b.m_y, a.m_z * a.m_z + b.m_z * b.m_z, a.m_y * a.m_z + b.m_y * b.m_z};
}

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
