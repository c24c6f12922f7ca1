// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_TABLES_H
#define EP_REPORT_TABLES_H

#include "judge/ByProblem.h"
#include "page/Grid.h"

namespace ep
{
/// All problems by all families at the game's step: how right each is, in one look.
Grid overviewOf(const ByProblem& problems);

/// What btElasticPlasticStepControl makes of each problem, against the quickest setting that keeps to the same error.
Grid profileOf(const ByProblem& problems);

/// What is saved, and what lost, by each part that is left out.
Grid partsOf(const ByProblem& problems);

/// The same of problems in whose sections forces act together, by numbers of fibres.
Grid fibresOf(const ByProblem& problems);
}  // namespace ep

#endif  // EP_REPORT_TABLES_H
