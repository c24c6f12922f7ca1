// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticJoint.h"

#include <stdio.h>

#include "ElasticPlastic/joint/JointRegistry.h"
#include "ElasticPlastic/joint/JointWorks.h"

using btElasticPlastic::JointStep;
using btElasticPlastic::JointWorks;

btElasticPlasticJoint::btElasticPlasticJoint(btTypedConstraint& constraint, const btTransform& frameInA,
											 const btTransform& frameInB)
	: m_works(new JointWorks(*this, constraint, frameInA, frameInB))
{
}

btElasticPlasticJoint::~btElasticPlasticJoint()
{
	if (m_works->m_entry.m_registry)
		m_works->m_entry.m_registry->remove(*m_works);
	delete m_works;
}

btElasticPlasticJoint* btElasticPlasticJoint::from(btTypedConstraint* constraint, btElasticPlasticOwnPrecision)
{
	const JointWorks* const works = constraint ? JointWorks::from(constraint) : nullptr;
	return works ? &works->m_joint : nullptr;
}

// ---- settings

bool btElasticPlasticJoint::setCapacity(const btElasticPlasticCapacity& capacity)
{
	btElasticPlastic::JointModel& model = m_works->m_model;
	const bool isOther = model.m_fault || !capacity.isSameAs(model.m_capacity);
	model.m_refused = capacity.fault();
	if (!model.m_refused)
	{
		model.takeCapacity(capacity);
		m_works->m_step.followCapacity();
	}
	m_works->rouse();
	m_works->setFault(model.findFault());
	if (model.m_fault)
	{
		// Without an action it is told when one is to take the joint, or when the joint is stepped.
		if (m_works->m_entry.m_registry)
			m_works->tellFaultOnce();
		return false;
	}
	m_works->releaseBase();
	if (isOther)
		m_works->wakeBodies();
	return true;
}

const btElasticPlasticCapacity& btElasticPlasticJoint::getCapacity() const { return m_works->m_model.m_capacity; }

void btElasticPlasticJoint::setScheme(btElasticPlasticScheme scheme)
{
	m_works->m_model.m_isPaper = scheme == BT_EP_SCHEME_PAPER;
	m_works->m_model.m_isByMode = scheme == BT_EP_SCHEME_BY_MODE;
}

btElasticPlasticScheme btElasticPlasticJoint::getScheme() const
{
	const auto& model = m_works->m_model;
	return model.m_isPaper ? BT_EP_SCHEME_PAPER : model.m_isByMode ? BT_EP_SCHEME_BY_MODE : BT_EP_SCHEME_IMPLICIT;
}

void btElasticPlasticJoint::setName(const char* name) { snprintf(m_name, sizeof m_name, "%s", name ? name : ""); }

void btElasticPlasticJoint::setReferenceToCurrentPose()
{
	m_works->m_model.setReferenceToCurrentPose();
	m_works->m_step.revert();
	m_works->wakeBodies();
}

bool btElasticPlasticJoint::setLevel(btElasticPlasticQuantity quantity, btScalar level)
{
	return m_works->m_levels.set(quantity, level);
}

btScalar btElasticPlasticJoint::getLevel(btElasticPlasticQuantity quantity) const
{
	return m_works->m_levels.get(quantity);
}

bool btElasticPlasticJoint::setState(const btElasticPlasticState& state) { return m_works->setState(state); }

// ---- readings

const btElasticPlasticState& btElasticPlasticJoint::getState() const { return m_works->m_model.m_state; }
const btElasticPlasticFault& btElasticPlasticJoint::fault() const { return m_works->getFault(); }
bool btElasticPlasticJoint::hasYielded() const { return getState().m_yielded; }
bool btElasticPlasticJoint::isBroken() const { return getState().m_broken; }
btTypedConstraint& btElasticPlasticJoint::getConstraint() { return m_works->m_model.m_constraint; }
const btTypedConstraint& btElasticPlasticJoint::getConstraint() const { return m_works->m_model.m_constraint; }
btTransform btElasticPlasticJoint::getFrameA() const { return m_works->m_model.frameA(); }
btTransform btElasticPlasticJoint::getFrameB() const { return m_works->m_model.frameB(); }
btVector3 btElasticPlasticJoint::getPosition() const { return (getFrameA().getOrigin() + getFrameB().getOrigin()) / 2; }

const btVector3& btElasticPlasticJoint::getJointAxis(int dof) const
{
	return m_works->m_step.getKinematics().m_axis[btElasticPlasticIsDof(dof) ? dof % 3 : 0];
}

namespace
{
/// Of what is no degree of freedom there is nothing.
btScalar read(const btScalar values[BT_EP_DOF_COUNT], int dof)
{
	return btElasticPlasticIsDof(dof) ? values[dof] : btScalar(0);
}
}  // namespace

btScalar btElasticPlasticJoint::getForce(int dof) const
{
	btScalar force = read(getState().m_force, dof);
	for (const btScalar* branch : getState().m_branch)
		force += read(branch, dof);
	const btElasticPlasticCapacity& capacity = getCapacity();
	const bool isShear = dof == BT_EP_SHEAR_Y || dof == BT_EP_SHEAR_Z;
	// Fibres that harden have no yield value, and shears bear more under pressure with friction.
	if (!capacity.isElasticPlastic(dof) || (isShear && capacity.m_friction > 0) ||
		(capacity.hasFibres() && btElasticPlasticCapacity::isOfFibres(dof)))
		return force;
	// The sum of spring and damping may be rounded beyond the yield value, and by mode a spring may be strained beyond it for a step. Beside others in some
	// sections with fibres a shear bears more: what has been applied tells it.
	const btScalar applied = isShear && capacity.hasFibres() ? btFabs(read(getState().m_applied, dof)) : btScalar(0),
				   most = btMax(capacity.m_yield[dof], applied);
	return btMax(-most, btMin(most, force));
}
btScalar btElasticPlasticJoint::getAppliedForce(int dof) const { return read(getState().m_applied, dof); }
btScalar btElasticPlasticJoint::getPlasticDeformation(int dof) const { return read(getState().m_plastic, dof); }
btScalar btElasticPlasticJoint::getPlasticPath(int dof) const { return read(getState().m_plasticPath, dof); }

btScalar btElasticPlasticJoint::getElasticDeformation(int dof) const
{
	return btElasticPlasticIsDof(dof) ? m_works->m_model.elasticDeformation(dof) : btScalar(0);
}

btScalar btElasticPlasticJoint::getDamage(int dof) const
{
	return btElasticPlasticIsDof(dof) ? m_works->m_model.damage(dof) : btScalar(0);
}

btScalar btElasticPlasticJoint::getDamage() const { return m_works->m_model.damage(); }

btElasticPlasticFibreReading btElasticPlasticJoint::getFibre(int index) const
{
	return m_works->m_model.readFibre(index);
}

int btElasticPlasticJoint::getRulingFibre() const
{
	int ruling = -1;
	btElasticPlasticFibreReading most;
	for (int i = 0; i < getState().m_fibres.size(); ++i)
	{
		const btElasticPlasticFibreReading own = getFibre(i);
		const bool isMore =
			own.m_damage != most.m_damage ? own.m_damage > most.m_damage : own.m_utilisation > most.m_utilisation;
		if (getState().m_fibres[i].isRuptured() || !isMore)
			continue;
		ruling = i;
		most = own;
	}
	return ruling;
}

btScalar btElasticPlasticJoint::getQuantity(btElasticPlasticQuantity quantity) const
{
	const btScalar* const applied = getState().m_applied;
	switch (quantity)
	{
		case BT_EP_QUANTITY_FORCE:
			return btVector3(applied[0], applied[1], applied[2]).length();
		case BT_EP_QUANTITY_MOMENT:
			return btVector3(applied[3], applied[4], applied[5]).length();
		case BT_EP_QUANTITY_UTILISATION:
			return getUtilisation();
		case BT_EP_QUANTITY_DAMAGE:
			return getDamage();
		case BT_EP_QUANTITY_COUNT:
			break;
	}
	return 0;
}

btScalar btElasticPlasticJoint::getUtilisation(int dof) const
{
	if (!getCapacity().isElasticPlastic(dof))
		return 0;
	const btScalar most = m_works->m_model.yieldUnder(-getAppliedForce(BT_EP_AXIAL), dof),
				   force = btFabs(getAppliedForce(dof));
	return most > 0 ? force / most : force > 0 ? btScalar(1) : btScalar(0);
}

btScalar btElasticPlasticJoint::getUtilisation(int* limitingDof) const
{
	btScalar largest = 0;
	int limiting = -1;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (getUtilisation(i) > largest)
		{
			largest = getUtilisation(i);
			limiting = i;
		}
	const btScalar whole = m_works->m_model.fibreUtilisation();
	if (whole > largest)
	{
		largest = whole;
		limiting = BT_EP_AXIAL;
		for (int i = BT_EP_BENDING_Y; i <= BT_EP_BENDING_Z; ++i)
			if (getUtilisation(i) > getUtilisation(limiting))
				limiting = i;
	}
	if (limitingDof)
		*limitingDof = limiting;
	return largest;
}

double btElasticPlasticJoint::getElasticEnergy() const { return m_works->m_model.elasticEnergy(); }

double btElasticPlasticJoint::getPlasticEnergy() const
{
	return getState().m_plasticEnergy * m_works->m_model.paidShare();
}

double btElasticPlasticJoint::getDampingEnergy() const
{
	return getState().m_dampingEnergy * m_works->m_model.paidShare();
}

double btElasticPlasticJoint::getWork() const { return getState().m_work; }

double btElasticPlasticJoint::getNumericalEnergy() const
{
	return getWork() - getPlasticEnergy() - getDampingEnergy() - getElasticEnergy();
}

int btElasticPlasticJoint::getNumCommittedRows() const { return m_works->m_step.getNumCommittedRows(); }

void btElasticPlasticJoint::getCommittedRow(int r, int& dof, btScalar& rateBefore, btScalar& rateAfter) const
{
	const JointStep& step = m_works->m_step;
	const bool isThere = r >= 0 && r < step.getNumCommittedRows();
	dof = isThere ? step.getDof(r) : 0;
	rateBefore = isThere ? step.getRateBefore(r) : btScalar(0);
	rateAfter = isThere ? step.getRateAfter(r) : btScalar(0);
}

void btElasticPlasticJoint::printFault(char* text, int capacity) const { m_works->printFault(fault(), text, capacity); }

// ---- for Bullet's class

void btElasticPlasticJoint::buildElasticPlastic() { m_works->buildJacobian(); }
int btElasticPlasticJoint::countElasticPlasticRows() { return m_works->prepare(); }
bool btElasticPlasticJoint::hasBaseRows() { return m_works->hasBaseRows(); }

void btElasticPlasticJoint::writeElasticPlasticRows(btTypedConstraint::btConstraintInfo2* info, int firstRow)
{
	m_works->writeRows(info, firstRow);
}

void btElasticPlasticJoint::answer(btSolverBody& asked) { m_works->answer(asked); }
