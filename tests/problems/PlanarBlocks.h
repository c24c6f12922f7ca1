// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_PLANAR_BLOCKS_H
#define EP_TEST_PLANAR_BLOCKS_H

#include <cmath>
#include <vector>

/// A straight row of rigid blocks in a plane on elastic-perfectly plastic springs, stepped explicitly: for references. It shares
/// nothing with the library, no solver, no matrix, no step that is not far below the quickest period.
struct PlanarBlocks
{
	struct Section
	{
		double youngs, poisson, density, yieldStress, side;  // a square
	};

	struct Block
	{
		double mass, inertia, place[2], angle = 0, velocity[2] = {0, 0}, spin = 0, force[2] = {0, 0}, torque = 0;
	};

	/// Axial, shear, bending between a block's end and the next one's beginning, at distances from their centres.
	struct Joint
	{
		int a, b;
		double fromA, toB, stiffness[3], yield[3], plastic[3] = {0, 0, 0};
	};

	std::vector<Block> blocks;  // the first one is the support
	std::vector<Joint> joints;
	double gravity = 0;  // downwards

	PlanarBlocks(const Section& s, double length, int parts) : m_section(s)
	{
		const double l = length / parts, mass = s.density * s.side * s.side * l;
		blocks.push_back({0, 0, {0, 0}});
		for (int i = 0; i < parts; ++i)
			blocks.push_back({mass, mass * (l * l + s.side * s.side) / 12, {l * (i + 0.5), 0}});
		for (int i = 0; i < parts; ++i)
			join(i, i + 1, i == 0 ? 0 : l / 2, l / 2, i == 0 ? l / 2 : l);
	}

	/// A spring for a length of the member.
	void join(int a, int b, double fromA, double toB, double length)
	{
		const Section& s = m_section;
		const double area = s.side * s.side, shear = s.youngs / (2 + 2 * s.poisson);
		joints.push_back(
			{a,
			 b,
			 fromA,
			 toB,
			 {s.youngs * area / length, shear * area * 5 / 6 / length, s.youngs * area * area / 12 / length},
			 {area * s.yieldStress, area * s.yieldStress / 2, area * s.side / 4 * s.yieldStress}});
	}

	/// Symplectic Euler.
	void step(double dt)
	{
		for (Block& b : blocks)
			b.force[0] = b.torque = 0, b.force[1] = -b.mass * gravity;
		for (Joint& j : joints)
			pull(j);
		for (size_t i = 1; i < blocks.size(); ++i)
		{
			Block& b = blocks[i];
			for (int k = 0; k < 2; ++k)
				b.place[k] += dt * (b.velocity[k] += dt * b.force[k] / b.mass);
			b.angle += dt * (b.spin += dt * b.torque / b.inertia);
		}
	}

private:
	/// The gradient of the springs' energy, deformation being measured in the frame half way between the two blocks.
	void pull(Joint& j)
	{
		Block &a = blocks[j.a], &b = blocks[j.b];
		const double armA[] = {j.fromA * std::cos(a.angle), j.fromA * std::sin(a.angle)},
					 armB[] = {-j.toB * std::cos(b.angle), -j.toB * std::sin(b.angle)};
		const double gap[] = {b.place[0] + armB[0] - a.place[0] - armA[0], b.place[1] + armB[1] - a.place[1] - armA[1]};
		const double c = std::cos((a.angle + b.angle) / 2), s = std::sin((a.angle + b.angle) / 2);
		const double e[] = {c * gap[0] + s * gap[1], c * gap[1] - s * gap[0], b.angle - a.angle};
		double f[3];
		for (int i = 0; i < 3; ++i)
		{
			const double trial = j.stiffness[i] * (e[i] - j.plastic[i]);
			f[i] = std::fmax(-j.yield[i], std::fmin(j.yield[i], trial));
			j.plastic[i] += (trial - f[i]) / j.stiffness[i];
		}
		const double force[] = {c * f[0] - s * f[1], s * f[0] + c * f[1]}, turn = (f[0] * e[1] - f[1] * e[0]) / 2;
		for (int k = 0; k < 2; ++k)
		{
			a.force[k] += force[k];
			b.force[k] -= force[k];
		}
		a.torque += armA[0] * force[1] - armA[1] * force[0] - turn + f[2];
		b.torque -= armB[0] * force[1] - armB[1] * force[0] + turn + f[2];
	}

	Section m_section;
};

#endif  // EP_TEST_PLANAR_BLOCKS_H
