#include "Judgement.h"

#include <algorithm>
#include <cmath>

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

double orderOf(const std::vector<const Record*>& records, const std::string& family)
{
	double n = 0, x = 0, y = 0, xx = 0, xy = 0;
	for (const Record* r : records)
	{
		if (r->family() != family || r->substeps != 1 || r->iterations != 10 || r->jointClass == "spring" ||
			r->precision != "double" || !(r->error > 1e-12) || r->error > 0.5)
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
}  // namespace ep
