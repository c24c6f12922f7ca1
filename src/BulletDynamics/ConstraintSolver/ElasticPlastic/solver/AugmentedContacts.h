// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_AUGMENTED_CONTACTS_H
#define BT_ELASTIC_PLASTIC_AUGMENTED_CONTACTS_H

#include <vector>

#include "AdmissibleBox.h"
#include "SystemInput.h"

namespace btElasticPlastic
{
/// The augmented Lagrangian that solves hard contacts by a sequence of soft ones.
///
/// Contacts are hard (C = 0) or nearly so, with friction bounded by the normal impulse. They are given to the search with a
/// softening c and a multiplier l: the row asks for J dv + C lambda + c (lambda - l) = b. From loop to loop l becomes the last
/// lambda, and friction's bounds follow the normal impulses, until nothing changes.
class AugmentedContacts
{
public:
	/// Begins a problem: rows get their guessed impulses as multipliers.
	void begin(SystemInput& input, const AdmissibleBox& box);

	/// Whether the present problem has any contact.
	bool isAny() const { return m_isAny; }

	/// Whether the present problem's compliances have changed.
	bool hasHardened() const { return m_hasHardened; }

	/// The outcome of a loop.
	struct Progress
	{
		bool m_isOpen = false;            ///< whether another loop is needed
		bool m_hasChangedMatrix = false;  ///< whether a compliance has changed, and with it the matrix
	};

	/// Ends a loop: sets the rows' targets, compliances and bounds for the next one.
	/// \param tolerance  of velocities, relative to the fastest approach
	Progress tighten(SystemInput& input, const AdmissibleBox& box, int loop, double tolerance);

	/// Takes the bounds of friction away where nothing presses any more: they are those of impulses before. \return whether any rubs there
	bool releaseFriction(SystemInput& input, const AdmissibleBox& box) const;

	/// A contact's row without its softening and multiplier.
	SystemInput::Bounded getHardRow(const SystemInput& input, int singleRow) const;

	/// Sets multipliers and friction's bounds that another method has found; both by row.
	void setMultipliers(SystemInput& input, const std::vector<double>& impulses,
						const std::vector<double>& upperBounds);

	/// Adds b^T lambda and lambda^T C lambda of all rows, with contacts' targets as they were and without softening.
	void addWork(const SystemInput& input, const std::vector<double>& impulses, double& gain, double& cost) const;

private:
	/// By single row.
	struct State
	{
		double m_target = 0;      ///< b
		double m_multiplier = 0;  ///< l
		double m_softening = 0;   ///< c
		double m_slip = 0;        ///< velocity that the last loop has left
		double m_leastSoftening = 0;
	};

	std::vector<State> m_states;
	bool m_isAny = false, m_hasHardened = false;
	double m_mostImpulse = 0;  ///< of a contact that is made harder
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_AUGMENTED_CONTACTS_H
