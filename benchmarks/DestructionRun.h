// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DESTRUCTION_RUN_H
#define EP_DESTRUCTION_RUN_H

#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticStatistics.h"
#include "scenes/destruction/Catalogue.h"

namespace ep
{
/// A scene of destruction, by our joints and in Bullet's own way, frame by frame.
struct DestructionRun
{
	/// Of one way.
	struct Way
	{
		std::vector<double>
			times;  ///< of the steps, by frame: what the calling thread has computed, the least of two runs [s]
		int broken = 0;
		/// Largest and summed gain of energy, less what slow recovery may have given, over the energy at play
		/// (EnergyAudit::gain). Not a number where it was not audited.
		double largestGain = 0, summedGain = 0;

		double mean() const;
		double largest() const;
		/// The time that a share of the frames stays below.
		double quantile(double share) const;
	};

	int joints = 0;
	Way ours, bullets;
	std::vector<btElasticPlasticStatistics> statistics;  ///< of our steps, by frame

	btElasticPlasticStatistics sum() const;

	/// Both ways take turns, frame by frame, so that their ratios hold on a machine that does other things, too. \param isAudited
	/// whether energy is followed as well, in a second run of each way, which takes as long again
	static DestructionRun play(const DestructionScene& scene, bool isAudited);
};
}  // namespace ep

#endif  // EP_DESTRUCTION_RUN_H
