// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticC.h"

#include <math.h>
#include <stdio.h>

#include <map>
#include <memory>

#include "ElasticPlastic/joint/EventQueue.h"
#include "btBulletDynamicsCommon.h"
#include "btElasticPlastic6DofSpring2Constraint.h"
#include "btElasticPlasticAction.h"
#include "btElasticPlasticConstraintSolver.h"

/// A world of the C interface. What is wrong with a joint is told to it, and not printed.
struct btep_world : btElasticPlasticListener
{
	typedef btElasticPlastic6DofSpring2Constraint Joint;

	struct Body
	{
		std::unique_ptr<btCollisionShape> m_shape;
		std::unique_ptr<btRigidBody> m_body;
	};

	struct Link
	{
		std::unique_ptr<Joint> m_joint;
		btElasticPlastic::UnreadEvents m_unread;
	};

	struct Section
	{
		btElasticPlasticSection m_section;
		btElasticPlasticMaterial m_material;
	};

	btDefaultCollisionConfiguration m_configuration;
	btCollisionDispatcher m_dispatcher{&m_configuration};
	btDbvtBroadphase m_broadphase;
	btElasticPlasticConstraintSolver m_solver;
	btDiscreteDynamicsWorld m_world{&m_dispatcher, &m_broadphase, &m_solver, &m_configuration};
	btElasticPlasticAction m_action;
	std::map<int, Body> m_bodies;
	std::map<int, Link> m_joints;
	std::map<int, Section> m_sections;
	std::map<int, btElasticPlasticCapacity> m_fibres;  ///< capacities with fibres
	btElasticPlastic::EventQueue m_events;
	int m_lastHandle = 0;
	char m_message[320] = {};

	BT_DECLARE_ALIGNED_ALLOCATOR();

	explicit btep_world(const btVector3& gravity)
	{
		m_world.setGravity(gravity);
		m_world.addAction(&m_action);
		m_action.addListener(this);
	}
	~btep_world() override
	{
		for (auto& joint : m_joints)
			m_world.removeConstraint(joint.second.m_joint.get());
		m_joints.clear();
		for (auto& body : m_bodies)
			m_world.removeRigidBody(body.second.m_body.get());
		m_world.removeAction(&m_action);
	}

	void onYield(const btElasticPlasticEvent& event) override { keep(event); }
	void onBreak(const btElasticPlasticEvent& event) override { keep(event); }
	void onLevel(const btElasticPlasticEvent& event) override { keep(event); }
	void onCrack(const btElasticPlasticEvent& event) override { keep(event); }
	void onRupture(const btElasticPlasticEvent& event) override { keep(event); }
	void onRefused(btElasticPlasticJoint&, const char* text) override { say(text); }
	void onBadStep(btScalar, const char* text) override { say(text); }

	void keep(const btElasticPlasticEvent& event)
	{
		m_events.push(event, m_joints[event.m_joint->getConstraint().getUserConstraintId()].m_unread);
	}

	void say(const char* text) { snprintf(m_message, sizeof m_message, "%s", text); }

	int fail(btep_result result, const char* text)
	{
		say(text);
		return result;
	}

	btRigidBody* find(int body)
	{
		const auto place = m_bodies.find(body);
		if (place == m_bodies.end())
			snprintf(m_message, sizeof m_message, "%d is no body of this world", body);
		return place == m_bodies.end() ? nullptr : place->second.m_body.get();
	}

	Joint* findJoint(int joint)
	{
		const auto place = m_joints.find(joint);
		if (place == m_joints.end())
			snprintf(m_message, sizeof m_message, "%d is no joint of this world", joint);
		return place == m_joints.end() ? nullptr : place->second.m_joint.get();
	}

	Section* findSection(int section)
	{
		const auto place = m_sections.find(section);
		if (place == m_sections.end())
			snprintf(m_message, sizeof m_message, "%d is no section of this world", section);
		return place == m_sections.end() ? nullptr : &place->second;
	}

	void destroyJoint(int joint)
	{
		// Its number goes with it: events that have not been read are not told any more.
		Link& gone = m_joints[joint];
		m_events.forget(gone.m_unread);
		m_world.removeConstraint(gone.m_joint.get());
		m_joints.erase(joint);
	}
};

namespace
{
btVector3 vectorOf(const double numbers[3])
{
	return btVector3(btScalar(numbers[0]), btScalar(numbers[1]), btScalar(numbers[2]));
}

void write(const btVector3& vector, double numbers[3])
{
	for (int i = 0; i < 3; ++i)
		numbers[i] = double(vector[i]);
}

/// What a number may be, as the header says: beyond it, products of what comes of it are no numbers in single precision, and bodies that
/// touch become NaN. Masses and spins are as in scene files; what has a length in it may be 1000 times as large, for millimetres.
struct Range
{
	double m_least, m_most;

	bool has(double value) const { return btElasticPlasticIsFinite(value) && value >= m_least && value <= m_most; }
};

Range upTo(double most) { return {-most, most}; }

const Range MASS = {1e-12, 1e12}, EXTENT = {1e-6, 1e7}, PLACE = upTo(1e9), FRICTION = {0, 100}, VELOCITY = upTo(1e8),
			SPIN = upTo(1e4), FORCE = upTo(1e18), ACCELERATION = upTo(1e12), GRAVITY = upTo(1e7), STEP = {1e-9, 1e3};

bool areIn(const Range& range, const double numbers[3])
{
	return range.has(numbers[0]) && range.has(numbers[1]) && range.has(numbers[2]);
}

/// \return whether numbers are in their range; if not, the world's message says which is not
bool check(btep_world& world, const char* name, const double* numbers, int count, const Range& range)
{
	for (int i = 0; i < count; ++i)
		if (!range.has(numbers[i]))
		{
			snprintf(world.m_message, sizeof world.m_message, "%s is %g; it must be from %g to %g", name, numbers[i],
					 range.m_least, range.m_most);
			return false;
		}
	return true;
}

double largestOf(const double rotation[4])
{
	double largest = 0;
	for (int i = 0; i < 4; ++i)
		largest = btMax(largest, fabs(rotation[i]));
	return largest;
}

bool isRotation(const double rotation[4])
{
	bool isRotation = largestOf(rotation) > 0;
	for (int i = 0; i < 4; ++i)
		isRotation &= btElasticPlasticIsFinite(rotation[i]);
	return isRotation;
}

btTransform poseOf(const double position[3], const double rotation[4])
{
	// Squares of numbers that are large or small are no numbers.
	const double largest = largestOf(rotation);
	btQuaternion turn;
	for (int i = 0; i < 4; ++i)
		turn[i] = btScalar(rotation[i] / largest);
	return btTransform(turn.normalized(), vectorOf(position));
}

/// The sum of numbers is finite only if all of them are.
bool isFinite(const btRigidBody& body)
{
	const btVector3 sum = body.getCenterOfMassPosition() + body.getLinearVelocity() + body.getAngularVelocity();
	return btElasticPlasticIsFinite(double(sum.x() + sum.y() + sum.z()));
}

/// Whether Bullet can reckon with a body's inertia: in its gyroscopic torques with the product of all three.
bool isInertia(const btVector3& inertia)
{
	const btScalar most = btMax(inertia.x(), btMax(inertia.y(), inertia.z()));
	return btElasticPlasticIsFinite(double(1000 * most * most * most));
}

btElasticPlasticCapacity capacityOf(const btep_capacity& from)
{
	btElasticPlasticCapacity capacity;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (from.m_yield[i] != 0)
			capacity.set(i, btScalar(from.m_stiffness[i]), btScalar(from.m_yield[i]),
						 btScalar(btMin(from.m_ductility[i], double(btElasticPlasticCapacity::unlimited()))));
	for (int i = 0; i < 2; ++i)
		capacity.m_coupling[i] = btScalar(from.m_coupling[i]);
	capacity.m_length = btScalar(from.m_length);
	capacity.m_damping = btScalar(from.m_damping);
	capacity.m_friction = btScalar(from.m_friction);
	return capacity;
}

void write(const btElasticPlasticCapacity& from, btep_capacity& capacity)
{
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		capacity.m_stiffness[i] = double(from.m_stiffness[i]);
		capacity.m_yield[i] = double(from.m_yield[i]);
		capacity.m_ductility[i] = double(from.m_ductility[i]);
	}
	for (int i = 0; i < 2; ++i)
		capacity.m_coupling[i] = double(from.m_coupling[i]);
	capacity.m_length = double(from.m_length);
	capacity.m_damping = double(from.m_damping);
	capacity.m_friction = double(from.m_friction);
	capacity.m_fibres = 0;
}

btElasticPlasticMaterial materialOf(const btep_material& from)
{
	btElasticPlasticMaterial material;
	material.m_youngsModulus = btScalar(from.m_youngs_modulus);
	material.m_poissonsRatio = btScalar(from.m_poissons_ratio);
	material.m_yieldStress = btScalar(from.m_yield_stress);
	material.m_ultimatePlasticStrain = btScalar(from.m_ultimate_plastic_strain);
	material.m_dampingRatio = btScalar(from.m_damping_ratio);
	material.m_shearModulus = btScalar(from.m_shear_modulus);
	material.m_shearStrength = btScalar(from.m_shear_strength);
	material.m_friction = btScalar(from.m_friction);
	material.m_tensileShare = btScalar(from.m_tensile_share);
	material.m_crushingStrain = btScalar(from.m_crushing_strain);
	return material;
}

int typeOf(btElasticPlasticEventType type)
{
	switch (type)
	{
		case BT_EP_EVENT_YIELD:
			return BTEP_YIELD;
		case BT_EP_EVENT_BREAK:
			return BTEP_BREAK;
		case BT_EP_EVENT_CRACK:
			return BTEP_CRACK;
		case BT_EP_EVENT_RUPTURE:
			return BTEP_RUPTURE;
		case BT_EP_EVENT_LEVEL:
			break;
	}
	return BTEP_LEVEL;
}

int failBy(btep_world* world, const btElasticPlasticFault& fault)
{
	fault.print(world->m_message, sizeof world->m_message);
	return BTEP_BAD_VALUE;
}
}  // namespace

int btep_version(void) { return BTEP_VERSION; }

int btep_world_create(int version, const double gravity[3], btep_world** world)
{
	if (!world || !gravity)
		return BTEP_BAD_POINTER;
	*world = nullptr;
	if (version != BTEP_VERSION)
		return BTEP_BAD_VERSION;
	if (!areIn(GRAVITY, gravity))
		return BTEP_BAD_VALUE;
	*world = new btep_world(vectorOf(gravity));
	return BTEP_OK;
}

void btep_world_destroy(btep_world* world) { delete world; }

const char* btep_world_message(const btep_world* world) { return world ? world->m_message : "the world is null"; }

int btep_world_step(btep_world* world, double length)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!check(*world, "length of a step", &length, 1, STEP))
		return BTEP_BAD_VALUE;
	world->m_world.stepSimulation(btScalar(length), 0);
	for (const auto& body : world->m_bodies)
		if (!isFinite(*body.second.m_body))
		{
			snprintf(
				world->m_message, sizeof world->m_message,
				"body %d is not finite any more: destroy it and what it touches, and begin with less extreme values",
				body.first);
			return BTEP_NOT_FINITE;
		}
	return BTEP_OK;
}

// ---- bodies

int btep_body_create(btep_world* world, const btep_body_description* description, int* body)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!description || !body)
		return world->fail(BTEP_BAD_POINTER, "description or result of a body is null");
	const btep_body_description& d = *description;
	if (d.m_size != sizeof d)
		return world->fail(BTEP_BAD_VERSION, "m_size of a body's description is not that of a known version");
	if (d.m_shape != BTEP_BOX && d.m_shape != BTEP_SPHERE)
		return world->fail(BTEP_BAD_VALUE, "shape of a body: it must be BTEP_BOX or BTEP_SPHERE");
	// By its bits: with -ffast-math processors take the least numbers for 0, and a body that was to move would stand.
	const bool hasMass = btElasticPlasticMagnitudeBits(d.m_mass) != 0;
	if (!check(*world, "extent of a body", d.m_extent, d.m_shape == BTEP_BOX ? 3 : 1, EXTENT) ||
		!check(*world, "coordinate of a body", d.m_position, 3, PLACE) ||
		(hasMass && !check(*world, "mass of a body that is not 0", &d.m_mass, 1, MASS)) ||
		!check(*world, "friction of a body", &d.m_friction, 1, FRICTION))
		return BTEP_BAD_VALUE;
	if (!isRotation(d.m_rotation))
		return world->fail(BTEP_BAD_VALUE, "rotation of a body: it must be finite, and not 0");

	btep_world::Body made;
	if (d.m_shape == BTEP_BOX)
		made.m_shape.reset(new btBoxShape(vectorOf(d.m_extent) / 2));
	else
		made.m_shape.reset(new btSphereShape(btScalar(d.m_extent[0])));
	btVector3 inertia(0, 0, 0);
	if (hasMass)
		made.m_shape->calculateLocalInertia(btScalar(d.m_mass), inertia);
	if (!isInertia(inertia))
		return world->fail(
			BTEP_BAD_VALUE,
			"mass and extents of a body: the cube of its inertia must be a number in the library's precision");
	btRigidBody::btRigidBodyConstructionInfo info(btScalar(d.m_mass), nullptr, made.m_shape.get(), inertia);
	info.m_startWorldTransform = poseOf(d.m_position, d.m_rotation);
	info.m_friction = btScalar(d.m_friction);
	made.m_body.reset(new btRigidBody(info));
	world->m_world.addRigidBody(made.m_body.get());
	*body = ++world->m_lastHandle;
	world->m_bodies[*body] = std::move(made);
	return BTEP_OK;
}

int btep_body_destroy(btep_world* world, int body)
{
	if (!world)
		return BTEP_BAD_POINTER;
	btRigidBody* const found = world->find(body);
	if (!found)
		return BTEP_BAD_HANDLE;
	for (auto place = world->m_joints.begin(); place != world->m_joints.end();)
	{
		const int joint = place->first;
		const btTypedConstraint& constraint = *place->second.m_joint;
		++place;
		if (&constraint.getRigidBodyA() == found || &constraint.getRigidBodyB() == found)
			world->destroyJoint(joint);
	}
	world->m_action.removeBody(world->m_world, *found);
	world->m_bodies.erase(body);
	return BTEP_OK;
}

int btep_body_get_pose(btep_world* world, int body, double position[3], double rotation[4])
{
	if (!world || !position || !rotation)
		return BTEP_BAD_POINTER;
	const btRigidBody* const found = world->find(body);
	if (!found)
		return BTEP_BAD_HANDLE;
	write(found->getCenterOfMassPosition(), position);
	const btQuaternion turn = found->getOrientation();
	for (int i = 0; i < 4; ++i)
		rotation[i] = double(turn[i]);
	return BTEP_OK;
}

int btep_body_get_velocity(btep_world* world, int body, double linear[3], double angular[3])
{
	if (!world || !linear || !angular)
		return BTEP_BAD_POINTER;
	const btRigidBody* const found = world->find(body);
	if (!found)
		return BTEP_BAD_HANDLE;
	write(found->getLinearVelocity(), linear);
	write(found->getAngularVelocity(), angular);
	return BTEP_OK;
}

int btep_body_set_velocity(btep_world* world, int body, const double linear[3], const double angular[3])
{
	if (!world || !linear || !angular)
		return BTEP_BAD_POINTER;
	btRigidBody* const found = world->find(body);
	if (!found)
		return BTEP_BAD_HANDLE;
	if (!check(*world, "velocity of a body", linear, 3, VELOCITY) ||
		!check(*world, "angular velocity of a body", angular, 3, SPIN))
		return BTEP_BAD_VALUE;
	found->activate();
	found->setLinearVelocity(vectorOf(linear));
	found->setAngularVelocity(vectorOf(angular));
	return BTEP_OK;
}

int btep_body_apply_force(btep_world* world, int body, const double force[3])
{
	if (!world || !force)
		return BTEP_BAD_POINTER;
	btRigidBody* const found = world->find(body);
	if (!found)
		return BTEP_BAD_HANDLE;
	if (!check(*world, "force on a body", force, 3, FORCE))
		return BTEP_BAD_VALUE;
	double acceleration[3];
	for (int i = 0; i < 3; ++i)
		acceleration[i] = force[i] * double(found->getInvMass());
	if (!check(*world, "force on a body over its mass", acceleration, 3, ACCELERATION))
		return BTEP_BAD_VALUE;
	found->activate();
	found->applyCentralForce(vectorOf(force));
	return BTEP_OK;
}

// ---- joints

int btep_capacity_of_member(btep_world* world, const btep_material* material, double width, double height,
							double length_a, double length_b, btep_capacity* capacity)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!material || !capacity)
		return world->fail(BTEP_BAD_POINTER, "material or result of a capacity is null");
	if (material->m_size != sizeof *material || capacity->m_size != sizeof *capacity)
		return world->fail(BTEP_BAD_VERSION, "m_size of a material or a capacity is not that of a known version");
	const btElasticPlasticCapacity made = btElasticPlasticCapacity::fromMember(
		materialOf(*material), btElasticPlasticSection::rectangle(btScalar(width), btScalar(height)),
		btScalar(length_a), btScalar(length_b));
	if (const btElasticPlasticFault fault = made.fault())
		return failBy(world, fault);
	write(made, *capacity);
	return BTEP_OK;
}

int btep_section_create(btep_world* world, const btep_material* material, double width, double height, int num_fibres,
						int* section)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!material || !section)
		return world->fail(BTEP_BAD_POINTER, "material or result of a section is null");
	if (material->m_size != sizeof *material)
		return world->fail(BTEP_BAD_VERSION, "m_size of a material is not that of a known version");
	const btep_world::Section made = {
		btElasticPlasticSection::rectangle(btScalar(width), btScalar(height)).withFibres(num_fibres),
		materialOf(*material)};
	if (const btElasticPlasticFault fault = made.m_section.m_fault)
		return failBy(world, fault);
	if (const btElasticPlasticFault fault = made.m_material.fault())
		return failBy(world, fault);
	*section = ++world->m_lastHandle;
	world->m_sections[*section] = made;
	return BTEP_OK;
}

int btep_section_add_bar(btep_world* world, int section, double y, double z, double area, const btep_material* material)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!material)
		return world->fail(BTEP_BAD_POINTER, "material of a bar is null");
	if (material->m_size != sizeof *material)
		return world->fail(BTEP_BAD_VERSION, "m_size of a material is not that of a known version");
	btep_world::Section* const found = world->findSection(section);
	if (!found)
		return BTEP_BAD_HANDLE;
	if (const btElasticPlasticFault fault = materialOf(*material).fault())
		return failBy(world, fault);
	btElasticPlasticSection more = found->m_section;
	more.addBar(btScalar(y), btScalar(z), btScalar(area), materialOf(*material));
	if (const btElasticPlasticFault fault = more.m_fault)
		return failBy(world, fault);
	found->m_section = more;
	return BTEP_OK;
}

int btep_capacity_of_section(btep_world* world, int section, double length_a, double length_b, double gauge_length,
							 btep_capacity* capacity)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!capacity)
		return world->fail(BTEP_BAD_POINTER, "result of a capacity is null");
	if (capacity->m_size != sizeof *capacity)
		return world->fail(BTEP_BAD_VERSION, "m_size of a capacity is not that of a known version");
	const btep_world::Section* const found = world->findSection(section);
	if (!found)
		return BTEP_BAD_HANDLE;
	const btElasticPlasticCapacity made = btElasticPlasticCapacity::fromMember(
		found->m_material, found->m_section, btScalar(length_a), btScalar(length_b), btScalar(gauge_length));
	if (const btElasticPlasticFault fault = made.fault())
		return failBy(world, fault);
	write(made, *capacity);
	for (const auto& known : world->m_fibres)
		if (known.second.isSameAs(made))
		{
			capacity->m_fibres = known.first;
			return BTEP_OK;
		}
	capacity->m_fibres = ++world->m_lastHandle;
	world->m_fibres[capacity->m_fibres] = made;
	return BTEP_OK;
}

int btep_section_destroy(btep_world* world, int section)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!world->findSection(section))
		return BTEP_BAD_HANDLE;
	world->m_sections.erase(section);
	return BTEP_OK;
}

int btep_joint_create(btep_world* world, int body_a, int body_b, const double position[3], const double rotation[4],
					  const btep_capacity* capacity, int* joint)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!position || !rotation || !capacity || !joint)
		return world->fail(BTEP_BAD_POINTER, "pose, capacity or result of a joint is null");
	if (capacity->m_size != sizeof *capacity)
		return world->fail(BTEP_BAD_VERSION, "m_size of a capacity is not that of a known version");
	const auto fibres = world->m_fibres.find(capacity->m_fibres);
	if (capacity->m_fibres != 0 && fibres == world->m_fibres.end())
		return world->fail(BTEP_BAD_HANDLE,
						   "m_fibres of a capacity is no number that btep_capacity_of_section() has given");
	btRigidBody *const a = world->find(body_a), *const b = a ? world->find(body_b) : nullptr;
	if (!a || !b)
		return BTEP_BAD_HANDLE;
	if (!check(*world, "coordinate of a joint", position, 3, PLACE))
		return BTEP_BAD_VALUE;
	if (!isRotation(rotation))
		return world->fail(BTEP_BAD_VALUE, "rotation of a joint: it must be finite, and not 0");
	const btTransform frame = poseOf(position, rotation);
	std::unique_ptr<btep_world::Joint> made(new btep_world::Joint(
		*a, *b, a->getCenterOfMassTransform().inverse() * frame, b->getCenterOfMassTransform().inverse() * frame));
	for (int i = 3; i < BT_EP_DOF_COUNT; ++i)
		made->setLimit(i, 1, -1);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (capacity->m_yield[i] == 0)
			made->setLimit(i, 1, -1);
	// The action tells what is wrong, and the joint has never been in the world then.
	btElasticPlasticCapacity taken = capacityOf(*capacity);
	if (capacity->m_fibres != 0)
	{
		taken.m_fibres = fibres->second.m_fibres;
		taken.m_curvePoints = fibres->second.m_curvePoints;
	}
	made->setCapacity(taken);
	if (!world->m_action.addJoint(made.get()))
		return BTEP_BAD_VALUE;
	world->m_world.addConstraint(made.get(), true);
	*joint = ++world->m_lastHandle;
	made->setUserConstraintId(*joint);
	world->m_joints[*joint].m_joint = std::move(made);
	a->activate();
	b->activate();
	return BTEP_OK;
}

int btep_joint_destroy(btep_world* world, int joint)
{
	if (!world)
		return BTEP_BAD_POINTER;
	btep_world::Joint* const found = world->findJoint(joint);
	if (!found)
		return BTEP_BAD_HANDLE;
	found->getRigidBodyA().activate();
	found->getRigidBodyB().activate();
	world->destroyJoint(joint);
	return BTEP_OK;
}

int btep_joint_get_state(btep_world* world, int joint, btep_joint_state* state)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!state)
		return world->fail(BTEP_BAD_POINTER, "result of a joint's state is null");
	if (state->m_size != sizeof *state)
		return world->fail(BTEP_BAD_VERSION, "m_size of a joint's state is not that of a known version");
	const btep_world::Joint* const found = world->findJoint(joint);
	if (!found)
		return BTEP_BAD_HANDLE;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		state->m_force[i] = double(found->getAppliedForce(i));
		state->m_plastic[i] = double(found->getPlasticDeformation(i));
	}
	state->m_utilisation = double(found->getUtilisation());
	state->m_damage = double(found->getDamage());
	state->m_elastic_energy = found->getElasticEnergy();
	state->m_damping_energy = found->getDampingEnergy();
	state->m_plastic_energy = found->getPlasticEnergy();
	state->m_is_broken = found->isBroken();
	return BTEP_OK;
}

int btep_joint_get_num_fibres(btep_world* world, int joint, int* count)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!count)
		return world->fail(BTEP_BAD_POINTER, "result of a number of fibres is null");
	const btep_world::Joint* const found = world->findJoint(joint);
	if (!found)
		return BTEP_BAD_HANDLE;
	*count = found->getCapacity().m_fibres.size();
	return BTEP_OK;
}

int btep_joint_get_fibre(btep_world* world, int joint, int fibre, btep_fibre* reading)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!reading)
		return world->fail(BTEP_BAD_POINTER, "result of a fibre is null");
	if (reading->m_size != sizeof *reading)
		return world->fail(BTEP_BAD_VERSION, "m_size of a fibre is not that of a known version");
	const btep_world::Joint* const found = world->findJoint(joint);
	if (!found)
		return BTEP_BAD_HANDLE;
	const btElasticPlasticCapacity& capacity = found->getCapacity();
	if (fibre < 0 || fibre >= capacity.m_fibres.size())
		return world->fail(BTEP_BAD_VALUE, "number of a fibre: it must be 0 and less than that of the joint's fibres");
	const btElasticPlasticFibreReading from = found->getFibre(fibre);
	reading->m_force = double(from.m_force);
	reading->m_elongation = double(from.m_elongation);
	reading->m_plastic = double(from.m_plastic);
	reading->m_utilisation = double(from.m_utilisation);
	reading->m_damage = double(from.m_damage);
	reading->m_is_cracked = from.m_isCracked;
	reading->m_part = capacity.m_fibres[fibre].m_part;
	return BTEP_OK;
}

int btep_joint_set_level(btep_world* world, int joint, double utilisation)
{
	if (!world)
		return BTEP_BAD_POINTER;
	btep_world::Joint* const found = world->findJoint(joint);
	if (!found)
		return BTEP_BAD_HANDLE;
	if (!found->setLevel(BT_EP_QUANTITY_UTILISATION, btScalar(utilisation)))
		return world->fail(BTEP_BAD_VALUE, "level of a joint's utilisation: it must be finite and greater than 0");
	return BTEP_OK;
}

int btep_event_next(btep_world* world, btep_event* event)
{
	if (!world)
		return BTEP_BAD_POINTER;
	if (!event)
		return world->fail(BTEP_BAD_POINTER, "result of an event is null");
	if (event->m_size != sizeof *event)
		return world->fail(BTEP_BAD_VERSION, "m_size of an event is not that of a known version");
	btElasticPlasticEvent from;
	if (!world->m_events.pop(from))
		return BTEP_NO_EVENT;
	event->m_type = typeOf(from.m_type);
	event->m_joint = from.m_joint->getConstraint().getUserConstraintId();
	event->m_dof = from.m_dof;
	event->m_time = from.m_time;
	event->m_energy = from.m_energy;
	write(from.m_position, event->m_position);
	write(from.m_impulse, event->m_impulse);
	write(from.m_velocity, event->m_velocity);
	event->m_fibre = from.m_fibre;
	event->m_part = from.m_part;
	return BTEP_OK;
}
