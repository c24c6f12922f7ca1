// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticBulletFile.h"

#include <string.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "ElasticPlastic/bulletfile/JointBlock.h"
#include "ElasticPlastic/joint/JointRegistry.h"
#include "ElasticPlastic/joint/JointWorks.h"
#include "LinearMath/btSerializer.h"
#include "btElasticPlastic6DofSpring2Constraint.h"
#include "btElasticPlastic6DofSpringConstraint.h"
#include "btElasticPlasticAction.h"

using btElasticPlastic::JointBlock;
using btElasticPlastic::JointWorks;

// ---- writing

bool btElasticPlasticJoint::isInFile() const
{
	const btElasticPlastic::JointModel& model = m_works->m_model;
	return model.m_dofs != 0 && !model.m_fault && !model.m_state.m_broken;
}

btTransform btElasticPlasticJoint::getReferenceInA() const
{
	const btElasticPlasticState& state = getState();
	const btVector3 offset = quatRotate(state.m_plasticMiddle, state.offset());
	return m_works->m_model.m_frameInA * btTransform(state.m_plasticRotation, offset);
}

void btElasticPlasticJoint::serializeElasticPlastic(btSerializer& serializer) const
{
	const std::vector<unsigned char> bytes = JointBlock::of(*m_works).write();
	btChunk* const chunk = serializer.allocate(1, int(bytes.size()));
	memcpy(chunk->m_oldPtr, bytes.data(), bytes.size());
	serializer.finalizeChunk(chunk, "char", BT_ARRAY_CODE, m_works);
}

// ---- reading

namespace
{
/// A constraint that has come from the file, and the joint that is to take its place.
struct Place
{
	int m_constraint;  ///< in the order of the file
	JointBlock m_block;
	std::unique_ptr<btTypedConstraint> m_joint;
};

/// What every constraint's chunk begins with.
struct ConstraintHead
{
	const void* m_bodies[2];
	const void* m_name;
	int m_type;
};

/// Whether Bullet's importer leaves a constraint of the file out: it loads those that join one body to the world, but not of all classes.
bool isLeftOut(const btElasticPlastic::FileChunk& constraint, const std::vector<const void*>& bodies)
{
	ConstraintHead head;
	if (constraint.m_size < sizeof head)
		return false;
	memcpy(&head, constraint.m_data, sizeof head);
	const auto isInFile = [&](const void* body)
	{ return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); };
	const int numBodies = isInFile(head.m_bodies[0]) + isInFile(head.m_bodies[1]);
	const bool needsBoth = head.m_type == D6_SPRING_CONSTRAINT_TYPE || head.m_type == D6_SPRING_2_CONSTRAINT_TYPE ||
						   head.m_type == FIXED_CONSTRAINT_TYPE || head.m_type == GEAR_CONSTRAINT_TYPE;
	return numBodies < (needsBoth ? 2 : 1);
}

btElasticPlasticFault read(const void* file, int size, std::vector<Place>& places, int& numConstraints)
{
	std::vector<btElasticPlastic::FileChunk> chunks;
	std::vector<const void*> bodies;
	bool isOut = false;
	numConstraints = 0;
	if (const btElasticPlasticFault fault =
			btElasticPlastic::findChunks(static_cast<const unsigned char*>(file), size_t(size > 0 ? size : 0), chunks))
		return fault;
	for (const btElasticPlastic::FileChunk& chunk : chunks)
		if (chunk.m_code == BT_RIGIDBODY_CODE)
			bodies.push_back(chunk.m_id);
	for (const btElasticPlastic::FileChunk& chunk : chunks)
	{
		if (chunk.m_code == BT_CONSTRAINT_CODE)
		{
			isOut = isLeftOut(chunk, bodies);
			numConstraints += !isOut;
		}
		if (!JointBlock::isIn(chunk) || isOut)
			continue;
		// A joint comes right after its constraint.
		Place place = {numConstraints - 1, JointBlock(), nullptr};
		if (place.m_constraint < 0 || (!places.empty() && places.back().m_constraint == place.m_constraint))
			return btElasticPlasticFault("number of constraints before a joint in the file", 0, "1");
		if (const btElasticPlasticFault fault = place.m_block.read(chunk))
			return fault;
		places.push_back(std::move(place));
	}
	return btElasticPlasticFault();
}

/// A joint with what Bullet has loaded of its own class.
btTypedConstraint* makeLike(btGeneric6DofSpring2Constraint& loaded, const JointBlock& block)
{
	auto* const joint =
		new btElasticPlastic6DofSpring2Constraint(loaded.getRigidBodyA(), loaded.getRigidBodyB(), block.m_frames[0],
												  block.m_frames[1], loaded.getRotationOrder());
	*joint->getTranslationalLimitMotor() = *loaded.getTranslationalLimitMotor();
	for (int i = 0; i < 3; ++i)
		*joint->getRotationalLimitMotor(i) = *loaded.getRotationalLimitMotor(i);
	return joint;
}

btTypedConstraint* makeLike(btGeneric6DofSpringConstraint& loaded, const JointBlock& block)
{
	auto* const joint =
		new btElasticPlastic6DofSpringConstraint(loaded.getRigidBodyA(), loaded.getRigidBodyB(), block.m_frames[0],
												 block.m_frames[1], loaded.getUseLinearReferenceFrameA());
	*joint->getTranslationalLimitMotor() = *loaded.getTranslationalLimitMotor();
	for (int i = 0; i < 3; ++i)
		*joint->getRotationalLimitMotor(i) = *loaded.getRotationalLimitMotor(i);
	for (int i = 0; i < 6; ++i)
	{
		joint->setStiffness(i, loaded.getStiffness(i));
		joint->setDamping(i, loaded.getDamping(i));
		joint->setEquilibriumPoint(i, loaded.getEquilibriumPoint(i));
		joint->enableSpring(i, loaded.isSpringEnabled(i));
	}
	return joint;
}

btElasticPlasticFault make(Place& place, btTypedConstraint& loaded)
{
	if (place.m_block.m_type != loaded.getConstraintType() || JointWorks::from(&loaded))
		return btElasticPlasticFault("type of a constraint in the world", btScalar(loaded.getConstraintType()),
									 "that of the file's constraint in this place");
	switch (loaded.getConstraintType())
	{
		case D6_SPRING_CONSTRAINT_TYPE:
			place.m_joint.reset(makeLike(static_cast<btGeneric6DofSpringConstraint&>(loaded), place.m_block));
			break;
		case D6_SPRING_2_CONSTRAINT_TYPE:
			place.m_joint.reset(makeLike(static_cast<btGeneric6DofSpring2Constraint&>(loaded), place.m_block));
			break;
		default:
			return btElasticPlasticFault("type of a joint in the file", btScalar(place.m_block.m_type),
										 "a 6-dof spring constraint's");
	}
	btTypedConstraint& joint = *place.m_joint;
	joint.setBreakingImpulseThreshold(loaded.getBreakingImpulseThreshold());
	joint.setEnabled(loaded.isEnabled());
	joint.setOverrideNumSolverIterations(loaded.getOverrideNumSolverIterations());
	joint.setDbgDrawSize(loaded.getDbgDrawSize());
	return place.m_block.give(*JointWorks::from(&joint));
}

/// Puts joints where their constraints are: these and all that come after them leave the world and return in their order.
void replace(btDynamicsWorld& world, int first, const std::vector<Place>& places)
{
	struct Entry
	{
		btTypedConstraint* m_constraint;
		bool m_disableCollisions;
	};
	std::vector<Entry> entries;
	for (int i = first; i < world.getNumConstraints(); ++i)
		entries.push_back({world.getConstraint(i), btElasticPlastic::keepsFromColliding(*world.getConstraint(i))});
	for (size_t i = entries.size(); i-- > 0;)
		world.removeConstraint(entries[i].m_constraint);
	for (const Place& place : places)
		entries[size_t(place.m_constraint)].m_constraint = place.m_joint.get();
	for (const Entry& entry : entries)
		world.addConstraint(entry.m_constraint, entry.m_disableCollisions);
}
}  // namespace

btElasticPlasticFault btElasticPlasticImport(btDynamicsWorld& world, btElasticPlasticAction& action, const void* file,
											 int size, btAlignedObjectArray<btTypedConstraint*>& made, int first,
											 btElasticPlasticOwnPrecision)
{
	std::vector<Place> places;
	int numConstraints;
	if (const btElasticPlasticFault fault = read(file, size, places, numConstraints))
		return fault;
	if (first < 0 || world.getNumConstraints() - first != numConstraints)
		return btElasticPlasticFault("number of constraints in the world from the first one of the file",
									 btScalar(world.getNumConstraints() - first), "that of the file");
	for (Place& place : places)
		if (const btElasticPlasticFault fault = make(place, *world.getConstraint(first + place.m_constraint)))
			return fault;
	replace(world, first, places);
	for (Place& place : places)
	{
		action.addJoint(btElasticPlasticJoint::from(place.m_joint.get()));
		made.push_back(place.m_joint.release());
	}
	return btElasticPlasticFault();
}
