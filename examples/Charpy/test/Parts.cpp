// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "test/Parts.h"

#include <cmath>

namespace ep::charpy
{
namespace
{
btVector3 corner(double x, double z) { return btVector3(btScalar(x), 0, btScalar(z)); }

Shape boxShape(double x, double y, double z)
{
	return {{corner(-x / 2, -z / 2), corner(x / 2, -z / 2), corner(x / 2, z / 2), corner(-x / 2, z / 2)}, y};
}

/// Boxes are boxes to Bullet, which has an algorithm of its own for them.
btCollisionShape* makeShape(World& world, const Shape& shape, const Settings& s, bool isBox)
{
	const btScalar unit = btScalar(s.lengthsPerMetre), half = btScalar(shape.height / 2) * unit;
	btPolyhedralConvexShape* made;
	if (isBox)
	{
		const btVector3 c = shape.plan[2] * unit;
		made = new btBoxShape(btVector3(c.x(), half, c.z()));
	}
	else
	{
		auto* const hull = new btConvexHullShape;
		for (const btVector3& c : shape.plan)
			for (btScalar y : {-half, half})
				hull->addPoint(btVector3(c.x() * unit, y, c.z() * unit), false);
		hull->recalcLocalAabb();
		// Bullet's default of 0.04 units is for bodies of size 1; of boxes it makes this by itself.
		btVector3 low, high;
		hull->getAabb(btTransform::getIdentity(), low, high);
		hull->setSafeMargin((high - low) / 2 - btVector3(1, 1, 1) * hull->getMargin());
		made = hull;
	}
	world.keep(made);
	if (s.preciseContacts)
	{
		made->setMargin(btScalar(0.2e-3) * unit);
		made->initializePolyhedralFeatures();
	}
	return made;
}

btTransform at(const Settings& s, const btVector3& place, btScalar angle = 0)
{
	return btTransform(btQuaternion(btVector3(0, 0, 1), angle), place * btScalar(s.lengthsPerMetre));
}

btVector3 turned(const btVector3& v, double angle)
{
	return quatRotate(btQuaternion(btVector3(0, 0, 1), btScalar(angle)), v);
}

bool isPaper(const Settings& s) { return s.geometry == Geometry::Paper; }

int numPieces(const Settings& s) { return s.way == kinds::Rigid ? 1 : s.pieces; }

/// What slides along the specimen would catch at the next piece's end, for Bullet pushes a corner that is in by a little out
/// the short way, back along the specimen. So a piece reaches past its inner ends, there below its neighbour's faces: what
/// arrives finds a face that rises by 1 in 20.
Shape reachingShape(const Settings& s, int i)
{
	const double x = s.height / 2, reach = 1e-3, depth = 0.1e-3;
	Shape shape = {{}, s.width};
	for (int side : {-1, 1})
	{
		const bool inner = side < 0 ? i > 0 : i + 1 < numPieces(s);
		const double end = side * s.length / numPieces(s) / 2, past = inner ? side * reach : 0, low = inner ? depth : 0;
		for (const btVector3& c : {corner(side * x, end - past), corner(side * (x - low), end + past),
								   corner(-side * (x - low), end + past), corner(-side * x, end - past)})
			shape.plan.push_back(c);
	}
	return shape;
}
}  // namespace

Shape hammerShape(const Settings& s)
{
	const double half = s.hammerHalfThickness(), front = s.hammerLength / 2;
	if (isPaper(s))
	{
		const double shoulder = front - s.draft;
		return {{corner(front, 0), corner(shoulder, half), corner(-front, half), corner(-front, -half),
				 corner(shoulder, -half)},
				s.hammerHeight};
	}
	// Wedge of 30 degrees, its edge 4 mm wide: ISO 148-2 rounds it with a radius of 2 mm.
	const double edge = 0.002, shoulder = front - (half - edge) / std::tan(15 * M_PI / 180);
	return {{corner(front, -edge), corner(front, edge), corner(shoulder, half), corner(-front, half),
			 corner(-front, -half), corner(shoulder, -half)},
			s.hammerHeight};
}

Shape pieceShape(const Settings& s) { return boxShape(s.height, s.width, s.length / numPieces(s)); }

Shape anvilShape(const Settings& s, bool left)
{
	const double half = s.anvilWidth / 2, height = 0.1;
	Shape shape = boxShape(2 * half, height, 2 * half);
	// ISO 148-2 wants the anvils' faces relieved by 11 degrees, so that they do not rub on what has passed their corners.
	const double relief = isPaper(s) ? 0 : 2 * half * std::tan(11 * M_PI / 180);
	if (left)
		shape.plan[2].setZ(btScalar(half - relief));
	else
		shape.plan[1].setZ(btScalar(relief - half));
	return shape;
}

btVector3 hammerCentre(const Settings& s) { return btVector3(btScalar(-s.hammerLength / 2), btScalar(-s.arm), 0); }

btVector3 hammerAxis(const Settings& s) { return btVector3(btScalar(s.shift - s.height), btScalar(s.arm), 0); }

btVector3 anvilCentre(const Settings& s, bool left)
{
	const double z = (s.gap + s.anvilWidth) / 2;
	return btVector3(btScalar(s.anvilWidth / 2), 0, btScalar(left ? -z : z));
}

btVector3 pieceCentre(const Settings& s, int i)
{
	const int n = numPieces(s);
	return btVector3(btScalar(-s.height / 2), 0, btScalar(s.length * ((i + 0.5) / n - 0.5)));
}

Parts::Parts(World& world, const Settings& s)
{
	const auto finish = [&s](btRigidBody* body)
	{
		// Bullet multiplies the two bodies' coefficients.
		body->setFriction(btScalar(std::sqrt(s.friction)));
		if (s.way == kinds::Rigid)
			body->setRestitution(btScalar(std::sqrt(s.restitution)));
		// Bullet brakes bodies before they touch, and what has been braked does not bounce.
		if (s.way == kinds::Rigid && s.preciseContacts)
			body->setContactProcessingThreshold(btScalar(1e-6 * s.lengthsPerMetre));
		return body;
	};
	for (int i = 0; i < 2; ++i)
	{
		btCollisionShape* const shape = makeShape(world, anvilShape(s, i == 0), s, isPaper(s));
		anvils[i] = finish(world.body(0, shape, at(s, anvilCentre(s, i == 0))));
	}
	const int n = numPieces(s);
	const double mass = s.density * s.length * s.width * s.height / n;
	for (int i = 0; i < n; ++i)
	{
		btCollisionShape* const block = makeShape(world, pieceShape(s), s, true);
		btRigidBody* const piece = finish(world.body(btScalar(mass), block, at(s, pieceCentre(s, i))));
		// Two alone need nothing of the kind, and a box has better contacts.
		if (n > 2)
			piece->setCollisionShape(makeShape(world, reachingShape(s, i), s, false));
		// The seat that bears its weight before the blow is left out.
		piece->setGravity(btVector3(0, 0, 0));
		// At the notch pieces overlap when they bend, which is no contact: neighbours' neighbours, too, if they are short.
		for (btRigidBody* other : pieces)
		{
			piece->setIgnoreCollisionCheck(other, true);
			other->setIgnoreCollisionCheck(piece, true);
		}
		pieces.push_back(piece);
	}
	const btVector3 centre = hammerCentre(s), released = hammerAxis(s) + turned(centre, -s.release);
	hammer = finish(world.body(btScalar(s.hammerMass), makeShape(world, hammerShape(s), s, false),
							   at(s, released, btScalar(-s.release))));
	bearing = new btHingeConstraint(*hammer, -centre * btScalar(s.lengthsPerMetre), btVector3(0, 0, 1), true);
	world.add(bearing);
}
}  // namespace ep::charpy
