// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ENERGY_LEDGER_H
#define BT_ELASTIC_PLASTIC_ENERGY_LEDGER_H

#include <vector>

#include "RigidMotion.h"

class btRigidBody;

namespace btElasticPlastic
{
class JointWorks;

/// Keeps joints from giving more energy than they have been given, where a solver's iterations have ended before the solution.
///
/// What joints do to bodies in a step is exactly the sum of impulse times mean relative velocity. A solution takes energy by it, or gives
/// back what springs have stored. Impulses that are not one may do any work: in a taut rope that ten iterations cannot hold they make
/// millions of joules. So each structure, bodies that joints connect, has an account of what its joints have taken and neither
/// given back nor dissipated. Where they would give more, all motion beside that of the whole as one is slowed until what they give is
/// what they have. Momentum and angular momentum stay; a structure that is joined to something static is slowed towards rest. It is soft,
/// and makes nothing.
///
/// What springs have stored is what bodies have given for it. Strain that an unfinished solution has left is no energy, and flow counts as
/// dissipation as far as bodies have given for it.
class EnergyLedger
{
public:
	/// Begins the end of a step.
	void begin();

	/// Adds a joint that no exact solver has solved; nothing if neither of its bodies moves.
	void add(JointWorks& joint);

	/// Before joints end their steps: takes back what they give beyond what they have.
	void limit();

	/// After joints have ended their steps: books what they have stored.
	void book();

private:
	struct Entry
	{
		JointWorks* m_joint;
		int m_bodies[2];  ///< of m_bodies, -1: does not move
		int m_structure;
		double m_given;               ///< in the step [J]
		double m_plastic, m_damping;  ///< dissipated before it [J]
	};

	struct Body
	{
		btRigidBody* m_body;
		int m_parent;                   ///< another of the same structure, or itself
		btVector3 m_linear, m_angular;  ///< by which the ledger changes its velocity [m/s], [rad/s]
		const btVector3* m_spinBefore;  ///< with which the step began, of a joint's step
	};

	/// The entries of a structure, and what its joints have [J].
	struct Account
	{
		size_t m_first, m_end;
		double m_balance;
	};

	int indexOf(const JointWorks& joint, int side);
	int rootOf(int body);
	void sortByStructure();
	void limit(Account& account);
	void findParts(const Account& account);
	RigidMotion findReference(const Account& account) const;
	double findWorkOfTurning(const Account& account);
	void calm(const Account& account, double beyond);
	void move(btScalar dt);
	void limitDissipation(Account& account);
	void book(Account& account);

	std::vector<Entry> m_entries;
	std::vector<Account> m_accounts;
	std::vector<Body> m_bodies;
	std::vector<int> m_indices;  ///< of m_bodies, by the bodies' place in the world; -1: none
	std::vector<RigidMotion::Part> m_parts;
	std::vector<int> m_partBodies;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ENERGY_LEDGER_H
