// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What units can bear, as the search sees it: impulses are the gradient of a potential, on which line searches go down.

#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/solver/AdmissibleBox.h"

namespace testAdmissibleBox
{
using btElasticPlastic::AdmissibleBox;
using btElasticPlastic::SystemInput;

/// A row by itself, and two whose compliance is coupled.
SystemInput threeRows()
{
	SystemInput input;
	input.m_rows.resize(3);
	input.m_guess.resize(3);
	const double compliance[3] = {2, 0.5, 3};
	for (int i = 0; i < 3; ++i)
	{
		SystemInput::Bounded& row = input.m_rows[size_t(i)];
		row.m_target = 0;
		row.m_compliance = compliance[i];
		row.m_lower = -1;
		row.m_upper = 2;
	}
	for (const int i : {1, 2})
	{
		input.m_rows[size_t(i)].m_partner = 3 - i;
		input.m_rows[size_t(i)].m_coupling = 0.9;
	}
	return input;
}

TEST(AdmissibleBox, ImpulsesAreTheGradientOfThePotential)
{
	const SystemInput input = threeRows();
	AdmissibleBox box;
	box.begin(input);
	const auto potentialAt = [&](const std::vector<double>& along)
	{
		double sum = 0, terms = 0;
		box.project(input, along);
		box.addPotential(input, along, sum, terms);
		return sum;
	};
	// Inside all bounds, at one of each, and at both of the pair.
	const std::vector<double> places[] = {{0.3, 0.2, -0.4}, {-6, -0.8, -5}, {3, 0.7, -9}, {0.1, -5, 6}};
	bool isFree = false, isBounded = false;
	for (std::vector<double> along : places)
		for (size_t i = 0; i < 3; ++i)
		{
			const double h = 1e-5, place = along[i];
			along[i] = place + h;
			const double after = potentialAt(along);
			along[i] = place - h;
			const double before = potentialAt(along);
			along[i] = place;
			box.project(input, along);
			// By u = b - J dv.
			EXPECT_NEAR(-(after - before) / (2 * h), box.getImpulse(int(i)), 1e-9) << i << " at " << place;
			(box.getBounds(int(i))[0] == 0 ? isFree : isBounded) = true;
		}
	EXPECT_TRUE(isFree && isBounded);
}
}  // namespace testAdmissibleBox
