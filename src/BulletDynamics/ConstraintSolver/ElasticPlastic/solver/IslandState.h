// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ISLAND_STATE_H
#define BT_ELASTIC_PLASTIC_ISLAND_STATE_H

#include "../../btElasticPlasticState.h"
#include "../joint/BodyMotion.h"
#include "../joint/LoadHistory.h"
#include "Islands.h"
#include "JoinedShift.h"
#include "SteadyPushes.h"
#include "LinearMath/btAlignedObjectArray.h"

class btManifoldPoint;
class btRigidBody;

namespace btElasticPlastic
{
class JointRegistry;

/// An island within a step: where its bodies, contact points and joints were when the step began, and how they are carried through
/// inner steps.
class IslandState
{
public:
	/// Notes the beginning of a step of dt [s], of all but the joints' state, which evaluating a joint does not change.
	/// \param registry      of the joints
	/// \param findsPushes   whether steady pushes on bodies act in it as loads, from here until finish()
	void begin(const SolverGroup& island, btScalar dt, const JointRegistry& registry, bool findsPushes);

	bool hasPushes() const { return m_hasPushes; }

	/// Notes the joints' state, too, before the first inner step changes it.
	void saveJoints(const SolverGroup& island);

	/// Goes back to the beginning.
	void restore();

	/// Has the velocities of bodies that nothing holds or touches, alone or joined to each other, belong to another time.
	///
	/// Bullet's velocities belong to a time half a step before that of its places. With shorter steps that time comes closer, and a
	/// falling body gets the speed that gravity gives it in between, and gives it back when the step ends.
	/// \param later  [s]
	void shiftFreeVelocities(btScalar later);

	/// The same as the step ends. What was free as it began and is touched now gives back what it has got, as far as it has fallen freely and still falls: what slips off
	/// or is brushed would be faster each time, and what strikes something gives it its speed.
	void endShift(btScalar later);

	/// The same of those that joints hold and nothing touches, where steps of h [s] are not as long as the last one: see JoinedShift.
	/// To be called after saveJoints(), if the island may go back.
	void shiftJoinedVelocities(const SolverGroup& island, btScalar h, bool isResolved);

	/// Whether that would be a small part of the velocities there are, or of those for which joints hold the energy.
	bool isJoinedShiftSmall(const SolverGroup& island, btScalar h);

	int getNumPoints() const { return m_points.size(); }

	/// Whether a contact has a stiffness of its own. As deep as a long step has let it come, a spring would give back in short ones what nobody has
	/// put into it.
	bool hasSpringContact() const { return m_hasSpringContact; }

	/// Whether something that is still apart at the beginning is to meet within the step at a speed at which it bounces.
	bool hasBounceAhead(btScalar leastSpeed) const;

	/// The most that a contact takes to stop what closes at the beginning of the step, if it meets within the step: by the bodies' masses [J].
	double getEnergyOfBlow() const;

	/// What contacts have taken from the bodies along their normals in the step or inner step that has been solved last, before bodies are moved [J].
	double getTaken() const;

	/// Of the bodies as they move now [J].
	double getKineticEnergy() const;

	/// Has contact points' impulses, with which a solution begins, and their own factors of error reduction be those of a step that is as many
	/// times as long.
	void scalePoints(btScalar share);

	/// Before an inner step of h [s] is solved: contact points are where bodies have carried them. Normals stay as they were found.
	/// What is to bounce does nothing until it touches: Bullet's row would bounce it off the gap, with what speed the gap leaves.
	/// \param end         of the inner step, from the beginning [s]; kinematic bodies are put there
	/// \param leastSpeed  at which bodies bounce [m/s]
	void carry(btScalar end, btScalar h, btScalar leastSpeed);

	/// Notes the velocities with which an inner step has ended, or the step has begun, and what joints have booked as their work until then.
	void note();

	/// After an inner step has been solved: goes back to where carry() began, but for kinematic bodies, and with what note() has noted.
	void takeBack();

	/// After an inner step of h [s] has been solved: moves the bodies by their velocities.
	void move(btScalar h);

	/// Ends the step: bodies are where they were, with their mean velocity, and contact points have the sum of their impulses, where no joint holds any more the last ones, and none where they are no forces.
	/// \param steps    how many inner steps it was
	/// \param motions  gets how the bodies have moved
	void finish(int steps, std::vector<BodyMotion>& motions);

	/// How loads of bodies have changed, for the next step.
	const std::vector<LoadHistory>& getLoads() const { return m_loads; }

	/// Puts kinematic bodies back where the step has them end.
	void releaseKinematicBodies();

private:
	struct Body
	{
		btRigidBody* m_body;
		btTransform m_start;
		btVector3 m_linear, m_angular;
		btElasticPlasticInnerMotion m_inner;
		btTransform m_place;  ///< when the inner step began
		btVector3 m_velocity, m_spin;
		btVector3 m_notedVelocity, m_notedSpin;  ///< see note()
		double m_notedShift, m_notedGravity;     ///< of m_inner
		btScalar m_ahead,
			m_notedAhead;   ///< the time by which its velocity belongs to a later one than before the step [s]
		int m_given;        ///< of m_pushes
		int m_load;         ///< of m_loads, -1: none
		bool m_isJoined;    ///< has constraints
		bool m_wasTouched;  ///< by a contact, when the step began
	};
	struct Kinematic
	{
		btRigidBody* m_body;
		btTransform m_end;
	};
	struct Point
	{
		btManifoldPoint* m_point;
		const btCollisionObject* m_objects[2];
		int m_bodies[2];                    ///< of m_bodies, -1: none of them
		btScalar m_distance, m_impulse[3];  ///< at the beginning; normal and lateral
		btScalar m_guess[3];                ///< of the impulses, when the inner step began
		btVector3 m_onA, m_onB;
		btScalar m_erp;     ///< of its own, where it has one
		btScalar m_sum[3];  ///< of impulses over the inner steps
	};
	struct Joint
	{
		JointWorks* m_works;
		btElasticPlasticState m_state;
		double m_notedWork;  ///< see note()
	};

	void addBodies(const SolverGroup& island, const JointRegistry& registry, bool findsPushes);
	void beginPushes();
	void addLoad(Body& body, const JointRegistry& registry);
	void addPoints(const SolverGroup& island);
	void addKinematic(btRigidBody& body);
	void bookWork(const Point& point);
	void leavePoints();
	bool doPointsTellForces() const;
	static void leave(const Point& point, const btScalar* impulses);
	void shift(Body& body, btScalar later);
	void findTouched();
	bool findJoinedShift(const SolverGroup& island, btScalar h);
	bool isAnyTouched() const;
	bool isFalling() const { return !m_isHeld && !isAnyTouched(); }
	static btScalar approachOf(const Point& point);

	btScalar m_dt = 0;
	btAlignedObjectArray<Body> m_bodies;
	btAlignedObjectArray<Kinematic> m_kinematic;
	btAlignedObjectArray<Point> m_points;
	btAlignedObjectArray<Joint> m_joints;
	btAlignedObjectArray<btTypedConstraint*> m_enabled;  ///< constraints
	btAlignedObjectArray<bool> m_isEnabled;              ///< of these, when the inner step began
	JoinedShift m_joinedShift;
	SteadyPushes m_pushes;
	std::vector<LoadHistory> m_loads;
	bool m_hasPushes = false;
	bool m_hasSpringContact = false;
	bool m_isHeld = false;                   ///< by a constraint with what does not move freely
	btAlignedObjectArray<bool> m_isTouched;  ///< by body, in the last inner step
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ISLAND_STATE_H
