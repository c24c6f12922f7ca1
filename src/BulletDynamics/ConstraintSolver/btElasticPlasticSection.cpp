// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticSection.h"

#include "LinearMath/btMinMax.h"

#include <math.h>

namespace
{
const double PI = 3.14159265358979323846;

/// Plastic torsion modulus of a rectangle: twice the volume of the sand heap of unit slope on it (Nadai, Plasticity, 1931).
double sandHeap(double b, double h)
{
	const double lo = btMin(b, h), hi = btMax(b, h);
	return lo * lo * (3 * hi - lo) / 6;
}

/// Integral of the distance from the centre over a rectangle, the paper's Figure 5 in closed form.
double polarIntegral(double b, double h)
{
	const double a = b / 2, c = h / 2, d = sqrt(a * a + c * c);
	return 4 * (a * c * d / 3 + a * a * a / 6 * log((c + d) / a) + c * c * c / 6 * log((a + d) / c));
}

/// Saint-Venant's series for the torsion constant of a rectangle (Timoshenko and Goodier, section 109);
/// the terms fall with n^-5: eight of them leave 1e-7 of J.
double torsionConstant(double b, double h)
{
	const double lo = btMin(b, h), hi = btMax(b, h);
	double sum = 0;
	for (int n = 1; n <= 15; n += 2)
		sum += tanh(n * PI * hi / (2 * lo)) / pow(double(n), 5);
	return hi * lo * lo * lo / 3 * (1 - 192 * lo / (pow(PI, 5) * hi) * sum);
}

bool isPositive(btElasticPlasticSection& section, const char* quantity, btScalar value)
{
	section.m_fault = btElasticPlasticCheckPositive(quantity, value);
	return !section.m_fault;
}

bool isBelow(btElasticPlasticSection& section, const char* quantity, btScalar value, btScalar limit, const char* range)
{
	if (!isPositive(section, quantity, value))
		return false;
	if (value < limit)
		return true;
	section.m_fault = btElasticPlasticFault(quantity, value, range);
	return false;
}

void addRectangle(btElasticPlasticSection& s, double y, double z, double height, double width)
{
	btElasticPlasticSectionPart part;
	part.m_y = btScalar(y);
	part.m_z = btScalar(z);
	part.m_height = btScalar(height);
	part.m_width = btScalar(width);
	s.m_parts.push_back(part);
}

void setRound(btElasticPlasticSection& s, double r, double inner, double plasticShearShare)
{
	const double m2 = inner * inner / (r * r), n = (1 + m2) * (1 + m2);
	s.m_area = btScalar(PI * (r * r - inner * inner));
	s.m_torsionConstant = btScalar(PI / 2 * (pow(r, 4) - pow(inner, 4)));
	s.m_plasticTorsionModulus = btScalar(2 * PI / 3 * (pow(r, 3) - pow(inner, 3)));
	btElasticPlasticSectionPart ring;
	ring.m_radius = btScalar(r);
	ring.m_innerRadius = btScalar(inner);
	s.m_parts.push_back(ring);
	for (int i = 0; i < 2; ++i)
	{
		// Cowper, The shear coefficient in Timoshenko's beam theory, 1966, hollow circle at nu = 0.
		s.m_shearArea[i] = btScalar(s.m_area * 6 * n / (7 * n + 20 * m2));
		s.m_plasticShearArea[i] = btScalar(s.m_area * plasticShearShare);
		s.m_secondMoment[i] = s.m_torsionConstant / 2;
		s.m_plasticModulus[i] = btScalar(4. / 3 * (pow(r, 3) - pow(inner, 3)));
		s.m_outerFibre[i] = btScalar(r);
	}
}
}  // namespace

btElasticPlasticSection btElasticPlasticSection::rectangle(btScalar width, btScalar height,
														   btElasticPlasticTorsion torsion)
{
	btElasticPlasticSection s;
	if (!isPositive(s, "section width [m]", width) || !isPositive(s, "section height [m]", height))
		return s;
	if (torsion < BT_EP_TORSION_EXACT || torsion > BT_EP_TORSION_POLAR)
	{
		s.m_fault =
			btElasticPlasticFault("plastic torsion modulus", btScalar(torsion), "one of btElasticPlasticTorsion");
		return s;
	}
	const double b = width, h = height;
	s.m_area = btScalar(b * h);
	s.m_torsionConstant = btScalar(torsionConstant(b, h));
	s.m_plasticTorsionModulus = btScalar(torsion == BT_EP_TORSION_PAPER   ? 0.38 * b * h * (b + h) / 2
										 : torsion == BT_EP_TORSION_POLAR ? polarIntegral(b, h)
																		  : sandHeap(b, h));
	for (int i = 0; i < 2; ++i)
	{
		s.m_shearArea[i] = btScalar(b * h * 5 / 6);
		s.m_plasticShearArea[i] = s.m_area;
	}
	s.m_secondMoment[0] = btScalar(h * b * b * b / 12);
	s.m_secondMoment[1] = btScalar(b * h * h * h / 12);
	s.m_plasticModulus[0] = btScalar(b * b * h / 4);
	s.m_plasticModulus[1] = btScalar(b * h * h / 4);
	s.m_outerFibre[0] = btScalar(h / 2);
	s.m_outerFibre[1] = btScalar(b / 2);
	addRectangle(s, 0, 0, h, b);
	return s;
}

btElasticPlasticSection btElasticPlasticSection::circle(btScalar radius)
{
	btElasticPlasticSection s;
	if (isPositive(s, "section radius [m]", radius))
		setRound(s, radius, 0, 1);
	return s;
}

btElasticPlasticSection btElasticPlasticSection::hollowCircle(btScalar radius, btScalar wall)
{
	btElasticPlasticSection s;
	// The wall may be half of the radius itself.
	if (isPositive(s, "section radius [m]", radius) &&
		isBelow(s, "section wall [m]", wall, radius * (btScalar(0.5) + SIMD_EPSILON),
				"greater than 0 and at most half of the radius; with an inner radius use tube()"))
		setRound(s, radius, radius - wall, 2 / PI);
	return s;
}

btElasticPlasticSection btElasticPlasticSection::tube(btScalar outerRadius, btScalar innerRadius)
{
	btElasticPlasticSection s;
	if (isPositive(s, "section outer radius [m]", outerRadius) &&
		isBelow(s, "section inner radius [m]", innerRadius, outerRadius, "greater than 0 and less than the outer one"))
		setRound(s, outerRadius, innerRadius, 2 / PI);
	return s;
}

btElasticPlasticSection btElasticPlasticSection::hollowRectangle(btScalar width, btScalar height, btScalar wall)
{
	btElasticPlasticSection s;
	if (!isPositive(s, "section width [m]", width) || !isPositive(s, "section height [m]", height) ||
		!isBelow(s, "section wall [m]", wall, btMin(width, height) / 2,
				 "greater than 0 and less than half of width and height"))
		return s;
	const double b = width, h = height, t = wall, bi = b - 2 * t, hi = h - 2 * t;
	s.m_area = btScalar(b * h - bi * hi);
	s.m_torsionConstant = btScalar(2 * t * (b - t) * (b - t) * (h - t) * (h - t) / (b + h - 2 * t));
	s.m_plasticTorsionModulus = btScalar(sandHeap(b, h) - sandHeap(bi, hi));
	s.m_shearArea[0] = s.m_plasticShearArea[0] = btScalar(s.m_area * h / (b + h));
	s.m_shearArea[1] = s.m_plasticShearArea[1] = btScalar(s.m_area * b / (b + h));
	s.m_secondMoment[0] = btScalar((h * b * b * b - hi * bi * bi * bi) / 12);
	s.m_secondMoment[1] = btScalar((b * h * h * h - bi * hi * hi * hi) / 12);
	s.m_plasticModulus[0] = btScalar((b * b * h - bi * bi * hi) / 4);
	s.m_plasticModulus[1] = btScalar((b * h * h - bi * hi * hi) / 4);
	s.m_outerFibre[0] = btScalar(h / 2);
	s.m_outerFibre[1] = btScalar(b / 2);
	for (int side = -1; side <= 1; side += 2)
	{
		addRectangle(s, side * (h - t) / 2, 0, t, b);
		addRectangle(s, 0, side * (b - t) / 2, hi, t);
	}
	return s;
}

btElasticPlasticSection btElasticPlasticSection::iSection(btScalar width, btScalar height, btScalar web,
														  btScalar flange)
{
	btElasticPlasticSection s;
	if (!isPositive(s, "section width [m]", width) || !isPositive(s, "section height [m]", height) ||
		!isBelow(s, "section web [m]", web, width, "greater than 0 and less than the width") ||
		!isBelow(s, "section flange [m]", flange, height / 2, "greater than 0 and less than half of the height"))
		return s;
	const double b = width, h = height, tw = web, tf = flange, hw = h - 2 * tf;
	s.m_area = btScalar(2 * b * tf + hw * tw);
	s.m_torsionConstant = btScalar((2 * b * tf * tf * tf + hw * tw * tw * tw) / 3);
	// The web's heap runs into the flanges' heaps at both ends: no hips of its own.
	s.m_plasticTorsionModulus = btScalar(2 * sandHeap(b, tf) + hw * tw * tw / 2);
	s.m_shearArea[0] = s.m_plasticShearArea[0] = btScalar(hw * tw);
	s.m_shearArea[1] = btScalar(2 * b * tf * 5 / 6);
	s.m_plasticShearArea[1] = btScalar(2 * b * tf);
	s.m_secondMoment[0] = btScalar((2 * tf * b * b * b + hw * tw * tw * tw) / 12);
	s.m_secondMoment[1] = btScalar((b * h * h * h - (b - tw) * hw * hw * hw) / 12);
	s.m_plasticModulus[0] = btScalar(b * b * tf / 2 + hw * tw * tw / 4);
	s.m_plasticModulus[1] = btScalar(b * tf * (h - tf) + tw * hw * hw / 4);
	s.m_outerFibre[0] = btScalar(h / 2);
	s.m_outerFibre[1] = btScalar(b / 2);
	addRectangle(s, 0, 0, hw, tw);
	for (int side = -1; side <= 1; side += 2)
		addRectangle(s, side * (h - tf) / 2, 0, tf, b);
	return s;
}
