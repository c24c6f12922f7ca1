#include "CharpyJoints.h"

namespace ep
{
namespace
{
/// Bullet's unit of length in place of the metre. A force is kg times length, a moment kg times length squared.
btElasticPlasticCapacity inUnits(btElasticPlasticCapacity c, double lengthsPerMetre)
{
	const btScalar s = btScalar(lengthsPerMetre);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const bool linear = i < 3;
		c.m_stiffness[i] *= linear ? 1 : s * s;
		c.m_yield[i] *= linear ? s : s * s;
	}
	return c;
}

/// The material's, but tearing only by bending to the maximum rotation.
btElasticPlasticCapacity capacityOf(const CharpySettings& s, const CharpyJointPlace& place)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(s.yieldStress));
	steel.m_youngsModulus = btScalar(s.youngsModulus);
	const btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(s.width), btScalar(place.height));
	btElasticPlasticCapacity c =
		btElasticPlasticCapacity::fromMember(steel, section, btScalar(place.pieceLength), btScalar(place.pieceLength));
	for (btScalar& ductility : c.m_ductility)
		ductility = btElasticPlasticCapacity::unlimited();
	c.m_ductility[BT_EP_BENDING_Z] = btScalar(s.maxRotation);
	return inUnits(c, s.lengthsPerMetre);
}

class ElasticPlastic : public CharpyJoint
{
public:
	ElasticPlastic(World& world, const CharpySettings& s, const CharpyJointPlace& place)
	{
		const bool first = s.way == CharpyWay::Ep1 || s.way == CharpyWay::Ep1Paper;
		m_joint = world.joint(*place.a, *place.b, place.frame, capacityOf(s, place),
							  first ? JointClass::Spring : JointClass::Spring2);
		if (s.way == CharpyWay::Ep1Paper || s.way == CharpyWay::Ep2Paper)
			m_joint->setScheme(BT_EP_SCHEME_PAPER);
	}
	bool isBroken() const override { return m_joint->isBroken(); }
	double plasticWork() const override { return m_joint->getPlasticEnergy(); }
	double elasticEnergy() const override { return m_joint->getElasticEnergy(); }
	double numericalEnergy() const override { return m_joint->getNumericalEnergy(); }

private:
	btElasticPlasticJoint* m_joint;
};

/// What one of Bullet's constraints does.
class Stock : public CharpyJoint
{
public:
	Stock(World& world, CharpyEnergy& energy, btTypedConstraint* constraint)
		: m_constraint(*constraint), m_energy(energy), m_number(energy.watch(*constraint))
	{
		world.add(constraint);
	}
	bool isBroken() const override { return !m_constraint.isEnabled(); }
	double plasticWork() const override { return 0; }
	double elasticEnergy() const override { return 0; }
	double numericalEnergy() const override { return taken() - plasticWork() - elasticEnergy(); }

protected:
	/// From the bodies, in all.
	double taken() const { return -m_energy.work(m_number); }

private:
	btTypedConstraint& m_constraint;
	CharpyEnergy& m_energy;
	int m_number;
};

btTransform in(const btRigidBody& body, const btTransform& frame) { return body.getWorldTransform().inverse() * frame; }

/// Locked, and disabled once a row's force is more than a threshold. Bullet has one threshold for forces and moments: the
/// shear force beside the notch when the specimen, on its anvils, is bent by the plastic moment, M / (gap / 2).
class Breaking : public Stock
{
public:
	Breaking(World& world, CharpyEnergy& energy, const CharpySettings& s, const CharpyJointPlace& p)
		: Breaking(world, energy, new btGeneric6DofConstraint(*p.a, *p.b, in(*p.a, p.frame), in(*p.b, p.frame), true),
				   btScalar(2 * s.plasticMoment() / s.gap * s.lengthsPerMetre))
	{
	}
	void beforeStep(btScalar dt) override { m_lock->setBreakingImpulseThreshold(m_force * dt); }

private:
	Breaking(World& world, CharpyEnergy& energy, btGeneric6DofConstraint* lock, btScalar force)
		: Stock(world, energy, lock), m_lock(lock), m_force(force)
	{
		for (int i = 0; i < 6; ++i)
			lock->setLimit(i, 0, 0);
	}

	btGeneric6DofConstraint* m_lock;
	btScalar m_force;
};

/// Locked but for bending, where it springs.
template <class Constraint>
class Spring : public Stock
{
public:
	Spring(World& world, CharpyEnergy& energy, const CharpySettings& s, const CharpyJointPlace& p,
		   Constraint* constraint)
		: Stock(world, energy, constraint),
		  m_pieces{p.a, p.b},
		  m_stiffness(capacityOf(s, p).m_stiffness[BT_EP_BENDING_Z])
	{
		for (int i = 0; i < 6; ++i)
			constraint->setLimit(i, 0, 0);
		constraint->setLimit(BT_EP_BENDING_Z, 1, -1);
		constraint->enableSpring(BT_EP_BENDING_Z, true);
		constraint->setStiffness(BT_EP_BENDING_Z, m_stiffness);
		constraint->setEquilibriumPoint(BT_EP_BENDING_Z);
	}
	double elasticEnergy() const override
	{
		const btVector3 a = m_pieces[0]->getWorldTransform().getBasis().getColumn(2),
						b = m_pieces[1]->getWorldTransform().getBasis().getColumn(2);
		const double angle = std::atan2(double(a.cross(b).length()), double(a.dot(b)));
		return double(m_stiffness) * angle * angle / 2;
	}

	/// It is explicit: with longer steps it explodes, or Bullet weakens it (the paper's equation 16).
	double longestStep() const override
	{
		const double inverse = double(m_pieces[0]->getInvInertiaDiagLocal().y());
		return 0.25 / std::sqrt(double(m_stiffness) * inverse);
	}

private:
	btRigidBody* m_pieces[2];
	btScalar m_stiffness;
};

/// A hinge whose motor brakes with the plastic moment; it lets go at the maximum rotation if it has one.
class Motor : public Stock
{
public:
	Motor(World& world, CharpyEnergy& energy, const CharpySettings& s, const CharpyJointPlace& p, bool breaks)
		: Motor(world, energy, s, p, breaks,
				new btHingeConstraint(*p.a, *p.b, in(*p.a, p.frame), in(*p.b, p.frame), true))
	{
	}
	void beforeStep(btScalar dt) override { m_hinge->enableAngularMotor(true, 0, m_moment * dt); }
	void afterStep(btScalar dt) override
	{
		if (isBroken())
			return;
		const btVector3 axis = m_pieces[0]->getWorldTransform().getBasis().getColumn(1);
		m_rotation +=
			std::fabs(double(axis.dot(m_pieces[1]->getAngularVelocity() - m_pieces[0]->getAngularVelocity()) * dt));
		if (m_rotation > m_maxRotation)
			m_hinge->setEnabled(false);
	}
	double plasticWork() const override { return taken(); }

private:
	Motor(World& world, CharpyEnergy& energy, const CharpySettings& s, const CharpyJointPlace& p, bool breaks,
		  btHingeConstraint* hinge)
		: Stock(world, energy, hinge),
		  m_hinge(hinge),
		  m_pieces{p.a, p.b},
		  m_moment(capacityOf(s, p).m_yield[BT_EP_BENDING_Z]),
		  m_maxRotation(breaks ? s.maxRotation : HUGE_VAL)
	{
	}

	btHingeConstraint* m_hinge;
	btRigidBody* m_pieces[2];
	btScalar m_moment;
	double m_maxRotation;
	double m_rotation = 0;
};
}  // namespace

std::unique_ptr<CharpyJoint> makeCharpyJoint(World& world, CharpyEnergy& energy, const CharpySettings& s,
											 const CharpyJointPlace& p)
{
	switch (s.way)
	{
		case CharpyWay::Breaking:
			return std::make_unique<Breaking>(world, energy, s, p);
		case CharpyWay::Spring:
			return std::make_unique<Spring<btGeneric6DofSpringConstraint>>(
				world, energy, s, p,
				new btGeneric6DofSpringConstraint(*p.a, *p.b, in(*p.a, p.frame), in(*p.b, p.frame), true));
		case CharpyWay::Spring2:
			return std::make_unique<Spring<btGeneric6DofSpring2Constraint>>(
				world, energy, s, p,
				new btGeneric6DofSpring2Constraint(*p.a, *p.b, in(*p.a, p.frame), in(*p.b, p.frame)));
		case CharpyWay::HingeMotor:
		case CharpyWay::PlasticHinge:
			return std::make_unique<Motor>(world, energy, s, p, s.way == CharpyWay::PlasticHinge);
		case CharpyWay::Rigid:
			return nullptr;
		default:
			return std::make_unique<ElasticPlastic>(world, s, p);
	}
}
}  // namespace ep
