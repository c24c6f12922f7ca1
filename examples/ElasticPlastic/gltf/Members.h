// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_MEMBERS_H
#define EP_MEMBERS_H

#include <vector>

#include "gltf/Triangles.h"

namespace ep
{
/// A body that can look bent, as a part of a beam: a box that joints hold at one end or at both, in all degrees of freedom, and nowhere else.
struct Member
{
	int body;
	int axis;                      ///< of the box, along the member
	int joints[2] = {NONE, NONE};  ///< at its lower and its upper end
	btScalar ends[2] = {0, 0};     ///< coordinates of these joints, or of the box's own ends where there are none

	static constexpr int NONE = -1;
};

/// In the order of bodies.
std::vector<Member> membersOf(const SceneDescription& scene);

/// Surface of a member that is straight, from end to end, and for each corner by how much it follows the ends: beside them it follows
/// the body.
struct MemberSurface
{
	Triangles triangles;
	std::vector<btScalar> shares;  ///< below 0: so much of the lower end, above: of the upper one
};
MemberSurface surfaceOf(const Member& member, const btVector3& size);

/// What holds an end, in the frame of the member's body: half way between the frames of the two bodies if the other one can be bent as well,
/// and else where the other one has it.
/// \param poses  of bodies
btTransform endOf(const SceneDescription& scene, const Member& member, int end, bool isOtherMember,
				  const std::vector<btTransform>& poses);

/// The same where nothing is bent.
btTransform straightEndOf(const SceneDescription& scene, const Member& member, int end);

/// The body on the other side of an end's joint.
int otherBodyOf(const SceneDescription& scene, const Member& member, int end);
}  // namespace ep

#endif  // EP_MEMBERS_H
