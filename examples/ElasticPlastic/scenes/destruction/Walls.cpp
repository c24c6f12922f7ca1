// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/destruction/Walls.h"

namespace ep
{
namespace
{
const double BRICK_YIELD = 2e6;  // [Pa]
const double BRICK_STRAIN = 0.02;
const int FIRST_BLOW = 60;  // frame: by then what was built has settled

/// Smaller than the place it takes.
btCollisionShape* brick(Stage& stage, double x, double y, double z)
{
	return stage.world().box(vector(x - 2 * Stage::GAP, y - 2 * Stage::GAP, z - 2 * Stage::GAP));
}
}  // namespace

void Wall::build(Stage& stage) const
{
	const double length = 0.6, height = 0.3, depth = 0.3;
	const btElasticPlasticMaterial material = stage.concrete(BRICK_YIELD, BRICK_STRAIN);
	const btElasticPlasticCapacity beside = stage.rectangularMember(material, depth, height, length, length),
								   above = stage.rectangularMember(material, depth, length, height, height);
	btCollisionShape* const shape = brick(stage, length, height, depth);
	const auto placeOf = [&](double column, double row)
	{ return vector((column - columns / 2.) * length, (row + 0.5) * height, 0); };
	std::vector<btRigidBody*> bricks;
	for (int row = 0; row < rows; ++row)
		for (int column = 0; column < columns; ++column)
			bricks.push_back(
				&stage.body(double(material.m_density) * length * height * depth, shape, placeOf(column, row)));
	const auto at = [&](int column, int row) -> btRigidBody& { return *bricks[size_t(row * columns + column)]; };
	for (int row = 0; row < rows; ++row)
		for (int column = 0; column < columns; ++column)
		{
			if (column + 1 < columns)
				stage.join(at(column, row), at(column + 1, row), placeOf(column + 0.5, row), Stage::Along::X, beside);
			stage.join(row > 0 ? at(column, row - 1) : stage.ground(), at(column, row), placeOf(column, row - 0.5),
					   Stage::Along::Y, above);
		}
	const double radius = 0.8, before = -radius - 3;
	// Not on a joint's axis.
	const Stage::Ball blows[] = {
		{btScalar(radius), btScalar(ballMass), vector(0.13, 0.45 * rows * height, before), vector(0, 2, 20)},
		{btScalar(radius), btScalar(ballMass), vector(-0.25 * columns * length, 0.3 * rows * height, before),
		 vector(3, 2, 20)}};
	for (int i = 0; i < balls && i < 2; ++i)
		stage.throwBall(FIRST_BLOW + 90 * i, blows[i]);
}

void Tower::build(Stage& stage) const
{
	const double block = 0.5;
	const btElasticPlasticMaterial material = stage.concrete(BRICK_YIELD, BRICK_STRAIN);
	const btElasticPlasticCapacity capacity = stage.rectangularMember(material, block, block, block, block);
	btCollisionShape* const shape = brick(stage, block, block, block);
	std::vector<btRigidBody*> blocks(size_t(side * side * rows), nullptr);
	const auto at = [&](int x, int y, int z) -> btRigidBody*& { return blocks[size_t((y * side + z) * side + x)]; };
	const auto placeOf = [&](double x, double y, double z)
	{ return vector((x - side / 2.) * block, (y + 0.5) * block, (z - side / 2.) * block); };
	const auto isOuter = [&](int x, int z) { return x == 0 || z == 0 || x == side - 1 || z == side - 1; };
	for (int y = 0; y < rows; ++y)
		for (int z = 0; z < side; ++z)
			for (int x = 0; x < side; ++x)
				if (isOuter(x, z))
					at(x, y, z) =
						&stage.body(double(material.m_density) * block * block * block, shape, placeOf(x, y, z));
	for (int y = 0; y < rows; ++y)
		for (int z = 0; z < side; ++z)
			for (int x = 0; x < side; ++x)
			{
				btRigidBody* const here = at(x, y, z);
				if (!here)
					continue;
				if (x + 1 < side && at(x + 1, y, z))
					stage.join(*here, *at(x + 1, y, z), placeOf(x + 0.5, y, z), Stage::Along::X, capacity);
				if (z + 1 < side && at(x, y, z + 1))
					stage.join(*here, *at(x, y, z + 1), placeOf(x, y, z + 0.5), Stage::Along::Z, capacity);
				stage.join(y > 0 ? *at(x, y - 1, z) : stage.ground(), *here, placeOf(x, y - 0.5, z), Stage::Along::Y,
						   capacity);
			}
	for (int i = 0; i < shots; ++i)
	{
		// All over the tower, low and high, left and right, without an order that the eye sees.
		const double height = (0.25 + 0.6 * (i * 7 % 16) / 16.) * rows * block, aside = 0.3 * (i * 5 % 3 - 1);
		stage.throwBall(FIRST_BLOW + 15 * i, {btScalar(0.35), 1500, vector(aside, height, -4), vector(0, 1, 30)});
	}
}

void Lattice::build(Stage& stage) const
{
	const double cube = 0.5;
	const btElasticPlasticMaterial material = stage.concrete(BRICK_YIELD, BRICK_STRAIN);
	const btElasticPlasticCapacity capacity = stage.rectangularMember(material, cube, cube, cube, cube);
	btCollisionShape* const shape = brick(stage, cube, cube, cube);
	const double height = stands ? 0 : 20;
	const auto placeOf = [&](double x, double y, double z)
	{ return vector(x * cube, (y + 0.5) * cube + height, z * cube); };
	std::vector<btRigidBody*> cubes;
	const auto at = [&](int x, int y, int z) -> btRigidBody& { return *cubes[size_t((y * side + z) * side + x)]; };
	for (int y = 0; y < side; ++y)
		for (int z = 0; z < side; ++z)
			for (int x = 0; x < side; ++x)
				cubes.push_back(&stage.body(double(material.m_density) * cube * cube * cube, shape, placeOf(x, y, z)));
	for (int y = 0; y < side; ++y)
		for (int z = 0; z < side; ++z)
			for (int x = 0; x < side; ++x)
			{
				if (x + 1 < side)
					stage.join(at(x, y, z), at(x + 1, y, z), placeOf(x + 0.5, y, z), Stage::Along::X, capacity);
				if (z + 1 < side)
					stage.join(at(x, y, z), at(x, y, z + 1), placeOf(x, y, z + 0.5), Stage::Along::Z, capacity);
				if (y > 0 || stands)
					stage.join(y > 0 ? at(x, y - 1, z) : stage.ground(), at(x, y, z), placeOf(x, y - 0.5, z),
							   Stage::Along::Y, capacity);
			}
	stage.throwBall(FIRST_BLOW, {btScalar(0.5), 5000, vector(side * cube / 2 + 0.1, side * cube * 0.6 + height, -4),
								 vector(0, 1, 25)});
}
}  // namespace ep
