// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_WORLD_IMAGE_H
#define BT_ELASTIC_PLASTIC_WORLD_IMAGE_H

#include <algorithm>
#include <vector>

#include "../../btElasticPlasticCapacity.h"
#include "../../btElasticPlasticEvent.h"
#include "../../btElasticPlasticInnerMotion.h"
#include "../../btElasticPlasticState.h"
#include "../joint/LoadHistory.h"
#include "Archive.h"
#include "BulletCollision/NarrowPhaseCollision/btManifoldPoint.h"

namespace btElasticPlastic
{
// What a snapshot holds, without pointers. Collision objects go by their rank, the order in which they came into the world; joints by
// the number that the registry has given them.

/// A collision object.
struct ObjectImage
{
	btTransform m_pose, m_interpolatedPose;
	btVector3 m_interpolatedVelocity, m_interpolatedSpin;
	int m_flags = 0, m_activation = 0, m_worldIndex = 0;
	btScalar m_timeAtRest = 0;
	// Of a rigid body.
	bool m_isBody = false;
	btScalar m_inverseMass = 0;  ///< to tell a foreign world
	btVector3 m_velocity, m_spin, m_force, m_torque;
};

template <class Archive>
void transfer(Archive& archive, ObjectImage& image)
{
	transfer(archive, image.m_pose);
	transfer(archive, image.m_interpolatedPose);
	transfer(archive, image.m_interpolatedVelocity);
	transfer(archive, image.m_interpolatedSpin);
	archive(image.m_flags);
	archive(image.m_activation);
	archive(image.m_worldIndex);
	archive(image.m_timeAtRest);
	archive(image.m_isBody);
	if (!image.m_isBody)
		return;
	archive(image.m_inverseMass);
	for (btVector3* vector : {&image.m_velocity, &image.m_spin, &image.m_force, &image.m_torque})
		transfer(archive, *vector);
}

template <class Archive>
void transfer(Archive& archive, btElasticPlasticFibreState& state)
{
	for (btScalar* number : {&state.m_force, &state.m_forceRate, &state.m_offset, &state.m_damage, &state.m_path,
							 &state.m_rate, &state.m_rateShare})
		archive(*number);
	archive(state.m_isCracked);
}

template <class Archive>
void transfer(Archive& archive, btElasticPlasticState::Support& support)
{
	archive(support.m_kind);
	bool isSeen = support.m_kind == btElasticPlasticState::Support::SEEN;
	archive(isSeen);
	if (!isSeen)
		return;
	transfer(archive, support.m_place);
	archive(support.m_lead);
	archive(support.m_late);
}

/// Whether anything but their weight has acted on the bodies of a joint.
inline bool hasLoad(const btElasticPlasticState& state)
{
	for (const auto& load : state.m_load)
		for (const btScalar component : load)
			if (component != 0)
				return true;
	return false;
}

template <class Archive>
void transfer(Archive& archive, btElasticPlasticState& state)
{
	transfer(archive, state.m_plasticRotation);
	transfer(archive, state.m_plasticMiddle);
	transfer(archive, state.m_plastic);
	transfer(archive, state.m_initial);
	archive(state.m_lastStep);
	transfer(archive, state.m_force);
	for (auto& branch : state.m_branch)
		transfer(archive, branch);
	transfer(archive, state.m_forceRate);
	bool isLoaded = hasLoad(state);
	archive(isLoaded);
	for (int side = 0; isLoaded && side < 2; ++side)
		transfer(archive, state.m_load[side]);
	archive(state.m_isGiven);
	for (int side = 0; state.m_isGiven && side < 2; ++side)
		transfer(archive, state.m_given[side]);
	transfer(archive, state.m_withheld);
	archive(state.m_withheldStep);
	transfer(archive, state.m_spin);
	archive(state.m_solvedExactly);
	transfer(archive, state.m_applied);
	transfer(archive, state.m_appliedBefore);
	archive(state.m_yielded);
	archive(state.m_broken);
	archive(state.m_work);
	archive(state.m_storedEnergy);
	archive(state.m_placeEnergy);
	archive(state.m_plasticEnergy);
	archive(state.m_dampingEnergy);
	transfer(archive, state.m_plasticPath);
	transfer(archive, state.m_watched);
	archive(state.m_passedLevels);
	transfer(archive, state.m_support);
	transferList(archive, state.m_fibres);
	transfer(archive, state.m_fibreStrain);
	for (unsigned char* number : {&state.m_innerRhythm.m_level, &state.m_innerRhythm.m_calm,
								  &state.m_innerRhythm.m_spare, &state.m_innerRhythm.m_quiet})
		archive(*number);
	archive(state.m_innerRhythm.m_ringing);
}

template <class Archive>
void transfer(Archive& archive, btElasticPlasticFibre& fibre)
{
	for (btScalar* number : {&fibre.m_y, &fibre.m_z, &fibre.m_stiffness, &fibre.m_tension, &fibre.m_compression,
							 &fibre.m_stretchLimit, &fibre.m_crushLimit})
		archive(*number);
	archive(fibre.m_firstPoint);
	archive(fibre.m_numPoints);
	archive(fibre.m_rateReference);
	archive(fibre.m_rateExponent);
	archive(fibre.m_softens);
	archive(fibre.m_part);
	archive(fibre.m_bearsShear);
	if (fibre.m_bearsShear)
	{
		transfer(archive, fibre.m_wall);
		transfer(archive, fibre.m_twist);
	}
}

template <class Archive>
void transfer(Archive& archive, btElasticPlasticCurvePoint& point)
{
	archive(point.m_path);
	archive(point.m_factor);
}

template <class Archive>
void transfer(Archive& archive, btElasticPlasticCapacity& capacity)
{
	transfer(archive, capacity.m_stiffness);
	transfer(archive, capacity.m_yield);
	transfer(archive, capacity.m_ductility);
	transfer(archive, capacity.m_coupling);
	archive(capacity.m_length);
	archive(capacity.m_damping);
	archive(capacity.m_friction);
	archive(capacity.m_rigidPlastic);
	transferList(archive, capacity.m_fibres);
	transferList(archive, capacity.m_curvePoints);
}

struct JointImage
{
	int m_number = 0;
	int m_bodies[2] = {-1, -1};  ///< ranks, -1: in no world
	btElasticPlasticState m_state;
	btElasticPlasticCapacity m_capacity;
	btScalar m_levels[BT_EP_QUANTITY_COUNT] = {};
	unsigned m_dofs = 0;
	bool m_isPaper = false, m_isByMode = false, m_hasReference = false, m_isEnabled = true;
	bool m_isRefused = false;  ///< a capacity that was to take the place of m_capacity
	signed char m_lastBounds[BT_EP_DOF_COUNT] = {};
	std::vector<signed char> m_lastFibreBounds;
	int m_numUncommitted = 0, m_nextRequest = 0;
	bool m_isSeparating = false;
	btScalar m_overlap = 0;
};

/// Whether rows' bounds of the last step can be those of a joint: -1, 0 or 1, and no more than it has fibres.
inline bool areBounds(const signed char (&bounds)[BT_EP_DOF_COUNT], const std::vector<signed char>& ofFibres,
					  const btElasticPlasticCapacity& capacity)
{
	const auto isBound = [](signed char bound) { return bound >= -1 && bound <= 1; };
	return ofFibres.size() <= size_t(capacity.m_fibres.size()) &&
		   std::all_of(bounds, bounds + BT_EP_DOF_COUNT, isBound) &&
		   std::all_of(ofFibres.begin(), ofFibres.end(), isBound);
}

/// \param state, capacity  those of the image, or of the joint itself
template <class Archive>
void transfer(Archive& archive, JointImage& image, btElasticPlasticState& state, btElasticPlasticCapacity& capacity)
{
	archive(image.m_number);
	transfer(archive, image.m_bodies);
	transfer(archive, state);
	transfer(archive, capacity);
	transfer(archive, image.m_levels);
	archive(image.m_dofs);
	archive(image.m_isPaper);
	archive(image.m_isByMode);
	archive(image.m_hasReference);
	archive(image.m_isEnabled);
	archive(image.m_isRefused);
	transfer(archive, image.m_lastBounds);
	transferNumbers(archive, image.m_lastFibreBounds);
	archive(image.m_numUncommitted);
	archive(image.m_nextRequest);
	archive(image.m_isSeparating);
	if (image.m_isSeparating)
		archive(image.m_overlap);
}

template <class Archive>
void transfer(Archive& archive, JointImage& image)
{
	transfer(archive, image, image.m_state, image.m_capacity);
}

/// How a body has gone through the inner steps of the last substep.
struct MotionImage
{
	int m_object = 0;
	btElasticPlasticInnerMotion m_inner;
	bool m_isTouched = false;
};

template <class Archive>
void transfer(Archive& archive, MotionImage& image)
{
	archive(image.m_object);
	archive(image.m_inner.m_steps);
	for (btVector3* vector : {&image.m_inner.m_way, &image.m_inner.m_turn, &image.m_inner.m_pushed})
		transfer(archive, *vector);
	for (double* energy :
		 {&image.m_inner.m_work, &image.m_inner.m_shift, &image.m_inner.m_contacts, &image.m_inner.m_friction,
		  &image.m_inner.m_turning, &image.m_inner.m_pushes, &image.m_inner.m_gravity})
		archive(*energy);
	archive(image.m_isTouched);
}

/// How the loads of a body have changed.
struct LoadImage
{
	int m_object = 0;
	LoadHistory m_history;
};

template <class Archive>
void transfer(Archive& archive, LoadImage& image)
{
	archive(image.m_object);
	archive(image.m_history.m_step);
	for (LoadHistory::Part* part : {&image.m_history.m_force, &image.m_history.m_torque})
	{
		transfer(archive, part->m_load);
		transfer(archive, part->m_change);
		transfer(archive, part->m_smooth);
		archive(part->m_greatest);
	}
}

/// A constraint in the world's list.
struct ConstraintImage
{
	int m_joint = -1;            ///< number, -1: none of the action's joints
	int m_bodies[2] = {-1, -1};  ///< by which others are known
	int m_type = 0;
	bool m_isEnabled = true;
};

template <class Archive>
void transfer(Archive& archive, ConstraintImage& image)
{
	archive(image.m_joint);
	if (image.m_joint >= 0)
		return;
	transfer(archive, image.m_bodies);
	archive(image.m_type);
	archive(image.m_isEnabled);
}

struct EventImage
{
	btElasticPlasticEvent m_event;  ///< without pointers
	int m_joint = 0, m_type = 0, m_quantity = 0;
};

template <class Archive>
void transfer(Archive& archive, EventImage& image)
{
	archive(image.m_joint);
	archive(image.m_type);
	archive(image.m_quantity);
	archive(image.m_event.m_value);
	archive(image.m_event.m_dof);
	archive(image.m_event.m_fibre);
	archive(image.m_event.m_part);
	archive(image.m_event.m_time);
	archive(image.m_event.m_energy);
	transfer(archive, image.m_event.m_position);
	transfer(archive, image.m_event.m_force);
	transfer(archive, image.m_event.m_moment);
	transfer(archive, image.m_event.m_impulse);
	transfer(archive, image.m_event.m_velocity);
}

template <class Archive>
void transfer(Archive& archive, btManifoldPoint& point)
{
	for (btVector3* vector :
		 {&point.m_localPointA, &point.m_localPointB, &point.m_positionWorldOnB, &point.m_positionWorldOnA,
		  &point.m_normalWorldOnB, &point.m_lateralFrictionDir1, &point.m_lateralFrictionDir2})
		transfer(archive, *vector);
	for (btScalar* number :
		 {&point.m_distance1, &point.m_combinedFriction, &point.m_combinedRollingFriction,
		  &point.m_combinedSpinningFriction, &point.m_combinedRestitution, &point.m_appliedImpulse, &point.m_prevRHS,
		  &point.m_appliedImpulseLateral1, &point.m_appliedImpulseLateral2, &point.m_contactMotion1,
		  &point.m_contactMotion2, &point.m_contactCFM, &point.m_contactERP, &point.m_frictionCFM})
		archive(*number);
	for (int* number : {&point.m_partId0, &point.m_partId1, &point.m_index0, &point.m_index1,
						&point.m_contactPointFlags, &point.m_lifeTime})
		archive(*number);
}

struct ManifoldImage
{
	int m_place = 0;  ///< in the dispatcher's list
	std::vector<btManifoldPoint> m_points;
};

template <class Archive>
void transfer(Archive& archive, ManifoldImage& image)
{
	archive(image.m_place);
	transferList(archive, image.m_points);
}

/// A pair of the broadphase.
struct PairImage
{
	int m_objects[2] = {0, 0};
	bool m_hasAlgorithm = false;
	std::vector<int>
		m_children;  ///< numbers of manifolds of a compound's children, -1: no algorithm; of other pairs none
	std::vector<ManifoldImage> m_manifolds;
};

template <class Archive>
void transfer(Archive& archive, PairImage& image)
{
	transfer(archive, image.m_objects);
	archive(image.m_hasAlgorithm);
	if (!image.m_hasAlgorithm)
		return;
	transferNumbers(archive, image.m_children);
	transferList(archive, image.m_manifolds);
}

/// A node of one of the broadphase's trees. A tree's nodes stand in the order of a walk that goes to the first child first.
struct NodeImage
{
	int m_object = -1;      ///< of a leaf; -1: it has two children
	int m_addressRank = 0;  ///< Bullet's trees are balanced by the order of their nodes' addresses
	btVector3 m_low, m_high;
};

template <class Archive>
void transfer(Archive& archive, NodeImage& image)
{
	archive(image.m_object);
	archive(image.m_addressRank);
	transfer(archive, image.m_low);
	transfer(archive, image.m_high);
}

struct TreeImage
{
	std::vector<NodeImage> m_nodes;
	int m_freeRank = -1;  ///< address rank of the node that is kept for later, -1: none
	unsigned m_path = 0;  ///< where balancing goes on
};

template <class Archive>
void transfer(Archive& archive, TreeImage& image)
{
	transferList(archive, image.m_nodes);
	archive(image.m_freeRank);
	archive(image.m_path);
}

struct BroadphaseImage
{
	TreeImage m_trees[2];
	std::vector<int> m_stages[3];    ///< objects of each stage, in order
	std::vector<btVector3> m_boxes;  ///< two for each object
	int m_stage = 0, m_newPairs = 0, m_fixedLeft = 0, m_parse = 0, m_cleanup = 0;
	unsigned m_calls = 0, m_done = 0;
	btScalar m_ratio = 0;
	bool m_needsCleanup = false;
};

template <class Archive>
void transfer(Archive& archive, BroadphaseImage& image)
{
	for (TreeImage& tree : image.m_trees)
		transfer(archive, tree);
	for (std::vector<int>& stage : image.m_stages)
		transferNumbers(archive, stage);
	transferList(archive, image.m_boxes);
	for (int* number : {&image.m_stage, &image.m_newPairs, &image.m_fixedLeft, &image.m_parse, &image.m_cleanup})
		archive(*number);
	archive(image.m_calls);
	archive(image.m_done);
	archive(image.m_ratio);
	archive(image.m_needsCleanup);
}

struct WorldImage
{
	std::vector<ObjectImage> m_objects;  ///< by rank
	bool m_hasToken = false;             ///< an object of the registry that comes after them
	std::vector<JointImage> m_joints;    ///< those that hold, then the broken ones, in the registry's order
	std::vector<MotionImage> m_motions;
	std::vector<LoadImage> m_loads;
	std::vector<ConstraintImage> m_constraints;
	std::vector<EventImage> m_events;
	std::vector<PairImage> m_pairs;
	BroadphaseImage m_broadphase;
	double m_time = 0;         ///< of the action
	btScalar m_leftOver = 0;   ///< of the world: time that its fixed steps have not reached yet
	btScalar m_fixedStep = 0;  ///< of the world, the last one: motion states are behind by it
};

template <class Archive>
void transfer(Archive& archive, WorldImage& image)
{
	transferList(archive, image.m_objects);
	archive(image.m_hasToken);
	transferList(archive, image.m_joints);
	transferList(archive, image.m_motions);
	transferList(archive, image.m_loads);
	transferList(archive, image.m_constraints);
	transferList(archive, image.m_events);
	transferList(archive, image.m_pairs);
	transfer(archive, image.m_broadphase);
	archive(image.m_time);
	archive(image.m_leftOver);
	archive(image.m_fixedStep);
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_WORLD_IMAGE_H
