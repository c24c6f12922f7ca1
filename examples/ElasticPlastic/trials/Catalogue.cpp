// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "trials/Catalogue.h"

#include "trials/Handling.h"
#include "trials/Loading.h"
#include "trials/Motion.h"
#include "trials/Scale.h"

namespace ep
{
const std::vector<Trial>& stabilityTrials()
{
	static const std::vector<Trial> all = []
	{
		std::vector<Trial> list;
		for (const auto& group : {trialsOfScale(), trialsOfMotion(), trialsOfHandling(), trialsOfLoading()})
			list.insert(list.end(), group.begin(), group.end());
		return list;
	}();
	return all;
}

const Trial* findTrial(const std::string& fullName)
{
	for (const Trial& trial : stabilityTrials())
		if (fullName == trial.fullName())
			return &trial;
	return nullptr;
}
}  // namespace ep
