// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_RECOVERY_H
#define BT_ELASTIC_PLASTIC_RECOVERY_H

#include <vector>

#include "System.h"

struct btContactSolverInfo;
struct btSolverConstraint;

namespace btElasticPlastic
{
/// Takes the penetration of contacts back without giving it a velocity.
///
/// Bullet adds what penetration is to lose in a step to a contact's velocity, or pushes the bodies' places apart as if nothing held
/// them. Joined bodies feel both: the first gives energy, the second strains joints, and a normal that points along a beam wedges its
/// blocks apart with any force. Here velocities are found without recovery. Then the same system is solved again with it, and the
/// difference of the two solutions moves places only; fast recovery waits where a joint would begin to yield by it. What recovery may push is bounded by some times the impulse that would part
/// the two bodies by themselves. Joints take the second solution for their strain, the first for their work.
class Recovery
{
public:
	/// Of a contact in Bullet's pool.
	struct Demand
	{
		double m_speed = 0;      ///< at which recovery is to part the bodies [m/s]; 0: what Bullet does about it stays
		bool m_isInRow = false;  ///< whether Bullet's row asks for this speed, too
	};

	/// Reads what recovery asks for, and takes Bullet's own push back.
	static Demand take(btSolverConstraint& contact, const btContactSolverInfo& info);

	/// Begins an island.
	void begin();

	/// \param row    of the system, without the demand's speed
	/// \param alone  impulse per speed that would part the two bodies by themselves
	void addContact(int row, double speed, double alone) { m_contacts.push_back({row, speed, alone}); }

	bool hasContacts() const { return !m_contacts.empty(); }

	/// Keeps the rows as they are before the first solution.
	void keep(const SystemInput& input) { m_rows = input.m_rows; }

	/// After the first solution: solves with recovery.
	/// \param push  by body, 6 doubles: velocity with which other contacts move places; empty: none
	void solve(System& system, SystemInput& input, const std::vector<double>& push);

	/// Did the last solution move anything?
	bool hasMotion() const { return !m_motion.empty(); }

	/// Of a body, 6 doubles: velocity with which its place moves in this step, beside its own.
	const double* getMotion(int body) const { return &m_motion[6 * size_t(body)]; }

	/// Of the solution that places go with; from a row on.
	const double* getImpulses(int row) const { return &m_second.m_impulses[size_t(row)]; }
	const signed char* getBounds(int row) const { return &m_second.m_bounds[size_t(row)]; }

private:
	struct Contact
	{
		int m_row;
		double m_speed, m_alone;
	};

	bool makesYield(const SystemInput& input) const;

	std::vector<Contact> m_contacts;
	std::vector<SystemInput::Bounded> m_rows;  // before the first solution
	SystemResult m_first, m_second;
	std::vector<double> m_motion;  // empty: none
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_RECOVERY_H
