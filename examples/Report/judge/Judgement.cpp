// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "judge/Judgement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ep
{
std::vector<const Record*> nonDominated(const std::vector<const Record*>& records)
{
	std::vector<const Record*> sorted = records, front;
	std::sort(sorted.begin(), sorted.end(),
			  [](const Record* a, const Record* b)
			  { return a->cost() != b->cost() ? a->cost() < b->cost() : a->error < b->error; });
	// What is right to a millionth is right: below there is rounding.
	const auto errorOf = [](const Record* r) { return std::max(r->error, 1e-6); };
	for (const Record* record : sorted)
		if (std::isfinite(record->error) && (front.empty() || errorOf(record) < errorOf(front.back())))
			front.push_back(record);
	return front;
}

const Record* quickestWithin(const std::vector<const Record*>& records, double error)
{
	const Record* best = nullptr;
	for (const Record* record : records)
		if (record->error <= error && (!best || record->cost() < best->cost()))
			best = record;
	return best;
}

const Record* quickestReliable(const std::vector<const Record*>& records, double error)
{
	// All but the step makes a method; its finest step that fails spoils those as coarse and coarser.
	std::map<decltype(std::declval<Record>().method()), double> failing;
	for (const Record* r : records)
		if (!(r->error <= error))
		{
			const auto known = failing.emplace(r->method(), r->substep()).first;
			known->second = std::min(known->second, r->substep());
		}
	std::vector<const Record*> reliable;
	for (const Record* r : records)
	{
		const auto known = failing.find(r->method());
		// The same substep may come as a step of its own.
		if (known == failing.end() || r->substep() < known->second * (1 - 1e-6))
			reliable.push_back(r);
	}
	return quickestWithin(reliable, error);
}

double orderOf(const std::vector<const Record*>& records, const Family& family)
{
	double n = 0, x = 0, y = 0, xx = 0, xy = 0;
	for (const Record* r : records)
	{
		if (r->family() != family || r->budget > 0 || r->substeps != 1 || r->iterations != 10 ||
			r->jointClass == JointClass::Spring || r->precision != Precision::Double || !(r->error > 1e-12) ||
			r->error > 0.5)
			continue;
		const double u = std::log(r->dt), v = std::log(r->error);
		n += 1;
		x += u;
		y += v;
		xx += u * u;
		xy += u * v;
	}
	return n < 3 ? NAN : (n * xy - x * y) / (n * xx - x * x);
}

double median(std::vector<double> values)
{
	if (values.empty())
		return NAN;
	const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
	std::nth_element(values.begin(), middle, values.end());
	return *middle;
}

double spreadOfTimes(const std::vector<Record>& records)
{
	std::vector<double> spreads;
	for (const Record& r : records)
		if (std::isfinite(r.spread))
			spreads.push_back(r.spread);
	return median(std::move(spreads));
}
}  // namespace ep
