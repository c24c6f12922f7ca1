// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_RECOVERY_H
#define BT_ELASTIC_PLASTIC_RECOVERY_H

#include <vector>

#include "SolverPools.h"
#include "System.h"

struct btContactSolverInfo;

namespace btElasticPlastic
{
/// Takes the penetration of contacts back without giving it a velocity.
///
/// Bullet adds what penetration is to lose in a step to a contact's velocity, or pushes the bodies' places apart as if nothing held
/// them. Joined bodies feel both: the first gives energy, the second strains joints, and a normal that points along a beam wedges its
/// blocks apart with any force. Here velocities are found without recovery, which then moves places only:
///  - Of a loose body and a joined one only the loose one moves, contact after contact, as Bullet pushes them.
///  - Where joined bodies have to move, the system is solved again with recovery, with joints as stiff as they can be and without
///    bounds: bodies move as if they were one, and no hinge turns. The difference of the two solutions moves places. What recovery may
///    push is bounded by some times the impulse that would part the two bodies by themselves.
/// The joints' references follow what relative motion is left (JointStep::setRecovery): recovery loads no joint.
class Recovery
{
public:
	/// Takes Bullet's own push back from a contact in its pool, unless the user has given the contact a stiffness. One with a factor of error
	/// reduction of its own is recovered by that.
	/// \param slowest  recovery below this speed stays Bullet's [m/s]
	/// \return the speed at which recovery is to part the bodies [m/s]; 0: not at all
	static double take(btSolverConstraint& contact, const btContactSolverInfo& info, double slowest);

	/// Begins an island.
	void begin();

	/// \param contact  in Bullet's pool
	/// \param speed    0: its bodies are kept from approaching by what other contacts push
	/// \param moves    whether its bodies' places may be moved
	void addContact(int contact, double speed, const bool moves[2]);

	/// A contact between bodies that joints hold.
	/// \param row    of the system
	/// \param alone  impulse per speed that would part the two bodies by themselves
	void addJoinedContact(int row, double speed, double alone);

	/// Is there anything to recover?
	bool isAsked() const { return m_isAsked; }

	/// Keeps the rows as they are before the first solution, if it is asked.
	void keep(const SystemInput& input)
	{
		if (!m_isAsked)
			return;
		m_rows.reserve(input.m_rows.capacity());
		m_rows = input.m_rows;
	}

	/// After the first solution: finds the motion of places.
	/// \param solverBodies  of the system's bodies
	/// \param isLoose       by the system's bodies: nothing holds it but contacts
	void solve(System& system, SystemInput& input, const SolverPools& pools, const btContactSolverInfo& info,
			   const btAlignedObjectArray<int>& solverBodies, const btAlignedObjectArray<bool>& isLoose);

	/// Did the last solution move anything?
	bool hasMotion() const { return !m_motion.empty(); }

	/// Of a solver body, 6 doubles: velocity with which its place moves in this step, beside its own.
	const double* getMotion(int solverBody) const { return &m_motion[6 * size_t(solverBody)]; }

private:
	struct PushedContact
	{
		int m_contact;
		double m_speed, m_impulse;
		bool m_moves[2];
	};
	struct JoinedContact
	{
		int m_row;
		double m_speed, m_alone;
	};

	void push(const SolverPools& pools, int sweeps);
	void stiffen(const System& system, SystemInput& input);
	bool solveJoined(System& system, SystemInput& input, const std::vector<double>& push);

	bool m_isAsked = false;
	std::vector<PushedContact> m_pushed;
	std::vector<JoinedContact> m_joined;
	std::vector<SystemInput::Bounded> m_rows;  // before the first solution
	SystemResult m_first, m_second;
	std::vector<double> m_share;   // of joints' compliance in the second solution, by row
	std::vector<double> m_motion;  // by solver body, 6 doubles; empty: none
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_RECOVERY_H
