// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Shade.h"

#include <algorithm>
#include <cmath>

namespace ep
{
namespace
{
const Vector SUN = {2.35f, 2.08f, 1.65f}, ABOVE = {.27f, .36f, .52f}, BELOW = {.17f, .155f, .12f};
const Vector ZENITH = {.03f, .15f, .52f}, HORIZON = {.50f, .69f, .93f};

Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator*(const Vector& a, const Vector& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
Vector operator*(const Vector& a, float s) { return {a[0] * s, a[1] * s, a[2] * s}; }
float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
float length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector unit(const Vector& a) { return a * (1 / length(a)); }
Vector mix(const Vector& a, const Vector& b, float t) { return a * (1 - t) + b * t; }
float clamp01(float x) { return std::min(1.f, std::max(0.f, x)); }

float smoothstep(float from, float to, float x)
{
	const float t = clamp01((x - from) / (to - from));
	return t * t * (3 - 2 * t);
}

float hash(float x, float y)
{
	const float h = std::sin(x * 12.9898f + y * 78.233f) * 43758.547f;
	return h - std::floor(h);
}

/// Smooth noise of cell size 1, 0 to 1.
float noise(float x, float y)
{
	const float ix = std::floor(x), iy = std::floor(y), u = smoothstep(0, 1, x - ix), v = smoothstep(0, 1, y - iy);
	const float a = hash(ix, iy) * (1 - u) + hash(ix + 1, iy) * u;
	const float b = hash(ix, iy + 1) * (1 - u) + hash(ix + 1, iy + 1) * u;
	return a * (1 - v) + b * v;
}

Vector sky(const Vector& direction) { return mix(HORIZON, ZENITH, std::sqrt(clamp01(direction[1]))); }

Vector fog(const Vector& light, float distance) { return mix(HORIZON, light, std::exp(-distance / 900)); }

Vector lit(const Vector& colour, const Vector& normal, float sunLight)
{
	const float facing = std::max(0.f, dot(normal, sunDirection()));
	return colour * (mix(BELOW, ABOVE, .5f + .5f * normal[1]) + SUN * (facing * sunLight));
}

/// A line of a grid with the given spacing, 1 on the line; it fades where it is finer than a pixel of the given size.
float gridLine(float x, float spacing, float width, float pixel)
{
	const float offset = std::fabs(x / spacing - std::floor(x / spacing + .5f)) * spacing;
	return (1 - smoothstep(width / 2, width / 2 + pixel, offset)) * std::min(1.f, width / pixel);
}
}  // namespace

Vector shadeSurface(const Vertex& s, const Vector& eye, const SunLight& sun)
{
	const Vector toEye = eye + s.position * -1, normal = unit(s.normal);
	const float distance = length(toEye);
	const float edge = std::min(std::min(s.edges[0], s.edges[1]), std::min(s.edges[2], s.edges[3]));
	const float grain = noise(s.edges[0] * 1.7f, s.edges[2] * 1.7f) + .5f * noise(s.edges[0] * 9, s.edges[2] * 9);
	const float tone = (.72f + .28f * smoothstep(0, .09f, edge)) * (.91f + .12f * grain);
	const float sunLight = sun(s.position, normal);
	const Vector half = unit(unit(toEye) + sunDirection());
	const float shine = s.gloss * std::pow(std::max(0.f, dot(normal, half)), 40.f) * sunLight;
	return fog(lit({s.colour[0] * tone, s.colour[1] * tone, s.colour[2] * tone}, normal, sunLight) + SUN * shine,
			   distance);
}

Vector shadeBackground(const Vector& eye, const Vector& direction, const SunLight& sun)
{
	const Vector d = unit(direction);
	if (d[1] > -1e-4f || eye[1] <= 0)
		return sky(d);
	const float distance = -eye[1] / d[1];
	const Vector point = eye + d * distance;
	const float pixel = .0012f * distance / std::max(.02f, -d[1]);
	const float patches = noise(point[0] / 11, point[2] / 11) * .6f + noise(point[0] / 2.3f, point[2] / 2.3f) * .4f;
	const Vector grass = mix({.13f, .17f, .075f}, {.21f, .23f, .11f}, patches);
	const float line = std::max(gridLine(point[0], 10, .12f, pixel), gridLine(point[2], 10, .12f, pixel));
	const Vector up = {0, 1, 0};
	return fog(lit(grass * (1 - .28f * line), up, sun(point, up)), distance);
}

unsigned char displayValue(float light)
{
	// A film's curve (Narkowicz's fit of ACES): contrast in the middle, and bright concrete does not burn out.
	const float x = .72f * light, film = x * (2.51f * x + .03f) / (x * (2.43f * x + .59f) + .14f);
	const float shown = std::pow(clamp01(film), 1 / 2.2f);
	return static_cast<unsigned char>(255 * clamp01(shown) + .5f);
}
}  // namespace ep
