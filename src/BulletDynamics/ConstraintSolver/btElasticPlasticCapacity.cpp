// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticCapacity.h"

#include <math.h>

#include <initializer_list>

#include "LinearMath/btMinMax.h"

namespace
{
/// Index of m_coupling: 0 of shear y and bending z, 1 of shear z and bending y.
int planeOf(int dof) { return dof == BT_EP_SHEAR_Y || dof == BT_EP_BENDING_Z ? 0 : 1; }

/// Of fibres that are none, or whose material there is not, or whose bars' material is refused.
btElasticPlasticFault faultOfFibresOf(const btElasticPlasticSection& section)
{
	for (int i = 0; i < section.m_fibres.size(); ++i)
	{
		const btElasticPlasticSectionFibre& fibre = section.m_fibres[i];
		if (fibre.m_material < 0 || fibre.m_material > section.m_materials.size())
			return btElasticPlasticFault("material of a fibre of the section", btScalar(fibre.m_material),
										 "0, or the number of one of the section's materials");
		for (const btScalar place : {fibre.m_y, fibre.m_z})
			if (!btElasticPlasticIsFinite(double(place)))
				return btElasticPlasticFault("place of a fibre of the section, y or z [m]", place, "finite");
		if (btElasticPlasticFault f =
				btElasticPlasticCheckPositive("area of a fibre of the section [m^2]", fibre.m_area))
			return f;
	}
	for (int i = 0; i < section.m_materials.size(); ++i)
		if (btElasticPlasticFault f = section.m_materials[i].fault())
			return f;
	return btElasticPlasticFault();
}

/// E I of a section's bars for bending about y (0) and z (1) [N m^2].
btScalar stiffnessOfBars(const btElasticPlasticSection& section, int bending)
{
	btScalar sum = 0;
	for (int i = 0; i < section.m_fibres.size(); ++i)
	{
		const btElasticPlasticSectionFibre& fibre = section.m_fibres[i];
		const btScalar arm = bending == 0 ? fibre.m_z : fibre.m_y;
		if (fibre.m_material > 0)
			sum += section.m_materials[fibre.m_material - 1].m_youngsModulus * fibre.m_area * (1 + fibre.m_excess) *
				   arm * arm;
	}
	return sum;
}
}  // namespace

btElasticPlasticCapacity::btElasticPlasticCapacity(btElasticPlasticOwnPrecision)
{
	m_rigidPlastic = 0;
	m_coupling[0] = m_coupling[1] = 0;
	m_length = m_damping = m_friction = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		clear(i);
}

void btElasticPlasticCapacity::set(int dof, btScalar stiffness, btScalar yield, btScalar ductility)
{
	if (!btElasticPlasticIsDof(dof))
	{
		m_fault = btElasticPlasticFault("degree of freedom", btScalar(dof), "0 to 5, see btElasticPlasticDof");
		return;
	}
	m_stiffness[dof] = stiffness;
	m_yield[dof] = yield;
	m_ductility[dof] = ductility;
	m_rigidPlastic &= ~(1u << dof);
	if (coupledWith(dof) >= 0)
		m_coupling[planeOf(dof)] = 0;
	if (isOfFibres(dof))
	{
		m_fibres.clear();
		m_curvePoints.clear();
	}
}

void btElasticPlasticCapacity::setRigidPlastic(int dof, btScalar yield, btScalar ductility)
{
	set(dof, 0, yield, ductility);
	if (btElasticPlasticIsDof(dof))
		m_rigidPlastic |= 1u << dof;
}

void btElasticPlasticCapacity::clear(int dof) { set(dof, 0, 0, unlimited()); }

void btElasticPlasticCapacity::scaleYield(btScalar factor)
{
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		m_yield[i] *= factor;
	if (factor == 0)
		m_fibres.clear();
	for (int i = 0; i < m_fibres.size(); ++i)
	{
		m_fibres[i].m_tension *= factor;
		m_fibres[i].m_compression *= factor;
	}
}

namespace
{
btElasticPlasticFault faultOfHeat(const btElasticPlasticHeat& heat)
{
	if (btElasticPlasticFault f = btElasticPlasticCheckNotNegative("what heat leaves of strength", heat.m_strength))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckNotNegative("what heat leaves of stiffness", heat.m_stiffness))
		return f;
	return btElasticPlasticCheckNotNegative("what heat leaves in tension over strength", heat.m_tensileShare);
}
}  // namespace

btElasticPlasticCapacity btElasticPlasticCapacity::heated(const btElasticPlasticHeat& heat) const
{
	btElasticPlasticCapacity hot = *this;
	if (!hot.m_fault)
		hot.m_fault = faultOfHeat(heat);
	if (hot.m_fault)
		return hot;
	const bool isAnyLeft = heat.m_strength > 0 && heat.m_stiffness > 0;
	hot.scaleYield(isAnyLeft ? heat.m_strength : btScalar(0));
	for (int i = 0; i < BT_EP_DOF_COUNT && isAnyLeft; ++i)
		hot.m_stiffness[i] *= heat.m_stiffness;
	for (int i = 0; i < hot.m_fibres.size(); ++i)
	{
		hot.m_fibres[i].m_stiffness *= heat.m_stiffness;
		hot.m_fibres[i].m_tension *= heat.m_tensileShare;
	}
	return hot;
}

btElasticPlasticCapacity btElasticPlasticCapacity::heated(const btElasticPlasticHeat* ofParts, int count) const
{
	btElasticPlasticCapacity hot = *this;
	if (!hot.m_fault && !ofParts)
		hot.m_fault = btElasticPlasticFault("address of the parts' heats", 0, "not null");
	if (!hot.m_fault && count < 1)
		hot.m_fault = btElasticPlasticFault("number of heats", btScalar(count), "1 or more");
	for (int i = 0; i < count && !hot.m_fault; ++i)
		hot.m_fault = faultOfHeat(ofParts[i]);
	if (hot.m_fault)
		return hot;
	bool isAnyLeft = false;
	for (int i = 0; i < m_fibres.size(); ++i)
	{
		const btElasticPlasticHeat& heat = ofParts[btMax(0, btMin(m_fibres[i].m_part, count - 1))];
		isAnyLeft |= heat.m_strength > 0 && heat.m_stiffness > 0;
	}
	if (!isAnyLeft)
	{
		btElasticPlasticHeat all = ofParts[0];
		if (hasFibres())
			all.m_strength = all.m_stiffness = 0;
		return heated(all);
	}
	const btScalar least = btScalar(1e-6);
	for (int i = 0; i < m_fibres.size(); ++i)
	{
		const btElasticPlasticHeat& heat = ofParts[btMax(0, btMin(m_fibres[i].m_part, count - 1))];
		btElasticPlasticFibre& fibre = hot.m_fibres[i];
		fibre.m_stiffness *= btMax(heat.m_stiffness, least);
		fibre.m_compression *= btMax(heat.m_strength, least);
		fibre.m_tension *= btMax(heat.m_strength, least) * heat.m_tensileShare;
	}
	hot.takeFibres(*this);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		if (isOfFibres(i))
			continue;
		// A shear bends the section's halves, too.
		const int bending = coupledWith(i);
		const btScalar bent = bending >= 0 ? hot.m_stiffness[bending] / m_stiffness[bending] : btScalar(1),
					   left = btMax(ofParts[0].m_stiffness, least);
		hot.m_yield[i] *= btMax(ofParts[0].m_strength, least);
		hot.m_stiffness[i] *= btMin(left, bent);
		if (bending >= 0)
			hot.m_coupling[planeOf(i)] *= btSqrt(btMin(left, bent) / bent);
	}
	return hot;
}

bool btElasticPlasticCapacity::isSameAs(const btElasticPlasticCapacity& other) const
{
	bool isSame = m_rigidPlastic == other.m_rigidPlastic && m_length == other.m_length &&
				  m_damping == other.m_damping && m_friction == other.m_friction &&
				  m_fibres.size() == other.m_fibres.size();
	isSame &= m_curvePoints.size() == other.m_curvePoints.size();
	for (int i = 0; isSame && i < m_fibres.size(); ++i)
		isSame = m_fibres[i].isSameAs(other.m_fibres[i]);
	for (int i = 0; isSame && i < m_curvePoints.size(); ++i)
		isSame = m_curvePoints[i].isSameAs(other.m_curvePoints[i]);
	for (int i = 0; i < 2; ++i)
		isSame &= m_coupling[i] == other.m_coupling[i];
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		isSame &= m_stiffness[i] == other.m_stiffness[i] && m_yield[i] == other.m_yield[i] &&
				  m_ductility[i] == other.m_ductility[i];
	return isSame;
}

namespace
{
/// Products of two are numbers yet, in float with arms of fibres.
const btScalar MOST_STIFFNESS_OF_FIBRES = btScalar(1e24);
/// The determinant of two springs' compliance is a number in float.
const btScalar LEAST_STIFFNESS_OF_PAIR = btScalar(1e-18), MOST_STIFFNESS_OF_PAIR = btScalar(1e18);
const char* const LENGTH = "finite, from -1e6 to 1e6";

bool isStrength(double value)
{
	return btElasticPlasticIsFinite(value) && value <= double(btElasticPlasticCapacity::greatestYield());
}

bool isLength(btScalar value)
{
	return btElasticPlasticIsFinite(double(value)) && btFabs(value) <= btElasticPlasticCapacity::greatestLength();
}
}  // namespace

btElasticPlasticFault btElasticPlasticCapacity::fault() const
{
	if (m_fault)
		return m_fault;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const bool linear = i < 3;
		if (btElasticPlasticFault f =
				btElasticPlasticCheckNotNegative(linear ? "stiffness [N/m]" : "stiffness [N m/rad]", m_stiffness[i], i))
			return f;
		if (btElasticPlasticFault f =
				btElasticPlasticCheckNotNegative(linear ? "yield force [N]" : "yield moment [N m]", m_yield[i], i))
			return f;
		if (m_yield[i] > greatestYield())
			return btElasticPlasticFault(
				linear ? "yield force [N]" : "yield moment [N m]", m_yield[i],
				"at most greatestYield(), 1e37 in float and 1e250 in double; unlimited() stands for never", i);
		if (btElasticPlasticFault f =
				btElasticPlasticCheckPositive(linear ? "ductility [m]" : "ductility [rad]", m_ductility[i], i))
			return f;
		if (isElasticPlastic(i) && !isRigidPlastic(i) && !(m_stiffness[i] >= leastStiffness()))
			return btElasticPlasticFault(
				linear ? "stiffness [N/m]" : "stiffness [N m/rad]", m_stiffness[i],
				"greater than 0 where there is a yield value, at least 1e-20 (or rigid-plastic, by setRigidPlastic)",
				i);
	}
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const char* stiffness = i < 3 ? "stiffness [N/m]" : "stiffness [N m/rad]";
		if (hasFibres() && m_stiffness[i] > MOST_STIFFNESS_OF_FIBRES)
			return btElasticPlasticFault(stiffness, m_stiffness[i], "at most 1e24 where a section has fibres", i);
		if (relativeCoupling(i) != 0 &&
			!(m_stiffness[i] >= LEAST_STIFFNESS_OF_PAIR && m_stiffness[i] <= MOST_STIFFNESS_OF_PAIR))
			return btElasticPlasticFault(stiffness, m_stiffness[i], "1e-18 to 1e18 where shear and bending are coupled",
										 i);
	}
	if (btElasticPlasticFault f = faultOfFibres())
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckNotNegative("length that bows [m]", m_length))
		return f;
	if (m_length > greatestLength())
		return btElasticPlasticFault("length that bows [m]", m_length, "at most 1e6");
	if (btElasticPlasticFault f = btElasticPlasticCheckDampingRatio(m_damping))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckFriction(m_friction))
		return f;
	for (int i = BT_EP_SHEAR_Y; i <= BT_EP_SHEAR_Z; ++i)
		if (!btElasticPlasticIsFinite(double(m_coupling[planeOf(i)])) || !(btFabs(m_coupling[planeOf(i)]) < 1))
			return btElasticPlasticFault("coupling of shear and bending", m_coupling[planeOf(i)],
										 "greater than -1 and less than 1", i);
	return btElasticPlasticFault();
}

btElasticPlasticFault btElasticPlasticCapacity::faultOfFibres() const
{
	for (int i = 0; i < BT_EP_DOF_COUNT && hasFibres(); ++i)
		if (isOfFibres(i) && (!isElasticPlastic(i) || isRigidPlastic(i)))
			return btElasticPlasticFault("yield value of a section with fibres", m_yield[i],
										 "that of a spring, greater than 0 (or m_fibres empty)", i);
	for (int i = 0; i < m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = m_fibres[i];
		for (const btScalar place : {fibre.m_y, fibre.m_z})
			if (!isLength(place))
				return btElasticPlasticFault("place of a fibre, y or z [m]", place, LENGTH);
		if (btElasticPlasticFault f = btElasticPlasticCheckPositive("stiffness of a fibre [N/m]", fibre.m_stiffness))
			return f;
		if (!(fibre.m_stiffness >= leastStiffness()) || fibre.m_stiffness > MOST_STIFFNESS_OF_FIBRES)
			return btElasticPlasticFault("stiffness of a fibre [N/m]", fibre.m_stiffness, "1e-20 to 1e24");
		if (btElasticPlasticFault f =
				btElasticPlasticCheckNotNegative("strength of a fibre in tension [N]", fibre.m_tension))
			return f;
		if (btElasticPlasticFault f =
				btElasticPlasticCheckNotNegative("strength of a fibre in compression [N]", fibre.m_compression))
			return f;
		if (fibre.m_tension > greatestYield() || fibre.m_compression > greatestYield())
			return btElasticPlasticFault("strength of a fibre [N]", btMax(fibre.m_tension, fibre.m_compression),
										 "at most greatestYield(), 1e37 in float and 1e250 in double");
		if (btElasticPlasticFault f = btElasticPlasticCheckPositive(
				"strength of a fibre in tension and compression [N]", fibre.m_tension + fibre.m_compression))
			return f;
		if (btElasticPlasticFault f =
				btElasticPlasticCheckPositive("elongation at which a fibre ruptures [m]", fibre.m_stretchLimit))
			return f;
		if (btElasticPlasticFault f =
				btElasticPlasticCheckPositive("shortening at which a fibre is crushed [m]", fibre.m_crushLimit))
			return f;
		if (fibre.m_softens && !(fibre.m_stretchLimit < btScalar(BT_LARGE_FLOAT)))
			return btElasticPlasticFault("elongation at which a fibre that softens ruptures [m]", fibre.m_stretchLimit,
										 "less than BT_LARGE_FLOAT: by then its strength is 0");
		if (btElasticPlasticFault f = faultOfCurve(fibre))
			return f;
		if (btElasticPlasticFault f = btElasticPlasticCheckNotNegative("rate at which a fibre's strength doubles [m/s]",
																	   fibre.m_rateReference))
			return f;
		if (!btElasticPlasticIsFinite(double(fibre.m_rateExponent)) || !(fibre.m_rateExponent >= 1))
			return btElasticPlasticFault("exponent of a fibre's rate", fibre.m_rateExponent, "finite, at least 1");
		for (const btScalar number : {fibre.m_wall[0], fibre.m_wall[1], fibre.m_twist[0], fibre.m_twist[1]})
			if (!isLength(number))
				return btElasticPlasticFault("direction in which a fibre is sheared", number, LENGTH);
		const double wall = hypot(double(fibre.m_wall[0]), double(fibre.m_wall[1]));
		if (wall != 0 && fabs(wall - 1) > 1e-3)
			return btElasticPlasticFault("length of the direction in which a fibre is sheared", btScalar(wall),
										 "1, or 0 for any direction");
		if (fibre.m_part < 0)
			return btElasticPlasticFault("part of the section to which a fibre belongs", btScalar(fibre.m_part),
										 "0 or more");
	}
	return btElasticPlasticFault();
}

btElasticPlasticFault btElasticPlasticCapacity::faultOfCurve(const btElasticPlasticFibre& fibre) const
{
	if (fibre.m_numPoints < 0 || fibre.m_numPoints > m_curvePoints.size() || fibre.m_firstPoint < 0 ||
		fibre.m_firstPoint > m_curvePoints.size() - fibre.m_numPoints)
		return btElasticPlasticFault("point of a fibre's curve", btScalar(fibre.m_firstPoint), "one of m_curvePoints");
	const btScalar strength = btMax(fibre.m_tension, fibre.m_compression);
	btElasticPlasticCurvePoint before = {0, 1};
	for (int i = fibre.m_firstPoint; i < fibre.m_firstPoint + fibre.m_numPoints; ++i)
	{
		const btElasticPlasticCurvePoint& point = m_curvePoints[i];
		if (btElasticPlasticFault f = btElasticPlasticCheckPositive("factor of a fibre's strength", point.m_factor))
			return f;
		if (!isStrength(double(point.m_factor) * double(strength)))
			return btElasticPlasticFault("factor of a fibre's strength", point.m_factor,
										 "one by which the strength stays within greatestYield()");
		const btScalar way = point.m_path - before.m_path;
		if (!btElasticPlasticIsFinite(double(point.m_path)) || !(way > 0))
			return btElasticPlasticFault("plastic path on a fibre's curve [m]", point.m_path,
										 "finite and more than at the point before");
		if (!isStrength(double(btFabs(point.m_factor - before.m_factor) / way) * double(strength)))
			return btElasticPlasticFault("plastic path on a fibre's curve [m]", point.m_path,
										 "so long that the strength's slope stays within greatestYield()");
		before = point;
	}
	return btElasticPlasticFault();
}

btScalar btElasticPlasticCapacity::relativeCoupling(int dof) const
{
	const int other = coupledWith(dof);
	const bool areSprings = other >= 0 && isElasticPlastic(dof) && !isRigidPlastic(dof) && isElasticPlastic(other) &&
							!isRigidPlastic(other);
	return areSprings ? m_coupling[planeOf(dof)] : btScalar(0);
}

btScalar btElasticPlasticCapacity::couplingCompliance(int dof) const
{
	const int other = coupledWith(dof);
	const btScalar relative = relativeCoupling(dof);
	return other < 0 || relative == 0 ? btScalar(0)
									  : relative / (btSqrt(m_stiffness[dof]) * btSqrt(m_stiffness[other]));
}

btScalar btElasticPlasticCapacity::elasticMiddle(int shear) const
{
	if (shear != BT_EP_SHEAR_Y && shear != BT_EP_SHEAR_Z)
		return 0;
	// A force V at s makes the turn (M - s V_y) / k at the joint, or (M + s V_z) / k: x cross y is z, x cross z is -y.
	const btScalar turn = couplingCompliance(shear) * m_stiffness[coupledWith(shear)];
	return shear == BT_EP_SHEAR_Y ? -turn : turn;
}

btScalar btElasticPlasticCapacity::elasticDeformation(const btScalar force[BT_EP_DOF_COUNT], int dof) const
{
	if (!btElasticPlasticIsDof(dof) || !(m_stiffness[dof] > 0))
		return 0;
	const btScalar own = force[dof] / m_stiffness[dof], coupling = couplingCompliance(dof);
	return coupling != 0 ? own + coupling * force[coupledWith(dof)] : own;
}

btElasticPlasticCapacity btElasticPlasticCapacity::fromMember(const btElasticPlasticMaterial& material,
															  const btElasticPlasticSection& section, btScalar lengthA,
															  btScalar lengthB, btScalar gaugeLength)
{
	btElasticPlasticCapacity c;
	c.m_fault = material.fault();
	if (!c.m_fault)
		c.m_fault = section.m_fault;
	if (!c.m_fault)
		c.m_fault = faultOfFibresOf(section);
	if (!c.m_fault)
		c.m_fault = btElasticPlasticCheckPositive("section area [m^2]", section.m_area);
	for (int i = 0; i < 2 && !c.m_fault; ++i)
		c.m_fault =
			btElasticPlasticCheckPositive(i == 0 ? "distance of the section's outer fibre from the axis along y [m]"
												 : "distance of the section's outer fibre from the axis along z [m]",
										  section.m_outerFibre[i]);
	if (!c.m_fault)
		c.m_fault = btElasticPlasticCheckNotNegative("length of the first part [m]", lengthA);
	if (!c.m_fault)
		c.m_fault = btElasticPlasticCheckNotNegative("length of the second part [m]", lengthB);
	if (!c.m_fault)
		c.m_fault = btElasticPlasticCheckPositive("sum of the parts' lengths [m]", lengthA + lengthB);
	if (!c.m_fault)
		c.m_fault = btElasticPlasticCheckNotNegative("gauge length [m]", gaugeLength);
	if (c.m_fault)
		return c;

	const btScalar share = material.m_loadBearingShare;
	const btScalar E = material.m_youngsModulus * share, G = material.shearModulus() * share;
	const btScalar fy = material.m_yieldStress * share, tau = material.shearYieldStress() * share;
	const btScalar a = lengthA / 2, b = lengthB / 2, l = a + b;
	const btScalar plastic = material.m_ultimatePlasticStrain * (gaugeLength > 0 ? gaugeLength : l);
	// Equal work fy de = tau dg makes a shear strain g equivalent to a strain e = g tau / fy; where none follows from the other, by von Mises.
	const btScalar plasticShear = plastic * (material.m_shearStrength > 0 ? btSqrt(btScalar(3)) : fy / tau);

	c.set(BT_EP_AXIAL, E * section.m_area / l, section.m_area * fy, plastic);
	c.set(BT_EP_TORSION, G * section.m_torsionConstant / l, section.m_plasticTorsionModulus * tau,
		  plasticShear / btMax(section.m_outerFibre[0], section.m_outerFibre[1]));
	for (int i = 0; i < 2; ++i)
	{
		// A force along y (i = 0) bends about z, one along z about y: the other second moment.
		const btScalar halves =
			(a * a * a + b * b * b) / (3 * E * section.m_secondMoment[1 - i] + 3 * stiffnessOfBars(section, 1 - i));
		c.set(BT_EP_SHEAR_Y + i, 1 / (l / (G * section.m_shearArea[i]) + halves), section.m_plasticShearArea[i] * tau,
			  plasticShear);
		c.set(BT_EP_BENDING_Y + i, E * section.m_secondMoment[i] / l, section.m_plasticModulus[i] * fy,
			  plastic / section.m_outerFibre[1 - i]);
	}
	c.m_length = l;
	c.addFibres(material, section, l, gaugeLength > 0 ? gaugeLength : l);
	c.m_damping = material.m_dampingRatio;
	c.m_friction = material.m_friction;
	// Of the sign, see elasticMiddle().
	const btScalar middle = (b - a) / 2;
	for (int i = 0; i < 2; ++i)
		c.m_coupling[i] =
			(i == 0 ? -middle : middle) * btSqrt(c.m_stiffness[BT_EP_SHEAR_Y + i] / c.m_stiffness[BT_EP_BENDING_Z - i]);
	return c;
}
