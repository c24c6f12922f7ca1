// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "sound/Voice.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace ep
{
namespace
{
/// What is a hundred times as much sounds twice as strong.
double strength(double energy) { return std::min(1., std::max(0., (std::log10(std::max(energy, 1.)) - 1) / 5)); }

struct Tone
{
	double frequency, share, decay;  ///< [Hz], of the whole, time in which it falls to 1/e [s]
};

/// Noise through a low pass.
struct Noise
{
	double highest, share, decay;  ///< [Hz], and as of a tone
};

struct Timbre
{
	std::vector<Tone> tones;
	Noise noise;
};

Timbre timbreOf(const Burst& burst)
{
	const double large = strength(burst.energy), slow = 1 + 2 * large;
	if (burst.kind == Burst::Kind::Charge)
		return {{{35, .5, .7}}, {400, .5, .9}};
	if (burst.kind == Burst::Kind::Blow)
		return {{{140 / slow, .6, .06 * slow}}, {1200 / slow, .4, .03 * slow}};
	if (!burst.isSteel)
		return {{}, {2500 / slow, 1, .1 * slow}};
	// A free bar's first modes of bending, and the crack itself.
	const double first = 900 / slow;
	return {{{first, .3, .12 * slow}, {first * 2.756, .25, .08 * slow}, {first * 5.404, .15, .05 * slow}},
			{6000, .3, .02}};
}
}  // namespace

float loudnessOf(const Burst& burst) { return float(strength(burst.energy)); }

std::vector<float> voiceOf(const Burst& burst, int samplesPerSecond)
{
	const Timbre timbre = timbreOf(burst);
	const Noise& noise = timbre.noise;
	double longest = noise.decay;
	for (const Tone& tone : timbre.tones)
		longest = std::max(longest, tone.decay);
	const double pi = 3.14159265358979, dt = 1. / samplesPerSecond, pass = 1 - std::exp(-2 * pi * noise.highest * dt);
	std::minstd_rand random;
	double passed = 0;
	std::vector<float> samples(size_t(5 * longest * samplesPerSecond));  // then it is below a hundredth
	for (size_t i = 0; i < samples.size(); ++i)
	{
		const double time = double(i) * dt, white = 2 * double(random()) / double(std::minstd_rand::max()) - 1;
		passed += pass * (white - passed);
		// As strong as before the low pass.
		double sum = noise.share * std::exp(-time / noise.decay) * passed / std::sqrt(pass);
		for (const Tone& tone : timbre.tones)
			sum += tone.share * std::exp(-time / tone.decay) * std::sin(2 * pi * tone.frequency * time);
		samples[i] = float(std::min(1., std::max(-1., sum)));
	}
	return samples;
}
}  // namespace ep
