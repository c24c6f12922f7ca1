// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/SectionStrength.h"

#include <algorithm>

namespace ep
{
/// A sum of segments, whose corners have the fibres on one side of a line pulled and the others pressed.
std::vector<std::pair<double, double>> sectionStrength(const btElasticPlasticJoint& joint, bool isAboutZ, bool isNow)
{
	struct Fibre
	{
		double lever, tension, compression;
	};
	std::vector<Fibre> fibres;
	const btElasticPlasticCapacity& capacity = joint.getCapacity();
	for (int i = 0; i < capacity.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = capacity.m_fibres[i];
		const btElasticPlasticFibreState& state = joint.getState().m_fibres[i];
		if (isNow && state.isRuptured())
			continue;
		fibres.push_back({double(isAboutZ ? -fibre.m_y : fibre.m_z),
						  isNow && state.m_isCracked ? 0 : double(fibre.m_tension), double(fibre.m_compression)});
	}
	if (fibres.empty())
		return {};
	std::sort(fibres.begin(), fibres.end(), [](const Fibre& a, const Fibre& b) { return a.lever > b.lever; });
	double axial = 0, moment = 0;
	for (const Fibre& fibre : fibres)
	{
		axial -= fibre.compression;
		moment -= fibre.compression * fibre.lever;
	}
	std::vector<std::pair<double, double>> points = {{axial, moment}};
	const auto turn = [&](const Fibre& fibre, double way)
	{
		axial += way * (fibre.tension + fibre.compression);
		moment += way * (fibre.tension + fibre.compression) * fibre.lever;
		points.emplace_back(axial, moment);
	};
	for (const Fibre& fibre : fibres)
		turn(fibre, 1);
	for (const Fibre& fibre : fibres)
		turn(fibre, -1);
	return points;
}
}  // namespace ep
