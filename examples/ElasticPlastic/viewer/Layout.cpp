// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Layout.h"

#include <algorithm>

namespace ep
{
namespace
{
const int GAP = 3;
}

Layout::Layout(size_t numViews, bool hasChart, int width, int height)
{
	// A window may have no size at all.
	width = std::max(width, 4 * GAP);
	height = std::max(height, 4 * GAP);
	const bool one = numViews < 2;
	const int rows = one ? 3 : int(numViews) - 1 + hasChart, column = width / 3;
	const auto beside = [&](int row)
	{
		const int top = height * row / rows, bottom = height * (row + 1) / rows;
		return Tile{width - column + GAP, height - bottom, column - GAP,
					std::max(1, bottom - top - (row > 0 ? GAP : 0))};
	};
	views.push_back({0, 0, one ? width : width - column, height});
	for (size_t i = 1; i < numViews; ++i)
		views.push_back(beside(int(i) - 1));
	chart = beside(rows - 1);
}
}  // namespace ep
