// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_PICTURES_H
#define EP_REPORT_PICTURES_H

#include <string>

#include "judge/ByProblem.h"

namespace ep
{
/// What is compared: without what the profile and the study of parts made, which have tables of their own.
Selection comparedOf(const Selection& records);

/// Error over run time of what is compared.
std::string problemPicture(const std::string& name, const Selection& records);
}  // namespace ep

#endif  // EP_REPORT_PICTURES_H
