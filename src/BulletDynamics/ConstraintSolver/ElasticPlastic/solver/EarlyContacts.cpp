// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "EarlyContacts.h"

#include "../joint/BodyGate.h"
#include "../joint/JointWorks.h"
#include "BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h"
#include "BulletCollision/BroadphaseCollision/btDispatcher.h"
#include "BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h"
#include "BulletCollision/CollisionDispatch/btManifoldResult.h"
#include "BulletCollision/CollisionShapes/btCapsuleShape.h"
#include "BulletCollision/CollisionShapes/btConeShape.h"
#include "BulletCollision/CollisionShapes/btCylinderShape.h"
#include "BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h"
#include "BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "ContactPlace.h"
#include "InnerSteps.h"
#include "LinearMath/btTransformUtil.h"

namespace btElasticPlastic
{
namespace
{
/// What comes closer or goes deeper by less than this in a step is found by Bullet soon enough [m].
const btScalar LEAST_WAY = btScalar(0.005);
/// Bodies that are nearer than this touch, to Bullet's conservative advancement [m].
const btScalar TOUCH = btScalar(0.001);
/// How far bodies are moved beyond where they meet, so that detectors that know penetration only find all of a face's points [m].
const btScalar INTO = btScalar(0.003);
/// Bodies that are no further apart than this may have touched in the step before [m].
const btScalar JUST_PARTED = btScalar(0.01);
/// The cosine of what normals of the same face differ by, at most.
const btScalar SAME_FACE = btScalar(0.9);
/// Where an island has more constraints than this, contacts are taken as Bullet finds them: those found early are solved exactly, and a large
/// structure that is hit takes twice the work for them.
const int MOST_LOOKED_AHEAD = 1500;

/// The body's own axis about which a shape is round; -1: none.
int getAxisOfSymmetry(const btCollisionShape& shape)
{
	switch (shape.getShapeType())
	{
		case CYLINDER_SHAPE_PROXYTYPE:
			return static_cast<const btCylinderShape&>(shape).getUpAxis();
		case CAPSULE_SHAPE_PROXYTYPE:
			return static_cast<const btCapsuleShape&>(shape).getUpAxis();
		case CONE_SHAPE_PROXYTYPE:
			return static_cast<const btConeShape&>(shape).getConeUpIndex();
		default:
			return -1;
	}
}

/// Of one of the two bodies, in the coming step.
struct Way
{
	btCollisionObject& m_object;
	const btScalar m_dt;
	btVector3 m_velocity{0, 0, 0}, m_spin{0, 0, 0};
	btTransform m_now, m_from, m_to;

	Way(const btCollisionObject& object, btScalar dt) : m_object(const_cast<btCollisionObject&>(object)), m_dt(dt)
	{
		const btRigidBody* const body = btRigidBody::upcast(&object);
		if (!body || !body->isActive() || body->isStaticObject())
			return;
		m_velocity = body->getLinearVelocity();
		m_spin = body->getAngularVelocity();
		if (!body->isKinematicObject())
			m_velocity += body->getTotalForce() * (body->getInvMass() * dt);
	}

	/// Not further than this does the body's surface go by its turn [m]. What is round and turns about its own axis stays where it is:
	/// a wheel that rolls.
	btScalar getTurnLength() const
	{
		const btCollisionShape& shape = *m_object.getCollisionShape();
		btVector3 turn = m_spin * m_dt;
		if (shape.getShapeType() == SPHERE_SHAPE_PROXYTYPE)
			return 0;
		const int axis = getAxisOfSymmetry(shape);
		if (axis >= 0)
		{
			const btVector3 along = m_object.getWorldTransform().getBasis().getColumn(axis);
			turn -= along * along.dot(turn);
		}
		btVector3 center;
		btScalar radius;
		shape.getBoundingSphere(center, radius);
		return (radius + center.length()) * turn.length();
	}

	btVector3 velocityAt(const btVector3& place) const
	{
		return m_velocity + m_spin.cross(place - m_object.getWorldTransform().getOrigin());
	}

	/// Looks up where the body is and where it goes.
	void findEnds()
	{
		m_now = m_from = m_to = m_object.getWorldTransform();
		// A kinematic body is already where it goes.
		const bool isThere = m_object.isKinematicObject();
		btTransformUtil::integrateTransform(m_now, m_velocity, m_spin, isThere ? -m_dt : m_dt, isThere ? m_from : m_to);
	}

	/// Has it stay where it is instead.
	void stay()
	{
		m_velocity.setZero();
		m_spin.setZero();
		m_from = m_to = m_now;
	}

	/// Puts the body to a share of its way.
	void go(btScalar share) const
	{
		m_object.setWorldTransform(btTransform(m_from.getRotation().slerp(m_to.getRotation(), share),
											   m_from.getOrigin().lerp(m_to.getOrigin(), share)));
	}
	void goBack() const { m_object.setWorldTransform(m_now); }
};

/// How far a body reaches into the box around another one from either side of it along that one's own axes, at most over several places [m].
struct DepthInBox
{
	btVector3 m_fromBelow = btVector3(-BT_LARGE_FLOAT, -BT_LARGE_FLOAT, -BT_LARGE_FLOAT), m_fromAbove = m_fromBelow;

	void add(const btCollisionShape& shape, const btTransform& place, const btCollisionShape& box,
			 const btTransform& boxPlace)
	{
		btVector3 from, to, boxFrom, boxTo;
		shape.getAabb(boxPlace.inverseTimes(place), from, to);
		box.getAabb(btTransform::getIdentity(), boxFrom, boxTo);
		m_fromBelow.setMax(to - boxFrom);
		m_fromAbove.setMax(boxTo - from);
	}

	/// From that side from which it is the least.
	btScalar least() const { return btMin(m_fromBelow[m_fromBelow.minAxis()], m_fromAbove[m_fromAbove.minAxis()]); }
};

/// Whether a body is beside the other one's box at the start of their ways as at the end, and on the same side of it, like a wheel on its road: whatever
/// their shapes are, they do not go far into each other between.
bool staysBeside(const Way& way, const Way& other)
{
	const btCollisionShape &shape = *way.m_object.getCollisionShape(), &box = *other.m_object.getCollisionShape();
	DepthInBox depth;
	depth.add(shape, way.m_from, box, other.m_from);
	depth.add(shape, way.m_to, box, other.m_to);
	return depth.least() < LEAST_WAY;
}

/// The share of their ways at which two bodies meet; 1: they do not, 0: they touch already.
btScalar shareAtMeeting(const Way ways[2])
{
	btVoronoiSimplexSolver simplex;
	btGjkEpaPenetrationDepthSolver depth;
	btContinuousConvexCollision cast(static_cast<const btConvexShape*>(ways[0].m_object.getCollisionShape()),
									 static_cast<const btConvexShape*>(ways[1].m_object.getCollisionShape()), &simplex,
									 &depth);
	btConvexCast::CastResult result;
	result.m_fraction = 1;
	const bool meet = cast.calcTimeOfImpact(ways[0].m_from, ways[0].m_to, ways[1].m_from, ways[1].m_to, result);
	return meet ? result.m_fraction : btScalar(1);
}

/// Puts points into a manifold whichever one the algorithm has made for itself.
struct PointsInto : btManifoldResult
{
	btPersistentManifold& m_manifold;

	PointsInto(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btPersistentManifold& manifold)
		: btManifoldResult(&a, &b), m_manifold(manifold)
	{
	}
	void addContactPoint(const btVector3& normal, const btVector3& point, btScalar depth) override
	{
		m_manifoldPtr = &m_manifold;
		btManifoldResult::addContactPoint(normal, point, depth);
	}
};

/// Has Bullet find the points of a pair where it is now.
void detect(const Way ways[2], btPersistentManifold& manifold, btDispatcher& dispatcher)
{
	const btCollisionObject &a = ways[0].m_object, &b = ways[1].m_object;
	const btCollisionObjectWrapper wrapA(nullptr, a.getCollisionShape(), &a, a.getWorldTransform(), -1, -1),
		wrapB(nullptr, b.getCollisionShape(), &b, b.getWorldTransform(), -1, -1);
	btCollisionAlgorithm* const algorithm =
		dispatcher.findAlgorithm(&wrapA, &wrapB, nullptr, BT_CONTACT_POINT_ALGORITHMS);
	if (!algorithm)
		return;
	PointsInto result(wrapA, wrapB, manifold);
	algorithm->processCollision(&wrapA, &wrapB, btDispatcherInfo(), &result);
	algorithm->~btCollisionAlgorithm();
	dispatcher.freeCollisionAlgorithm(algorithm);
}

bool isCandidate(const btPersistentManifold& manifold, Islands& islands)
{
	const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
	return manifold.getNumContacts() < MANIFOLD_CACHE_SIZE && (islands.isJoined(a) || islands.isJoined(b)) &&
		   a.getCollisionShape()->isConvex() && b.getCollisionShape()->isConvex() &&
		   islands.countConstraints(a, b) <= MOST_LOOKED_AHEAD;
}

/// What would bounce when it touches, if there were inner steps for it, bounces where it is: of a gap Bullet's row takes the speed at which it closes off
/// the one with which bodies part.
void closeGaps(btPersistentManifold& manifold, btScalar dt)
{
	const Way ways[2] = {Way(*manifold.getBody0(), dt), Way(*manifold.getBody1(), dt)};
	for (int i = 0; i < manifold.getNumContacts(); ++i)
	{
		btManifoldPoint& point = manifold.getContactPoint(i);
		const btScalar approach =
			(ways[1].velocityAt(point.m_positionWorldOnB) - ways[0].velocityAt(point.m_positionWorldOnA))
				.dot(point.m_normalWorldOnB);
		if (point.m_distance1 > 0 && point.m_distance1 < approach * dt)
			point.m_distance1 = 0;
	}
}

/// Where a pair touches at an edge or a corner, the rest of the face may follow as it turns: adds the points of the same face that are no further apart than the
/// bodies go.
void addRestOfFace(const Way ways[2], btPersistentManifold& manifold, btDispatcher& dispatcher)
{
	const btVector3 normal = manifold.getContactPoint(0).m_normalWorldOnB;
	const btScalar length = btFabs(normal.dot(ways[1].m_velocity - ways[0].m_velocity)) * ways[0].m_dt +
							ways[0].getTurnLength() + ways[1].getTurnLength();
	const auto isOfFace = [&](const btManifoldPoint& point) { return point.m_normalWorldOnB.dot(normal) > SAME_FACE; };
	for (btScalar reach = length; reach > LEAST_WAY; reach /= 4)
	{
		btPersistentManifold face(&ways[0].m_object, &ways[1].m_object, 0, manifold.getContactBreakingThreshold(),
								  manifold.getContactProcessingThreshold());
		btTransform nearer = ways[0].m_now;
		nearer.setOrigin(nearer.getOrigin() - normal * reach);
		ways[0].m_object.setWorldTransform(nearer);
		detect(ways, face, dispatcher);
		ways[0].goBack();
		bool isAny = false;
		for (int i = 0; i < face.getNumContacts(); ++i)
		{
			btManifoldPoint& point = face.getContactPoint(i);
			if (!isOfFace(point))
				continue;
			isAny = true;
			placeContact(point, ways[0].m_now, ways[1].m_now);
			if (point.m_distance1 > 0 && manifold.getNumContacts() < MANIFOLD_CACHE_SIZE &&
				manifold.getCacheEntry(point) < 0)
				manifold.addManifoldPoint(point);
		}
		// Too near, bodies lie in each other along another normal.
		if (isAny)
			return;
	}
}

/// Finds the points at which two bodies meet on their ways. \return whether they do
bool findMeeting(const Way ways[2], btScalar length, btPersistentManifold& manifold, btDispatcher& dispatcher)
{
	if (staysBeside(ways[0], ways[1]) || staysBeside(ways[1], ways[0]))
		return false;
	const btScalar share = shareAtMeeting(ways);
	if (!(share < 1))
		return false;
	// Further where the bodies move along each other rather than into each other.
	for (btScalar into = INTO / length; manifold.getNumContacts() == 0 && share + into < 1 + INTO / length; into *= 4)
	{
		for (int side = 0; side < 2; ++side)
			ways[side].go(share + into);
		detect(ways, manifold, dispatcher);
	}
	for (int side = 0; side < 2; ++side)
		ways[side].goBack();
	// What touches as the step begins has no points yet where its detector knows penetration only.
	const btScalar least = share > 0 ? btScalar(0) : -TOUCH;
	bool isAhead = true;
	for (int i = 0; i < manifold.getNumContacts(); ++i)
	{
		btManifoldPoint& point = manifold.getContactPoint(i);
		placeContact(point, ways[0].m_now, ways[1].m_now);
		isAhead &= point.m_distance1 >= least;
	}
	// Bodies that do not touch yet, but lie in each other along the normal, do not come together that way: an edge passes by a face.
	if (!isAhead)
		manifold.clearManifold();
	return manifold.getNumContacts() > 0;
}

/// By the boxes around them, now.
bool areNear(const Way ways[2])
{
	btVector3 from[2], to[2];
	for (int side = 0; side < 2; ++side)
		ways[side].m_object.getCollisionShape()->getAabb(ways[side].m_now, from[side], to[side]);
	const btVector3 gap = from[0] - to[1], other = from[1] - to[0];
	return gap[gap.maxAxis()] < JUST_PARTED && other[other.maxAxis()] < JUST_PARTED;
}

/// \param held  which of the two its joints hold back while the other one is loose, -1: neither
void findContact(btPersistentManifold& manifold, btScalar dt, int held, btDispatcher& dispatcher)
{
	Way ways[2] = {Way(*manifold.getBody0(), dt), Way(*manifold.getBody1(), dt)};
	const auto lengthOfWays = [&] {
		return (ways[1].m_velocity - ways[0].m_velocity).length() * dt + ways[0].getTurnLength() +
			   ways[1].getTurnLength();
	};
	// A share of a way without end is no place.
	const auto isWay = [](btScalar length) { return length > LEAST_WAY && btElasticPlasticIsFinite(length); };
	btScalar length = lengthOfWays();
	if (!isWay(length))
		return;
	for (Way& way : ways)
		way.findEnds();
	if (manifold.getNumContacts() > 0)
	{
		addRestOfFace(ways, manifold, dispatcher);
		return;
	}
	if (findMeeting(ways, length, manifold, dispatcher) || held < 0 || !areNear(ways))
		return;
	// What has been struck is faster than what has struck it, and its joints bring it back within the step.
	ways[held].stay();
	length = lengthOfWays();
	if (!isWay(length) || !findMeeting(ways, length, manifold, dispatcher))
		return;
	btScalar nearest = manifold.getContactPoint(0).m_distance1;
	for (int i = 1; i < manifold.getNumContacts(); ++i)
		btSetMin(nearest, manifold.getContactPoint(i).m_distance1);
	if (nearest > JUST_PARTED)
		manifold.clearManifold();
}
}  // namespace

bool EarlyContacts::find(SolverGroup& group, Islands& islands, btScalar dt,
						 const btElasticPlasticSolverSettings& settings, btDispatcher& dispatcher)
{
	bool doMeet = false;
	// Bullet's algorithms make manifolds for themselves, and the group's may be in the dispatcher's own array.
	m_manifolds.assign(group.m_manifolds, group.m_manifolds + group.m_numManifolds);
	group.m_manifolds = m_manifolds.data();
	for (btPersistentManifold* manifold : m_manifolds)
	{
		if (!isCandidate(*manifold, islands))
			continue;
		const btCollisionObject &a = *manifold->getBody0(), &b = *manifold->getBody1();
		const bool wasEmpty = manifold->getNumContacts() == 0,
				   areJoined[2] = {islands.isJoined(a), islands.isJoined(b)};
		findContact(*manifold, dt, areJoined[0] == areJoined[1] ? -1 : areJoined[0] ? 0 : 1, dispatcher);
		if (!wasEmpty || manifold->getNumContacts() == 0)
			continue;
		doMeet = true;
		const bool bounces = a.getRestitution() * b.getRestitution() != 0;
		if (bounces && !InnerSteps::mayBounce(islands.countConstraints(a, b), settings))
			closeGaps(*manifold, dt);
	}
	return doMeet;
}
}  // namespace btElasticPlastic
