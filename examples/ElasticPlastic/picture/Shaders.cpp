// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Shaders.h"

namespace ep
{
const char* const SHADER_LIGHT = R"(#version 120
uniform vec3 eye;
uniform vec3 toSun;
uniform mat4 sunMatrix;
uniform sampler2DShadow shadowMap;

const vec3 SUN = vec3(2.35, 2.08, 1.65), ABOVE = vec3(.27, .36, .52), BELOW = vec3(.17, .155, .12);
const vec3 ZENITH = vec3(.03, .15, .52), HORIZON = vec3(.50, .69, .93);

float hash(vec2 p)
{
	return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.547);
}

float noise(vec2 p)
{
	vec2 i = floor(p), f = smoothstep(0., 1., p - i);
	return mix(mix(hash(i), hash(i + vec2(1., 0.)), f.x), mix(hash(i + vec2(0., 1.)), hash(i + vec2(1., 1.)), f.x), f.y);
}

float sunLight(vec3 point, vec3 normal)
{
	vec3 place = (sunMatrix * vec4(point + .08 * normal, 1.)).xyz * .5 + .5;
	if (any(lessThan(place, vec3(0.))) || any(greaterThan(place, vec3(1.))))
		return 1.;
	float sum = 0.;
	for (int y = 0; y < 2; ++y)
		for (int x = 0; x < 2; ++x)
			sum += shadow2D(shadowMap, place + vec3(vec2(float(x) - .5, float(y) - .5) * 1.8 / 2048., -1.2e-3)).r;
	return sum / 4.;
}

vec3 lit(vec3 colour, vec3 normal, float light)
{
	return colour * (mix(BELOW, ABOVE, .5 + .5 * normal.y) + SUN * max(0., dot(normal, toSun)) * light);
}

vec3 fog(vec3 light, float distance)
{
	return mix(HORIZON, light, exp(-distance / 900.));
}

vec4 display(vec3 light)
{
	vec3 x = .72 * light, film = x * (2.51 * x + .03) / (x * (2.43 * x + .59) + .14);
	return vec4(pow(clamp(film, 0., 1.), vec3(1. / 2.2)), 1.);
}
)";

const char* const SHADER_SURFACE_VERTEX = R"(#version 120
uniform mat4 viewMatrix;
attribute vec3 position;
attribute vec3 normal;
attribute vec3 colour;
attribute vec4 edges;
attribute float gloss;
varying vec3 vPosition, vNormal, vColour;
varying vec4 vEdges;
varying float vGloss;

void main()
{
	vPosition = position;
	vNormal = normal;
	vColour = colour;
	vEdges = edges;
	vGloss = gloss;
	gl_Position = viewMatrix * vec4(position, 1.);
}
)";

const char* const SHADER_SURFACE = R"(
varying vec3 vPosition, vNormal, vColour;
varying vec4 vEdges;
varying float vGloss;

void main()
{
	vec3 toEye = eye - vPosition, normal = normalize(vNormal);
	float edge = min(min(vEdges.x, vEdges.y), min(vEdges.z, vEdges.w));
	float grain = noise(vEdges.xz * 1.7) + .5 * noise(vEdges.xz * 9.);
	float tone = (.72 + .28 * smoothstep(0., .09, edge)) * (.91 + .12 * grain);
	float light = sunLight(vPosition, normal);
	float shine = vGloss * pow(max(0., dot(normal, normalize(normalize(toEye) + toSun))), 40.) * light;
	gl_FragColor = display(fog(lit(vColour * tone, normal, light) + SUN * shine, length(toEye)));
}
)";

// Across a puff the first two edges run from -1 to 1; the third is its opacity.
const char* const SHADER_PUFF = R"(
varying vec3 vPosition, vColour;
varying vec4 vEdges;

void main()
{
	float thickness = max(0., 1. - dot(vEdges.xy, vEdges.xy));
	gl_FragColor = vec4(display(fog(vColour, length(eye - vPosition))).rgb, vEdges.z * thickness);
}
)";

const char* const SHADER_BACKGROUND_VERTEX = R"(#version 120
uniform vec3 right, up, forward;
attribute vec3 position;
varying vec3 vDirection;

void main()
{
	vDirection = forward + right * position.x + up * position.y;
	gl_Position = vec4(position.xy, 1., 1.);
}
)";

const char* const SHADER_BACKGROUND = R"(
varying vec3 vDirection;

float gridLine(float x, float pixel)
{
	float offset = abs(x / 10. - floor(x / 10. + .5)) * 10.;
	return (1. - smoothstep(.06, .06 + pixel, offset)) * min(1., .12 / pixel);
}

void main()
{
	vec3 d = normalize(vDirection);
	if (d.y > -1e-4 || eye.y <= 0.)
	{
		gl_FragColor = display(mix(HORIZON, ZENITH, sqrt(clamp(d.y, 0., 1.))));
		return;
	}
	float distance = -eye.y / d.y;
	vec3 point = eye + d * distance;
	float pixel = .0012 * distance / max(.02, -d.y);
	float patches = noise(point.xz / 11.) * .6 + noise(point.xz / 2.3) * .4;
	vec3 grass = mix(vec3(.13, .17, .075), vec3(.21, .23, .11), patches);
	float line = max(gridLine(point.x, pixel), gridLine(point.z, pixel));
	vec3 normal = vec3(0., 1., 0.);
	gl_FragColor = display(fog(lit(grass * (1. - .28 * line), normal, sunLight(point, normal)), distance));
}
)";

const char* const SHADER_SHADOW_VERTEX = R"(#version 120
uniform mat4 sunMatrix;
attribute vec3 position;

void main()
{
	gl_Position = sunMatrix * vec4(position, 1.);
}
)";

const char* const SHADER_SHADOW = R"(#version 120
void main()
{
	gl_FragColor = vec4(1.);
}
)";
}  // namespace ep
