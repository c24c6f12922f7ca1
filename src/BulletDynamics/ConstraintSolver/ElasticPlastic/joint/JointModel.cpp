// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JointModel.h"

#include "BodyGate.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
btTransform JointModel::frameA() const { return bodyA().getCenterOfMassTransform() * m_frameInA; }
btTransform JointModel::frameB() const { return bodyB().getCenterOfMassTransform() * m_frameInB; }

/// Whether the joint's x axis points from body A to body B. What does not move may have its centre anywhere.
bool JointModel::pointsTowardsB(const Kinematics& k) const
{
	const btScalar a = bodyA().getInvMass() > 0 ? k.m_rA.dot(k.m_axis[0]) : btScalar(0),
				   b = bodyB().getInvMass() > 0 ? k.m_rB.dot(k.m_axis[0]) : btScalar(0);
	return a >= b;
}

void JointModel::measure(Kinematics& kinematics) const
{
	kinematics.evaluate(bodyA().getCenterOfMassTransform(), bodyB().getCenterOfMassTransform(), m_frameInA, m_frameInB,
						m_state.offset(), m_state.m_plasticRotation, m_state.m_plasticMiddle);
	if (m_capacity.m_length > 0)
	{
		const btScalar length = pointsTowardsB(kinematics) ? m_capacity.m_length : -m_capacity.m_length;
		kinematics.bow(isElasticPlastic(BT_EP_BENDING_Y) ? length : btScalar(0),
					   isElasticPlastic(BT_EP_BENDING_Z) ? length : btScalar(0));
	}
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

bool isFrame(const btTransform& frame)
{
	const btMatrix3x3 product = frame.getBasis().transposeTimes(frame.getBasis());
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
			if (!btElasticPlasticIsFinite(product[i][j]) ||
				!(btFabs(product[i][j] - btScalar(i == j ? 1 : 0)) < FRAME_TOLERANCE))
				return false;
	const btVector3& origin = frame.getOrigin();
	return frame.getBasis().determinant() > 0 && btElasticPlasticIsFinite(origin.x() + origin.y() + origin.z());
}
}  // namespace

btElasticPlasticFault JointModel::findFault() const
{
	if (const btElasticPlasticFault fault = m_capacity.fault())
		return fault;
	if (&bodyA() == &bodyB())
		return btElasticPlasticFault("number of bodies", 1, "2: a body cannot be joined to itself");
	if (bodyA().getInvMass() == 0 && bodyB().getInvMass() == 0)
		return btElasticPlasticFault("number of bodies with mass", 0, "1 or 2: two static bodies cannot be joined");
	if (!isFrame(m_frameInA) || !isFrame(m_frameInB))
		return btElasticPlasticFault(
			isFrame(m_frameInA) ? "frame in body B: determinant" : "frame in body A: determinant",
			(isFrame(m_frameInA) ? m_frameInB : m_frameInA).getBasis().determinant(),
			"1, of three axes of unit length at right angles, with a finite origin");
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
bool isRotation(const btQuaternion& q)
{
	return btElasticPlasticIsFinite(q.length2()) && btFabs(q.length2() - 1) < FRAME_TOLERANCE;
}

btElasticPlasticFault findNotFinite(const btElasticPlasticState& state)
{
	const struct
	{
		const char* m_name;
		const btScalar* m_values;
		int m_count;
	} arrays[] = {{"the state's force", state.m_force, BT_EP_DOF_COUNT},
				  {"the state's rate of force", state.m_forceRate, BT_EP_DOF_COUNT},
				  {"the state's applied force", state.m_applied, BT_EP_DOF_COUNT},
				  {"the state's plastic deformation", state.m_plastic, BT_EP_DOF_COUNT},
				  {"the state's plastic path", state.m_plasticPath, BT_EP_DOF_COUNT},
				  {"the state's withheld deformation", state.m_withheld, BT_EP_DOF_COUNT},
				  {"the state's watched deformation", state.m_watched, BT_EP_DOF_COUNT},
				  {"the state's initial offset", state.m_initial, 3}};
	for (const auto& array : arrays)
		for (int i = 0; i < array.m_count; ++i)
			if (!btElasticPlasticIsFinite(double(array.m_values[i])))
				return btElasticPlasticFault(array.m_name, array.m_values[i], "finite", i);
	if (!btElasticPlasticIsFinite(state.m_work))
		return btElasticPlasticFault("the state's work [J]", btScalar(state.m_work), "finite");
	return btElasticPlasticFault();
}
}  // namespace

btElasticPlasticFault JointModel::findStateFault(const btElasticPlasticState& state) const
{
	const btQuaternion* const rotations[2] = {&state.m_plasticRotation, &state.m_plasticMiddle};
	for (const btQuaternion* rotation : rotations)
		if (!isRotation(*rotation))
			return btElasticPlasticFault("length of one of the state's rotations", rotation->length(), "1");
	if (const btElasticPlasticFault fault = findNotFinite(state))
		return fault;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		// A force on the yield value may be rounded to either side of it.
		const btScalar most = isElasticPlastic(i) ? m_capacity.m_yield[i] * (1 + 8 * SIMD_EPSILON) : btScalar(0);
		if (btFabs(state.m_force[i]) > most)
			return btElasticPlasticFault("the state's force", state.m_force[i],
										 "within the joint's yield value (0 where it is not elastic-plastic)", i);
		if (state.m_plasticPath[i] < 0)
			return btElasticPlasticFault("the state's plastic path", state.m_plasticPath[i], "not negative", i);
	}
	if (!btElasticPlasticIsFinite(state.m_plasticEnergy) || state.m_plasticEnergy < 0)
		return btElasticPlasticFault("the state's plastic energy [J]", btScalar(state.m_plasticEnergy),
									 "finite and not negative");
	const btElasticPlasticFault fault = btElasticPlasticCheckNotNegative("the state's last step [s]", state.m_lastStep);
	return fault ? fault : btElasticPlasticCheckNotNegative("the state's withheld step [s]", state.m_withheldStep);
}

void JointModel::takeCapacity(const btElasticPlasticCapacity& former)
{
	const unsigned before = m_dofs;
	m_dofs = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (m_capacity.isElasticPlastic(i))
			m_dofs |= 1u << i;
		else
			m_state.m_force[i] = m_state.m_applied[i] = m_state.m_forceRate[i] = m_state.m_withheld[i] = 0;
	if (!m_hasReference)
		takeRoundingAsReference();
	else
	{
		keepForce(former);
		if (m_dofs & ~before)
			takePoseAsReference(m_dofs & ~before);
	}
	m_hasReference = true;
}

/// Makes the present pose the reference of degrees of freedom that were free until now: they hold where the bodies are.
void JointModel::takePoseAsReference(unsigned dofs)
{
	Kinematics now;
	measure(now);
	btScalar away[BT_EP_DOF_COUNT] = {};
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (dofs >> i & 1u)
			away[i] = now.m_strain[i];
	moveReference(away);
}

void JointModel::moveReference(const btScalar deformation[BT_EP_DOF_COUNT])
{
	for (int i = 0; i < 3; ++i)
		m_state.m_initial[i] += deformation[i];
	if (deformation[3] != 0 || deformation[4] != 0 || deformation[5] != 0)
		turnReference(deformation);
}

/// A degree of freedom whose stiffness changes under load keeps its force, and its elastic deformation follows. The change of
/// its elastic energy counts as numerical energy.
void JointModel::keepForce(const btElasticPlasticCapacity& before)
{
	btScalar change[BT_EP_DOF_COUNT] = {};
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const bool isSpring = m_capacity.isElasticPlastic(i) && !m_capacity.isRigidPlastic(i);
		const bool wasSpring = before.isElasticPlastic(i) && !before.isRigidPlastic(i);
		const bool isTheSame = m_capacity.m_stiffness[i] == before.m_stiffness[i] &&
							   m_capacity.couplingCompliance(i) == before.couplingCompliance(i);
		if (!isSpring || !wasSpring || isTheSame)
			continue;
		// A force beyond a lower yield value flows off in the next step.
		change[i] = elasticDeformation(before, i) - elasticDeformation(i);
		m_state.m_forceRate[i] = 0;
	}
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
	measure(now);
	const RelativeRotation rotation = relativeRotation();
	for (int i = 0; i < 3; ++i)
		m_state.m_initial[i] += now.m_strain[i];
	m_state.m_plasticRotation = rotation.m_relative;
	m_state.m_plasticMiddle = rotation.m_middle;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		m_state.m_force[i] = m_state.m_applied[i] = m_state.m_forceRate[i] = m_state.m_withheld[i] = 0;
}

void JointModel::turnReference(const btScalar increment[BT_EP_DOF_COUNT])
{
	Kinematics now;
	measure(now);
	const RelativeRotation rotation = relativeRotation();
	const btVector3 elastic(now.m_strain[3] - increment[3], now.m_strain[4] - increment[4],
							now.m_strain[5] - increment[5]);
	m_state.m_plasticRotation =
		(exponential(-quatRotate(rotation.m_middle, elastic)) * rotation.m_relative).normalized();
	m_state.m_plasticMiddle = (rotation.m_middle * exponential(elastic * btScalar(-0.5))).normalized();
}
}  // namespace btElasticPlastic
