// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "run/Variation.h"

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "text/Format.h"

namespace ep
{
namespace
{
const size_t MOST_CASES = 1000000;

/// "path=rest"
std::pair<std::string, std::string> split(const std::string& text, const char* option, const char* form)
{
	const size_t equals = text.find('=');
	if (equals == std::string::npos || equals == 0)
		throw std::runtime_error(std::string(option) + " is '" + text + "'; it must be " + form);
	return {text.substr(0, equals), text.substr(equals + 1)};
}

struct Sweep
{
	std::string path;
	std::vector<std::string> values;
};

Sweep sweepOf(const std::string& text)
{
	const char* const form = "path=from:to:count with count from 1 to 1000000, such as span=4:8:5";
	const auto [path, rest] = split(text, "--sweep", form);
	double from, to;
	int count;
	char end;
	if (sscanf(rest.c_str(), "%lf:%lf:%d%c", &from, &to, &count, &end) != 3 || count < 1 || count > int(MOST_CASES) ||
		!std::isfinite(from) || !std::isfinite(to))
		throw std::runtime_error("--sweep is '" + text + "'; it must be " + form);
	Sweep sweep = {path, {}};
	for (int i = 0; i < count; ++i)
		sweep.values.push_back(format("%.12g", count == 1 ? from : from + (to - from) * i / (count - 1)));
	return sweep;
}

typedef std::function<double(std::mt19937_64&)> Draw;

Draw drawOf(const std::string& text, const std::string& law)
{
	char name[16];
	double a, b;
	char end;
	const bool isRead = sscanf(law.c_str(), "%15[a-z](%lf,%lf)%c", name, &a, &b, &end) == 3 && law.back() == ')' &&
						std::isfinite(a) && std::isfinite(b);
	const std::string kind = isRead ? name : "";
	if (kind == "normal" && b >= 0)
		return [a, b](std::mt19937_64& random) { return a + b * std::normal_distribution<double>()(random); };
	if (kind == "lognormal" && a > 0 && b >= 0)
		return [a, b](std::mt19937_64& random) { return a * std::exp(b * std::normal_distribution<double>()(random)); };
	if (kind == "uniform" && a <= b)
		return [a, b](std::mt19937_64& random) { return std::uniform_real_distribution<double>(a, b)(random); };
	throw std::runtime_error("--vary is '" + text +
							 "'; it must be path=normal(mean,deviation), path=uniform(from,to) or "
							 "path=lognormal(median,deviation)");
}
}  // namespace

Variation Variation::make(const std::vector<std::string>& sweeps, int random, const std::vector<std::string>& vary,
						  unsigned seed)
{
	if ((random > 0) == vary.empty())
		throw std::runtime_error("--random and --vary belong together: how many cases, and what is drawn");
	Variation all;
	all.cases.emplace_back();
	for (const std::string& text : sweeps)
	{
		const Sweep sweep = sweepOf(text);
		all.paths.push_back(sweep.path);
		std::vector<std::vector<std::string>> cases;
		if (all.cases.size() * sweep.values.size() > MOST_CASES)
			throw std::runtime_error("--sweep makes more than " + std::to_string(MOST_CASES) + " cases");
		for (const auto& before : all.cases)
			for (const std::string& value : sweep.values)
			{
				cases.push_back(before);
				cases.back().push_back(value);
			}
		all.cases = cases;
	}
	if (vary.empty())
		return all;
	if (all.cases.size() * size_t(random) > MOST_CASES)
		throw std::runtime_error("--random makes more than " + std::to_string(MOST_CASES) + " cases");
	std::vector<Draw> draws;
	for (const std::string& text : vary)
	{
		const auto [path, law] = split(text, "--vary", "path=normal(mean,deviation)");
		all.paths.push_back(path);
		draws.push_back(drawOf(text, law));
	}
	std::mt19937_64 generator(seed);
	std::vector<std::vector<std::string>> cases;
	for (const auto& before : all.cases)
		for (int i = 0; i < random; ++i)
		{
			cases.push_back(before);
			for (const Draw& draw : draws)
				cases.back().push_back(format("%.12g", draw(generator)));
		}
	all.cases = cases;
	return all;
}

std::string Variation::text() const
{
	std::string text = "case";
	for (const std::string& path : paths)
		text += "," + path;
	for (size_t i = 0; i < cases.size(); ++i)
	{
		text += "\n" + std::to_string(i + 1);
		for (const std::string& value : cases[i])
			text += "," + value;
	}
	return text + "\n";
}
}  // namespace ep
