// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticSnapshot.h"

#include <limits.h>

#include "BulletCollision/BroadphaseCollision/btDbvtBroadphase.h"
#include "BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h"
#include "ElasticPlastic/snapshot/Snapshot.h"

using namespace btElasticPlastic;

namespace
{
/// What stands before a snapshot's values.
struct Header
{
	uint32_t m_sign = 0x53504542;  ///< reversed where the order of bytes is
	uint16_t m_version = 16;
	uint16_t m_precision = sizeof(btScalar);
	uint64_t m_checksum = 0;  ///< of what follows
};

/// What somebody else has put into a broadphase is neither saved nor put back, and objects are found by what they have there.
/// \return of proxies and objects those that have no partner
int countOthers(const btDiscreteDynamicsWorld& world, const btDbvtBroadphase& broadphase)
{
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	int numPairs = 0;
	for (int i = 0; i < objects.size(); ++i)
	{
		const btBroadphaseProxy* const proxy = objects[i]->getBroadphaseHandle();
		numPairs += proxy && proxy->m_clientObject == objects[i];
	}
	return broadphase.m_sets[0].m_leaves + broadphase.m_sets[1].m_leaves - numPairs + objects.size() - numPairs;
}

const char* const WHOLE = "that of a whole snapshot of this version and precision";
}  // namespace

int btElasticPlasticSave(btDiscreteDynamicsWorld& world, btDbvtBroadphase& broadphase, btElasticPlasticAction& action,
						 void* buffer, int capacity, btElasticPlasticOwnPrecision)
{
	if (world.getBroadphase() != &broadphase || countOthers(world, broadphase) != 0)
		return 0;
	Snapshot snapshot(world, broadphase, action);
	if (!snapshot.isBetweenSteps() || snapshot.isOfAnotherWorld())
		return 0;
	Header header;
	const size_t room = buffer && capacity > int(sizeof header) ? size_t(capacity) - sizeof header : 0;
	unsigned char* const values = room > 0 ? static_cast<unsigned char*>(buffer) + sizeof header : nullptr;
	Writer writer(values, room);
	snapshot.save(writer);
	const size_t size = sizeof header + writer.getSize();
	if (size > INT_MAX)
		return 0;
	if (writer.getSize() <= room)
	{
		header.m_checksum = checksumOf(values, writer.getSize());
		memcpy(buffer, &header, sizeof header);
		snapshot.leaveFactors();
	}
	return int(size);
}

btElasticPlasticFault btElasticPlasticRestore(btDiscreteDynamicsWorld& world, btDbvtBroadphase& broadphase,
											  btElasticPlasticAction& action, const void* buffer, int size,
											  btElasticPlasticOwnPrecision)
{
	if (world.getBroadphase() != &broadphase)
		return btElasticPlasticFault("number of broadphases", 2, "1: the world's own");
	if (const int others = countOthers(world, broadphase))
		return btElasticPlasticFault("number of what is in the broadphase and no object of the world, or the reverse",
									 others, "0");
	Snapshot snapshot(world, broadphase, action);
	if (!snapshot.isBetweenSteps())
		return btElasticPlasticFault("number of substeps and events under way", 1, "0: restore outside of listeners");
	if (snapshot.isOfAnotherWorld())
		return btElasticPlasticFault("number of worlds in which broken joints of the action separate", 2,
									 "1: the one that is restored");
	Header header;
	const Header own;
	if (!buffer || size < int(sizeof header))
		return btElasticPlasticFault("size of the buffer [bytes]", btScalar(size), WHOLE);
	memcpy(&header, buffer, sizeof header);
	if (header.m_sign != own.m_sign)
		return btElasticPlasticFault("sign at the beginning", btScalar(header.m_sign), WHOLE);
	if (header.m_version != own.m_version)
		return btElasticPlasticFault("version", header.m_version, WHOLE);
	if (header.m_precision != own.m_precision)
		return btElasticPlasticFault("size of a number [bytes]", header.m_precision, WHOLE);
	const unsigned char* const values = static_cast<const unsigned char*>(buffer) + sizeof header;
	const size_t length = size_t(size) - sizeof header;
	Reader reader(values, length);
	WorldImage image;
	if (header.m_checksum == checksumOf(values, length))
		transfer(reader, image);
	if (!reader.isComplete())
		return btElasticPlasticFault("size of the buffer, or its checksum [bytes]", btScalar(size), WHOLE);
	if (const btElasticPlasticFault fault = snapshot.findMismatch(image))
		return fault;
	snapshot.write(image);
	return btElasticPlasticFault();
}
