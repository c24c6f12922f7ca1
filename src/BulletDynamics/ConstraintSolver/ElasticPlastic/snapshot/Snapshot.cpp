// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Snapshot.h"

#include <algorithm>
#include <unordered_map>

#include "../../btElasticPlasticAction.h"
#include "../../btElasticPlasticSolverSettings.h"
#include "../joint/JointRegistry.h"
#include "../joint/JointWorks.h"
#include "BroadphaseState.h"
#include "BulletCollision/BroadphaseCollision/btDbvtBroadphase.h"
#include "BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h"
#include "BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h"
#include "BulletCollision/CollisionDispatch/btCompoundCollisionAlgorithm.h"
#include "BulletCollision/CollisionDispatch/btManifoldResult.h"
#include "BulletCollision/CollisionShapes/btCompoundShape.h"
#include "BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h"

namespace btElasticPlastic
{
namespace
{
/// What Bullet shows to derived classes only.
struct WorldParts : btDiscreteDynamicsWorld
{
	static btAlignedObjectArray<btTypedConstraint*>& constraintsOf(btDiscreteDynamicsWorld& world)
	{
		return world.*(&WorldParts::m_constraints);
	}
	static btScalar& leftOverOf(btDiscreteDynamicsWorld& world) { return world.*(&WorldParts::m_localTime); }
	static btScalar& fixedStepOf(btDiscreteDynamicsWorld& world) { return world.*(&WorldParts::m_fixedTimeStep); }
};

struct CompoundParts : btCompoundCollisionAlgorithm
{
	static btAlignedObjectArray<btCollisionAlgorithm*>& childrenOf(btCollisionAlgorithm& algorithm)
	{
		return static_cast<btCompoundCollisionAlgorithm&>(algorithm).*(&CompoundParts::m_childCollisionAlgorithms);
	}
};

/// Which of two objects is a compound that Bullet's dispatcher has an algorithm for that goes child by child. \return -1: none.
/// That of two compounds shows its children to nobody.
int compoundOf(const btCollisionObject& a, const btCollisionObject& b)
{
	const btCollisionShape* const shapes[2] = {a.getCollisionShape(), b.getCollisionShape()};
	for (int i = 0; i < 2; ++i)
	{
		const int other = shapes[1 - i]->getShapeType();
		if (shapes[i]->isCompound() && (btBroadphaseProxy::isConvex(other) || btBroadphaseProxy::isConcave(other)) &&
			other != GIMPACT_SHAPE_PROXYTYPE)
			return i;
	}
	return -1;
}

/// The highest of Bullet's activation states, FIXED_BASE_MULTI_BODY, which Bullet 2.89 does not name yet.
const int LAST_ACTIVATION = 6;

bool isBodyOf(const btCollisionObject& object) { return btRigidBody::upcast(&object) != nullptr; }

btElasticPlasticFault foreign(const char* what, double value)
{
	return btElasticPlasticFault(what, btScalar(value), "that of the world from which the snapshot was taken");
}

/// Whether each of the numbers from 0 on occurs once.
bool isPermutation(std::vector<int> numbers)
{
	std::sort(numbers.begin(), numbers.end());
	for (size_t i = 0; i < numbers.size(); ++i)
		if (numbers[i] != int(i))
			return false;
	return true;
}

/// Substeps that nobody has committed, before a joint is refused; generously.
const int MOST_UNCOMMITTED = 100;

/// Whether there can be a joint as an image shows it, whatever its bodies are: a saved game may have been written by anybody.
bool isSound(const JointImage& image)
{
	const btElasticPlasticCapacity& capacity = image.m_capacity;
	unsigned dofs = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		dofs |= unsigned(capacity.isElasticPlastic(i)) << i;
	return !capacity.fault() && dofs == image.m_dofs && !findNumberFault(image.m_state) &&
		   image.m_state.m_fibres.size() == capacity.m_fibres.size() &&
		   std::all_of(image.m_levels, image.m_levels + BT_EP_QUANTITY_COUNT, &Levels::isLevel) &&
		   areBounds(image.m_lastBounds, image.m_lastFibreBounds, capacity) && image.m_numUncommitted >= 0 &&
		   image.m_numUncommitted <= MOST_UNCOMMITTED && image.m_nextRequest >= 0 && image.m_nextRequest <= 2;
}

uint64_t keyOf(int first, int second) { return uint64_t(unsigned(first)) << 32 | unsigned(second); }
}  // namespace

Snapshot::Snapshot(btDiscreteDynamicsWorld& world, btDbvtBroadphase& broadphase, btElasticPlasticAction& action)
	: m_world(world), m_broadphase(broadphase), m_registry(*action.m_registry)
{
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	for (int i = 0; i < objects.size(); ++i)
		if (objects[i] != m_registry.getMark())
			m_objects.push_back(objects[i]);
	std::sort(m_objects.begin(), m_objects.end(),
			  [](const btCollisionObject* a, const btCollisionObject* b)
			  { return a->getBroadphaseHandle()->getUid() < b->getBroadphaseHandle()->getUid(); });
	for (size_t i = 0; i < m_objects.size(); ++i)
		m_ranks.insert(btHashPtr(m_objects[i]), int(i));
	for (int i = 0; i < m_registry.getNumJoints(); ++i)
	{
		JointWorks& joint = m_registry.getJoint(i);
		if (joint.m_entry.m_number >= int(m_joints.size()))
			m_joints.resize(size_t(joint.m_entry.m_number) + 1, nullptr);
		m_joints[size_t(joint.m_entry.m_number)] = &joint;
	}
}

/// Does not look at the object: a joint that a user has taken out of the world may outlive its bodies. \return -1: not in the world
int Snapshot::rankOf(const btCollisionObject& object) const
{
	const int* const found = m_ranks.find(btHashPtr(&object));
	return found ? *found : -1;
}

/// Whether a joint's bodies are in the world, or the one that Bullet has for all worlds.
bool Snapshot::hasBodies(const JointWorks& joint) const
{
	const auto isThere = [this](const btRigidBody& body)
	{ return rankOf(body) >= 0 || &body == &btTypedConstraint::getFixedBody(); };
	return isThere(joint.m_model.bodyA()) && isThere(joint.m_model.bodyB());
}

ConstraintImage Snapshot::describe(btTypedConstraint& constraint) const
{
	ConstraintImage image;
	const JointWorks* const joint = JointWorks::from(&constraint);
	if (joint && joint->m_entry.m_registry == &m_registry)
		image.m_joint = joint->m_entry.m_number;
	image.m_bodies[0] = rankOf(constraint.getRigidBodyA());
	image.m_bodies[1] = rankOf(constraint.getRigidBodyB());
	image.m_type = constraint.getConstraintType();
	image.m_isEnabled = constraint.isEnabled();
	return image;
}

// ---- reading

namespace
{
/// Writes a list of so many images, each made in the place of the one before: a large world's image as a whole would take as long to find
/// memory for as to write.
/// \param save  fills an image and writes it
template <class Image, class Save>
void saveList(Writer& writer, size_t count, Save save)
{
	uint32_t length = uint32_t(count);
	writer(length);
	Image image;
	for (size_t i = 0; i < count; ++i)
		save(i, image);
}
}  // namespace

void Snapshot::readObject(const btCollisionObject& object, ObjectImage& image) const
{
	image.m_pose = object.getWorldTransform();
	image.m_interpolatedPose = object.getInterpolationWorldTransform();
	image.m_interpolatedVelocity = object.getInterpolationLinearVelocity();
	image.m_interpolatedSpin = object.getInterpolationAngularVelocity();
	image.m_flags = object.getCollisionFlags();
	image.m_activation = object.getActivationState();
	image.m_worldIndex = object.getWorldArrayIndex();
	image.m_timeAtRest = object.getDeactivationTime();
	image.m_isBody = isBodyOf(object);
	if (!image.m_isBody)
		return;
	const btRigidBody& body = *btRigidBody::upcast(&object);
	// A mass that is infinite may leave a zero with a sign, which does not tell one body from another.
	image.m_inverseMass = body.getInvMass() + btScalar(0);
	image.m_velocity = body.getLinearVelocity();
	image.m_spin = body.getAngularVelocity();
	image.m_force = body.getTotalForce();
	image.m_torque = body.getTotalTorque();
}

/// All but state and capacity.
void Snapshot::readJoint(const JointWorks& joint, JointImage& image) const
{
	const JointModel& model = joint.m_model;
	image.m_number = joint.m_entry.m_number;
	image.m_bodies[0] = rankOf(model.bodyA());
	image.m_bodies[1] = rankOf(model.bodyB());
	for (int q = 0; q < BT_EP_QUANTITY_COUNT; ++q)
		image.m_levels[q] = joint.m_levels.get(btElasticPlasticQuantity(q));
	image.m_dofs = model.m_dofs;
	image.m_isPaper = model.m_isPaper;
	image.m_isByMode = model.m_isByMode;
	image.m_hasReference = model.m_hasReference;
	image.m_isEnabled = model.m_constraint.isEnabled();
	image.m_isRefused = bool(model.m_refused);
	std::copy_n(joint.m_step.getLastBounds(), int(BT_EP_DOF_COUNT), image.m_lastBounds);
	image.m_lastFibreBounds = joint.m_step.getLastFibreBounds();
	image.m_numUncommitted = joint.getNumUncommitted();
	image.m_nextRequest = joint.getNextRequest();
	image.m_isSeparating = joint.m_separation.isUnderWay();
	image.m_overlap = joint.m_separation.getOverlap();
}

/// Of bodies that are still in the world: a body of the last substep may have left it since.
std::vector<MotionImage> Snapshot::readMotions() const
{
	std::vector<MotionImage> images;
	for (const BodyMotion& motion : m_registry.getMotions())
		if (rankOf(*motion.m_body) >= 0)
			images.push_back({rankOf(*motion.m_body), motion.m_inner, motion.m_isTouched});
	return images;
}

std::vector<LoadImage> Snapshot::readLoads() const
{
	std::vector<LoadImage> images;
	for (const LoadHistory& history : m_registry.getLoads())
		if (rankOf(*history.m_body) >= 0)
			images.push_back({rankOf(*history.m_body), history});
	return images;
}

std::vector<EventImage> Snapshot::readEvents() const
{
	std::vector<EventImage> images;
	for (int i = 0; i < m_registry.getEvents().getCount(); ++i)
	{
		EventImage image;
		image.m_event = m_registry.getEvents().get(i);
		image.m_joint = JointWorks::from(&image.m_event.m_joint->getConstraint())->m_entry.m_number;
		image.m_type = image.m_event.m_type;
		image.m_quantity = image.m_event.m_quantity;
		images.push_back(image);
	}
	return images;
}

namespace
{
size_t countManifolds(btCollisionAlgorithm& algorithm)
{
	btManifoldArray manifolds;
	algorithm.getAllContactManifolds(manifolds);
	return size_t(manifolds.size());
}

/// As PairImage::m_children. One whose shape has changed since the last step is made anew by Bullet.
void countOfChildren(const btCollisionObject& a, const btCollisionObject& b, btCollisionAlgorithm& algorithm,
					 std::vector<int>& counts)
{
	const int side = compoundOf(a, b);
	if (side < 0)
		return;
	const btCollisionShape& shape = *(side == 0 ? a : b).getCollisionShape();
	const btAlignedObjectArray<btCollisionAlgorithm*>& children = CompoundParts::childrenOf(algorithm);
	if (children.size() == static_cast<const btCompoundShape&>(shape).getNumChildShapes())
		for (int i = 0; i < children.size(); ++i)
			counts.push_back(children[i] ? int(countManifolds(*children[i])) : -1);
}
}  // namespace

/// \param manifolds  room for the pair's
void Snapshot::readPair(const btBroadphasePair& pair, btManifoldArray& manifolds, PairImage& image) const
{
	const btCollisionObject& a = *static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject);
	const btCollisionObject& b = *static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject);
	image.m_objects[0] = rankOf(a);
	image.m_objects[1] = rankOf(b);
	image.m_hasAlgorithm = pair.m_algorithm != nullptr;
	image.m_children.clear();
	manifolds.resize(0);
	if (pair.m_algorithm)
	{
		pair.m_algorithm->getAllContactManifolds(manifolds);
		countOfChildren(a, b, *pair.m_algorithm, image.m_children);
	}
	image.m_manifolds.resize(size_t(manifolds.size()));
	for (int m = 0; m < manifolds.size(); ++m)
	{
		ManifoldImage& to = image.m_manifolds[size_t(m)];
		to.m_place = manifolds[m]->m_index1a;
		to.m_points.clear();
		for (int p = 0; p < manifolds[m]->getNumContacts(); ++p)
			to.m_points.push_back(manifolds[m]->getContactPoint(p));
	}
}

void Snapshot::save(Writer& writer) const
{
	saveList<ObjectImage>(writer, m_objects.size(),
						  [&](size_t i, ObjectImage& image)
						  {
							  readObject(*m_objects[i], image);
							  transfer(writer, image);
						  });
	bool hasToken = m_registry.getMark() != nullptr;
	writer(hasToken);
	saveList<JointImage>(writer, size_t(m_registry.getNumJoints()),
						 [&](size_t i, JointImage& image)
						 {
							 // What is largest is not copied. Writing changes nothing.
							 JointModel& model = m_registry.getJoint(int(i)).m_model;
							 readJoint(m_registry.getJoint(int(i)), image);
							 transfer(writer, image, model.m_state, model.m_capacity);
						 });
	std::vector<MotionImage> motions = readMotions();
	transferList(writer, motions);
	std::vector<LoadImage> loads = readLoads();
	transferList(writer, loads);
	saveList<ConstraintImage>(writer, size_t(m_world.getNumConstraints()),
							  [&](size_t i, ConstraintImage& image)
							  {
								  image = describe(*m_world.getConstraint(int(i)));
								  transfer(writer, image);
							  });
	std::vector<EventImage> events = readEvents();
	transferList(writer, events);
	const btBroadphasePairArray& pairs = m_broadphase.getOverlappingPairCache()->getOverlappingPairArray();
	btManifoldArray manifolds;
	saveList<PairImage>(writer, size_t(pairs.size()),
						[&](size_t i, PairImage& image)
						{
							readPair(pairs[int(i)], manifolds, image);
							transfer(writer, image);
						});
	std::vector<btCollisionObject*> objects = m_objects;
	if (hasToken)
		objects.push_back(m_registry.getMark());
	BroadphaseImage broadphase = BroadphaseState(m_broadphase, objects).read();
	transfer(writer, broadphase);
	double time = m_registry.getTime();
	btScalar leftOver = WorldParts::leftOverOf(m_world), fixedStep = WorldParts::fixedStepOf(m_world);
	writer(time);
	writer(leftOver);
	writer(fixedStep);
}

void Snapshot::leaveFactors()
{
	for (JointWorks* joint : m_joints)
		if (joint)
			joint->leaveFactor();
}

// ---- what does not fit

btElasticPlasticFault Snapshot::findForeignObject(const WorldImage& image) const
{
	if (image.m_objects.size() != m_objects.size())
		return foreign("number of collision objects in the world", double(m_objects.size()));
	std::vector<int> indices;
	for (size_t i = 0; i < m_objects.size(); ++i)
	{
		const ObjectImage& object = image.m_objects[i];
		const btRigidBody* const body = btRigidBody::upcast(m_objects[i]);
		if (object.m_isBody != (body != nullptr))
			return foreign("type of a collision object", m_objects[i]->getInternalType());
		if (body && object.m_inverseMass != body->getInvMass())
			return foreign("inverse mass of a body [1/kg]", double(body->getInvMass()));
		if (object.m_activation < ACTIVE_TAG || object.m_activation > LAST_ACTIVATION)
			return foreign("activation state in the snapshot", object.m_activation);
		indices.push_back(object.m_worldIndex);
	}
	// The registry's own object has a place among them, too.
	const size_t last = m_objects.size();
	if (image.m_hasToken)
	{
		int gap = int(last);
		std::sort(indices.begin(), indices.end());
		for (size_t i = 0; i < last && gap == int(last); ++i)
			if (indices[i] != int(i))
				gap = int(i);
		indices.push_back(gap);
	}
	if (!isPermutation(indices))
		return foreign("number of places in the world's list of objects", double(last));
	return btElasticPlasticFault();
}

btElasticPlasticFault Snapshot::findForeignJoint(const WorldImage& image) const
{
	if (int(image.m_joints.size()) != m_registry.getNumJoints())
		return foreign("number of joints that the action knows", m_registry.getNumJoints());
	std::vector<char> seen(m_joints.size(), 0);
	bool isBroken = false, isSeparating = false;
	for (const JointImage& joint : image.m_joints)
	{
		const size_t number = size_t(joint.m_number);
		if (joint.m_number < 0 || number >= m_joints.size() || !m_joints[number] || seen[number])
			return foreign("number of a joint", joint.m_number);
		seen[number] = 1;
		const JointModel& model = m_joints[number]->m_model;
		if (joint.m_bodies[0] != rankOf(model.bodyA()) || joint.m_bodies[1] != rankOf(model.bodyB()))
			return foreign("number of a joint between these bodies", joint.m_number);
		if (!isSound(joint) || (!hasBodies(*m_joints[number]) && joint.m_state.m_broken != model.m_state.m_broken))
			return foreign("state of a joint with the number", joint.m_number);
		// Broken ones come last.
		if (isBroken && !joint.m_state.m_broken)
			return foreign("number of a joint that holds", joint.m_number);
		isBroken = joint.m_state.m_broken;
		isSeparating |= joint.m_isSeparating;
		if (joint.m_isSeparating && !isBroken)
			return foreign("state of a joint with the number", joint.m_number);
	}
	if (isSeparating != image.m_hasToken)
		return foreign("number of joints whose bodies separate", isSeparating);
	return btElasticPlasticFault();
}

btTypedConstraint* Snapshot::findConstraint(const ConstraintImage& image, std::vector<btTypedConstraint*>& left) const
{
	if (image.m_joint >= 0)
		return size_t(image.m_joint) < m_joints.size() && m_joints[size_t(image.m_joint)]
				   ? &m_joints[size_t(image.m_joint)]->m_model.m_constraint
				   : nullptr;
	for (btTypedConstraint*& constraint : left)
	{
		if (!constraint)
			continue;
		const ConstraintImage other = describe(*constraint);
		if (other.m_joint >= 0 || other.m_type != image.m_type || other.m_bodies[0] != image.m_bodies[0] ||
			other.m_bodies[1] != image.m_bodies[1])
			continue;
		btTypedConstraint* const found = constraint;
		constraint = nullptr;
		return found;
	}
	return nullptr;
}

namespace
{
std::vector<btTypedConstraint*> constraintsIn(btDiscreteDynamicsWorld& world)
{
	std::vector<btTypedConstraint*> constraints;
	for (int i = 0; i < world.getNumConstraints(); ++i)
		constraints.push_back(world.getConstraint(i));
	return constraints;
}
}  // namespace

/// The world has to have all of the image's constraints but those joints that are broken now, and no others but joints that are broken
/// in the image.
btElasticPlasticFault Snapshot::findForeignConstraint(const WorldImage& image) const
{
	std::vector<btTypedConstraint*> left = constraintsIn(m_world);
	std::vector<char> isThere(m_joints.size(), 0), isToBe(m_joints.size(), 0);
	size_t numOthers = 0;
	for (btTypedConstraint* constraint : left)
	{
		const ConstraintImage there = describe(*constraint);
		if (there.m_joint >= 0)
			isThere[size_t(there.m_joint)] = 1;
		else
			++numOthers;
	}
	size_t numOthersToBe = 0;
	for (const ConstraintImage& constraint : image.m_constraints)
	{
		if (!findConstraint(constraint, left))
			return foreign("number of constraints in the world", m_world.getNumConstraints());
		if (constraint.m_joint < 0)
			++numOthersToBe;
		else if (isToBe[size_t(constraint.m_joint)]++)
			return foreign("number of a joint in the world", constraint.m_joint);
	}
	if (numOthers != numOthersToBe)
		return foreign("number of constraints in the world that are no joints of the action", double(numOthers));
	for (const JointImage& joint : image.m_joints)
	{
		const size_t number = size_t(joint.m_number);
		// Broken ones that separate come into the world and leave it without the user.
		const bool wasBroken = m_joints[number]->m_model.m_state.m_broken;
		const bool isUsers = !wasBroken && !joint.m_state.m_broken && isThere[number] != isToBe[number];
		if (isUsers ||
			(joint.m_state.m_broken ? joint.m_isSeparating != bool(isToBe[number]) : wasBroken && !isToBe[number]))
			return foreign("number of a joint that is in the world or not", joint.m_number);
	}
	return btElasticPlasticFault();
}

namespace
{
template <class T>
bool isWithoutDoubles(std::vector<T>& values)
{
	std::sort(values.begin(), values.end());
	return std::adjacent_find(values.begin(), values.end()) == values.end();
}
}  // namespace

bool Snapshot::arePairsSound(const WorldImage& image) const
{
	std::vector<uint64_t> keys;
	std::vector<int> places;
	for (const PairImage& pair : image.m_pairs)
	{
		const int a = pair.m_objects[0], b = pair.m_objects[1];
		// By uid, and so by rank, as Bullet keeps them.
		if (a < 0 || b <= a || size_t(b) >= m_objects.size())
			return false;
		keys.push_back(keyOf(a, b));
		const int side = compoundOf(*m_objects[size_t(a)], *m_objects[size_t(b)]);
		const btCollisionShape* const compound =
			side < 0 ? nullptr : m_objects[size_t(pair.m_objects[side])]->getCollisionShape();
		if (!pair.m_children.empty() &&
			(!compound ||
			 int(pair.m_children.size()) != static_cast<const btCompoundShape*>(compound)->getNumChildShapes()))
			return false;
		for (const ManifoldImage& manifold : pair.m_manifolds)
		{
			if (manifold.m_points.size() > MANIFOLD_CACHE_SIZE || manifold.m_place < 0)
				return false;
			places.push_back(manifold.m_place);
		}
	}
	// Places of others, which some other object's algorithms own, may stand between them.
	return isWithoutDoubles(keys) && isWithoutDoubles(places);
}

bool Snapshot::areMotionsSound(const WorldImage& image) const
{
	const auto isBody = [&](int object)
	{ return object >= 0 && size_t(object) < m_objects.size() && isBodyOf(*m_objects[size_t(object)]); };
	for (const MotionImage& motion : image.m_motions)
		if (!isBody(motion.m_object))
			return false;
	for (const LoadImage& load : image.m_loads)
		if (!isBody(load.m_object))
			return false;
	return true;
}

namespace
{
/// So that a spoilt file asks for no memory.
const int FIBRES_OF_AN_EVENT = 1 << 20;
}  // namespace

bool Snapshot::areEventsSound(const WorldImage& image) const
{
	for (const EventImage& event : image.m_events)
	{
		if (event.m_joint < 0 || size_t(event.m_joint) >= m_joints.size() || !m_joints[size_t(event.m_joint)] ||
			event.m_type < BT_EP_EVENT_YIELD || event.m_type > BT_EP_EVENT_RUPTURE || event.m_quantity < 0 ||
			event.m_quantity > BT_EP_QUANTITY_COUNT ||
			(event.m_type == BT_EP_EVENT_LEVEL && event.m_quantity == BT_EP_QUANTITY_COUNT) ||
			!btElasticPlasticIsDof(event.m_event.m_dof))
			return false;
		const bool isOfFibre = event.m_type == BT_EP_EVENT_CRACK || event.m_type == BT_EP_EVENT_RUPTURE;
		if (isOfFibre != (event.m_event.m_fibre >= 0) || event.m_event.m_fibre >= FIBRES_OF_AN_EVENT)
			return false;
	}
	return true;
}

bool Snapshot::isBetweenSteps() const { return !m_registry.isBusy(); }

bool Snapshot::isOfAnotherWorld() const { return m_registry.hasMarkedAnother(m_world); }

btElasticPlasticFault Snapshot::findMismatch(const WorldImage& image) const
{
	if (const btElasticPlasticFault fault = findForeignObject(image))
		return fault;
	if (const btElasticPlasticFault fault = findForeignJoint(image))
		return fault;
	if (const btElasticPlasticFault fault = findForeignConstraint(image))
		return fault;
	if (!arePairsSound(image))
		return foreign("number of pairs", double(image.m_pairs.size()));
	if (!areMotionsSound(image))
		return foreign("number of bodies in inner steps", double(image.m_motions.size()));
	if (!areEventsSound(image))
		return foreign("number of events", double(image.m_events.size()));
	if (!BroadphaseState::isSound(image.m_broadphase, int(m_objects.size()) + image.m_hasToken))
		return foreign("number of objects in the broadphase", double(m_objects.size()));
	return btElasticPlasticFault();
}

// ---- writing

void Snapshot::writeRegistry(const WorldImage& image)
{
	std::vector<JointRegistry::Standing> standings;
	for (const JointImage& joint : image.m_joints)
		standings.push_back(
			{m_joints[size_t(joint.m_number)], joint.m_state.m_broken, joint.m_isSeparating, joint.m_overlap});
	m_registry.arrange(m_world, standings.data(), int(standings.size()), image.m_time);
	for (const JointImage& from : image.m_joints)
	{
		JointWorks& joint = *m_joints[size_t(from.m_number)];
		joint.m_model.m_state = from.m_state;
		joint.m_model.setCapacity(from.m_capacity);
		for (int q = 0; q < BT_EP_QUANTITY_COUNT; ++q)
			joint.m_levels.set(btElasticPlasticQuantity(q), from.m_levels[q]);
		joint.m_model.m_dofs = from.m_dofs;
		joint.m_model.m_isPaper = from.m_isPaper;
		joint.m_model.m_isByMode = from.m_isByMode;
		joint.m_model.m_hasReference = from.m_hasReference;
		joint.m_model.m_constraint.setEnabled(from.m_isEnabled);
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			joint.m_step.setLastBound(dof, from.m_lastBounds[dof]);
		joint.m_step.setLastFibreBounds(from.m_lastFibreBounds);
		joint.resume(from.m_numUncommitted, from.m_nextRequest);
		if (!from.m_isRefused)
			joint.m_model.m_refused = btElasticPlasticFault();
		else if (!joint.m_model.m_refused)
			joint.m_model.m_refused =
				btElasticPlasticFault("number of valid capacities since one was refused", 0, "1: call setCapacity");
		// Which may be told from the bodies.
		if (hasBodies(joint))
			joint.setFault(joint.m_model.findFault());
	}
	for (const EventImage& from : image.m_events)
	{
		JointWorks& joint = *m_joints[size_t(from.m_joint)];
		btElasticPlasticEvent event = from.m_event;
		event.m_type = btElasticPlasticEventType(from.m_type);
		event.m_quantity = btElasticPlasticQuantity(from.m_quantity);
		event.m_joint = &joint.m_joint;
		event.m_bodyA = &joint.m_model.bodyA();
		event.m_bodyB = &joint.m_model.bodyB();
		m_registry.addEvent(event, joint);
	}
}

void Snapshot::writeMotions(const WorldImage& image)
{
	std::vector<BodyMotion> motions;
	for (const MotionImage& from : image.m_motions)
	{
		BodyMotion motion;
		motion.m_body = btRigidBody::upcast(m_objects[size_t(from.m_object)]);
		motion.m_inner = from.m_inner;
		motion.m_isTouched = from.m_isTouched;
		motions.push_back(motion);
	}
	m_registry.setMotions(motions);
	std::vector<LoadHistory> loads;
	for (const LoadImage& from : image.m_loads)
	{
		LoadHistory history = from.m_history;
		history.m_body = btRigidBody::upcast(m_objects[size_t(from.m_object)]);
		history.m_proxy = history.m_body->getBroadphaseHandle()->getUid();
		loads.push_back(history);
	}
	m_registry.setLoads(loads);
}

void Snapshot::writeConstraints(const WorldImage& image)
{
	std::vector<btTypedConstraint*> left = constraintsIn(m_world);
	btAlignedObjectArray<btTypedConstraint*>& constraints = WorldParts::constraintsOf(m_world);
	constraints.resize(0);
	for (const ConstraintImage& from : image.m_constraints)
	{
		btTypedConstraint* const constraint = findConstraint(from, left);
		if (from.m_joint < 0)
			constraint->setEnabled(from.m_isEnabled);
		constraints.push_back(constraint);
	}
}

void Snapshot::writeObjects(const WorldImage& image)
{
	btCollisionObjectArray& order = m_world.getCollisionObjectArray();
	const btCollisionObject* const mark = m_registry.getMark();
	std::vector<btCollisionObject*> places(size_t(order.size()), const_cast<btCollisionObject*>(mark));
	for (size_t i = 0; i < m_objects.size(); ++i)
	{
		const ObjectImage& from = image.m_objects[i];
		btCollisionObject& object = *m_objects[i];
		places[size_t(from.m_worldIndex)] = &object;
		object.setCollisionFlags(from.m_flags);
		object.forceActivationState(from.m_activation);
		object.setDeactivationTime(from.m_timeAtRest);
		btRigidBody* const body = btRigidBody::upcast(&object);
		if (body)
		{
			// Bullet's inertia in world axes follows from the pose. Forces that are given to a body are multiplied by its factors.
			body->setCenterOfMassTransform(from.m_pose);
			body->setLinearVelocity(from.m_velocity);
			body->setAngularVelocity(from.m_spin);
			const btVector3 linear = body->getLinearFactor(), angular = body->getAngularFactor(), one(1, 1, 1);
			body->clearForces();
			body->setLinearFactor(one);
			body->setAngularFactor(one);
			body->applyCentralForce(from.m_force);
			body->applyTorque(from.m_torque);
			body->setLinearFactor(linear);
			body->setAngularFactor(angular);
		}
		object.setWorldTransform(from.m_pose);
		object.setInterpolationWorldTransform(from.m_interpolatedPose);
		object.setInterpolationLinearVelocity(from.m_interpolatedVelocity);
		object.setInterpolationAngularVelocity(from.m_interpolatedSpin);
	}
	for (size_t i = 0; i < places.size(); ++i)
	{
		order[int(i)] = places[i];
		places[i]->setWorldArrayIndex(int(i));
	}
}

namespace
{
/// Has two objects collide while it lives, even if they sleep or a joint between them keeps them from it: Bullet makes no manifolds else.
class Colliding
{
public:
	Colliding(btCollisionObject& a, btCollisionObject& b)
		: m_objects{&a, &b}, m_activations{a.getActivationState(), b.getActivationState()}
	{
		for (int i = 0; i < 2; ++i)
		{
			m_objects[i]->forceActivationState(ACTIVE_TAG);
			for (; !m_objects[i]->checkCollideWith(m_objects[1 - i]) && m_numIgnored[i] < MOST; ++m_numIgnored[i])
				m_objects[i]->setIgnoreCollisionCheck(m_objects[1 - i], false);
		}
	}
	~Colliding()
	{
		for (int i = 0; i < 2; ++i)
		{
			m_objects[i]->forceActivationState(m_activations[i]);
			for (; m_numIgnored[i] > 0; --m_numIgnored[i])
				m_objects[i]->setIgnoreCollisionCheck(m_objects[1 - i], true);
		}
	}
	Colliding(const Colliding&) = delete;
	Colliding& operator=(const Colliding&) = delete;

private:
	/// So many constraints between two objects are looked at: what a class of the user's ignores for good does not end.
	static constexpr int MOST = 64;

	btCollisionObject* m_objects[2];
	int m_activations[2], m_numIgnored[2] = {0, 0};
};
}  // namespace

/// Makes the algorithm of a pair that has none yet, with its manifolds; their points do not count.
btCollisionAlgorithm* Snapshot::makeAlgorithm(const PairImage& image) const
{
	btCollisionObject &a = *m_objects[size_t(image.m_objects[0])], &b = *m_objects[size_t(image.m_objects[1])];
	const Colliding colliding(a, b);
	const btCollisionObjectWrapper first(nullptr, a.getCollisionShape(), &a, a.getWorldTransform(), -1, -1);
	const btCollisionObjectWrapper second(nullptr, b.getCollisionShape(), &b, b.getWorldTransform(), -1, -1);
	btCollisionAlgorithm* const algorithm =
		m_world.getDispatcher()->findAlgorithm(&first, &second, nullptr, BT_CONTACT_POINT_ALGORITHMS);
	if (algorithm && image.m_children.empty() && countManifolds(*algorithm) < image.m_manifolds.size())
	{
		btManifoldResult result(&first, &second);
		algorithm->processCollision(&first, &second, m_world.getDispatchInfo(), &result);
	}
	return algorithm;
}

/// The same for a child of a compound, as Bullet makes it.
btCollisionAlgorithm* Snapshot::makeChild(const PairImage& image, int child) const
{
	btCollisionObject &a = *m_objects[size_t(image.m_objects[0])], &b = *m_objects[size_t(image.m_objects[1])];
	const Colliding colliding(a, b);
	const bool isSwapped = compoundOf(a, b) == 1;
	btCollisionObject &object = isSwapped ? b : a, &other = isSwapped ? a : b;
	const btCompoundShape& shape = *static_cast<const btCompoundShape*>(object.getCollisionShape());
	const btTransform place = object.getWorldTransform() * shape.getChildTransform(child);
	const btCollisionObjectWrapper whole(nullptr, &shape, &object, object.getWorldTransform(), -1, -1);
	const btCollisionObjectWrapper first(&whole, shape.getChildShape(child), &object, place, -1, child);
	const btCollisionObjectWrapper second(nullptr, other.getCollisionShape(), &other, other.getWorldTransform(), -1,
										  -1);
	btCollisionAlgorithm* const algorithm =
		m_world.getDispatcher()->findAlgorithm(&first, &second, nullptr, BT_CONTACT_POINT_ALGORITHMS);
	if (algorithm && int(countManifolds(*algorithm)) < image.m_children[size_t(child)])
	{
		btManifoldResult result(&first, &second);
		algorithm->processCollision(&first, &second, m_world.getDispatchInfo(), &result);
	}
	return algorithm;
}

void Snapshot::destroy(btCollisionAlgorithm* algorithm) const
{
	if (!algorithm)
		return;
	algorithm->~btCollisionAlgorithm();
	m_world.getDispatcher()->freeCollisionAlgorithm(algorithm);
}

/// A compound has algorithms for those children alone that were near the other object in the last step.
void Snapshot::writeChildren(const PairImage& image, btCollisionAlgorithm& algorithm) const
{
	btAlignedObjectArray<btCollisionAlgorithm*>& children = CompoundParts::childrenOf(algorithm);
	for (int i = 0; i < children.size(); ++i)
	{
		const int count = image.m_children[size_t(i)];
		if (children[i] && int(countManifolds(*children[i])) == count)
			continue;
		destroy(children[i]);
		children[i] = count < 0 ? nullptr : makeChild(image, i);
	}
}

/// Pairs come back in their order with the algorithms that they have, if these have as many manifolds as they had.
void Snapshot::writePairs(const WorldImage& image)
{
	btOverlappingPairCache& cache = *m_broadphase.getOverlappingPairCache();
	btDispatcher& dispatcher = *m_world.getDispatcher();
	btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
	std::unordered_map<uint64_t, btCollisionAlgorithm*> algorithms;
	while (pairs.size() > 0)
	{
		btBroadphasePair& pair = pairs[pairs.size() - 1];
		algorithms[keyOf(rankOf(*static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject)),
						 rankOf(*static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject)))] = pair.m_algorithm;
		pair.m_algorithm = nullptr;
		cache.removeOverlappingPair(pair.m_pProxy0, pair.m_pProxy1, &dispatcher);
	}
	btManifoldArray manifolds;
	std::vector<std::pair<int, btPersistentManifold*>> places;
	for (const PairImage& from : image.m_pairs)
	{
		btBroadphasePair* const pair =
			cache.addOverlappingPair(m_objects[size_t(from.m_objects[0])]->getBroadphaseHandle(),
									 m_objects[size_t(from.m_objects[1])]->getBroadphaseHandle());
		if (!pair)
			continue;
		btCollisionAlgorithm*& kept = algorithms[keyOf(from.m_objects[0], from.m_objects[1])];
		const bool goesByChildren = !from.m_children.empty();
		const auto isLike = [&](btCollisionAlgorithm& algorithm)
		{
			return goesByChildren ? CompoundParts::childrenOf(algorithm).size() == int(from.m_children.size())
								  : countManifolds(algorithm) == from.m_manifolds.size();
		};
		if (kept && (!from.m_hasAlgorithm || !isLike(*kept)))
		{
			destroy(kept);
			kept = nullptr;
		}
		pair->m_algorithm = kept || !from.m_hasAlgorithm ? kept : makeAlgorithm(from);
		kept = nullptr;
		if (pair->m_algorithm && goesByChildren)
			writeChildren(from, *pair->m_algorithm);
		manifolds.resize(0);
		if (pair->m_algorithm)
			pair->m_algorithm->getAllContactManifolds(manifolds);
		for (int m = 0; m < manifolds.size(); ++m)
		{
			manifolds[m]->clearManifold();
			if (size_t(m) >= from.m_manifolds.size())
				continue;
			const ManifoldImage& points = from.m_manifolds[size_t(m)];
			for (size_t p = 0; p < points.m_points.size(); ++p)
				manifolds[m]->getContactPoint(int(p)) = points.m_points[p];
			manifolds[m]->setNumContacts(int(points.m_points.size()));
			places.push_back({points.m_place, manifolds[m]});
		}
	}
	for (const auto& left : algorithms)
		destroy(left.second);
	// Others than those of pairs come last.
	std::sort(places.begin(), places.end());
	btPersistentManifold** const all = dispatcher.getInternalManifoldPointer();
	for (size_t i = 0; i < places.size(); ++i)
	{
		btPersistentManifold*& there = all[i];
		const int from = places[i].second->m_index1a;
		std::swap(there, all[from]);
		all[from]->m_index1a = from;
		there->m_index1a = int(i);
	}
}

void Snapshot::write(const WorldImage& image)
{
	writeRegistry(image);
	writeMotions(image);
	writeConstraints(image);
	writeObjects(image);
	writePairs(image);
	std::vector<btCollisionObject*> objects = m_objects;
	if (btCollisionObject* const mark = m_registry.getMark())
		objects.push_back(mark);
	BroadphaseState(m_broadphase, objects).write(image.m_broadphase);
	WorldParts::leftOverOf(m_world) = image.m_leftOver;
	WorldParts::fixedStepOf(m_world) = image.m_fixedStep;
	// Those that sleep, too, whose motion states Bullet leaves alone.
	for (btCollisionObject* object : m_objects)
		if (btRigidBody* const body = btRigidBody::upcast(object))
			m_world.synchronizeSingleMotionState(body);
}
}  // namespace btElasticPlastic
