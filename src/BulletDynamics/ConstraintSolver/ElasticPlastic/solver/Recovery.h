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
/// difference of the two solutions moves places only. What recovery may push is bounded by some times the impulse that would part
/// the two bodies by themselves. Joints take the second solution for their strain, the first for their work.
class Recovery
{
public:
	/// Begins an island.
	void begin() { m_contacts.clear(); }

	/// Takes recovery out of a contact's row.
	/// \param from  Bullet's row, whose push is taken, too
	/// \param row   the single row made from it
	void addContact(btSolverConstraint& from, const btContactSolverInfo& info, SystemInput& input, int row);

	/// Solves without recovery and, if there is any, with it.
	/// \return false if the search does not converge
	bool solve(System& system, SystemInput& input, int& islandId);

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
		double m_speed;  ///< at which it is to part
		double m_mostImpulse;
	};

	std::vector<Contact> m_contacts;
	std::vector<SystemInput::Bounded> m_rows;  // before the first solution
	SystemResult m_first, m_second;
	std::vector<double> m_motion;  // empty: none
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_RECOVERY_H
