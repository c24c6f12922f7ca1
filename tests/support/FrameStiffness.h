// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_FRAME_STIFFNESS_H
#define EP_TEST_FRAME_STIFFNESS_H

#include <array>
#include <cmath>
#include <utility>
#include <vector>

/// A space frame by matrix stiffness, with Timoshenko's beams between nodes: a reference in double, linear, which shares nothing
/// with the library.
class FrameStiffness
{
public:
	typedef std::array<double, 3> Vector;
	typedef std::array<double, 6> Six;  ///< along and about three axes

	/// Of a section: E A, G times the shear areas of forces along y and z, G J, E I about y and z.
	struct Section
	{
		double axial, shear[2], torsion, bending[2];
	};

	int addNode(const Vector& place, bool isFixed)
	{
		m_nodes.push_back({place, isFixed});
		return int(m_nodes.size()) - 1;
	}

	/// \param start, end  of the elastic member; what is between them and the nodes is rigid
	/// \param y           direction of the section's height, at a right angle to the member
	int addMember(int i, int k, const Vector& start, const Vector& end, const Vector& y, const Section& section)
	{
		Member member;
		member.node[0] = i;
		member.node[1] = k;
		Vector x;
		for (int c = 0; c < 3; ++c)
			x[size_t(c)] = end[size_t(c)] - start[size_t(c)];
		member.length = std::sqrt(dot(x, x));
		for (double& component : x)
			component /= member.length;
		member.axes[0] = x;
		member.axes[1] = y;
		member.axes[2] = cross(x, y);
		for (int c = 0; c < 3; ++c)
		{
			member.arm[0][size_t(c)] = start[size_t(c)] - m_nodes[size_t(i)].place[size_t(c)];
			member.arm[1][size_t(c)] = end[size_t(c)] - m_nodes[size_t(k)].place[size_t(c)];
		}
		member.section = section;
		m_members.push_back(member);
		return int(m_members.size()) - 1;
	}

	/// Solves for loads on the nodes [N], [N m].
	void solve(const std::vector<Six>& loads)
	{
		const size_t n = 6 * m_nodes.size();
		std::vector<std::vector<double>> matrix(n, std::vector<double>(n + 1, 0.));
		for (const Member& member : m_members)
		{
			const Local k = stiffnessOf(member);
			const auto T = transformOf(member);
			for (size_t r = 0; r < 12; ++r)
				for (size_t c = 0; c < 12; ++c)
				{
					double sum = 0;
					for (size_t p = 0; p < 12; ++p)
						for (size_t q = 0; q < 12; ++q)
							sum += T[p][r] * k[p][q] * T[q][c];
					matrix[placeOf(member, r)][placeOf(member, c)] += sum;
				}
		}
		for (size_t i = 0; i < n; ++i)
		{
			matrix[i][n] = loads[i / 6][i % 6];
			if (!m_nodes[i / 6].isFixed)
				continue;
			for (size_t c = 0; c <= n; ++c)
				matrix[i][c] = matrix[c < n ? c : i][i] = 0;
			matrix[i][n] = 0;
			matrix[i][i] = 1;
		}
		m_moved = eliminated(std::move(matrix));
	}

	/// Displacement and turn of a node, world axes.
	Six displacement(int node) const
	{
		Six d;
		for (size_t i = 0; i < 6; ++i)
			d[i] = m_moved[6 * size_t(node) + i];
		return d;
	}

	/// Force and moment that a member bears at an end, member axes: that of the node of its end, minus that of the node of its start.
	Six sectionForce(int index, int end) const
	{
		const Member& member = m_members[size_t(index)];
		const Local k = stiffnessOf(member);
		const auto T = transformOf(member);
		Six force = {};
		for (size_t r = 0; r < 6; ++r)
			for (size_t p = 0; p < 12; ++p)
				for (size_t c = 0; c < 12; ++c)
					force[r] += (end == 0 ? -1 : 1) * k[size_t(6 * end) + r][p] * T[p][c] * m_moved[placeOf(member, c)];
		return force;
	}

private:
	struct Node
	{
		Vector place;
		bool isFixed;
	};
	struct Member
	{
		int node[2];
		Vector axes[3], arm[2];
		double length;
		Section section;
	};
	typedef std::array<std::array<double, 12>, 12> Local;

	static double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
	static Vector cross(const Vector& a, const Vector& b)
	{
		return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
	}
	static size_t placeOf(const Member& member, size_t i) { return 6 * size_t(member.node[i / 6]) + i % 6; }

	/// Przemieniecki, Theory of Matrix Structural Analysis, 5.6: of the member's two ends in member axes.
	static Local stiffnessOf(const Member& member)
	{
		Local k = {};
		const Section& s = member.section;
		const double L = member.length;
		const auto spring = [&k](size_t dof, double stiffness)
		{
			k[dof][dof] = k[dof + 6][dof + 6] = stiffness;
			k[dof][dof + 6] = k[dof + 6][dof] = -stiffness;
		};
		spring(0, s.axial / L);
		spring(3, s.torsion / L);
		for (size_t plane = 0; plane < 2; ++plane)
		{
			// Plane 0: along y, about z; plane 1: along z, about y, where a positive turn lowers what lies ahead.
			const size_t v = 1 + plane, t = 5 - plane;
			const double EI = s.bending[1 - plane], phi = 12 * EI / (s.shear[plane] * L * L),
						 sign = plane == 0 ? 1 : -1;
			const double a = 12 * EI / (L * L * L * (1 + phi)), b = sign * 6 * EI / (L * L * (1 + phi)),
						 c = (4 + phi) * EI / (L * (1 + phi)), d = (2 - phi) * EI / (L * (1 + phi));
			spring(v, a);
			k[t][t] = k[t + 6][t + 6] = c;
			k[t][t + 6] = k[t + 6][t] = d;
			for (size_t end = 0; end < 2; ++end)
			{
				k[v][t + 6 * end] = k[t + 6 * end][v] = b;
				k[v + 6][t + 6 * end] = k[t + 6 * end][v + 6] = -b;
			}
		}
		return k;
	}

	/// From the nodes' displacements in world axes to those of the member's ends in member axes.
	static Local transformOf(const Member& member)
	{
		Local T = {};
		for (size_t end = 0; end < 2; ++end)
			for (size_t axis = 0; axis < 3; ++axis)
			{
				const Vector moment = cross(member.arm[end], member.axes[axis]);
				for (size_t c = 0; c < 3; ++c)
				{
					T[6 * end + axis][6 * end + c] = T[6 * end + 3 + axis][6 * end + 3 + c] = member.axes[axis][c];
					T[6 * end + axis][6 * end + 3 + c] = moment[c];
				}
			}
		return T;
	}

	/// Gauss's elimination of a matrix with its right side as last column, with pivots.
	static std::vector<double> eliminated(std::vector<std::vector<double>> m)
	{
		const size_t n = m.size();
		for (size_t c = 0; c < n; ++c)
		{
			size_t best = c;
			for (size_t r = c; r < n; ++r)
				if (std::fabs(m[r][c]) > std::fabs(m[best][c]))
					best = r;
			std::swap(m[c], m[best]);
			for (size_t r = 0; r < n; ++r)
			{
				if (r == c || m[r][c] == 0)
					continue;
				const double factor = m[r][c] / m[c][c];
				for (size_t i = c; i <= n; ++i)
					m[r][i] -= factor * m[c][i];
			}
		}
		std::vector<double> x(n);
		for (size_t i = 0; i < n; ++i)
			x[i] = m[i][n] / m[i][i];
		return x;
	}

	std::vector<Node> m_nodes;
	std::vector<Member> m_members;
	std::vector<double> m_moved;
};

#endif  // EP_TEST_FRAME_STIFFNESS_H
