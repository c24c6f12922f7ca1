// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "gltf/Members.h"

namespace ep
{
namespace
{
using Joint = SceneDescription::Joint;
using JointType = SceneDescription::JointType;

const int SLICES = 8;  // of a bent member

/// The joint's frame in a body's own.
btTransform frameIn(const SceneDescription& scene, int body, const Joint& joint)
{
	return body == SceneDescription::WORLD ? joint.frame : scene.bodies[size_t(body)].pose.inverse() * joint.frame;
}

bool isFull(const Joint& joint)
{
	const bool isOurs =
		joint.type == JointType::World || joint.type == JointType::Spring || joint.type == JointType::Paper;
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		if (!joint.capacity.isElasticPlastic(dof))
			return false;
	return isOurs;
}

/// \return axis and end (0, 1) of the box near whose middle a place is, as 2 axis + end; -1: none
int faceAt(const btVector3& size, const btVector3& place)
{
	const btScalar off = btScalar(.03);  // of the size: parts have gaps around them
	for (int axis = 0; axis < 3; ++axis)
	{
		btVector3 beside = place.absolute() / size;
		const btScalar along = beside[axis];
		beside[axis] = 0;
		if (btFabs(along - btScalar(.5)) <= off && beside[beside.maxAxis()] <= off)
			return 2 * axis + (place[axis] > 0);
	}
	return -1;
}

/// A corner of a section.
struct Corner
{
	btVector3 place;
	btScalar share;
};

/// Corners counter-clockwise seen from outside.
void addFace(MemberSurface& s, const Corner (&corners)[4])
{
	const btVector3 normal =
		(corners[1].place - corners[0].place).cross(corners[3].place - corners[0].place).normalized();
	for (int i : {0, 1, 2, 0, 2, 3})
	{
		s.triangles.corners.push_back(corners[i].place);
		s.triangles.normals.push_back(normal);
		s.shares.push_back(corners[i].share);
	}
}
}  // namespace

std::vector<Member> membersOf(const SceneDescription& scene)
{
	std::vector<std::vector<int>> jointsOf(scene.bodies.size());
	for (size_t i = 0; i < scene.joints.size(); ++i)
		for (int body : scene.joints[i].bodies)
			if (body != SceneDescription::WORLD)
				jointsOf[size_t(body)].push_back(int(i));
	std::vector<Member> members;
	for (size_t i = 0; i < scene.bodies.size(); ++i)
	{
		const SceneDescription::Body& body = scene.bodies[i];
		bool is = body.shape.kind == SceneDescription::ShapeKind::Box &&
				  body.motion == SceneDescription::Motion::Dynamic && !jointsOf[i].empty() && jointsOf[i].size() <= 2;
		Member member;
		member.body = int(i);
		member.axis = Member::NONE;
		for (int index : jointsOf[i])
		{
			const Joint& joint = scene.joints[size_t(index)];
			const btVector3 place = frameIn(scene, int(i), joint).getOrigin();
			const int face = faceAt(body.shape.size, place);
			is = is && face >= 0 && isFull(joint) && (member.axis == Member::NONE || member.axis == face / 2) &&
				 member.joints[face % 2] == Member::NONE;
			if (!is)
				break;
			member.axis = face / 2;
			member.joints[face % 2] = index;
			member.ends[face % 2] = place[member.axis];
		}
		if (!is)
			continue;
		for (int end = 0; end < 2; ++end)
			if (member.joints[end] == Member::NONE)
				member.ends[end] = body.shape.size[member.axis] * (end == 0 ? btScalar(-.5) : btScalar(.5));
		members.push_back(member);
	}
	return members;
}

MemberSurface surfaceOf(const Member& member, const btVector3& size)
{
	const int axis = member.axis, y = (axis + 1) % 3, z = (axis + 2) % 3;
	// A body follows an end with the square of the distance from its middle: bent by small angles it is then as a beam is, a cubic that has
	// the body's direction in the middle and the joint's at the end.
	const auto cornerAt = [&](int section, int corner)
	{
		const btScalar t = btScalar(2 * section - SLICES) / SLICES;
		const int end = t > 0;
		Corner made = {btVector3(0, 0, 0), 0};
		made.place[axis] = btFabs(t) * member.ends[end];
		made.place[y] = size[y] * (corner == 1 || corner == 2 ? btScalar(.5) : btScalar(-.5));
		made.place[z] = size[z] * (corner >= 2 ? btScalar(.5) : btScalar(-.5));
		made.share = member.joints[end] == Member::NONE ? 0 : t * btFabs(t);
		return made;
	};
	MemberSurface s;
	for (int i = 0; i < SLICES; ++i)
		for (int a = 0; a < 4; ++a)
		{
			const int b = (a + 1) % 4;
			addFace(s, {cornerAt(i, a), cornerAt(i, b), cornerAt(i + 1, b), cornerAt(i + 1, a)});
		}
	addFace(s, {cornerAt(0, 0), cornerAt(0, 3), cornerAt(0, 2), cornerAt(0, 1)});
	addFace(s, {cornerAt(SLICES, 0), cornerAt(SLICES, 1), cornerAt(SLICES, 2), cornerAt(SLICES, 3)});
	return s;
}

int otherBodyOf(const SceneDescription& scene, const Member& member, int end)
{
	const Joint& joint = scene.joints[size_t(member.joints[end])];
	return joint.bodies[joint.bodies[0] == member.body ? 1 : 0];
}

btTransform straightEndOf(const SceneDescription& scene, const Member& member, int end)
{
	return frameIn(scene, member.body, scene.joints[size_t(member.joints[end])]);
}

btTransform endOf(const SceneDescription& scene, const Member& member, int end, bool isOtherMember,
				  const std::vector<btTransform>& poses)
{
	const Joint& joint = scene.joints[size_t(member.joints[end])];
	const int other = otherBodyOf(scene, member, end);
	const btTransform straight = straightEndOf(scene, member, end);
	const btTransform otherFrame = frameIn(scene, other, joint),
					  held = poses[size_t(member.body)].inverse() *
							 (other == SceneDescription::WORLD ? otherFrame : poses[size_t(other)] * otherFrame);
	if (!isOtherMember)
		return held;
	// Half way in between: Bullet's slerp() leaves out small turns.
	const btQuaternion a = straight.getRotation(), b = held.getRotation();
	return btTransform((a.dot(b) < 0 ? a - b : a + b).normalized(),
					   straight.getOrigin().lerp(held.getOrigin(), btScalar(.5)));
}
}  // namespace ep
