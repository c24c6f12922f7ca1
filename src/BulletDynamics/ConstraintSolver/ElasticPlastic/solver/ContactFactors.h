// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONTACT_FACTORS_H
#define BT_ELASTIC_PLASTIC_CONTACT_FACTORS_H

#include <vector>

#include "Islands.h"

class btManifoldPoint;

namespace btElasticPlastic
{
/// Whether a contact has a factor of error reduction of its own.
bool hasOwnFactor(const btManifoldPoint& point);

/// Whether the user has made a contact soft: then it is a spring.
bool isSpring(const btManifoldPoint& point);

/// Contacts' own factors of error reduction (BT_CONTACT_FLAG_HAS_CONTACT_ERP), made those of a substep as long as this object exists: in proportion, as
/// the world's are. They are the user's for a step: by them, a substep would push bodies apart as many times as fast. Bullet asks its user for them
/// whenever it finds a contact, and so they are made less between that and the solution.
class ContactFactors
{
public:
	/// \param share  of the step that the substep is
	ContactFactors(const SolverGroup& group, btScalar share);
	~ContactFactors();
	ContactFactors(const ContactFactors&) = delete;
	ContactFactors& operator=(const ContactFactors&) = delete;

private:
	struct Held
	{
		btManifoldPoint* m_point;
		btScalar m_own;
	};

	std::vector<Held> m_held;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_CONTACT_FACTORS_H
