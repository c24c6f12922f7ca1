// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JointModel.h"

#include <math.h>

#include <initializer_list>

#include "../../btElasticPlasticSolverSettings.h"
#include "BodyGate.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "MaterialDamping.h"
#include "SupportWay.h"

namespace btElasticPlastic
{
btTransform JointModel::frameA() const { return bodyA().getCenterOfMassTransform() * m_frameInA; }
btTransform JointModel::frameB() const { return bodyB().getCenterOfMassTransform() * m_frameInB; }

/// Whether the joint's x axis points from body A to body B where nothing is bent: a hinge that has flowed through half a turn has
/// it point anywhere. What does not move may have its centre anywhere.
bool JointModel::pointsTowardsB() const
{
	const auto reachOf = [](const btRigidBody& body, const btTransform& frame)
	{ return body.getInvMass() > 0 ? frame.getOrigin().dot(frame.getBasis().getColumn(0)) : btScalar(0); };
	return reachOf(bodyA(), m_frameInA) >= reachOf(bodyB(), m_frameInB);
}

namespace
{
/// Components of a rotation vector are deformations as long as the rotation is small: their rates are off by a twelfth of its square. A
/// turn about what is free is taken out of it beyond this [rad].
const btScalar FREE_TURN = btScalar(0.03);
}  // namespace

const btRigidBody* JointModel::support() const
{
	if (bodyA().isStaticOrKinematicObject())
		return &bodyA();
	return bodyB().isStaticOrKinematicObject() ? &bodyB() : nullptr;
}

void JointModel::measure(Kinematics& kinematics, btScalar lead) const
{
	const btRigidBody* const body = lead > 0 ? support() : nullptr;
	if (body)
		measureAt(kinematics, placeBefore(body->getCenterOfMassTransform(), *body, lead));
	else
		measureBetween(kinematics, bodyA().getCenterOfMassTransform(), bodyB().getCenterOfMassTransform());
}

void JointModel::measureAt(Kinematics& kinematics, const btTransform& place) const
{
	const bool isOfA = support() == &bodyA();
	measureBetween(kinematics, isOfA ? place : bodyA().getCenterOfMassTransform(),
				   isOfA ? bodyB().getCenterOfMassTransform() : place);
}

void JointModel::measureBetween(Kinematics& kinematics, const btTransform& placeA, const btTransform& placeB) const
{
	kinematics.evaluate(placeA, placeB, m_frameInA, m_frameInB, m_state.offset(), m_state.m_plasticRotation,
						m_state.m_plasticMiddle);
	if (m_capacity.m_length > 0)
	{
		const BowedLengths lengths = bowedLengths();
		kinematics.bow(lengths.m_y, lengths.m_z);
	}
}

JointModel::BowedLengths JointModel::bowedLengths() const
{
	const btScalar length = pointsTowardsB() ? m_capacity.m_length : -m_capacity.m_length;
	return {isElasticPlastic(BT_EP_BENDING_Y) ? length : btScalar(0),
			isElasticPlastic(BT_EP_BENDING_Z) ? length : btScalar(0)};
}

btScalar JointModel::strainRounding(int dof) const
{
	const btScalar size = dof < 3 ? bodyA().getCenterOfMassPosition().length() + m_frameInA.getOrigin().length() +
										bodyB().getCenterOfMassPosition().length() + m_frameInB.getOrigin().length()
								  : btScalar(1);
	// A strain is computed from the world's coordinates with eight roundings of half SIMD_EPSILON each.
	return 4 * SIMD_EPSILON * size;
}

RelativeRotation JointModel::relativeRotation() const
{
	return RelativeRotation(frameA().getBasis(), frameB().getBasis(), m_state.m_plasticRotation,
							m_state.m_plasticMiddle);
}

namespace
{
/// A frame's axes may deviate from unit length and right angles by this much; rounding and careless normalisation deviate less.
const btScalar FRAME_TOLERANCE = btScalar(1e-3);

/// \param isA  of which body the frame is
btElasticPlasticFault findFrameFault(const btTransform& frame, bool isA)
{
	const btVector3& origin = frame.getOrigin();
	for (int i = 0; i < 3; ++i)
		if (!btElasticPlasticIsFinite(origin[i]))
			return btElasticPlasticFault(
				isA ? "origin of the frame in body A [m]" : "origin of the frame in body B [m]", origin[i], "finite");
	const btMatrix3x3 product = frame.getBasis().transposeTimes(frame.getBasis());
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
		{
			const btScalar deviation = btFabs(product[i][j] - btScalar(i == j ? 1 : 0));
			if (!btElasticPlasticIsFinite(deviation) || !(deviation < FRAME_TOLERANCE))
				return btElasticPlasticFault(
					isA ? "frame in body A: deviation from axes of unit length at right angles"
						: "frame in body B: deviation from axes of unit length at right angles",
					deviation, "below 0.001");
		}
	if (!(frame.getBasis().determinant() > 0))
		return btElasticPlasticFault(isA ? "frame in body A: determinant" : "frame in body B: determinant",
									 frame.getBasis().determinant(), "1, of axes that are right-handed");
	return btElasticPlasticFault();
}
}  // namespace

btElasticPlasticFault JointModel::findFault() const
{
	if (m_refused)
		return m_refused;
	if (&bodyA() == &bodyB())
		return btElasticPlasticFault("number of bodies", 1, "2: a body cannot be joined to itself");
	if (bodyA().getInvMass() == 0 && bodyB().getInvMass() == 0)
		return btElasticPlasticFault("number of bodies with mass", 0, "1 or 2: two static bodies cannot be joined");
	for (const bool isA : {true, false})
		if (const btElasticPlasticFault fault = findFrameFault(isA ? m_frameInA : m_frameInB, isA))
			return fault;
	const btRigidBody* const bodies[2] = {&bodyA(), &bodyB()};
	for (int i = 3; i < BT_EP_DOF_COUNT; ++i)
		for (const btRigidBody* body : bodies)
		{
			const btVector3& inverse = body->getInvInertiaDiagLocal();
			const bool hasInertia = inverse.x() > 0 && inverse.y() > 0 && inverse.z() > 0;
			if (!m_capacity.isElasticPlastic(i) || body->getInvMass() == 0 || hasInertia)
				continue;
			return btElasticPlasticFault(
				body == bodies[0] ? "smallest inertia of body A [kg m^2]" : "smallest inertia of body B [kg m^2]", 0,
				"greater than 0 for a body with mass: use btCollisionShape::calculateLocalInertia", i);
		}
	return btElasticPlasticFault();
}

btElasticPlasticFault JointModel::findMissingWorld() const
{
	const btElasticPlasticFault fault = btElasticPlastic::findMissingWorld(bodyA(), true);
	return fault ? fault : btElasticPlastic::findMissingWorld(bodyB(), false);
}

btElasticPlasticFault JointModel::findStepFault() const
{
	const bool isTurned = (m_dofs >> 3) != 0;
	if (const btElasticPlasticFault fault = findBodyFault(bodyA(), true, isTurned))
		return fault;
	return findBodyFault(bodyB(), false, isTurned);
}

namespace
{
/// A state's force over what the joint bears, at most: more is nonsense. Where a mean force at yield follows one at yield to the other
/// side, a spring is strained for a step to five times its yield value, and to some ten times where the material damps. Of a joint that
/// has been heated or weakened, what is beyond its strength flows off in the next step.
const btScalar MOST_OVER_YIELD = 64;

bool isRotation(const btQuaternion& q)
{
	return btElasticPlasticIsFinite(q.length2()) && btFabs(q.length2() - 1) < FRAME_TOLERANCE;
}

const char* const WITHIN_YIELD = "within 64 times the joint's yield value (0 where it is not elastic-plastic)";
const char* const KEPT = "finite and at most 1e37 in float, 1e250 in double";

}  // namespace

btElasticPlasticFault findNumberFault(const btElasticPlasticState& state)
{
	for (const btQuaternion* rotation : {&state.m_plasticRotation, &state.m_plasticMiddle})
		if (!isRotation(*rotation))
			return btElasticPlasticFault("length of one of the state's rotations", rotation->length(), "1");
	const struct
	{
		const char* m_name;
		const btScalar* m_values;
		int m_count;
	} arrays[] = {
		{"the state's force", state.m_force, BT_EP_DOF_COUNT},
		{"the state's rate of force", state.m_forceRate, BT_EP_DOF_COUNT},
		{"the state's applied force", state.m_applied, BT_EP_DOF_COUNT},
		{"the state's applied force of the step before", state.m_appliedBefore, BT_EP_DOF_COUNT},
		{"the state's damping force", state.m_branch[0], int(BT_EP_DOF_COUNT) * int(btElasticPlasticState::BRANCHES)},
		{"the state's load of a body", state.m_load[0], 2 * int(BT_EP_DOF_COUNT)},
		{"the state's given acceleration of a body", state.m_given[0], 2 * int(BT_EP_DOF_COUNT)},
		{"the state's plastic deformation", state.m_plastic, BT_EP_DOF_COUNT},
		{"the state's plastic path", state.m_plasticPath, BT_EP_DOF_COUNT},
		{"the state's withheld deformation", state.m_withheld, BT_EP_DOF_COUNT},
		{"the state's watched deformation", state.m_watched, BT_EP_DOF_COUNT},
		{"the state's initial offset", state.m_initial, 3},
		{"the state's strain of fibres", state.m_fibreStrain, 3}};
	for (const auto& array : arrays)
		for (int i = 0; i < array.m_count; ++i)
			if (!canBeKept(array.m_values[i]))
				return btElasticPlasticFault(array.m_name, array.m_values[i], KEPT, i % BT_EP_DOF_COUNT);
	for (int i = 0; i < state.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibreState& fibre = state.m_fibres[i];
		for (const btScalar value : {fibre.m_force, fibre.m_forceRate, fibre.m_offset, fibre.m_damage, fibre.m_path,
									 fibre.m_rate, fibre.m_rateShare})
			if (!canBeKept(value))
				return btElasticPlasticFault("a number of one of the state's fibres", value, KEPT);
		if (fibre.m_rateShare < 0)
			return btElasticPlasticFault("share by which one of the state's fibres is stronger than at rest",
										 fibre.m_rateShare, "not negative");
		if (fibre.m_damage < 0)
			return btElasticPlasticFault("damage of one of the state's fibres", fibre.m_damage, "not negative");
		if (fibre.m_path < 0)
			return btElasticPlasticFault("plastic path of one of the state's fibres [m]", fibre.m_path, "not negative");
	}
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (state.m_plasticPath[i] < 0)
			return btElasticPlasticFault("the state's plastic path", state.m_plasticPath[i], "not negative", i);
	const struct
	{
		const char* m_name;
		double m_value;
	} energies[] = {{"the state's work [J]", state.m_work},
					{"the state's plastic energy [J]", state.m_plasticEnergy},
					{"the state's damping energy [J]", state.m_dampingEnergy},
					{"the state's stored energy [J]", state.m_storedEnergy},
					{"the state's energy of places [J]", state.m_placeEnergy}};
	for (const auto& energy : energies)
		if (!btElasticPlasticIsFinite(energy.m_value))
			return btElasticPlasticFault(energy.m_name, btScalar(energy.m_value), "finite");
	if (state.m_plasticEnergy < 0)
		return btElasticPlasticFault("the state's plastic energy [J]", btScalar(state.m_plasticEnergy), "not negative");
	if (state.m_dampingEnergy < 0)
		return btElasticPlasticFault("the state's damping energy [J]", btScalar(state.m_dampingEnergy), "not negative");
	const struct
	{
		const char* m_name;
		btScalar m_value;
	} steps[] = {{"the state's last step [s]", state.m_lastStep},
				 {"the state's withheld step [s]", state.m_withheldStep},
				 {"the state's spin of body A [rad/s]", state.m_spin[0]},
				 {"the state's spin of body B [rad/s]", state.m_spin[1]},
				 {"the state's lead of its support [s]", state.m_support.m_lead},
				 {"the state's time behind its support [s]", state.m_support.m_late},
				 {"the state's rate of ringing [W]", btScalar(state.m_innerRhythm.m_ringing)}};
	for (const auto& step : steps)
		if (!canBeKept(step.m_value) || step.m_value < 0)
			return btElasticPlasticFault(step.m_name, step.m_value, "finite and not negative");
	if (state.m_innerRhythm.m_level > 30 ||
		1 << state.m_innerRhythm.m_level > btElasticPlasticSolverSettings::MAX_INNER_STEPS)
		return btElasticPlasticFault("the state's level of inner steps", state.m_innerRhythm.m_level, "0 to 12");
	return btElasticPlasticFault();
}

btElasticPlasticFault JointModel::findStateFault(const btElasticPlasticState& state) const
{
	if (const btElasticPlasticFault fault = findNumberFault(state))
		return fault;
	if (const btElasticPlasticFault fault = findFibreFault(state))
		return fault;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const btScalar most = mostForce(state, i);
		if (btFabs(state.m_force[i]) > most)
			return btElasticPlasticFault("the state's force", state.m_force[i], WITHIN_YIELD, i);
		for (const btScalar* branch : state.m_branch)
			if (btFabs(branch[i]) > most)
				return btElasticPlasticFault("the state's damping force", branch[i], WITHIN_YIELD, i);
	}
	return btElasticPlasticFault();
}

btScalar JointModel::mostForce(const btElasticPlasticState& state, int dof) const
{
	if (!isElasticPlastic(dof))
		return 0;
	const btScalar without =
		MOST_OVER_YIELD * (m_capacity.m_yield[dof] + m_capacity.m_friction * m_capacity.m_yield[BT_EP_AXIAL]);
	// Forces of fibres stay where another scheme has taken over since.
	if (!btElasticPlasticCapacity::isOfFibres(dof) || !m_capacity.hasFibres())
		return without;
	btScalar sum = 0;
	for (int i = 0; i < state.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = m_capacity.m_fibres[i];
		const btScalar arm = dof == BT_EP_AXIAL ? btScalar(1) : dof == BT_EP_BENDING_Y ? fibre.m_z : fibre.m_y;
		sum += btFabs(arm) * mostForce(state.m_fibres[i], fibre);
	}
	return btMax(sum, without);
}

/// Where a section damps, one that cracks at little tension is unloaded by as much as it has been pressed by.
btScalar JointModel::mostForce(const btElasticPlasticFibreState& state, const btElasticPlasticFibre& fibre) const
{
	btScalar hardened = 1;
	for (int i = 0; i < fibre.m_numPoints; ++i)
		btSetMax(hardened, m_capacity.m_curvePoints[fibre.m_firstPoint + i].m_factor);
	return MOST_OVER_YIELD * btMax(fibre.m_tension, fibre.m_compression) * hardened * (1 + state.m_rateShare);
}

btElasticPlasticFault JointModel::findFibreFault(const btElasticPlasticState& state) const
{
	if (state.m_fibres.size() != m_capacity.m_fibres.size())
		return btElasticPlasticFault("number of the state's fibres", btScalar(state.m_fibres.size()),
									 "that of the joint's capacity");
	for (int i = 0; i < state.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibreState& own = state.m_fibres[i];
		const btElasticPlasticFibre& fibre = m_capacity.m_fibres[i];
		if (btFabs(own.m_force) > mostForce(own, fibre))
			return btElasticPlasticFault("force of one of the state's fibres [N]", own.m_force,
										 "within 64 times the fibre's tension or compression");
	}
	return btElasticPlasticFault();
}

void JointModel::setCapacity(const btElasticPlasticCapacity& capacity)
{
	m_capacity = capacity;
	SectionStiffness section;
	m_bearing.resize(m_capacity.m_fibres.size());
	m_areSteady = true;
	m_reach[0] = m_reach[1] = 0;
	for (int i = 0; i < m_capacity.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = m_capacity.m_fibres[i];
		section.add(fibre, double(fibre.m_stiffness));
		m_bearing[i] = {fibre.m_y, fibre.m_z, fibre.m_stiffness, fibre.m_tension, fibre.m_compression};
		m_areSteady &= fibre.isSteady();
		btSetMax(m_reach[0], btFabs(fibre.m_z));
		btSetMax(m_reach[1], btFabs(fibre.m_y));
	}
	m_wholeCompliance = section.invert();
}

void JointModel::takeCapacity(const btElasticPlasticCapacity& capacity)
{
	const btElasticPlasticCapacity former = m_capacity;
	const unsigned before = m_dofs;
	const BowedLengths bowed = bowedLengths();
	const Stretch stretch = findStretch();
	setCapacity(capacity);
	m_dofs = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (m_capacity.isElasticPlastic(i))
			m_dofs |= 1u << i;
		else
			m_state.forget(i);
	// Nobody has followed it meanwhile.
	if (before == 0)
		SupportWay(*this).find();
	const bool areSame = hasFibresAt(former);
	soften(former, stretch.m_energy, areSame);
	takeFibres(stretch, areSame);
	if (m_hasReference)
	{
		followBow(bowed);
		followStiffness(former, stretch);
		unsigned held = m_dofs & ~before;
		// What rigid rows have left open is no stretch of a spring.
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			if (former.isElasticPlastic(i) && former.isRigidPlastic(i) && isElasticPlastic(i) &&
				!m_capacity.isRigidPlastic(i))
				held |= 1u << i;
		if (held)
			takePoseAsReference(held);
	}
	else
		takeRoundingAsReference();
	m_hasReference = true;
}

/// \return false if the bodies are not at places that can be a reference. It then stays as it is; the joint is left out of steps, and
/// its owner is told.
bool JointModel::measureReference(Kinematics& kinematics) const
{
	measure(kinematics);
	// Two bodies of the same skew basis would measure no strain between them.
	return kinematics.isUsable() && !findFrameFault(frameA(), true) && !findFrameFault(frameB(), false);
}

/// Makes the present pose the reference of degrees of freedom that were free until now: they hold where the bodies are.
void JointModel::takePoseAsReference(unsigned dofs)
{
	Kinematics now;
	if (!measureReference(now))
		return;
	btScalar away[BT_EP_DOF_COUNT] = {};
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (dofs >> i & 1u)
			away[i] = now.m_strain[i];
	moveReference(away);
}

void JointModel::moveReference(const btScalar deformation[BT_EP_DOF_COUNT])
{
	// What bows less is longer, and is not to be pressed for it.
	if (deformation[3] != 0 || deformation[4] != 0 || deformation[5] != 0)
		m_state.m_initial[BT_EP_AXIAL] += turnReference(deformation);
	for (int i = 0; i < 3; ++i)
		m_state.m_initial[i] += deformation[i];
}

JointModel::Stretch JointModel::findStretch() const
{
	Stretch stretch;
	stretch.m_energy = springEnergy();
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		stretch.m_deformation[i] = elasticDeformation(i);
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
		stretch.m_elongation.push_back(elasticElongation(m_capacity, i));
	return stretch;
}

void JointModel::scaleForce(int dof, btScalar factor)
{
	btElasticPlasticState& s = m_state;
	for (btScalar* force : {&s.m_force[dof], &s.m_applied[dof], &s.m_appliedBefore[dof], &s.m_branch[0][dof],
							&s.m_branch[1][dof], &s.m_branch[2][dof]})
		*force *= factor;
}

/// Reduces the springs' forces, but for those of fibres, to what there is the energy for.
/// \param most  [J]
/// \return what is left of them
btScalar JointModel::limitEnergy(double most)
{
	const double energy = springEnergy();
	if (!(energy > most))
		return 1;
	const btScalar share = btScalar(sqrt(most / energy));
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (!m_capacity.isRigidPlastic(i))
			scaleForce(i, share);
	return share;
}

/// Of a spring that becomes softer the force falls with its stiffness, as that of steel in a fire does: its deformation stays, and what it bears
/// comes down on it in the steps that follow. With the force that it had it would hold more energy than anybody has given it.
/// \param most  energy of the springs before [J]
void JointModel::soften(const btElasticPlasticCapacity& before, double most, bool areSame)
{
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		if (!m_capacity.isElasticPlastic(i) || m_capacity.isRigidPlastic(i) || !before.isElasticPlastic(i))
			continue;
		const btScalar had = before.m_stiffness[i], has = m_capacity.m_stiffness[i];
		if (before.isRigidPlastic(i) || has < had)
			scaleForce(i, before.isRigidPlastic(i) ? btScalar(0) : has / had);
	}
	const bool areFibres = usesFibres() && areSame;
	for (int i = 0; i < m_state.m_fibres.size() && areFibres; ++i)
		m_state.m_fibres[i].m_force *=
			btMin(m_capacity.m_fibres[i].m_stiffness / before.m_fibres[i].m_stiffness, btScalar(1));
	// Coupling may change by itself, or one of two that are coupled.
	const btScalar share = limitEnergy(most);
	for (int i = 0; i < m_state.m_fibres.size() && areFibres; ++i)
		m_state.m_fibres[i].m_force *= share;
	if (areFibres && m_state.m_fibres.size() > 0)
		sumFibres();
}

/// Whether the fibres are as many, and where those of a capacity before were.
bool JointModel::hasFibresAt(const btElasticPlasticCapacity& before) const
{
	const int n = m_capacity.m_fibres.size();
	bool areSame = m_state.m_fibres.size() == n && before.m_fibres.size() == n;
	for (int i = 0; i < n && areSame; ++i)
		areSame = m_capacity.m_fibres[i].m_y == before.m_fibres[i].m_y &&
				  m_capacity.m_fibres[i].m_z == before.m_fibres[i].m_z;
	return areSame;
}

/// The joint's forces are those of its fibres.
void JointModel::sumFibres()
{
	btScalar* const force = m_state.m_force;
	force[BT_EP_AXIAL] = force[BT_EP_BENDING_Y] = force[BT_EP_BENDING_Z] = 0;
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = m_capacity.m_fibres[i];
		const btScalar own = m_state.m_fibres[i].m_force;
		force[BT_EP_AXIAL] += own;
		force[BT_EP_BENDING_Y] += fibre.m_z * own;
		force[BT_EP_BENDING_Z] -= fibre.m_y * own;
	}
}

/// A member that bows by another length from now on, be it that its bending begins or ends to hold, is not stretched by that: its springs would have
/// the energy from nobody.
void JointModel::followBow(const BowedLengths& before)
{
	const BowedLengths now = bowedLengths();
	Kinematics pose;
	if ((now.m_y == before.m_y && now.m_z == before.m_z) || !measureReference(pose))
		return;
	m_state.m_initial[BT_EP_AXIAL] +=
		Kinematics::strainOfBow(pose.m_strain, now.m_y - before.m_y, now.m_z - before.m_z);
}

/// A degree of freedom that becomes stiffer under load keeps its force, and its elastic deformation becomes less. The change of
/// its elastic energy counts as numerical energy.
void JointModel::followStiffness(const btElasticPlasticCapacity& before, const Stretch& stretch)
{
	btScalar change[BT_EP_DOF_COUNT] = {};
	bool areDeformations = true;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const bool isSpring = m_capacity.isElasticPlastic(i) && !m_capacity.isRigidPlastic(i);
		const bool wasSpring = before.isElasticPlastic(i) && !before.isRigidPlastic(i);
		const bool isRigid = m_capacity.isElasticPlastic(i) && m_capacity.isRigidPlastic(i);
		if (!wasSpring || (!isSpring && !isRigid))
			continue;
		// A force beyond a lower yield value flows off in the next step. Rigid rows would take a spring's stretch back as an error.
		change[i] = stretch.m_deformation[i] - (isSpring ? elasticDeformation(i) : btScalar(0));
		if (change[i] == 0)
			continue;
		m_state.m_forceRate[i] = 0;
		areDeformations &= isDeformation(change[i]);
	}
	if (!areDeformations)
	{
		setReferenceToCurrentPose();
		return;
	}
	if (m_state.m_storedEnergy > 0 && stretch.m_energy > 0)
		m_state.m_storedEnergy = fmin(m_state.m_storedEnergy / stretch.m_energy, 1) * springEnergy();
	m_state.m_placeEnergy = -1;
	moveReference(change);
}

/// Frames that coincide up to the rounding of their coordinates are meant to coincide: in float, half a micrometre in a metre
/// would be a noticeable force in a stiff joint. A larger misfit is intended by the user, and loads the joint.
void JointModel::takeRoundingAsReference()
{
	Kinematics now;
	measure(now);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (btFabs(now.m_strain[i]) > strainRounding(i))
			return;
	setReferenceToCurrentPose();
}

void JointModel::setReferenceToCurrentPose()
{
	Kinematics now;
	if (measureReference(now))
	{
		const RelativeRotation rotation = relativeRotation();
		m_state.m_plasticRotation = rotation.m_relative;
		m_state.m_plasticMiddle = rotation.m_middle;
		// What is straight does not bow.
		measure(now);
		for (int i = 0; i < 3; ++i)
			m_state.m_initial[i] += now.m_strain[i];
	}
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		m_state.forget(i);
	m_state.m_fibres.resize(m_capacity.m_fibres.size());
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
		m_state.m_fibres[i].m_force = m_state.m_fibres[i].m_forceRate = m_state.m_fibres[i].m_offset = 0;
	for (btScalar& strain : m_state.m_fibreStrain)
		strain = 0;
}

// ---- fibres

JointModel::FibreStrength JointModel::strengthOf(int fibre, btScalar morePath) const
{
	const btElasticPlasticFibre& own = m_capacity.m_fibres[fibre];
	const btElasticPlasticFibreState& state = m_state.m_fibres[fibre];
	FibreStrength strength = {own.m_tension, own.m_compression};
	if (own.m_numPoints > 0)
	{
		const btScalar factor = m_capacity.strengthFactor(own, state.m_path + morePath);
		strength.m_tension *= factor;
		strength.m_compression *= factor;
	}
	if (state.m_isCracked)
		strength.m_tension = 0;
	else if (own.m_softens)
		strength.m_tension *= btMax(1 - state.m_damage - morePath / own.m_stretchLimit, btScalar(0));
	return strength;
}

btScalar JointModel::bondedShare() const
{
	btScalar bonded = 0, all = 0;
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibreState& fibre = m_state.m_fibres[i];
		all += m_bearing[i].m_stiffness;
		bonded += fibre.m_isCracked || fibre.isRuptured() ? btScalar(0) : m_bearing[i].m_stiffness;
	}
	return all > 0 ? bonded / all : btScalar(1);
}

SectionCompliance JointModel::partCompliance() const
{
	SectionStiffness section;
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
		if (bears(i))
			section.add(m_capacity.m_fibres[i], double(m_capacity.m_fibres[i].m_stiffness));
	return section.invert();
}

SectionPlane JointModel::branchPlane() const
{
	SectionPlane sum;
	if (!(m_capacity.m_damping > 0))
		return sum;
	const SectionCompliance section = bearingCompliance();
	for (int b = 0; b < btElasticPlasticState::BRANCHES; ++b)
		sum.add(1, section.of(branchForces(b)));
	return sum;
}

/// A fibre's force with what the damping adds: by its share of the section's that may be somewhat more than its strength while others flow.
btScalar JointModel::forceOf(int fibre, const SectionPlane& branches) const
{
	const btElasticPlasticFibre& own = m_capacity.m_fibres[fibre];
	const btScalar force = m_state.m_fibres[fibre].m_force;
	return bears(fibre) ? force + btScalar(branches.at(own) * double(own.m_stiffness)) : force;
}

void JointModel::followFibres()
{
	const int dofs[3] = {BT_EP_AXIAL, BT_EP_BENDING_Y, BT_EP_BENDING_Z};
	for (int k = 0; k < 3 && m_capacity.hasFibres(); ++k)
		m_state.m_fibreStrain[k] = m_state.m_force[dofs[k]] / m_capacity.m_stiffness[dofs[k]];
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = m_capacity.m_fibres[i];
		btElasticPlasticFibreState& state = m_state.m_fibres[i];
		const btScalar force = fibre.m_stiffness * (m_state.m_fibreStrain[0] + fibre.m_z * m_state.m_fibreStrain[1] -
													fibre.m_y * m_state.m_fibreStrain[2]);
		const FibreStrength strength = strengthOf(i);
		state.m_force =
			state.isRuptured() ? btScalar(0) : btMax(-strength.m_compression, btMin(strength.m_tension, force));
		state.m_forceRate = state.m_offset = 0;
	}
}

void JointModel::wearFibres(btScalar damage)
{
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
		m_state.m_fibres[i].m_damage += damage;
}

/// Of a fibre, by its force and those of the shears that turn the section.
btScalar JointModel::elasticElongation(const btElasticPlasticCapacity& capacity, int fibre) const
{
	const btElasticPlasticFibre& own = capacity.m_fibres[fibre];
	btScalar elongation = m_state.m_fibres[fibre].m_force / own.m_stiffness;
	if (m_state.m_solvedExactly)
		elongation += capacity.couplingCompliance(BT_EP_SHEAR_Z) * own.m_z * m_state.m_force[BT_EP_SHEAR_Z] -
					  capacity.couplingCompliance(BT_EP_SHEAR_Y) * own.m_y * m_state.m_force[BT_EP_SHEAR_Y];
	return elongation;
}

btElasticPlasticFibreReading JointModel::readFibre(int fibre) const
{
	btElasticPlasticFibreReading reading;
	if (fibre < 0 || fibre >= m_state.m_fibres.size() || fibre >= m_capacity.m_fibres.size())
		return reading;
	const btElasticPlasticFibre& own = m_capacity.m_fibres[fibre];
	const btElasticPlasticFibreState& state = m_state.m_fibres[fibre];
	const FibreStrength strength = strengthOf(fibre);
	const btScalar force = forceOf(fibre, branchPlane()),
				   most = (force > 0 ? strength.m_tension : strength.m_compression) * (1 + state.m_rateShare);
	const btScalar* const plastic = m_state.m_plastic;
	reading.m_force = force;
	reading.m_elongation = plastic[BT_EP_AXIAL] + m_state.m_fibreStrain[0] +
						   own.m_z * (plastic[BT_EP_BENDING_Y] + m_state.m_fibreStrain[1]) -
						   own.m_y * (plastic[BT_EP_BENDING_Z] + m_state.m_fibreStrain[2]);
	reading.m_plastic = reading.m_elongation - elasticElongation(m_capacity, fibre);
	reading.m_utilisation = force != 0 && most > 0 ? btMin(btFabs(force) / most, btScalar(1)) : btScalar(0);
	reading.m_damage = btMin(state.m_damage, btScalar(1));
	reading.m_isCracked = state.m_isCracked;
	return reading;
}

/// Fibres that stay are stretched as they were, new ones take their forces from the joint, as far as there is the energy for it.
void JointModel::takeFibres(const Stretch& stretch, bool areSame)
{
	const int n = m_capacity.m_fibres.size();
	if (!areSame)
	{
		m_state.m_fibres.resize(0);
		m_state.m_fibres.resize(n);
		followFibres();
		if (limitEnergy(stretch.m_energy) < 1)
			followFibres();
		return;
	}
	for (int i = 0; i < n; ++i)
		m_state.m_fibres[i].m_offset += stretch.m_elongation[i] - elasticElongation(m_capacity, i);
}

/// The share of the section's strength that is spent.
btScalar JointModel::fibreDamage() const
{
	btScalar spent = 0, all = 0;
	bool isAnyLeft = false;
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = m_capacity.m_fibres[i];
		const btScalar strength = btMax(fibre.m_tension, fibre.m_compression);
		spent += strength * btMin(m_state.m_fibres[i].m_damage, btScalar(1));
		all += strength;
		isAnyLeft |= !m_state.m_fibres[i].isRuptured();
	}
	if (m_state.m_fibres.size() == 0)
		return 0;
	return isAnyLeft ? btMin(spent / all, 1 - SIMD_EPSILON) : btScalar(1);
}

btScalar JointModel::fibreUtilisation() const
{
	btScalar sum = 0, strength = 0;
	const SectionPlane branches = usesFibres() ? branchPlane() : SectionPlane();
	for (int i = 0; i < m_state.m_fibres.size() && usesFibres(); ++i)
	{
		const btElasticPlasticFibreState& state = m_state.m_fibres[i];
		if (state.isRuptured())
			continue;
		const FibreStrength own = strengthOf(i);
		const btScalar force = forceOf(i, branches);
		sum += btFabs(force);
		strength += (force > 0 ? own.m_tension : own.m_compression) * (1 + state.m_rateShare);
	}
	return strength > 0 ? btMin(sum / strength, btScalar(1)) : btScalar(0);
}

double JointModel::elasticEnergy() const
{
	const double springs = springEnergy();
	if (m_state.m_solvedExactly)
		return springs - fmin(springs, fmax(springsAhead(), -m_state.m_storedEnergy - dissipatedEnergy()));
	return m_state.m_lastStep == 0 ? springs : fmax(fmin(springs, m_state.m_storedEnergy), 0);
}

double JointModel::paidShare() const
{
	const double dissipated = dissipatedEnergy();
	if (m_state.m_storedEnergy >= 0 || dissipated <= 0)
		return 1;
	// What springs are ahead is held back of their own energy.
	const double owed = -m_state.m_storedEnergy - (m_state.m_solvedExactly && !m_state.m_broken ? springsAhead() : 0);
	return fmin(fmax(1 - owed / dissipated, 0), 1);
}

/// Places are half a step ahead of the bodies' velocities, and of what these have given: springs that are being loaded hold more, by what
/// they took in the last half of the step.
double JointModel::springsAhead() const
{
	if (m_isPaper)
		return 0;
	const bool areFibres = usesFibres() && m_state.m_fibres.size() > 0;
	double rate = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (!(areFibres && isOfFibres(i)))
			rate += double(elasticDeformation(i)) * double(m_state.m_forceRate[i]);
	for (int i = 0; i < m_state.m_fibres.size() && areFibres; ++i)
		rate += double(m_state.m_fibres[i].m_force) * double(m_state.m_fibres[i].m_forceRate) /
				double(m_capacity.m_fibres[i].m_stiffness);
	for (int i = BT_EP_SHEAR_Y; i <= BT_EP_SHEAR_Z && areFibres && m_state.m_solvedExactly; ++i)
		rate += double(m_state.m_force[i]) * double(m_capacity.couplingCompliance(i)) *
				double(m_state.m_forceRate[btElasticPlasticCapacity::coupledWith(i)]);
	const double springs = springEnergy();
	return fmax(
		fmin(fmin(0.5 * double(m_state.m_lastStep) * rate, springs + dissipatedEnergy() - m_state.m_work), springs), 0);
}

/// Before the first step nothing is behind a joint, and its force begins as that of a leapfrog does: all that it takes until it unloads, its flow
/// too, is half a step ahead. A step that is longer than the next leaves it ahead by more, which stays while the joint takes as much in a step
/// of the world. Under a load that stays, or where a contact has set the bodies moving, it may never be given: that is halved from step to step.
/// On what nothing acts from outside, there is nobody else who could have given it: all that a step adds is owed until bodies have.
void JointModel::findOwed(double share, bool isNew, double taken, const double* aheadBefore)
{
	if (m_isPaper || (!aheadBefore && !isNew && m_state.m_storedEnergy >= 0))
		return;
	const double ahead = fmax(aheadOfWork(), 0), owed = -m_state.m_storedEnergy;
	if (aheadBefore)
	{
		const double told = isNew ? 0 : fmax(*aheadBefore - fmax(owed, 0), 0);
		if (owed > 0 || ahead > told)
			m_state.m_storedEnergy = -fmax(ahead - told, 0);
		return;
	}
	const double lasting = fmax(pow(0.5, share) * owed, fmin(owed, taken / share));
	m_state.m_storedEnergy = -(isNew ? ahead : fmin(ahead, fmax(lasting, 0.5 * taken)));
}

double JointModel::springEnergy() const
{
	const MaterialDamping damping(m_capacity.m_damping, 1);
	double energy = 0;
	const bool areFibres = usesFibres() && m_state.m_fibres.size() > 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		if (!(areFibres && isOfFibres(i)))
			energy += 0.5 * double(m_state.m_force[i]) * double(elasticDeformation(i));
		for (int b = 0; b < MaterialDamping::BRANCHES && !damping.isNone() && !(areFibres && isOfFibres(i)); ++b)
			energy += 0.5 * double(m_state.m_branch[b][i]) *
					  double(elasticDeformation(m_capacity, m_state.m_branch[b], i)) / double(damping.getGain(b));
	}
	if (!areFibres)
		return energy;
	for (int i = 0; i < m_state.m_fibres.size(); ++i)
		energy += 0.5 * double(m_state.m_fibres[i].m_force) * double(m_state.m_fibres[i].m_force) /
				  double(m_capacity.m_fibres[i].m_stiffness);
	// The shears' deformation has a half of what they and the bendings have between them.
	const auto between = [&](const btScalar force[BT_EP_DOF_COUNT])
	{
		double sum = 0;
		for (int i = BT_EP_SHEAR_Y; i <= BT_EP_SHEAR_Z && m_state.m_solvedExactly; ++i)
			sum += 0.5 * double(force[i]) * double(m_capacity.couplingCompliance(i)) *
				   double(force[btElasticPlasticCapacity::coupledWith(i)]);
		return sum;
	};
	energy += between(m_state.m_force);
	if (damping.isNone())
		return energy;
	const SectionCompliance section = bearingCompliance();
	for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
	{
		const SectionForces forces = branchForces(b);
		energy += (forces.along(section.of(forces)) / 2 + between(m_state.m_branch[b])) / double(damping.getGain(b));
	}
	return energy;
}

void JointModel::followFreeTurn(const Kinematics& before)
{
	btScalar turn[BT_EP_DOF_COUNT] = {}, most = 0;
	Kinematics now;
	for (int i = 3; i < BT_EP_DOF_COUNT; ++i)
		if (!isElasticPlastic(i))
			btSetMax(most, btFabs(before.m_strain[i]));
	if (!(most > FREE_TURN) || !measureReference(now))
		return;
	for (int i = 3; i < BT_EP_DOF_COUNT; ++i)
		if (!isElasticPlastic(i))
			turn[i] = now.m_strain[i];
	turnReference(turn);
}

btScalar JointModel::turnReference(const btScalar increment[BT_EP_DOF_COUNT])
{
	Kinematics now;
	if (!measureReference(now))
		return 0;
	const RelativeRotation rotation = relativeRotation();
	btScalar turned[BT_EP_DOF_COUNT];
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		turned[i] = now.m_strain[i] - increment[i];
	const btVector3 elastic(turned[3], turned[4], turned[5]);
	m_state.m_plasticRotation =
		(exponential(-quatRotate(rotation.m_middle, elastic)) * rotation.m_relative).normalized();
	m_state.m_plasticMiddle = (rotation.m_middle * exponential(elastic * btScalar(-0.5))).normalized();
	if (!(m_capacity.m_length > 0))
		return 0;
	const BowedLengths lengths = bowedLengths();
	return Kinematics::strainOfBow(turned, lengths.m_y, lengths.m_z) -
		   Kinematics::strainOfBow(now.m_strain, lengths.m_y, lengths.m_z);
}
}  // namespace btElasticPlastic
