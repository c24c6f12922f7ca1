// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Raster.h"

#include <algorithm>
#include <cmath>

#include "picture/Shade.h"

namespace ep
{
namespace
{
const float NEAR_W = 0.5f;
const int SHADOW_SIZE = 3072, SAMPLES = 2;

/// A vertex in the picture: pixels, depth, and 1/w for perspective.
struct Corner
{
	float x, y, z, inverseW;
};

/// Depth and triangle of each pixel.
class DepthBuffer
{
public:
	DepthBuffer(int width, int height)
		: m_width(width), m_height(height), m_depth(size_t(width) * height, 2.f), m_triangle(m_depth.size(), -1)
	{
	}

	Corner corner(const Matrix& matrix, const Vector& point) const
	{
		const std::array<float, 4> c = matrix * point;
		return {(c[0] / c[3] * .5f + .5f) * m_width, (.5f - c[1] / c[3] * .5f) * m_height, c[2] / c[3], 1 / c[3]};
	}

	/// Weights of a triangle's corners at a pixel's centre, linear in the picture; negative outside.
	static std::array<float, 3> weights(const Corner (&t)[3], float x, float y)
	{
		const float area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
		const float b = ((x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (y - t[0].y)) / area;
		const float c = ((t[1].x - t[0].x) * (y - t[0].y) - (x - t[0].x) * (t[1].y - t[0].y)) / area;
		return {1 - b - c, b, c};
	}

	void draw(const Corner (&t)[3], int triangle)
	{
		const auto range = [](float a, float b, float c, int size)
		{
			return std::make_pair(std::max(0, int(std::floor(std::min({a, b, c})))),
								  std::min(size - 1, int(std::ceil(std::max({a, b, c})))));
		};
		const auto xs = range(t[0].x, t[1].x, t[2].x, m_width), ys = range(t[0].y, t[1].y, t[2].y, m_height);
		for (int y = ys.first; y <= ys.second; ++y)
			for (int x = xs.first; x <= xs.second; ++x)
			{
				const std::array<float, 3> w = weights(t, x + .5f, y + .5f);
				// A triangle without area has no finite weights.
				if (!(w[0] >= 0 && w[1] >= 0 && w[2] >= 0))
					continue;
				const float z = w[0] * t[0].z + w[1] * t[1].z + w[2] * t[2].z;
				const size_t i = size_t(y) * m_width + x;
				if (z < -1 || z >= m_depth[i])
					continue;
				m_depth[i] = z;
				m_triangle[i] = triangle;
			}
	}

	int width() const { return m_width; }
	float depth(int x, int y) const { return m_depth[size_t(y) * m_width + x]; }
	int triangle(int x, int y) const { return m_triangle[size_t(y) * m_width + x]; }

private:
	int m_width, m_height;
	std::vector<float> m_depth;
	std::vector<int> m_triangle;
};

template <size_t N>
void blend(std::array<float, N>& to, const std::array<float, N>& from, float weight)
{
	for (size_t i = 0; i < N; ++i)
		to[i] += from[i] * weight;
}

Vertex blend(const Vertex (&vertices)[3], const std::array<float, 3>& weights)
{
	Vertex result = {};
	for (int i = 0; i < 3; ++i)
	{
		blend(result.position, vertices[i].position, weights[i]);
		blend(result.normal, vertices[i].normal, weights[i]);
		blend(result.colour, vertices[i].colour, weights[i]);
		blend(result.edges, vertices[i].edges, weights[i]);
		result.gloss += vertices[i].gloss * weights[i];
	}
	return result;
}

/// Cuts off what is behind the camera's near plane.
std::vector<Vertex> clipped(const std::vector<Vertex>& mesh, const Matrix& matrix)
{
	std::vector<Vertex> result;
	for (size_t t = 0; t < mesh.size(); t += 3)
	{
		std::vector<Vertex> polygon;
		for (int i = 0; i < 3; ++i)
		{
			const Vertex &a = mesh[t + i], &b = mesh[t + (i + 1) % 3];
			const float wa = (matrix * a.position)[3] - NEAR_W, wb = (matrix * b.position)[3] - NEAR_W;
			if (wa >= 0)
				polygon.push_back(a);
			if (wa * wb < 0)
				polygon.push_back(blend({a, b, b}, {wb / (wb - wa), -wa / (wb - wa), 0}));
		}
		for (size_t i = 2; i < polygon.size(); ++i)
			result.insert(result.end(), {polygon[0], polygon[i - 1], polygon[i]});
	}
	return result;
}

class ShadowMap
{
public:
	ShadowMap(const std::vector<Vertex>& mesh, const btVector3& centre)
		: m_matrix(sunMatrix(centre)), m_buffer(SHADOW_SIZE, SHADOW_SIZE)
	{
		for (size_t t = 0; t < mesh.size(); t += 3)
			m_buffer.draw({at(mesh[t].position), at(mesh[t + 1].position), at(mesh[t + 2].position)}, 0);
	}

	/// The mean over a few neighbours makes the shadow's edge soft.
	float light(const Vector& point, const Vector& normal) const
	{
		Vector lifted = point;
		blend(lifted, normal, .08f);
		const Corner c = at(lifted);
		const int reach = 2, x0 = int(c.x), y0 = int(c.y);
		if (x0 < reach || y0 < reach || x0 >= SHADOW_SIZE - reach || y0 >= SHADOW_SIZE - reach)
			return 1;
		float sum = 0;
		for (int y = y0 - reach; y <= y0 + reach; ++y)
			for (int x = x0 - reach; x <= x0 + reach; ++x)
				sum += m_buffer.depth(x, y) < c.z - 1.2e-3f ? 0.f : 1.f;
		return sum / float((2 * reach + 1) * (2 * reach + 1));
	}

private:
	Corner at(const Vector& point) const { return m_buffer.corner(m_matrix, point); }

	Matrix m_matrix;
	DepthBuffer m_buffer;
};
}  // namespace

Image drawPicture(const View& view, int width, int height)
{
	const Camera& camera = view.camera;
	const float aspect = float(width) / float(height);
	const Matrix matrix = cameraMatrix(camera, aspect);
	const CameraAxes axes = cameraAxes(camera, aspect);
	const Vector eye = toVector(camera.eye);
	const std::vector<Vertex> whole = makeMesh(view.parts, view.skins), mesh = clipped(whole, matrix);
	const ShadowMap shadows(whole, camera.target);
	const SunLight sun = [&](const Vector& point, const Vector& normal) { return shadows.light(point, normal); };

	DepthBuffer buffer(width * SAMPLES, height * SAMPLES);
	std::vector<Corner> corners;
	for (const Vertex& vertex : mesh)
		corners.push_back(buffer.corner(matrix, vertex.position));
	for (size_t t = 0; t < corners.size(); t += 3)
		buffer.draw({corners[t], corners[t + 1], corners[t + 2]}, int(t));

	const auto sample = [&](int x, int y)
	{
		const int t = buffer.triangle(x, y);
		if (t < 0)
		{
			Vector direction = axes.forward;
			blend(direction, axes.right, 2 * (x + .5f) / float(width * SAMPLES) - 1);
			blend(direction, axes.up, 1 - 2 * (y + .5f) / float(height * SAMPLES));
			return shadeBackground(eye, direction, sun);
		}
		std::array<float, 3> w = DepthBuffer::weights({corners[t], corners[t + 1], corners[t + 2]}, x + .5f, y + .5f);
		float sum = 0;
		for (int i = 0; i < 3; ++i)
			sum += w[i] *= corners[t + i].inverseW;
		for (float& weight : w)
			weight /= sum;
		return shadeSurface(blend({mesh[t], mesh[t + 1], mesh[t + 2]}, w), eye, sun);
	};

	Image image = {width, height, {}};
	image.pixels.reserve(size_t(3) * width * height);
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x)
		{
			Vector light = {0, 0, 0};
			for (int s = 0; s < SAMPLES * SAMPLES; ++s)
				blend(light, sample(x * SAMPLES + s % SAMPLES, y * SAMPLES + s / SAMPLES), 1.f / (SAMPLES * SAMPLES));
			for (float channel : light)
				image.pixels.push_back(displayValue(channel));
		}
	return image;
}
}  // namespace ep
