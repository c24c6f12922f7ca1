// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/destruction/Decks.h"

#include <algorithm>
#include <cmath>

namespace ep
{
namespace
{

/// Square parts in a plane, each joined to its neighbours, the first with its middle above the origin.
class Slab
{
public:
	/// \param height  of its middle [m]
	Slab(Stage& stage, const btElasticPlasticMaterial& material, int length, int width, double part, double thickness,
		 double height)
		: m_length(length), m_part(part), m_height(height)
	{
		const btElasticPlasticCapacity capacity = stage.rectangularMember(material, part, thickness, part, part);
		btCollisionShape* const shape =
			stage.world().box(vector(part - 2 * Stage::GAP, thickness, part - 2 * Stage::GAP));
		for (int z = 0; z < width; ++z)
			for (int x = 0; x < length; ++x)
				m_parts.push_back(
					&stage.body(double(material.m_density) * part * part * thickness, shape, placeOf(x, z)));
		for (int z = 0; z < width; ++z)
			for (int x = 0; x < length; ++x)
			{
				if (x + 1 < length)
					stage.join(at(x, z), at(x + 1, z), placeOf(x + 0.5, z), Stage::Along::X, capacity);
				if (z + 1 < width)
					stage.join(at(x, z), at(x, z + 1), placeOf(x, z + 0.5), Stage::Along::Z, capacity);
			}
	}

	btRigidBody& at(int x, int z) const { return *m_parts[size_t(z * m_length + x)]; }
	btVector3 placeOf(double x, double z) const { return vector(x * m_part, m_height, z * m_part); }

private:
	int m_length;
	double m_part, m_height;
	std::vector<btRigidBody*> m_parts;
};

/// Four legs without parts of their own, which hold a slab so many parts from its edges.
void addLegs(Stage& stage, const Slab& slab, const btElasticPlasticMaterial& material, int side, int fromEdge,
			 double part, double thickness, double height)
{
	const btElasticPlasticCapacity leg = stage.rectangularMember(material, part, part, height, height);
	for (const int x : {fromEdge, side - 1 - fromEdge})
		for (const int z : {fromEdge, side - 1 - fromEdge})
			stage.join(stage.ground(), slab.at(x, z), slab.placeOf(x, z) - vector(0, thickness / 2, 0), Stage::Along::Y,
					   leg);
}

void addVehicle(Stage& stage, const btVector3& axle, bool drives, btCollisionShape* chassisShape,
				btCollisionShape* wheelShape)
{
	const double chassisMass = 3000, wheelMass = 40, wheelFriction = 1, aboveAxle = 0.5;
	const double wheelBase = 2.8, track = 2.2;
	const double speed = drives ? -6 : 0, impulse = 200;  // [rad/s], [N m s] a step
	btRigidBody& chassis = stage.body(chassisMass, chassisShape, axle + vector(0, aboveAxle, 0));
	for (int wheel = 0; wheel < 4; ++wheel)
	{
		const btVector3 place =
			axle + vector(wheel % 2 ? wheelBase / 2 : -wheelBase / 2, 0, wheel / 2 ? track / 2 : -track / 2);
		btRigidBody& body = stage.body(wheelMass, wheelShape, place, btQuaternion(0, 0, 0, 1), wheelFriction);
		stage.drive(chassis, body, speed, impulse);
	}
}
}  // namespace

void Bridge::build(Stage& stage) const
{
	const double part = 1, thickness = 0.5, height = 6, pier = 0.8;
	const btElasticPlasticMaterial material = stage.concrete(25e6, 0.05);
	const Slab slab(stage, material, length, width, part, thickness, height);
	const btElasticPlasticCapacity end = stage.rectangularMember(material, part, thickness, part, part);
	for (int z = 0; z < width; ++z)
	{
		stage.join(stage.ground(), slab.at(0, z), slab.placeOf(-0.5, z), Stage::Along::X, end);
		stage.join(slab.at(length - 1, z), stage.ground(), slab.placeOf(length - 0.5, z), Stage::Along::X, end);
	}
	// Piers in two parts under both edges, at each quarter of the length.
	const double half = (height - thickness / 2) / 2;
	const btElasticPlasticCapacity column = stage.rectangularMember(material, pier, pier, half, half);
	btCollisionShape* const pierShape = stage.world().box(vector(pier, half - 2 * Stage::GAP, pier));
	for (int quarter = 1; quarter < 4; ++quarter)
		for (const int z : {0, width - 1})
		{
			const int x = quarter * length / 4;
			const btVector3 foot = vector(x * part, 0, z * part);
			btRigidBody* last = &stage.ground();
			for (int i = 0; i < 2; ++i)
			{
				btRigidBody& next = stage.body(double(material.m_density) * pier * pier * half, pierShape,
											   foot + vector(0, half * (i + 0.5), 0));
				stage.join(*last, next, foot + vector(0, half * i, 0), Stage::Along::Y, column);
				last = &next;
			}
			stage.join(*last, slab.at(x, z), foot + vector(0, 2 * half, 0), Stage::Along::Y, column);
		}
	const double radius = 0.4, above = 0.01;
	btCollisionShape* const chassisShape = stage.world().box(vector(4, 0.8, 1.8));
	btCollisionShape* const wheelShape = stage.world().keep(new btCylinderShapeZ(vector(radius, radius, 0.15)));
	const int inLane = 5;
	for (int i = 0; i < vehicles; ++i)
		addVehicle(stage, vector(4 + i % inLane * 7, height + thickness / 2 + radius + above, 1.7 + i / inLane * 3.6),
				   drives, chassisShape, wheelShape);
}

void Plate::build(Stage& stage) const
{
	const double part = 0.5, thickness = 0.3, height = 3, legHeight = 3;
	const btElasticPlasticMaterial material = stage.concrete(30e6, 0.05);
	const Slab slab(stage, material, side, side, part, thickness, height);
	addLegs(stage, slab, material, side, 1, part, thickness, legHeight);
	const double box = 0.4, boxMass = 38.4;
	btCollisionShape* const shape = stage.world().box(vector(box, box, box));
	// Two layers of boxes, each turned by an angle of its own.
	const int inRow = std::max(1, int(std::sqrt(boxes / 2.)));
	const double pitch = (side - 1) * part / inRow;
	for (int i = 0; i < boxes; ++i)
	{
		const int layer = i / (inRow * inRow), x = i % inRow, z = i / inRow % inRow;
		stage.body(boxMass, shape,
				   vector(pitch * (x + 0.5), height + thickness / 2 + box / 2 + 0.01 + layer * (box + 0.05),
						  pitch * (z + 0.5)),
				   btQuaternion(btVector3(0, 1, 0), btScalar(0.3 * (i * 7 % 11))), 0.5);
	}
	const int settled = 180;
	const double middle = (side - 1) * part / 2 - 0.05;
	if (isHit)
		stage.throwBall(settled, {btScalar(0.5), 3000, vector(middle, height + 8, middle), vector(0, -10, 0)});
}

void PyramidOnDeck::build(Stage& stage) const
{
	const double part = 0.6, thickness = 0.3, height = 3, legHeight = 3;
	const btElasticPlasticMaterial material = stage.concrete(30e6, 0.05);
	const Slab slab(stage, material, side, side, part, thickness, height);
	addLegs(stage, slab, material, side, 0, part, thickness, legHeight);
	const double box = 0.4, pitch = 0.42, middle = (side - 1) * part / 2;
	btCollisionShape* const shape = stage.world().box(vector(box, box, box));
	for (int layer = 0; layer < layers; ++layer)
	{
		const int n = layers - layer;
		for (int x = 0; x < n; ++x)
			for (int z = 0; z < n; ++z)
				stage.body(boxMass, shape,
						   vector(middle + (x - (n - 1) / 2.) * pitch, height + thickness / 2 + box / 2 + layer * box,
								  middle + (z - (n - 1) / 2.) * pitch));
	}
}
}  // namespace ep
