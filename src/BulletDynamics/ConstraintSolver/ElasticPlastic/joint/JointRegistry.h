// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_REGISTRY_H
#define BT_ELASTIC_PLASTIC_JOINT_REGISTRY_H

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "../../btElasticPlasticEvent.h"
#include "../../btElasticPlasticFault.h"
#include "EnergyLedger.h"
#include "EventQueue.h"
#include "GapList.h"
#include "BodyMotion.h"
#include "BodyRecords.h"
#include "LoadHistory.h"
#include "WorldToken.h"

struct btBroadphaseProxy;
class btDynamicsWorld;
class btRigidBody;

class btTypedConstraint;

namespace btElasticPlastic
{
class JointWorks;

/// Whether a constraint in the world keeps its bodies from colliding.
bool keepsFromColliding(btTypedConstraint& constraint);

/// The implementation of btElasticPlasticAction: the joints of a world, which of them are broken, and their events. It owns
/// no joints.
class JointRegistry
{
public:
	JointRegistry() {}
	~JointRegistry();
	JointRegistry(const JointRegistry&) = delete;
	JointRegistry& operator=(const JointRegistry&) = delete;

	/// While it lives, whether a registry has been deleted: by a listener, or another action of the world.
	class Watch
	{
	public:
		explicit Watch(JointRegistry& registry) : m_registry(registry), m_outer(registry.m_watch)
		{
			registry.m_watch = this;
		}
		~Watch()
		{
			if (!m_isDeleted)
				m_registry.m_watch = m_outer;
			else if (m_outer)
				m_outer->m_isDeleted = true;
		}
		Watch(const Watch&) = delete;
		Watch& operator=(const Watch&) = delete;

		bool isDeleted() const { return m_isDeleted; }

	private:
		friend class JointRegistry;

		JointRegistry& m_registry;
		Watch* const m_outer;
		bool m_isDeleted = false;
	};

	bool add(JointWorks& joint);
	void remove(JointWorks& joint);
	void removeBody(btDynamicsWorld& world, btRigidBody& body);
	bool breakJoint(btDynamicsWorld& world, JointWorks& joint);

	/// \param world  where the joint is to come; null: that which it has left
	bool repair(JointWorks& joint, btDynamicsWorld* world);

	/// Takes a joint that has become broken off those that hold. It leaves its world at the end of the next substep.
	void moveToBroken(JointWorks& joint);

	/// Puts a broken joint back among those that hold, and into the world that it has left, or into another one.
	/// \param world  null: that which it has left
	/// \return a fault, and nothing changes, if a body of it that moves is in no world, or nobody can tell whether there still is the world
	/// that it has left
	btElasticPlasticFault putBack(JointWorks& joint, btDynamicsWorld* world);

	/// Whether a joint that is known here is among the broken ones.
	bool isBroken(const JointWorks& joint);

	int getNumJoints() const { return m_joints.getCount() + m_broken.getCount(); }
	int getNumBroken() const { return m_broken.getCount(); }
	JointWorks& getJoint(int index);

	/// Finds the joints whose bodies are in the world, as a user may have taken a joint out of it and deleted its bodies.
	/// Before the first step it finds none, as the world is not known yet. To be called only while the world exists.
	void findDrawable(btAlignedObjectArray<JointWorks*>& joints);

	/// Finds the joints that hold and are in a world, in the order in which they were added here.
	void findHolding(const btDynamicsWorld& world, btAlignedObjectArray<JointWorks*>& joints);

	/// Adds a listener that is not there, unless it is null.
	void addListener(btElasticPlasticListener* listener);
	void removeListener(btElasticPlasticListener* listener) { m_listeners.remove(listener); }
	void removeListeners() { m_listeners.resize(0); }
	bool popEvent(btElasticPlasticEvent& event) { return m_events.pop(event); }
	EventQueue& getEvents() { return m_events; }
	double getTime() const { return m_time; }

	void setWakingShare(btScalar share) { m_wakingShare = share; }
	btScalar getWakingShare() const { return m_wakingShare; }

	/// Tells that a btElasticPlasticStepControl has chosen the length of the coming substep: then there are no inner steps.
	/// \param share       of the control's step
	/// \param isResolved  it is so short that it resolves all that moves
	void setStepControlled(btScalar share, bool isResolved)
	{
		m_controlledTime = m_time;
		m_isStepResolved = isResolved;
		*m_substepShare = share;
	}
	bool isStepControlled() const { return m_controlledTime == m_time; }
	bool isStepResolved() const { return m_isStepResolved; }

	/// That share, 1 without a control. Solvers keep it, since they also solve what no joint tells of; it may outlive the registry.
	std::shared_ptr<const btScalar> getSubstepShare() const { return m_substepShare; }

	/// Wakes a body, with its weight in what is left of the step.
	void wake(btRigidBody& body);

	/// Tells listeners that a joint was refused; without one, prints the text to the standard error output.
	void refuse(btElasticPlasticJoint& joint, const char* text);

	// ---- for snapshots

	/// Whether a substep is being ended, or listeners are being told of an event: the world is not between steps.
	bool isBusy() const { return m_isCommitting || m_told; }

	/// A joint as it is to stand in the registry.
	struct Standing
	{
		JointWorks* m_joint;
		bool m_isBroken, m_isSeparating;
		btScalar m_overlap;  ///< while it separates
	};

	/// The object that marks a world in which broken joints separate; null if none do.
	btCollisionObject* getMark() const { return m_token.getObject(); }
	/// Whether it marks another world than this one.
	bool hasMarkedAnother(const btDynamicsWorld& world) const
	{
		return m_token.getWorld() && m_token.getWorld() != &world;
	}

	/// Arranges the joints that are known here, and whether they are in the world, as they were at another time. Unread events
	/// are gone.
	/// \param joints  all of them, those that hold first
	void arrange(btDynamicsWorld& world, const Standing* joints, int numJoints, double time);

	/// How bodies have gone through inner steps in the last substep.
	const std::vector<BodyMotion>& getMotions() const { return m_motions.getLast(); }
	void setMotions(const std::vector<BodyMotion>& motions) { m_motions.set(motions); }

	/// How loads of bodies have changed until the last substep.
	const std::vector<LoadHistory>& getLoads() const { return m_loads.getLast(); }
	void setLoads(const std::vector<LoadHistory>& loads) { m_loads.set(loads); }

	/// Puts an event of a known joint into the queue.
	void addEvent(const btElasticPlasticEvent& event, JointWorks& joint);

	// ---- in each step

	/// Takes how bodies have gone through inner steps, and how their loads have changed, for the end of the substep. Threads of a solver call it.
	void take(const std::vector<BodyMotion>& motions, const std::vector<LoadHistory>& loads);

	/// Forgets what was taken for the end of a substep that has not come.
	void forgetTaken();

	/// How a body has gone through the last substep. \return null if it has not taken inner steps
	const BodyMotion* findMotion(const btRigidBody& body) const { return m_motions.find(body); }

	/// How its loads have changed until the last substep. \return null if it has had none, or has not been in an island that may take inner steps
	const LoadHistory* findLoads(const btRigidBody& body) const { return m_loads.find(body); }

	/// Tells that a solver that is not exact has a joint in the substep under way. Threads of a solver call it.
	void expectUnsure() { m_hasUnsure.store(true, std::memory_order_relaxed); }

	/// Tells that a joint may have a part in the substep under way, or that its user has changed it: it is looked at again when the substep
	/// ends. Threads of a solver call it for joints of their own.
	/// \param index  of the joint in its list
	void rouse(const JointWorks& joint, int index)
	{
		if (index < m_joints.getEnd() && m_joints[index].m_joint == &joint)
			m_joints[index].m_isDormant = false;
	}

	/// Ends a substep: puts bodies that have gone through inner steps where these have ended, commits every joint, takes broken
	/// ones out of the world, and tells of events.
	void commit(btDynamicsWorld& world, btScalar timeStep);

private:
	struct Entry
	{
		JointWorks* m_joint;
		btDynamicsWorld* m_world = nullptr;  ///< that a broken joint has left; null: none
		bool m_disableCollisions = false;    ///< between the joint's bodies, while it holds
		bool m_isDormant = false;  ///< a joint that holds has nothing to end, and will not have until it is roused
		bool m_hasLeft = false;    ///< a broken joint is in no world that has been stepped since
		const btBroadphaseProxy* m_proxies[2] = {nullptr, nullptr};  ///< of the joint's bodies when it left
		int m_uids[2] = {0, 0};                                      ///< of these

		explicit Entry(JointWorks* joint = nullptr) : m_joint(joint) {}

		/// Notes the world that a broken joint leaves.
		void leave(btDynamicsWorld& world);

		/// Whether the world that the joint has left still exists, as far as its bodies show: one of them has been in it all the time.
		bool isWorldThere() const;

		void setIndex(int index) const;
		bool isGap() const { return !m_joint; }
		void makeGap() { m_joint = nullptr; }
	};
	typedef GapList<Entry> List;

	void removeJointsOf(const btRigidBody& body, List& list);
	void limitEnergy(const btDynamicsWorld& world);
	void commitJoints(const btDynamicsWorld& world, btScalar timeStep);
	bool isInWorld(const btDynamicsWorld& world, JointWorks& joint);
	void leaveIfGone(const btDynamicsWorld& world, JointWorks& joint);
	bool watch(const btDynamicsWorld& world, JointWorks& joint, btScalar timeStep);
	void wakeNeighbours(btDynamicsWorld& world, btRigidBody& body);
	void tellLeftOut(const btDynamicsWorld& world);
	void removeBrokenFromWorld(btDynamicsWorld& world);
	void removeFromWorld(btDynamicsWorld& world, Entry& entry);
	void endSeparations();
	void endSeparation(JointWorks& joint);
	void report(btElasticPlasticEventType type, JointWorks& joint,
				btElasticPlasticQuantity quantity = BT_EP_QUANTITY_COUNT, int fibre = -1);
	void reportLevels(JointWorks& joint);
	void reportLosses(JointWorks& joint);
	bool tell(const btElasticPlasticEvent& event);
	template <class Call>
	bool tellAll(const Call& call);
	void updateDrawnFrames(btDynamicsWorld& world);
	bool deliver();
	bool isStep(btScalar timeStep);
	void endTaken(btDynamicsWorld& world);

	List m_joints;  ///< those that hold
	List m_broken;
	btAlignedObjectArray<JointWorks*>
		m_leftOut;  ///< those that hold, and were in the substep before, but not in this one
	EventQueue m_events;
	EnergyLedger m_ledger;
	std::atomic<bool> m_hasUnsure{false};  ///< joints that the ledger has to look at
	btAlignedObjectArray<btElasticPlasticListener*> m_listeners;
	BodyRecords<BodyMotion> m_motions;
	BodyRecords<LoadHistory> m_loads;
	std::mutex m_taking;                 ///< held while they take
	std::recursive_mutex m_refusal;      ///< held while the listener is told, as threads of a solver refuse joints, too
	btDynamicsWorld* m_world = nullptr;  ///< the world that was stepped last
	double m_time = 0;
	bool m_isStepResolved = false;  ///< see setStepControlled()
	double m_controlledTime = -1;   ///< of the last substep that was
	const std::shared_ptr<btScalar> m_substepShare =
		std::make_shared<btScalar>(btScalar(1));  ///< see getSubstepShare()
	int m_numNumbers = 0;                         ///< that joints have got
	btScalar m_wakingShare = btScalar(0.05);      ///< see btElasticPlasticAction::setWakingShare
	bool m_isCommitting = false;                  ///< whether a substep is being ended
	int m_numSeparations = 0;                     ///< broken joints whose bodies still overlap
	WorldToken m_token;                           ///< in the world while there are any
	Watch* m_watch = nullptr;                     ///< the innermost
	btElasticPlasticEvent* m_told = nullptr;      ///< the event that listeners are being told
	bool m_isStepTold = false;                    ///< whether the listener was told of a bad step
	int m_nextWorldIndex = 0;  ///< where the joint after the one last looked for may stand in the world's list
	bool m_hasNew = false;     ///< whether joints have been added since the last substep
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINT_REGISTRY_H
