// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TRIAL_H
#define EP_TRIAL_H

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "world/EnergyAudit.h"

namespace ep
{
/// What became of a trial.
struct Verdict
{
	bool isFinite = true;        ///< all that it tells is a number, at all times
	double created = 0;          ///< energy from nowhere: EnergyAudit::created()
	double createdByJoints = 0;  ///< EnergyAudit::createdByJoints()
	double value = NAN;          ///< what it gave, not a number where no answer is known
	double exact = NAN;          ///< what it should have given
	double slack = 0;            ///< absolute: what precision and time given allow
	double runTime = 0;          ///< [s]

	/// Contacts by mean velocities may create a ten-thousandth, rounding in float as much (tests/solver/testDirectContacts.cpp).
	static constexpr double CREATED = 1e-3;

	bool isRight() const { return std::isnan(exact) || std::fabs(value - exact) <= slack; }
	bool isGreen() const
	{
		return isFinite && created <= CREATED && createdByJoints <= EnergyAudit::SLACK && isRight();
	}

	/// "" if all is well, else what is not.
	std::string complaint() const;
};

/// What a trial is run with.
struct TrialSetup
{
	Method method;
	Watch watch = {};

	/// For trials that step by themselves.
	void look(World& world, double time) const
	{
		if (watch)
			watch(world, time);
	}
};

/// A case that is stiff, extreme or unusual.
struct Trial
{
	const char* group;
	std::string name;
	std::function<Verdict(const TrialSetup& setup)> solve;
	const char* limitOfFloat = nullptr;  ///< why Bullet in float cannot be right here

	std::string fullName() const { return std::string(group) + "/" + name; }
	Verdict run(const Method& method, const Watch& watch = {}) const { return solve({method, watch}); }
};
}  // namespace ep

#endif  // EP_TRIAL_H
