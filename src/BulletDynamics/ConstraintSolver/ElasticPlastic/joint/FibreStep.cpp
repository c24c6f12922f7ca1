// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "FibreStep.h"

#include <math.h>

#include <algorithm>

#include "../Prefetch.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// What a fibre that is open or ruptured counts for in the mean of plastic offsets: next to nothing, but the mean of the fibres of
/// one line alone would not be defined.
const double WEIGHT_OF_IDLE = 1e-3;

/// A step that elongates a section by this share of what it yields at, or by more, does not resolve it.
const double RESOLVED_ELONGATION = 0.25;

/// A fibre that has been crushed by this share of its ductility is gone. What its stretch is found from has been rounded.
const double CRUSHED = 0.999;

/// A fibre with this share of its strength has flowed in the step before.
const double FLOWING = 0.999;

/// Newton's steps for a scalar equation; a few are enough.
const int MOST_RATE_STEPS = 30;

bool isFree(const btRigidBody& body)
{
	const btVector3 one(1, 1, 1);
	return body.getLinearFactor() == one && body.getAngularFactor() == one;
}
}  // namespace

namespace
{
/// By a value of its own, which loops over fibres keep in registers.
SectionPlaneOf<btScalar> planeOf(const btScalar strain[BT_EP_DOF_COUNT])
{
	SectionPlaneOf<btScalar> plane;
	plane.m_elongation = strain[BT_EP_AXIAL];
	plane.m_turnY = strain[BT_EP_BENDING_Y];
	plane.m_turnZ = strain[BT_EP_BENDING_Z];
	return plane;
}

template <class T>
void prefetchAll(const btAlignedObjectArray<T>& array)
{
	if (array.size() > 0)
		btElasticPlastic::prefetch(&array[0], &array[0] + array.size());
}
}  // namespace

void FibreStep::prefetch() const
{
	prefetchForSolution();
	prefetchAll(m_model.m_state.m_fibres);
}

void FibreStep::prefetchForSolution() const
{
	btElasticPlastic::prefetch(this, m_interaction.getEndWithoutShear());
	prefetchAll(m_model.m_bearing);
}

/// Without a yield value: a fibre has two.
inline DofState FibreStep::stateOf(int i, const SectionPlaneOf<btScalar>& plane) const
{
	const JointModel::BearingFibre& fibre = m_model.m_bearing[i];
	const btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
	DofState s = {fibre.m_stiffness, 0, plane.at(fibre) - state.m_offset, state.m_force, state.m_forceRate, {}};
	if (!m_damping.isNone())
		m_branches.addTo(s, fibre, bore(i));
	return s;
}

DofState FibreStep::stateOf(int i, const btScalar strain[BT_EP_DOF_COUNT]) const { return stateOf(i, planeOf(strain)); }

DofState FibreStep::stateOfShear(int shear, const btScalar strain[BT_EP_DOF_COUNT]) const
{
	const int dof = BT_EP_SHEAR_Y + shear;
	const btElasticPlasticState& state = m_model.m_state;
	DofState s = {m_model.m_capacity.m_stiffness[dof],
				  yieldOf(dof),
				  strain[dof],
				  state.m_force[dof],
				  state.m_forceRate[dof],
				  {state.m_applied[dof], state.m_appliedBefore[dof]}};
	m_damping.addTo(s, state.m_branch, dof);
	return s;
}

/// strengthInStep() of a fibre that is steady. Inline, since each step asks it twice of most fibres.
/// \param fibre, state  of the i-th
inline FibreStep::Strength FibreStep::steadyStrength(int i, const JointModel::BearingFibre& fibre,
													 const btElasticPlasticFibreState& state) const
{
	Strength strength;
	strength.m_tension = state.m_isCracked ? btScalar(0) : fibre.m_tension;
	strength.m_compression = fibre.m_compression;
	m_interaction.lessen(i, strength);
	strength.m_rate = strength.m_rateShare = 0;
	return strength;
}

void FibreStep::findBearing()
{
	m_boreAll = m_model.doAllBear();
	if (m_boreAll)
		return;
	m_bore.resize(m_numFibres);
	for (int i = 0; i < m_numFibres; ++i)
		m_bore[i] = m_model.bears(i);
	m_partCompliance = m_model.bearingCompliance();
}

/// The branches of all fibres together have three forces each; a fibre has of them what its elongation in the plane gives it.
void FibreStep::findBranches()
{
	if (m_damping.isNone())
		return;
	SectionPlane sum, kept;
	for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
	{
		m_branch[b] = compliance().of(m_model.branchForces(b));
		sum.add(1, m_branch[b]);
		kept.add(double(m_damping.getKept(b)), m_branch[b]);
	}
	m_branches.m_stiffening = m_damping.getStiffening();
	m_branches.m_force = sum.rounded();
	m_branches.m_carried = kept.rounded();
}

/// Compliance between a fibre and a shear: that between the shear and the bending in its plane, at the fibre's place.
double FibreStep::couplingOf(int fibre, int shear) const
{
	if (m_shearRow[shear] < 0 || m_model.m_state.m_fibres[fibre].isRuptured())
		return 0;
	const btElasticPlasticFibre& own = m_model.m_capacity.m_fibres[fibre];
	return double(m_model.m_capacity.couplingCompliance(BT_EP_SHEAR_Y + shear)) *
		   double(shear == 0 ? -own.m_y : own.m_z);
}

/// Coupling needs a unit of bodies that are free in all directions.
void FibreStep::findCoupledRows(const JointRows& rows)
{
	m_shearRow[0] = m_shearRow[1] = -1;
	const btElasticPlasticCapacity& capacity = m_model.m_capacity;
	if (capacity.m_coupling[0] == 0 && capacity.m_coupling[1] == 0)
		return;
	const bool isCoupled[2] = {capacity.couplingCompliance(BT_EP_SHEAR_Y) != 0,
							   capacity.couplingCompliance(BT_EP_SHEAR_Z) != 0};
	if ((!isCoupled[0] && !isCoupled[1]) || !isFree(m_model.bodyA()) || !isFree(m_model.bodyB()))
		return;
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		const int shear = rows.m_row[r].m_dof - BT_EP_SHEAR_Y;
		if ((shear == 0 || shear == 1) && isCoupled[shear])
			m_shearRow[shear] = r;
	}
}

/// How much slower the step ends if all fibres that know a rate are twice as strong as at rest: the velocities of the axial row and of the
/// two bendings [m/s], [rad/s]. Other joints only lessen it.
void FibreStep::findResponse(const Motion& motion, btScalar diagonal)
{
	double sum[3] = {};
	for (int i = 0; i < m_numFibres; ++i)
	{
		const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
		if (!(fibre.m_rateReference > 0))
			continue;
		const double strength = double(btMax(fibre.m_tension, fibre.m_compression));
		sum[0] += strength;
		sum[1] += strength * fabs(double(fibre.m_z));
		sum[2] += strength * fabs(double(fibre.m_y));
	}
	const double diagonals[3] = {double(diagonal), double(motion.m_turn[0]), double(motion.m_turn[1])};
	for (int k = 0; k < 3; ++k)
		m_response[k] = double(m_dt) * diagonals[k] * sum[k];
}

/// By what share s a fibre is stronger in the step than at rest. With the rate v with which the step begins that would be (v / D)^(1 / q), which
/// is steep where v is small: what flows slowly would be stopped in one step and let go in the next. So it is taken for the rate w at the
/// step's end, as far as this joint's bodies decide on it. With the last step's change of v going on, a response g of the rate to the
/// strength F, and the share s0 by which its force is above its strength at rest,
///
///     w = D s^q = v' - (g + F / (k dt)) (s - s0),   v' = v + (v - v0),
///
/// since what is not flow is elastic,
/// whose left side grows and whose right side falls with s: there is one solution, and Newton's steps from above go straight to it.
/// \param force     with which the step begins [N]
/// \param strength  at rest [N]
double FibreStep::rateShareInStep(int i, double force, double rate, const JointModel::FibreStrength& strength) const
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	const btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
	// What is under a force flows in its direction, if it flows.
	const bool isPressed = force != 0 ? force < 0 : rate < 0;
	const double sign = isPressed ? -1 : 1, v = sign * rate, before = sign * double(state.m_rate),
				 atRest = isPressed ? double(strength.m_compression) : double(strength.m_tension);
	if (!(atRest > 0))
		return 0;
	const double byStrength =
		m_response[0] + m_response[1] * fabs(double(fibre.m_z)) + m_response[2] * fabs(double(fibre.m_y));
	// A blow is no change that goes on: joints make no more than by their strength.
	const double ahead = v + btMax(-byStrength, btMin(byStrength, v - before));
	const double response = byStrength + atRest / (double(fibre.m_stiffness) * double(m_dt));
	const double reference = fibre.m_rateReference, exponent = fibre.m_rateExponent;
	const double right = ahead + response * (sign * force / atRest - 1);
	if (!(right > 0))
		return 0;
	double share = pow(right / reference, 1 / exponent);
	if (response > 0)
		share = btMin(share, right / response);
	for (int k = 0; k < MOST_RATE_STEPS; ++k)
	{
		const double power = reference * pow(share, exponent - 1),
					 step = (power * share + response * share - right) / (exponent * power + response);
		share -= step;
		if (!(step > 1e-6 * share))
			break;
	}
	return btMax(share, 0.);
}

/// How much a fibre flows whose force at the end of the step would be beyond its strength if that and the fibre stayed as they are: until what
/// the spring loses by the flow, and the strength gains or loses along its path, have made up for it.
/// \param stiffness  of the spring, with what the damping's branches add to it
double FibreStep::flowInStep(int i, bool isPulled, double beyond, double stiffness, double stronger) const
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	const btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
	double flow = 0;
	// Along a straight part of the strength. What falls faster than the spring lets go at once.
	const auto endsWithin = [&](double way, double rise)
	{
		const double needed = btMax(stiffness * way + rise, stiffness * way / 2);
		const bool ends = beyond <= needed;
		flow += ends ? way * beyond / needed : way;
		beyond -= needed;
		return ends;
	};
	if (fibre.m_softens && isPulled && !state.m_isCracked)
	{
		const double left = btMax(1 - double(state.m_damage), 0.);
		if (left > 0 && endsWithin(left * double(fibre.m_stretchLimit), -left * stronger * double(fibre.m_tension)))
			return flow;
	}
	const double strength = stronger * double(isPulled ? fibre.m_tension : fibre.m_compression);
	double from = state.m_path, factor = m_model.m_capacity.strengthFactor(fibre, state.m_path);
	for (int p = fibre.m_firstPoint; p < fibre.m_firstPoint + fibre.m_numPoints; ++p)
	{
		const btElasticPlasticCurvePoint& next = m_model.m_capacity.m_curvePoints[p];
		if (!(double(next.m_path) > from))
			continue;
		if (endsWithin(double(next.m_path) - from, strength * (double(next.m_factor) - factor)))
			return flow;
		from = next.m_path;
		factor = next.m_factor;
	}
	return flow + beyond / stiffness;
}

/// Steps that bear the strength at their end take up a crack's work, if they load it in several: one that loads and tears it takes none. In the step in
/// which a fibre comes to its strength, from F0 to F1 over the elongation u and of the work W of spring and crack, bodies are to give W but for what
/// steps before it have taken too much and those after it will. That is, by a mean force with the share alpha of the end's and with u in each of the steps,
///
///     alpha F = W / u - F0 / 2 + (alpha - 1/2) F1:
///
/// F = F1 once the fibre flows, but for rounding. No more than the strength; and if bodies slow down in the step it has taken less, to a quarter of a body's energy
/// that the crack would just have taken. Where the next step tears what this one has loaded it may be 12 % more.
/// \param elongation  in the step, if nothing slows it down [m]
/// \param strength    at its beginning [N]
/// \param end         at its end
/// \param alpha       of the step's scheme, see Law.h
double FibreStep::tearingStrength(int i, const DofState& s, double elongation, double strength, double end,
								  double alpha) const
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	const double stiffness = double(fibre.m_stiffness), pulled = fmax(double(s.m_force), 0),
				 under = fmax(-double(s.m_force), 0) / stiffness, length = elongation - under;
	if (!(pulled < FLOWING * strength) || !(length > 0))
		return end;
	const double opened = (1 - end / strength) * fmax(1 - double(m_model.m_state.m_fibres[i].m_damage), 0) *
						  double(fibre.m_stretchLimit),
				 work = (strength + end) / 2 * opened + (end * end - pulled * pulled) / (2 * stiffness),
				 force = (work / length - pulled / 2 + (alpha - 0.5) * end) / alpha;
	return fmax(end, fmin(force, strength));
}

/// The strength that a fibre has at the end of the step, after what it may flow in it by its rate: as the force of any spring, a step's is that of
/// its end, and the work of bodies, which they give by the mean of both ends' forces, is right but for the square of the step.
FibreStep::Strength FibreStep::strengthInStep(int i, const DofState& s, const Motion& motion, btScalar alpha) const
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	Strength strength;
	static_cast<JointModel::FibreStrength&>(strength) = m_model.strengthOf(i);
	strength.m_rate = strength.m_rateShare = 0;
	if (fibre.isSteady())
	{
		m_interaction.lessen(i, strength);
		return strength;
	}
	const btScalar* const rates = motion.m_rate;
	const btScalar rate = rates[BT_EP_AXIAL] + fibre.m_z * rates[BT_EP_BENDING_Y] - fibre.m_y * rates[BT_EP_BENDING_Z];
	if (fibre.m_rateReference > 0)
	{
		strength.m_rate = rate;
		strength.m_rateShare = btScalar(rateShareInStep(i, double(s.m_force), double(rate), strength));
	}
	const btScalar stronger = 1 + strength.m_rateShare, force = s.forceAt(s.m_strain + m_dt * rate),
				   beyondTension = force - stronger * strength.m_tension,
				   beyond = btMax(beyondTension, -force - stronger * strength.m_compression);
	if ((fibre.m_numPoints > 0 || fibre.m_softens) && beyond > 0)
	{
		const bool isPulled = beyond == beyondTension;
		const double flow = flowInStep(i, isPulled, double(beyond),
									   double(fibre.m_stiffness) * (1 + double(s.m_stiffening)), double(stronger));
		const JointModel::FibreStrength end = m_model.strengthOf(i, btScalar(flow));
		if (fibre.m_softens && isPulled)
			strength.m_tension = btScalar(tearingStrength(i, s, double(m_dt * rate), double(strength.m_tension),
														  double(end.m_tension), double(alpha)));
		else
			strength.m_tension = end.m_tension;
		strength.m_compression = end.m_compression;
	}
	strength.m_tension *= stronger;
	strength.m_compression *= stronger;
	m_interaction.lessen(i, strength);
	return strength;
}

void FibreStep::findSteadyStrengths()
{
	m_strength.resize(m_numFibres);
	for (int i = 0; i < m_numFibres; ++i)
		m_strength[i] = steadyStrength(i, m_model.m_bearing[i], m_model.m_state.m_fibres[i]);
}

/// How much the section elongates in the step, over that at which it yields.
btScalar FibreStep::elongationOverYield(const Motion& motion) const
{
	const btElasticPlasticCapacity& capacity = m_model.m_capacity;
	return m_dt * btFabs(motion.m_rate[BT_EP_AXIAL]) * capacity.m_stiffness[BT_EP_AXIAL] /
		   capacity.m_yield[BT_EP_AXIAL];
}

btScalar FibreStep::squareOfFrequency(const Motion& motion, btScalar diagonal, const JointRows& rows) const
{
	const btElasticPlasticCapacity& capacity = m_model.m_capacity;
	const btScalar axial = capacity.m_stiffness[BT_EP_AXIAL] * diagonal;
	double energy = 0, sum = 0;
	const auto add = [&](int dof, btScalar own)
	{
		const double rate = motion.m_rate[dof], moving = own > 0 ? rate * rate / double(own) : 0.;
		if (!(moving > 0) || capacity.isRigidPlastic(dof))
			return;
		energy += moving;
		sum += moving * log(double(capacity.m_stiffness[dof]) * double(own));
	};
	if (motion.m_isInner && !m_model.anyBearsPressureOnly())
	{
		add(BT_EP_AXIAL, diagonal);
		add(BT_EP_BENDING_Y, motion.m_turn[0]);
		add(BT_EP_BENDING_Z, motion.m_turn[1]);
		for (int r = 0; r < rows.m_numRows; ++r)
			add(rows.m_row[r].m_dof, rows.m_row[r].m_diagonal);
	}
	btScalar square = axial;
	if (energy > 0)
	{
		const double unresolved = fmin(1, double(elongationOverYield(motion)) / RESOLVED_ELONGATION);
		btSetMin(square, btScalar(exp((1 - unresolved) * sum / energy + unresolved * log(double(axial)))));
	}
	for (int shear = 0; shear < 2; ++shear)
		if (m_shearRow[shear] >= 0)
			btSetMax(square, capacity.m_stiffness[BT_EP_SHEAR_Y + shear] * rows.m_row[m_shearRow[shear]].m_diagonal);
	return square;
}

/// Not where a fibre opens by whatever it moves, or its strength changes in the step.
bool FibreStep::carriesWaves(const Motion& motion) const
{
	return motion.m_keepsSwings && m_model.m_areSteady && !m_model.anyBearsPressureOnly();
}

/// Of fibres only what they add up to is known of the last two steps' mean forces. That differs from the present one as in an elastic section: a fibre that has flowed
/// has kept its force meanwhile.
FibreStep::Past FibreStep::pastOf(const MeanForce& scheme) const
{
	const btElasticPlasticState& state = m_model.m_state;
	SectionForces now;
	if (!m_damping.isNone())
		for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
		{
			const SectionForces branch = m_model.branchForces(b);
			now.m_axial += branch.m_axial;
			now.m_momentY += branch.m_momentY;
			now.m_momentZ += branch.m_momentZ;
		}
	const auto beyond = [&](int dof, double branches)
	{
		return scheme.beyondOwn(double(state.m_applied[dof]), double(state.m_appliedBefore[dof]),
								double(state.m_force[dof]) + branches);
	};
	SectionForces sum;
	sum.m_axial = beyond(BT_EP_AXIAL, now.m_axial);
	sum.m_momentY = beyond(BT_EP_BENDING_Y, now.m_momentY);
	sum.m_momentZ = beyond(BT_EP_BENDING_Z, now.m_momentZ);
	return {scheme.shareOfOwn(), m_model.bearingCompliance().of(sum).rounded()};
}

btScalar FibreStep::knownByMode(int i, const Past& past, btScalar force,
								const JointModel::FibreStrength& strength) const
{
	const JointModel::BearingFibre& fibre = m_model.m_bearing[i];
	if (m_model.m_state.m_fibres[i].isRuptured())
		return 0;
	const btScalar known = past.m_own * force + past.m_plane.at(fibre) * fibre.m_stiffness;
	return btMax(-past.m_own * strength.m_compression, btMin(past.m_own * strength.m_tension, known));
}

void FibreStep::begin(const btScalar strain[BT_EP_DOF_COUNT], const Motion& motion, btScalar diagonal, btScalar dt,
					  JointRows& rows)
{
	const int n = m_model.m_bearing.size();
	m_dt = dt;
	m_numFibres = n;
	m_bound.resize(n, 0);
	if (rows.m_fibres.size() < n)
		rows.m_fibres.resize(n);
	if (!m_model.m_areSteady)
	{
		m_strength.resize(n);
		findResponse(motion, diagonal);
	}
	findCoupledRows(rows);
	findBearing();
	findBranches();
	const btScalar a = dt * dt * squareOfFrequency(motion, diagonal, rows);
	m_areOfWaves = carriesWaves(motion);
	const MeanForce scheme =
		m_areOfWaves ? MeanForce::byMode(motion.m_tau) : MeanForce::byRow(a, dt, motion.m_lastStep);
	Past past = {};
	if (m_areOfWaves)
		past = pastOf(scheme);
	const bool isCoupled = m_shearRow[0] >= 0 || m_shearRow[1] >= 0;
	if (isCoupled)
		m_known.resize(n);
	const btScalar perTime = 1 / dt, alpha = scheme.m_alpha,
				   perStiffness = perTime / (alpha * (1 + m_damping.getStiffening()));
	const JointModel::BearingFibre* const fibres = n > 0 ? &m_model.m_bearing[0] : nullptr;
	const btElasticPlasticFibreState* const states = n > 0 ? &m_model.m_state.m_fibres[0] : nullptr;
	JointRows::Fibre* const to = n > 0 ? &rows.m_fibres[0] : nullptr;
	const SectionPlaneOf<btScalar> plane = planeOf(strain);
	const bool areSteady = m_model.m_areSteady;
	for (int i = 0; i < n; ++i)
	{
		const JointModel::BearingFibre& fibre = fibres[i];
		const btElasticPlasticFibreState& state = states[i];
		const DofState s = stateOf(i, plane);
		// With a state of its own: what a function gets by address does not stay in registers, and most fibres are steady.
		const Strength strength =
			areSteady ? steadyStrength(i, fibre, state) : strengthInStep(i, stateOf(i, strain), motion, alpha);
		if (!areSteady)
			m_strength[i] = strength;
		const btScalar known = m_areOfWaves ? knownByMode(i, past, s.m_force, strength) : scheme.known(s, dt),
					   inverse = perStiffness / s.m_stiffness;
		const MeanForce::Bounds bounds = scheme.bound(known, strength.m_tension, strength.m_compression, a);
		if (isCoupled)
			m_known[i] = known;
		// As implicitRow(), with two bounds.
		JointRows::Fibre& row = to[i];
		const bool holds = !state.isRuptured();
		row.m_soft.m_compliance = inverse * perTime;
		row.m_soft.m_velocity = s.m_strain * perTime + (known + alpha * s.m_carried) * inverse;
		row.m_soft.m_lower = holds ? dt * bounds.m_lower : btScalar(0);
		row.m_soft.m_upper = holds ? dt * bounds.m_upper : btScalar(0);
		row.m_y = fibre.m_y;
		row.m_z = fibre.m_z;
		row.m_coupling[0] = row.m_coupling[1] = 0;
		row.m_bound = 0;
	}
	for (int i = 0; i < n && m_isAnyAtBound; ++i)
		to[i].m_bound = m_bound[i];
	rows.m_numFibres = n;
	if (isCoupled)
		couple(strain, scheme, a, rows);
	// Bending may be much more mobile than what is pulled.
	rows.m_fibreDiagonal = diagonal;
	for (int k = 0; k < 2; ++k)
		rows.m_fibreDiagonal += m_model.m_reach[k] * m_model.m_reach[k] * motion.m_turn[k];
	for (int shear = 0; shear < 2; ++shear)
		rows.m_coupledShear[shear] = m_shearRow[shear];
}

/// As coupledRows() of Law.h, for all fibres and both shears.
void FibreStep::couple(const btScalar strain[BT_EP_DOF_COUNT], const MeanForce& scheme, btScalar a, JointRows& rows)
{
	for (int shear = 0; shear < 2; ++shear)
	{
		if (m_shearRow[shear] < 0)
			continue;
		const DofState s = stateOfShear(shear, strain);
		const btScalar known = scheme.known(s, m_dt) + scheme.m_alpha * s.m_carried;
		SoftRow& soft = rows.m_row[m_shearRow[shear]].m_soft;
		soft = implicitRow(s, scheme, a, m_dt);
		for (int i = 0; i < m_numFibres; ++i)
		{
			const btScalar coupling = btScalar(couplingOf(i, shear)) / (scheme.m_alpha * (1 + s.m_stiffening) * m_dt);
			const DofState fibre = stateOf(i, strain);
			rows.m_fibres[i].m_coupling[shear] = coupling / m_dt;
			rows.m_fibres[i].m_soft.m_velocity += coupling * known;
			soft.m_velocity += coupling * (m_known[i] + scheme.m_alpha * fibre.m_carried);
		}
	}
}

void FibreStep::setSolution(const double* impulses, const signed char* bounds, bool isCut, btScalar resultant[3])
{
	SectionSum sums;
	const int n = m_numFibres;
	const JointModel::BearingFibre* const fibres = n > 0 ? &m_model.m_bearing[0] : nullptr;
	for (int i = 0; i < n; ++i)
		sums.add(fibres[i], impulses[i]);
	const SectionForces sum = sums.get();
	bool isAny = false;
	for (int i = 0; i < n && bounds; ++i)
		isAny |= bounds[i] != 0;
	for (int i = 0; i < n && (isAny || m_isAnyAtBound); ++i)
		m_bound[i] = isAny ? bounds[i] : static_cast<signed char>(0);
	m_isAnyAtBound = isAny;
	if (isCut)
	{
		m_impulse.resize(n);
		for (int i = 0; i < n; ++i)
			m_impulse[i] = btScalar(impulses[i]);
	}
	resultant[0] = btScalar(sum.m_axial);
	resultant[1] = btScalar(sum.m_momentY);
	resultant[2] = btScalar(sum.m_momentZ);
}

std::vector<signed char> FibreStep::getLastBounds() const
{
	std::vector<signed char> bounds;
	for (int i = 0; i < m_bound.size(); ++i)
		bounds.push_back(m_bound[i]);
	return bounds;
}

void FibreStep::setLastBounds(const std::vector<signed char>& bounds)
{
	m_bound.resize(0);
	for (const signed char bound : bounds)
		m_bound.push_back(bound);
	lookForBounds();
}

void FibreStep::lookForBounds()
{
	m_isAnyAtBound = false;
	for (int i = 0; i < m_bound.size(); ++i)
		m_isAnyAtBound |= m_bound[i] != 0;
}

// ---- return mapping

/// Ends a step in which all fibres bear before and after, and none comes to its strength, which is most of them: as mapAlone(), takeStates() and
/// dampTogether() do, without what is for others.
/// \return whether it was one; if not, nothing has changed
bool FibreStep::takeElastic(const btScalar trial[BT_EP_DOF_COUNT], Outcome& outcome)
{
	const int n = m_numFibres;
	if (n == 0 || !m_boreAll)
		return false;
	const bool damps = !m_damping.isNone(), areSteady = m_model.m_areSteady;
	const SectionPlaneOf<btScalar> plane = planeOf(trial), carried = m_branches.m_carried;
	const btScalar stiffening = m_branches.m_stiffening, stiffer = 1 + stiffening;
	const JointModel::BearingFibre* const fibres = &m_model.m_bearing[0];
	btElasticPlasticFibreState* const states = &m_model.m_state.m_fibres[0];
	bool areBelow = true;
	for (int i = 0; i < n && areBelow; ++i)
	{
		const JointModel::BearingFibre& fibre = fibres[i];
		const btElasticPlasticFibreState& state = states[i];
		const btScalar spring = (plane.at(fibre) - state.m_offset) * fibre.m_stiffness,
					   total = damps ? stiffer * spring +
										   (carried.at(fibre) * fibre.m_stiffness - stiffening * state.m_force)
									 : spring;
		const Strength strength = areSteady ? steadyStrength(i, fibre, state) : m_strength[i];
		areBelow = (total <= strength.m_tension) & (total >= -strength.m_compression) &
				   ((spring < 0) | (strength.m_tension > 0)) & !state.isRuptured();
	}
	if (!areBelow)
		return false;
	SectionSum sums, changes;
	const btScalar perTime = 1 / m_dt;
	for (int i = 0; i < n; ++i)
	{
		btElasticPlasticFibreState& state = states[i];
		// Once more in place of memory for it, and exactly: the joint's moments are its sums.
		const double force = double(plane.at(fibres[i]) - state.m_offset) * double(fibres[i].m_stiffness);
		const btScalar grown = btScalar(force) - state.m_force;
		state.m_rate = areSteady ? btScalar(0) : m_strength[i].m_rate;
		state.m_rateShare = areSteady ? btScalar(0) : m_strength[i].m_rateShare;
		state.m_forceRate = grown * perTime;
		state.m_force = btScalar(force);
		sums.add(fibres[i], force);
		changes.add(fibres[i], double(grown));
	}
	const SectionForces sum = sums.get();
	outcome.m_force[0] = btScalar(sum.m_axial);
	outcome.m_force[1] = btScalar(sum.m_momentY);
	outcome.m_force[2] = btScalar(sum.m_momentZ);
	if (damps)
		dampTogether(changes.get(), outcome);
	return true;
}

void FibreStep::mapAlone(const btScalar trial[BT_EP_DOF_COUNT])
{
	for (int i = 0; i < m_numFibres; ++i)
	{
		const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
		const DofState s = stateOf(i, trial);
		const double elongation = s.m_strain, stiffer = 1 + double(s.m_stiffening), carried = s.m_carried,
					 force = stiffer * (elongation * double(fibre.m_stiffness)) + carried;
		const int bound = m_bound[i];
		const double clamped =
			btMax(-double(m_strength[i].m_compression), btMin(double(m_strength[i].m_tension), force));
		const bool flows = clamped != force && (force > 0 ? bound > 0 : bound < 0);
		const double spring = (clamped - carried) / stiffer;
		m_mapped[i] = {spring, clamped, flows ? elongation - spring / double(fibre.m_stiffness) : 0, 0, 0};
	}
}

void FibreStep::mapCoupled(const btScalar trial[BT_EP_DOF_COUNT], const RowOutcome* const shears[2], Outcome& outcome)
{
	m_bundle.m_fibres.resize(size_t(m_numFibres));
	const double stiffer = 1 + double(m_damping.getStiffening());
	double carried[2] = {}, turnedByCarried[2] = {};  // of the shears, and by the fibres'
	for (int s = 0; s < 2; ++s)
		if (m_shearRow[s] >= 0)
			carried[s] = double(stateOfShear(s, trial).m_carried);
	for (int i = 0; i < m_numFibres; ++i)
	{
		const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
		const bool holds = !m_model.m_state.m_fibres[i].isRuptured();
		CoupledBundle::Fibre& spring = m_bundle.m_fibres[size_t(i)];
		spring.m_compliance = 1 / double(fibre.m_stiffness);
		spring.m_lower = holds ? -double(m_strength[i].m_compression) : 0;
		spring.m_upper = holds ? double(m_strength[i].m_tension) : 0;
		const DofState state = stateOf(i, trial);
		spring.m_target = stiffer * double(state.m_strain) + double(state.m_carried) * spring.m_compliance;
		spring.m_bound = m_bound[i];
		for (int s = 0; s < 2; ++s)
		{
			spring.m_coupling[s] = couplingOf(i, s);
			spring.m_target += spring.m_coupling[s] * carried[s];
			turnedByCarried[s] += spring.m_coupling[s] * double(state.m_carried);
		}
	}
	for (int s = 0; s < 2; ++s)
	{
		CoupledBundle::Spring& spring = m_bundle.m_shear[s];
		spring = {1, 0, 0, 0, 0, 1};
		if (m_shearRow[s] < 0)
			continue;
		const DofState state = stateOfShear(s, trial);
		spring = {1 / double(state.m_stiffness),
				  -double(state.m_yield),
				  double(state.m_yield),
				  stiffer * double(state.m_strain) + carried[s] / double(state.m_stiffness) + turnedByCarried[s],
				  0,
				  shears[s]->m_bound};
	}
	m_bundle.project();
	const double shear[2] = {(m_bundle.m_shear[0].m_force - carried[0]) / stiffer,
							 (m_bundle.m_shear[1].m_force - carried[1]) / stiffer};
	double turned[2] = {};
	for (int i = 0; i < m_numFibres; ++i)
	{
		const CoupledBundle::Fibre& spring = m_bundle.m_fibres[size_t(i)];
		const int bound = m_bound[i];
		const DofState state = stateOf(i, trial);
		const double force = (spring.m_force - double(state.m_carried)) / stiffer,
					 elastic = force * spring.m_compliance + spring.m_coupling[0] * shear[0] +
							   spring.m_coupling[1] * shear[1];
		const bool flows = spring.m_bound != 0 && spring.m_bound == bound;
		m_mapped[i] = {force, spring.m_force, flows ? double(state.m_strain) - elastic : 0, 0, 0};
		for (int s = 0; s < 2; ++s)
			turned[s] += spring.m_coupling[s] * force;
	}
	for (int s = 0; s < 2; ++s)
	{
		const CoupledBundle::Spring& spring = m_bundle.m_shear[s];
		const bool flows = m_shearRow[s] >= 0 && spring.m_bound != 0 && spring.m_bound == shears[s]->m_bound;
		outcome.m_shear[s].m_force = btScalar(shear[s]);
		outcome.m_shear[s].m_increment =
			flows ? btScalar(double(stateOfShear(s, trial).m_strain) - shear[s] * spring.m_compliance - turned[s])
				  : btScalar(0);
	}
}

/// The impulses' forces, which do not belong to the deformation: what is beyond them is given up.
void FibreStep::mapCut(const btScalar trial[BT_EP_DOF_COUNT], const RowOutcome* const shears[2], Outcome& outcome)
{
	double shear[2] = {}, turned[2] = {};
	for (int s = 0; s < 2; ++s)
		if (m_shearRow[s] >= 0)
		{
			const DofState state = stateOfShear(s, trial);
			shear[s] = double(state.springForce(state.withinYield(shears[s]->m_impulse / m_dt)));
		}
	for (int i = 0; i < m_numFibres; ++i)
	{
		const DofState state = stateOf(i, trial);
		const btScalar total = btMax(-m_strength[i].m_compression, btMin(m_strength[i].m_tension, m_impulse[i] / m_dt));
		const double force = double(state.springForce(total));
		const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
		double beyond = double(state.m_strain) - force / double(fibre.m_stiffness);
		for (int s = 0; s < 2; ++s)
		{
			beyond -= couplingOf(i, s) * shear[s];
			turned[s] += couplingOf(i, s) * force;
		}
		const bool opens = m_model.bearsPressureOnly(i) && beyond > 0;
		m_mapped[i] = {force, double(total), opens ? beyond : 0, opens ? 0 : beyond, 0};
	}
	for (int s = 0; s < 2; ++s)
	{
		if (m_shearRow[s] < 0)
			continue;
		const DofState state = stateOfShear(s, trial);
		const double beyond = double(state.m_strain) - shear[s] / double(state.m_stiffness) - turned[s];
		outcome.m_shear[s].m_force = btScalar(shear[s]);
		outcome.m_shear[s].m_increment = 0;
		outcome.m_shear[s].m_unloaded = btScalar(beyond);
	}
}

/// How far a fibre has been stretched beyond yield, whatever it has been pressed since: both together are its path, and what is left of the
/// one by the other its plastic elongation.
double FibreStep::stretchOf(int i) const
{
	const btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
	const double path = state.m_path,
				 left = double(planeOf(m_model.m_state.m_plastic).at(m_model.m_capacity.m_fibres[i])) +
						double(state.m_offset);
	return fmax(0, fmin((path + left) / 2, path));
}

/// A fibre's flow: what it dissipates and what it spends of the ductility. Nothing flows that the ductility does not allow.
void FibreStep::flow(int i, double force, double increment, Outcome& outcome)
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
	const double spent = fabs(increment) / double(increment > 0 ? fibre.m_stretchLimit : fibre.m_crushLimit),
				 damage = double(state.m_damage), left = 1 - damage, dissipated = fabs(force * increment);
	outcome.m_flowed = true;
	state.m_offset += btScalar(increment);
	state.m_path += btScalar(fabs(increment));
	// Rounded up, as a joint's is.
	if (spent * (1 + double(SIMD_EPSILON)) < left)
	{
		outcome.m_plasticEnergy += dissipated;
		state.m_damage = btScalar(damage + spent);
		return;
	}
	// More than 1 tells nothing.
	state.m_damage = 1;
	double beyond = spent - left;
	if (!state.m_isCracked && fibre.m_tension < fibre.m_compression)
		beyond = crack(i, increment, damage + spent);
	const double allowed = 1 - beyond / spent;
	outcome.m_plasticEnergy += dissipated * allowed;
	noteLoss(i, state.isRuptured() ? allowed : left / spent);
}

/// A fibre that is spent and is weaker in tension has been torn. By what it has been crushed beside, it is worn as any crack.
/// \param increment  with which it is spent
/// \param damage     with it
/// \return by how much the increment is beyond the ductility
double FibreStep::crack(int i, double increment, double damage)
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
	const double stretch = stretchOf(i), crushed = fmax(0, damage - stretch / double(fibre.m_stretchLimit));
	state.m_isCracked = crushed < CRUSHED;
	state.m_damage = btScalar(state.m_isCracked ? crushed : 1);
	if (increment < 0)
		return fmax(0, crushed - 1);
	// What is pressed has its faces together. Of what is pulled, all of the stretch is the crack's width, and where that is 0 they meet.
	if (state.m_isCracked)
	{
		state.m_offset -= btScalar(stretch);
		m_mapped[i].m_increment = stretch;
	}
	return damage - 1;
}

/// Takes back what a fibre that is being torn bears beyond the strength that is left to it, see tearingStrength().
void FibreStep::letGo(int i)
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	Mapped& mapped = m_mapped[i];
	if (!fibre.m_softens || m_model.m_state.m_fibres[i].m_isCracked || !(mapped.m_increment > 0))
		return;
	const JointModel::FibreStrength after = m_model.strengthOf(i, btScalar(mapped.m_increment));
	const double strength = double(after.m_tension) * (1 + double(m_strength[i].m_rateShare)) *
							double(m_interaction.getLeft(i, after).m_tension);
	if (!(mapped.m_force > strength))
		return;
	mapped.m_increment += (mapped.m_force - strength) / double(fibre.m_stiffness);
	mapped.m_force = strength;
}

/// The mean of a fibre's force while it flows: of its strength before and after that.
double FibreStep::flowForce(int i) const
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	const Mapped& mapped = m_mapped[i];
	if (fibre.m_numPoints == 0 && !fibre.m_softens)
		return mapped.m_total;
	const JointModel::FibreStrength before = m_model.strengthOf(i),
									after = m_model.strengthOf(i, btScalar(fabs(mapped.m_increment)));
	const double tension = double(before.m_tension) + double(after.m_tension),
				 compression = double(before.m_compression) + double(after.m_compression);
	const ShearInteraction::Left left = m_interaction.getLeft(i, {btScalar(tension / 2), btScalar(compression / 2)});
	const bool isPulled = mapped.m_increment > 0;
	return (isPulled ? tension : compression) / 2 * (1 + double(m_strength[i].m_rateShare)) *
		   double(isPulled ? left.m_tension : left.m_compression);
}

/// Notes that a fibre has cracked or ruptured, if it was the last of its piece's layers.
void FibreStep::noteLoss(int i, double share)
{
	const btAlignedObjectArray<btElasticPlasticFibre>& fibres = m_model.m_capacity.m_fibres;
	const auto hasGone = [&](int k)
	{
		const btElasticPlasticFibreState &own = m_model.m_state.m_fibres[i], &other = m_model.m_state.m_fibres[k];
		return own.isRuptured() ? other.isRuptured() : other.isTorn();
	};
	for (const int way : {-1, 1})
		for (int k = i + way; k >= 0 && k < m_numFibres && fibres[k].isLayerOf(fibres[i]); k += way)
			if (!hasGone(k))
				return;
	m_losses.push_back({i, m_model.m_state.m_fibres[i].isRuptured(), share});
}

/// Gives fibres their next state but for the mean of their offsets.
void FibreStep::takeStates(const btScalar trial[BT_EP_DOF_COUNT], Outcome& outcome)
{
	const btElasticPlasticCapacity& capacity = m_model.m_capacity;
	SectionSum sums;
	for (int i = 0; i < m_numFibres; ++i)
	{
		const btElasticPlasticFibre& fibre = capacity.m_fibres[i];
		btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
		state.m_rate = m_strength[i].m_rate;
		state.m_rateShare = m_strength[i].m_rateShare;
		// What is ruptured follows: else the turn of a section of which one line of fibres is left would grow for ever.
		if (state.isRuptured())
		{
			state.m_offset += stateOf(i, trial).m_strain;
			outcome.m_hasMoved = true;
			continue;
		}
		const Mapped& mapped = m_mapped[i];
		// A crack opens without a force, and closes where it has opened.
		const bool opens = isOpen(i);
		if (mapped.m_increment != 0 && !opens)
		{
			letGo(i);
			flow(i, flowForce(i), mapped.m_increment, outcome);
		}
		outcome.m_hasMoved |= mapped.m_increment != 0;
		state.m_offset += btScalar(opens ? 0 : mapped.m_unloaded);
		const bool holds = !state.isRuptured() && !(m_model.bearsPressureOnly(i) && mapped.m_force > 0);
		const double force = holds && !opens ? mapped.m_force : 0;
		m_mapped[i].m_change = btScalar(force) - state.m_force;
		state.m_forceRate = holds ? m_mapped[i].m_change / m_dt : btScalar(0);
		state.m_force = btScalar(force);
		sums.add(fibre, force);
	}
	const SectionForces sum = sums.get();
	outcome.m_force[0] = btScalar(sum.m_axial);
	outcome.m_force[1] = btScalar(sum.m_momentY);
	outcome.m_force[2] = btScalar(sum.m_momentZ);
}

/// Ends the step of the branches by which the material damps.
void FibreStep::damp(Outcome& outcome)
{
	bool isElastic = true;
	for (int i = 0; i < m_numFibres && isElastic; ++i)
	{
		const Mapped& mapped = m_mapped[i];
		const bool bears = m_model.bears(i), stays = mapped.m_increment == 0 && mapped.m_unloaded == 0;
		isElastic = bears == bore(i) && (stays || !bears);
	}
	if (!isElastic)
		return dampEach(outcome);
	SectionSum change;
	for (int i = 0; i < m_numFibres; ++i)
		change.add(m_model.m_capacity.m_fibres[i], double(m_mapped[i].m_change));
	dampTogether(change.get(), outcome);
}

/// Where forces have changed as in an elastic section, and so have those of the branches.
/// \param change  of the springs' forces
void FibreStep::dampTogether(const SectionForces& change, Outcome& outcome)
{
	SectionPlane grown;
	const SectionPlane changed = compliance().of(change);
	for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
	{
		const SectionForces before = m_model.branchForces(b);
		SectionForces& after = outcome.m_branch[b];
		const auto next = [&](double q, double by) { return double(m_damping.next(b, btScalar(q), btScalar(by))); };
		after.m_axial = next(before.m_axial, change.m_axial);
		after.m_momentY = next(before.m_momentY, change.m_momentY);
		after.m_momentZ = next(before.m_momentZ, change.m_momentZ);
		SectionPlane plane;
		plane.add(double(m_damping.getKept(b)), m_branch[b]);
		plane.add(double(m_damping.getTaken(b)), changed);
		outcome.m_squares[b] = before.along(m_branch[b]) + before.along(plane) + after.along(plane);
		grown.add(1, plane);
		grown.add(-1, m_branch[b]);
	}
	const SectionPlaneOf<btScalar> ofRate = grown.rounded();
	const btScalar perTime = 1 / m_dt;
	const JointModel::BearingFibre* const fibres = &m_model.m_bearing[0];
	btElasticPlasticFibreState* const states = &m_model.m_state.m_fibres[0];
	for (int i = 0, n = m_numFibres; i < n; ++i)
		if (bore(i))
			states[i].m_forceRate += ofRate.at(fibres[i]) * fibres[i].m_stiffness * perTime;
}

void FibreStep::dampEach(Outcome& outcome)
{
	double squares[MaterialDamping::BRANCHES] = {};
	for (int i = 0; i < m_numFibres; ++i)
	{
		const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
		const double stiffness = fibre.m_stiffness;
		const bool bears = m_model.bears(i);
		btScalar grown = 0;
		for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
		{
			const btScalar before = bore(i) ? btScalar(m_branch[b].at(fibre) * stiffness) : btScalar(0),
						   after = bears ? m_damping.next(b, before, m_mapped[i].m_change) : btScalar(0);
			const double q0 = before, q1 = after;
			outcome.m_squares[b] += bears ? (q0 * q0 + q0 * q1 + q1 * q1) / stiffness : 0;
			squares[b] += (bears ? q1 * q1 : q0 * q0) / stiffness;
			outcome.m_branch[b].add(fibre, q1);
			grown += after - before;
		}
		btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
		if (!state.isRuptured())
			state.m_forceRate += grown / m_dt;
	}
	const SectionCompliance kept = m_model.bearingCompliance();
	for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
	{
		const SectionForces& sum = outcome.m_branch[b];
		outcome.m_lost += fmax(squares[b] - sum.along(kept.of(sum)), 0) / (2 * double(m_damping.getGain(b)));
	}
}

/// Whether a fibre is open by more than it stretches; one that had to be torn for it, by as much again.
bool FibreStep::isGaping(int i) const
{
	const btElasticPlasticFibre& fibre = m_model.m_capacity.m_fibres[i];
	return isOpen(i) && m_mapped[i].m_increment > (fibre.m_tension > 0 ? 2 : 1) * double(fibre.m_stretchLimit);
}

/// Ruptures what is left of a section all of whose fibres gape.
void FibreStep::tearApart(Outcome& outcome)
{
	for (int i = 0; i < m_numFibres; ++i)
		if (!m_model.m_state.m_fibres[i].isRuptured() && !isGaping(i))
			return;
	for (int i = 0; i < m_numFibres; ++i)
	{
		btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
		if (state.isRuptured())
			continue;
		state.m_damage = 1;
		noteLoss(i, 1);
	}
	outcome.m_flowed = true;
}

/// Takes the mean of the fibres' offsets out of them: the plane that is nearest to them, weighed by stiffness. An open crack counts with its
/// gap, so that the elastic turn stays small however wide it gapes on one side; its own offset keeps the place where it closes.
void FibreStep::takeMean(btScalar mean[3])
{
	const btElasticPlasticCapacity& capacity = m_model.m_capacity;
	SectionStiffness section;
	SectionSum sum;
	for (int i = 0; i < m_numFibres; ++i)
	{
		const btElasticPlasticFibre& fibre = capacity.m_fibres[i];
		const btElasticPlasticFibreState& state = m_model.m_state.m_fibres[i];
		const bool opens = !state.isRuptured() && isOpen(i);
		const double weight = double(fibre.m_stiffness) * (state.isRuptured() || opens ? WEIGHT_OF_IDLE : 1),
					 offset = double(state.m_offset) + (opens ? m_mapped[i].m_increment : 0);
		section.add(fibre, weight);
		sum.add(fibre, weight * offset);
	}
	const SectionPlane plane = section.invert().of(sum.get());
	for (int i = 0; i < m_numFibres; ++i)
		m_model.m_state.m_fibres[i].m_offset -= btScalar(plane.at(capacity.m_fibres[i]));
	mean[0] = btScalar(plane.m_elongation);
	mean[1] = btScalar(plane.m_turnY);
	mean[2] = btScalar(plane.m_turnZ);
}

/// From what has been mapped to the next state.
void FibreStep::finish(const btScalar trial[BT_EP_DOF_COUNT], bool isCut, Outcome& outcome)
{
	const int numBefore = m_losses.size();
	takeStates(trial, outcome);
	tearApart(outcome);
	if (!m_damping.isNone())
		damp(outcome);
	if (m_losses.size() > numBefore + 1)
		std::stable_sort(&m_losses[numBefore], &m_losses[0] + m_losses.size(),
						 [](const Loss& a, const Loss& b) { return a.m_share < b.m_share; });
	if (outcome.m_hasMoved || isCut)
		takeMean(outcome.m_increment);
}

FibreStep::Outcome FibreStep::commit(const btScalar trial[BT_EP_DOF_COUNT], const RowOutcome* const shears[2],
									 bool isCut)
{
	Outcome outcome;
	for (int s = 0; s < 2; ++s)
		outcome.m_isCoupled[s] = m_shearRow[s] >= 0;
	const bool isCoupled = outcome.m_isCoupled[0] || outcome.m_isCoupled[1];
	if (isCut || isCoupled || !takeElastic(trial, outcome))
	{
		m_mapped.resize(m_numFibres);
		if (m_model.m_areSteady)
			findSteadyStrengths();
		if (isCut)
			mapCut(trial, shears, outcome);
		else if (isCoupled)
			mapCoupled(trial, shears, outcome);
		else
			mapAlone(trial);
		finish(trial, isCut, outcome);
	}
	const int dofs[3] = {BT_EP_AXIAL, BT_EP_BENDING_Y, BT_EP_BENDING_Z};
	for (int k = 0; k < 3; ++k)
		m_model.m_state.m_fibreStrain[k] = trial[dofs[k]] - outcome.m_increment[k];
	return outcome;
}
}  // namespace btElasticPlastic
