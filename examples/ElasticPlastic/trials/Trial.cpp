// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "trials/Trial.h"

#include <cstdio>

namespace ep
{
std::string Verdict::complaint() const
{
	char text[96] = "";
	if (!isFinite)
		return "not finite";
	if (created > CREATED)
		snprintf(text, sizeof text, "energy created: %.2g of all", created);
	else if (createdByJoints > EnergyAudit::SLACK)
		snprintf(text, sizeof text, "energy created by joints: %.2g of all", createdByJoints);
	else if (!isRight())
		snprintf(text, sizeof text, "%.4g instead of %.4g", value, exact);
	return text;
}
}  // namespace ep
