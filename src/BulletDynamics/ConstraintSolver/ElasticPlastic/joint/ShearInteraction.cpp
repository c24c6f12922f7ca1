// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "ShearInteraction.h"

#include <math.h>

namespace btElasticPlastic
{
namespace
{
/// Sum of the shares of the six forces in what each could be by itself, below which nothing can be near the surface.
const double LEAST_LOAD = 0.5;
/// Share of shears and torsion that leaves all but its square of the rest.
const double LEAST_SHEAR = 0.02;
/// Flow of a fibre over the mean, below which it counts as this: the surface's edges are rounded by as much.
const double LEAST_FLOW = 1e-3;
/// Room that shears and torsion have to grow in a step, over their yield values, and the share of the work from which on, if they do it, there is
/// none. With less room for a heated beam that hangs between its columns, steps of 1/60 s tear it by slip, which those of 1/500 s do not.
const double MOST_ROOM = 0.1, MOST_SLIP = 0.05;
const int SEARCHES = 12;
/// Place of the warping among the slips of a fibre.
const int WARPING = 3;
/// What the last search has added to the share.
const double CLOSE_ENOUGH = 1e-4;
/// Share of what the section bears from which on it is taken to flow.
const double FLOWS_FROM = 0.95;
/// Up to this plastic share a slip hardly counts as flow; from the second one on, all of it does. What rocks is at 0.01 and below.
const double ELASTIC = 0.1, PLASTIC = 0.5;
/// A purely elastic slip still counts by this much, or forces would go to and fro by 6 % between steps in which a shear flows and steps in which it does not
/// (4 % with this one; a stiff beam that rocks is as right with 0 as with 0.15, and 0.6 % off with 0.3).
const double LEAST_FLOWING = 0.15;
/// Part of the way to the bounds that belong to the present flow, in a step.
const double LONGEST_TURN = 0.3;
/// What is left of the yield values of shears and torsion at least. In a section that flows in one of them the others would else have none, and
/// never come back.
const double LEAST_SHARE = 0.1;
/// The same of fibres: one without any strength in tension would open as a crack does.
const double LEAST_LEFT = 1e-3;
/// Of a fibre's strengths the lesser one, over the greater, from which it bears shear by them. Under pressure it bears up to half of what is between both:
/// with less, that is out of all proportion to what it bears without.
const double LEAST_EVEN = 0.1;
/// Of walls that run at an angle to the section's axes, by how much one such direction outweighs the other.
const double LEAST_ASKEW = 1e-3;
/// Of the slips of walls by a twist and those by which they turn about the axis as a whole, their correlation, from which on the section is a closed one: 1 of a
/// box, 0.4 of one of 1 : 20 that slips evenly, and none of an open section, whose walls slip to and fro.
const double LEAST_CLOSED = 0.4;
/// Squares of the latter over those of the distance from the axis: 0.14 of that box, 0.02 of a flat bar. Walls that run through the axis slip as they turn, too.
const double LEAST_AROUND = 0.08;
/// Keeps what fibres on one line do not determine out of the way.
const double NEXT_TO_NOTHING = 1e-9;
}  // namespace

void ShearInteraction::Matrix::add(double weight, const double row[3])
{
	m_elements[0] += weight * row[0] * row[0];
	m_elements[1] += weight * row[0] * row[1];
	m_elements[2] += weight * row[0] * row[2];
	m_elements[3] += weight * row[1] * row[1];
	m_elements[4] += weight * row[1] * row[2];
	m_elements[5] += weight * row[2] * row[2];
}

ShearInteraction::Matrix ShearInteraction::Matrix::inverse() const
{
	const double* const m = m_elements;
	const double least = NEXT_TO_NOTHING * (m[0] + m[3] + m[5]);
	const double xx = m[0] + least, yy = m[3] + least, zz = m[5] + least, xy = m[1], xz = m[2], yz = m[4];
	const double c0 = yy * zz - yz * yz, c1 = xz * yz - xy * zz, c2 = xy * yz - xz * yy,
				 determinant = xx * c0 + xy * c1 + xz * c2;
	return {{c0 / determinant, c1 / determinant, c2 / determinant, (xx * zz - xz * xz) / determinant,
			 (xy * xz - xx * yz) / determinant, (xx * yy - xy * xy) / determinant}};
}

void ShearInteraction::Matrix::multiply(const double x[3], double result[3]) const
{
	const double* const m = m_elements;
	result[0] = m[0] * x[0] + m[1] * x[1] + m[2] * x[2];
	result[1] = m[1] * x[0] + m[3] * x[1] + m[4] * x[2];
	result[2] = m[2] * x[0] + m[4] * x[1] + m[5] * x[2];
}

/// What is left of half of the span of a fibre's forces is about their middle. A fibre that bears its shear under pressure only is not pressed by it:
/// nothing is left of tension.
ShearInteraction::Left ShearInteraction::leftAboutMiddle(btScalar left, const JointModel::FibreStrength& strength)
{
	const btScalar half = left * (strength.m_tension / 2 + strength.m_compression / 2),
				   middle = strength.m_tension / 2 - strength.m_compression / 2, least = btScalar(LEAST_LEFT);
	return {strength.m_tension > 0 ? btMax(least, (half + middle) / strength.m_tension) : btScalar(1),
			strength.m_compression > 0 ? btMax(least, (half - middle) / strength.m_compression) : btScalar(1)};
}

namespace
{
/// What a fibre bears of shear without a normal force, over the most that it bears with one: sqrt(1 - c^2 / a^2) of the ellipse about c with the half axis
/// a, before it has flowed.
double shearAtRest(const btElasticPlasticFibre& fibre)
{
	const double tension = fibre.m_tension, compression = fibre.m_compression,
				 middle = (tension - compression) / (tension + compression);
	return sqrt((1 - middle) * (1 + middle));
}

/// Whether a fibre bears shear by its strengths. Pressure adds to shear by unequal strengths or by friction, and not by both.
bool bearsShear(const btElasticPlasticFibre& fibre, btScalar friction)
{
	const btScalar greater = btMax(fibre.m_tension, fibre.m_compression),
				   lesser = btMin(fibre.m_tension, fibre.m_compression);
	return fibre.m_bearsShear && lesser > 0 &&
		   (lesser == greater || (lesser >= btScalar(LEAST_EVEN) * greater && !(friction > 0)));
}

/// About which a section warps with y z, so that none of that is a plane that turns: it would be sheared as a whole then.
struct WarpingAxis
{
	double m_y, m_z;
};

WarpingAxis warpingAxisOf(const btAlignedObjectArray<btElasticPlasticFibre>& fibres)
{
	double yy = 0, zz = 0, yyz = 0, yzz = 0;
	for (int i = 0; i < fibres.size(); ++i)
	{
		const double y = fibres[i].m_y, z = fibres[i].m_z, weight = fibres[i].m_stiffness;
		yy += weight * y * y;
		zz += weight * z * z;
		yyz += weight * y * y * z;
		yzz += weight * y * z * z;
	}
	return {zz > 0 ? yzz / zz : 0, yy > 0 ? yyz / yy : 0};
}

/// Tells whether walls run around the axis, and slip by a twist as those of a closed section do.
class WallsAround
{
public:
	/// \param wall  direction of a fibre's wall
	/// \param slip  along it, by a twist
	void add(const btElasticPlasticFibre& fibre, double strength, const double wall[2], double slip)
	{
		const double y = fibre.m_y, z = fibre.m_z, turn = wall[1] * y - wall[0] * z;
		m_both += strength * slip * turn;
		m_slips += strength * slip * slip;
		m_turns += strength * turn * turn;
		m_distances += strength * (y * y + z * z);
	}

	bool areClosed() const
	{
		return m_both > LEAST_CLOSED * sqrt(m_slips * m_turns) && m_turns > LEAST_AROUND * m_distances;
	}

private:
	double m_both = 0, m_slips = 0, m_turns = 0, m_distances = 0;
};
}  // namespace

/// Takes the fibres with what each of the six forces counts for in them, over what the section bears of it alone. A fibre of unequal strengths
/// is one of equal strengths about a force in the middle.
/// \return whether any of them bears shear
bool ShearInteraction::collect(const JointModel& model)
{
	const btElasticPlasticCapacity& capacity = model.m_capacity;
	bool isAny = false;
	for (int i = 0; i < capacity.m_fibres.size(); ++i)
		isAny |= bearsShear(capacity.m_fibres[i], capacity.m_friction);
	if (!isAny)
		return false;
	m_fibres.clear();
	double slips[3] = {}, most[3] = {}, askew = 0;
	WallsAround walls;
	m_isUneven = false;
	const WarpingAxis axis = warpingAxisOf(capacity.m_fibres);
	for (int k = 0; k < 3; ++k)
		m_alone[k] = m_middle[k] = 0;
	for (int i = 0; i < capacity.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& own = capacity.m_fibres[i];
		const btElasticPlasticFibreState& state = model.m_state.m_fibres[i];
		const JointModel::FibreStrength strength = model.strengthOf(i);
		const double stronger = state.isRuptured() ? 0 : 1 + double(state.m_rateShare),
					 middle = stronger * (double(strength.m_tension) - double(strength.m_compression)) / 2,
					 atRest = shearAtRest(own);
		Fibre fibre = {stronger * (double(strength.m_tension) + double(strength.m_compression)) / 2,
					   middle,
					   {1, double(own.m_z), -double(own.m_y)},
					   {},
					   0,
					   1};
		const double wall[2] = {double(own.m_wall[0]), double(own.m_wall[1])},
					 twist[2] = {double(own.m_twist[0]), double(own.m_twist[1])},
					 warp[2] = {axis.m_z - double(own.m_z), axis.m_y - double(own.m_y)};
		const bool isWall = wall[0] != 0 || wall[1] != 0;
		fibre.m_numSlips = bearsShear(own, capacity.m_friction) ? (isWall ? 1 : 2) : 0;
		m_isUneven |= fibre.m_numSlips > 0 && middle != 0;
		if (fibre.m_numSlips == 1)
		{
			fibre.m_slip[0][0] = wall[0];
			fibre.m_slip[0][1] = wall[1];
			fibre.m_slip[0][2] = wall[0] * twist[0] + wall[1] * twist[1];
			fibre.m_slip[0][WARPING] = wall[0] * warp[0] + wall[1] * warp[1];
			walls.add(own, fibre.m_strength, wall, fibre.m_slip[0][2]);
		}
		else
			for (int k = 0; k < fibre.m_numSlips; ++k)
			{
				fibre.m_slip[k][k] = 1;
				fibre.m_slip[k][2] = twist[k];
				fibre.m_slip[k][WARPING] = warp[k];
			}
		for (int k = 0; k < 3; ++k)
		{
			m_alone[k] += fibre.m_strength * fabs(fibre.m_normal[k]);
			m_middle[k] += middle * fibre.m_normal[k];
			const double slip = fibre.m_strength * hypot(fibre.m_slip[0][k], fibre.m_slip[1][k]);
			most[k] += slip;
			slips[k] += slip * atRest;
		}
		for (const auto& slip : fibre.m_slip)
			askew += fibre.m_strength * slip[0] * slip[1];
		m_fibres.push_back(fibre);
	}
	const bool isClosed = walls.areClosed();
	m_mayWarp = m_isUneven || isClosed;
	for (Fibre& fibre : m_fibres)
		if (!isClosed && !(m_isUneven && fibre.m_numSlips == 2))
			fibre.m_slip[0][WARPING] = fibre.m_slip[1][WARPING] = 0;
	const bool isAskew = fabs(askew) > LEAST_ASKEW * (most[0] + most[1]);
	for (int k = 0; k < 3; ++k)
	{
		if (most[k] > 0 && (m_mayWarp || (k < 2 && isAskew)))
			slips[k] = shearAlone(k, most[k]) * (slips[k] / most[k]);
		m_mostShare[k] = slips[k] > 0 ? most[k] / slips[k] : 1;
	}
	for (Fibre& fibre : m_fibres)
		for (int k = 0; k < 3; ++k)
		{
			fibre.m_normal[k] /= m_alone[k] > 0 ? m_alone[k] : 1;
			for (auto& slip : fibre.m_slip)
				slip[k] /= slips[k] > 0 ? slips[k] : 1;
		}
	return slips[0] + slips[1] + slips[2] > 0;
}

/// What fibres bear of a shear or of torsion alone: the least of sum w |b q| with q = 1 in its direction. A slip across a shear makes it less where walls that
/// are not alike run at an angle to it, and a warping where they bear unequally.
/// \param least  that without either
double ShearInteraction::shearAlone(int along, double least) const
{
	const int across[2] = {along < 2 ? 1 - along : WARPING, WARPING};
	double q[2] = {}, strength = 0;
	for (const Fibre& fibre : m_fibres)
		strength += fibre.m_strength;
	const double leastFlow = LEAST_FLOW * least / strength;
	for (int i = 0; i < SEARCHES; ++i)
	{
		double sum = 0, both[2] = {}, squares[3] = {};
		for (const Fibre& fibre : m_fibres)
		{
			double square = 0;
			for (const auto& slip : fibre.m_slip)
			{
				const double own = slip[along] + slip[across[0]] * q[0] + slip[across[1]] * q[1];
				square += own * own;
			}
			const double flow = sqrt(square), weight = fibre.m_strength / btMax(flow, leastFlow);
			sum += fibre.m_strength * flow;
			for (const auto& slip : fibre.m_slip)
			{
				const double a = slip[across[0]], b = slip[across[1]];
				both[0] += weight * slip[along] * a;
				both[1] += weight * slip[along] * b;
				squares[0] += weight * a * a;
				squares[1] += weight * a * b;
				squares[2] += weight * b * b;
			}
		}
		least = btMin(least, sum);
		// For torsion both are the warping.
		const double aa = squares[0] > 0 ? squares[0] * (1 + NEXT_TO_NOTHING) : 1,
					 bb = squares[2] > 0 ? squares[2] * (1 + NEXT_TO_NOTHING) : 1,
					 determinant = aa * bb - squares[1] * squares[1];
		const double next[2] = {(squares[1] * both[1] - bb * both[0]) / determinant,
								(squares[1] * both[0] - aa * both[1]) / determinant};
		const bool isFound = fabs(next[0] - q[0]) < CLOSE_ENOUGH && fabs(next[1] - q[1]) < CLOSE_ENOUGH;
		q[0] = next[0];
		q[1] = next[1];
		if (isFound)
			break;
	}
	return least;
}

double ShearInteraction::flowOf(const Fibre& fibre, const double q[6], bool withNormal) const
{
	double square = 0;
	const auto along = [](const double row[3], const double x[3])
	{ return row[0] * x[0] + row[1] * x[1] + row[2] * x[2]; };
	if (withNormal)
		square += along(fibre.m_normal, q) * along(fibre.m_normal, q);
	const double warping = m_mayWarp ? along(m_warping, q + 3) : 0;
	for (int r = 0; r < fibre.m_numSlips; ++r)
	{
		const double* const row = fibre.m_slip[r];
		const double slip = along(row, q + 3) + row[WARPING] * warping;
		square += slip * slip;
	}
	return sqrt(square);
}

/// A warping y z, on which no force works, has the section slip unevenly: the least of h(q) over the warping is what it bears. In a closed one any wall may slip by
/// itself then, so that a box bears shear beside torsion by V / V_pl + T / T_pl = 1 (EN 1993-1-1, 6.28) and not a third more. Fibres of unequal strengths bear more
/// shear under pressure, so a solid section that is bent slips more where it is pulled: without the warping a square with a tenth of its strength in tension bears
/// up to 0.12 too much, and one of equal strengths some hundredths. Walls of an open section do not warp by it: each would bear its shear by itself.
/// \param least  flow for which a fibre counts at least
/// \param slip   of shears and torsion by themselves, loses what the warping takes
void ShearInteraction::warp(double least, Matrix& slip)
{
	double both[3] = {}, square = 0;
	for (const Fibre& fibre : m_fibres)
	{
		const double weight = fibre.m_strength / btMax(fibre.m_flow, least);
		for (const auto& row : fibre.m_slip)
		{
			square += weight * row[WARPING] * row[WARPING];
			for (int k = 0; k < 3; ++k)
				both[k] += weight * row[WARPING] * row[k];
		}
	}
	for (int k = 0; k < 3; ++k)
		m_warping[k] = square > 0 ? -both[k] / square : 0;
	if (square > 0)
		slip.add(-1 / square, both);
}

/// \param q           gets the flow
/// \return the share of what the section bears
double ShearInteraction::search(const double force[6], double q[6])
{
	double strength = 0, most = 0, share = 0;
	for (Fibre& fibre : m_fibres)
	{
		fibre.m_flow = 1;
		strength += fibre.m_strength;
	}
	most = strength;
	for (int k = 0; k < SEARCHES; ++k)
	{
		Matrix normal = {}, slip = {};
		const double least = LEAST_FLOW * most / strength;
		m_most = 0;
		for (Fibre& fibre : m_fibres)
		{
			const double flow = btMax(fibre.m_flow, least), weight = fibre.m_strength / flow;
			m_most += fibre.m_strength * flow;
			normal.add(weight, fibre.m_normal);
			for (int r = 0; r < fibre.m_numSlips; ++r)
				slip.add(weight, fibre.m_slip[r]);
		}
		if (m_mayWarp)
			warp(least, slip);
		m_matrix = slip.inverse();
		m_matrix.multiply(force + 3, q + 3);
		normal.inverse().multiply(force, q);
		most = 0;
		for (Fibre& fibre : m_fibres)
		{
			fibre.m_flow = flowOf(fibre, q, true);
			most += fibre.m_strength * fibre.m_flow;
		}
		double work = 0;
		for (int i = 0; i < 6; ++i)
			work += force[i] * q[i];
		const double before = share;
		share = most > 0 ? work / most : 0;
		if (!(share - before > CLOSE_ENOUGH * share))
			break;
	}
	return share;
}

/// By Cauchy and Schwarz h(q)^2 <= q A q sum w n, with the matrix A of a search and its n: what the section bears is within the ellipsoid
/// F A^-1 F <= sum w n, and at the forces with which the search was made they touch. So that is what each of shears and torsion may be
/// beside the other five forces, and no more than it could be beside any.
/// \param share  at which the forces are
/// \param bears  of the normal forces, their part of F A^-1 F
void ShearInteraction::findShares(const double force[6], double share, double bears)
{
	const double shrunk = btMax(share, 1.);
	const double* const m = m_matrix.m_elements;
	const double diagonal[3] = {m[0], m[3], m[5]};
	for (int k = 0; k < 3; ++k)
	{
		double others[3] = {force[3] / shrunk, force[4] / shrunk, force[5] / shrunk}, product[3];
		others[k] = 0;
		m_matrix.multiply(others, product);
		const double half = force[3 + k] < 0 ? -product[k] : product[k],
					 rest = others[0] * product[0] + others[1] * product[1] + others[2] * product[2] +
							bears / (shrunk * shrunk) - m_most,
					 square = half * half - diagonal[k] * rest,
					 most = square > 0 ? (sqrt(square) - half) / diagonal[k] : 0;
		m_share[k] = btScalar(btMin(m_mostShare[k], btMax(LEAST_SHARE, most)));
	}
}

/// The share of what the section bears at which forces are if they have grown from nothing. Fibres of unequal strengths have their middle elsewhere, from
/// which the section would be near its surface while it bears next to nothing. Here the surface is taken for the plane that touches it where the forces come
/// to if they grow from there, within which all of it lies.
/// \param force  from the middle
/// \param q      the plane's normal
/// \param share  from the middle
double ShearInteraction::shareOf(const double force[6], const double q[6], double share) const
{
	if (!m_isUneven)
		return share;
	double work = 0, ofMiddle = 0;
	for (int k = 0; k < 6; ++k)
	{
		work += force[k] * q[k];
		ofMiddle += k < 3 && m_alone[k] > 0 ? m_middle[k] / m_alone[k] * q[k] : 0;
	}
	const double most = share > 0 ? work / share + ofMiddle : 0;
	return most > 0 ? (work + ofMiddle) / most : 0;
}

/// Leads the bounds to where the section bears the most against the way in which it moves: there its flow is the surface's normal. Fibres of unequal strengths
/// slip without a room that they would need for it, and so are not pressed: what they bear of shear is by the normal force that they have.
/// \param q       the way, by work for the forces over what each could be by itself
/// \param amount  of the way from where the forces are
void ShearInteraction::follow(const JointModel& model, const double q[6], double amount)
{
	const double warping = m_mayWarp ? m_warping[0] * q[3] + m_warping[1] * q[4] + m_warping[2] * q[5] : 0;
	double shear[3] = {};
	for (size_t i = 0; i < m_fibres.size(); ++i)
	{
		const Fibre& fibre = m_fibres[i];
		const double flow = flowOf(fibre, q, true), slip = flowOf(fibre, q, false);
		if (!(flow > 0))
			continue;
		const double normal = btMax(LEAST_LEFT, sqrt(btMax(0., 1 - slip * slip / (flow * flow))));
		m_left[int(i)] += btScalar(amount * (normal - double(m_left[int(i)])));
		double over = flow;
		if (fibre.m_middle != 0 && slip > 0)
		{
			const double half = fibre.m_strength * normal, lower = btMin(0., fibre.m_middle - half),
						 upper = btMax(0., fibre.m_middle + half),
						 force = btMax(lower, btMin(upper, double(model.m_state.m_fibres[int(i)].m_force))),
						 aside = (force - fibre.m_middle) / fibre.m_strength;
			over = slip / sqrt(btMax(LEAST_LEFT * LEAST_LEFT, 1 - aside * aside));
		}
		for (const auto& row : fibre.m_slip)
		{
			const double stress =
				fibre.m_strength * (row[0] * q[3] + row[1] * q[4] + row[2] * q[5] + row[WARPING] * warping) / over;
			for (int k = 0; k < 3; ++k)
				shear[k] += stress * row[k];
		}
	}
	for (int k = 0; k < 3; ++k)
		m_share[k] += btScalar(amount * (btMax(LEAST_SHARE, fabs(shear[k])) - double(m_share[k])));
}

namespace
{
/// The part of a rate of strain that follows from the change of force in the last step.
double elasticRate(const JointModel& model, int dof)
{
	const btElasticPlasticCapacity& capacity = model.m_capacity;
	if (capacity.isRigidPlastic(dof))
		return 0;
	const btScalar* const rate = model.m_state.m_forceRate;
	const double own = double(rate[dof]) / double(capacity.m_stiffness[dof]),
				 coupling = double(capacity.couplingCompliance(dof));
	return coupling != 0 ? own + coupling * double(rate[btElasticPlasticCapacity::coupledWith(dof)]) : own;
}

/// What of a slip is flow. As a light part rocks, its ends slip to and fro elastically by far more than the section flows.
double flowing(double slip, double elastic)
{
	const double share = slip != 0 ? fabs(1 - elastic / slip) : 0;
	return slip * btMax(LEAST_FLOWING, btMin(1., (share - ELASTIC) / (PLASTIC - ELASTIC)));
}
}  // namespace

void ShearInteraction::find(const JointModel& model, const btScalar stepYield[BT_EP_DOF_COUNT],
							const btScalar rate[BT_EP_DOF_COUNT], btScalar dt)
{
	m_left.resize(0);
	m_share[0] = m_share[1] = m_share[2] = 1;
	const btElasticPlasticCapacity& capacity = model.m_capacity;
	static const int dofs[6] = {BT_EP_AXIAL,   BT_EP_BENDING_Y, BT_EP_BENDING_Z,
								BT_EP_SHEAR_Y, BT_EP_SHEAR_Z,   BT_EP_TORSION};
	double force[6], way[6], flow[6], load = 0, work = 0, grown = 0;
	const auto yieldOf = [&](int k) { return capacity.isElasticPlastic(dofs[k]) ? double(stepYield[dofs[k]]) : 0.; };
	// A section's own fibres come first, and tell how weak it is in its weaker direction.
	const JointModel::BearingFibre& first = model.m_bearing[0];
	const bool isPulled = model.m_state.m_force[BT_EP_AXIAL] > 0;
	const double ahead = isPulled ? first.m_tension : first.m_compression,
				 stronger = btMax(first.m_tension, first.m_compression), weakness = ahead / stronger;
	// Shears and torsion first: most joints have next to none.
	for (int k = 5; k >= 0; --k)
	{
		const int dof = dofs[k];
		const double yield = yieldOf(k);
		force[k] = yield > 0 ? double(model.m_state.m_force[dof]) : 0;
		for (int b = 0; b < btElasticPlasticState::BRANCHES && yield > 0; ++b)
			force[k] += double(model.m_state.m_branch[b][dof]);
		load += yield > 0 ? fabs(force[k]) / (k == 0 && weakness > 0 ? weakness * yield : yield) : 0;
		if (k == 3 && !(load > LEAST_SHEAR))
			return;
	}
	if (!(load > LEAST_LOAD))
		return;
	for (int k = 3; k < 6; ++k)
		m_alone[k] = yieldOf(k);
	if (!collect(model))
		return;
	for (int k = 0; k < 6; ++k)
	{
		const double yield = yieldOf(k);
		way[k] = yield > 0 ? double(rate[dofs[k]]) : 0;
		work += force[k] * way[k];
		const double elastic = yield > 0 ? double(capacity.m_stiffness[dofs[k]]) * double(dt) * way[k] / yield : 0;
		grown += elastic * elastic;
		force[k] = m_alone[k] > 0 ? (force[k] - (k < 3 ? m_middle[k] : 0)) / m_alone[k] : 0;
		way[k] *= m_alone[k];
		flow[k] = k < 3 ? way[k] : flowing(way[k], elasticRate(model, dofs[k]) * m_alone[k]);
	}
	double q[6];
	const double share = search(force, q);
	// Of strengths that are out of all proportion.
	if (!btElasticPlasticIsFinite(share + q[0] + q[1] + q[2] + q[3] + q[4] + q[5]))
		return;
	m_left.resize(int(m_fibres.size()));
	for (int i = 0; i < m_left.size(); ++i)
	{
		const Fibre& fibre = m_fibres[size_t(i)];
		const double slip = flowOf(fibre, q, false),
					 taken = fibre.m_flow > 0 ? btMin(share, 1.) * slip / fibre.m_flow : 0;
		m_left[i] = btScalar(btMax(LEAST_LEFT, sqrt(btMax(0., 1 - taken * taken))));
	}
	findShares(force, share, force[0] * q[0] + force[1] * q[1] + force[2] * q[2]);
	const double reached = shareOf(force, q, share);
	if (reached > FLOWS_FROM && work > 0)
		follow(model, flow, btMin(1., (reached - FLOWS_FROM) / (1 - FLOWS_FROM)) * btMin(LONGEST_TURN, sqrt(grown)));
	// What shear and torsion do themselves.
	double slipped = 0;
	for (int k = 3; k < 6; ++k)
		slipped += fabs(force[k] * way[k]);
	const double room = MOST_ROOM * (1 - slipped / (MOST_SLIP * btMax(work, slipped)));
	for (int k = 0; k < 3 && room > 0; ++k)
		m_share[k] = btMin(btScalar(m_mostShare[k]), m_share[k] + btScalar(room));
}
}  // namespace btElasticPlastic
