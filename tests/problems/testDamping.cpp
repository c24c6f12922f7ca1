// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Damping of the scheme and of the material: by mode, whatever the number of blocks.

#include <math.h>

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/BlockUnderTension.h"
#include "scenes/Cantilever.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"
#include "support/Pair.h"

namespace testDamping
{
using namespace ep;

/// A row of blocks on a support, joined by springs along the row.
struct Chain
{
	World m_world{withoutInnerSteps(), btVector3(0, 0, 0)};
	std::vector<btRigidBody*> m_blocks;
	std::vector<btElasticPlasticJoint*> m_joints;

	explicit Chain(const btQuaternion& turn = btQuaternion::getIdentity()) : m_turn(turn)
	{
		m_last = m_world.body(0, m_world.box(btVector3(1, 1, 1)), m_turn * at(0), false);
	}

	/// \param blockFirst  whether the block is the joint's body A
	void add(double mass, double stiffness, double yield, double damping = 0, bool blockFirst = false)
	{
		btElasticPlasticCapacity capacity = evenCapacity(1e9);
		capacity.set(BT_EP_AXIAL, btScalar(stiffness), btScalar(yield));
		capacity.m_damping = btScalar(damping);
		const double x = double(m_blocks.size()) + 1;
		btRigidBody* block = m_world.body(btScalar(mass), m_world.box(btVector3(1, 1, 1)), m_turn * at(x), false);
		const btTransform place = m_turn * at(x - 0.5);
		m_joints.push_back(blockFirst ? m_world.joint(*block, *m_last, place, capacity)
									  : m_world.joint(*m_last, *block, place, capacity));
		m_joints.back()->setScheme(BT_EP_SCHEME_BY_MODE);
		m_blocks.push_back(m_last = block);
	}

	void throwBlock(size_t i, double speed)
	{
		m_blocks[i]->setLinearVelocity(m_turn * btVector3(btScalar(speed), 0, 0));
	}

	bool hasYielded() const
	{
		return std::any_of(m_joints.begin(), m_joints.end(),
						   [](const btElasticPlasticJoint* joint) { return joint->hasYielded(); });
	}

	/// How far the end block has moved along the row [m].
	double moved() const
	{
		return double((m_turn.inverse() * m_last->getCenterOfMassPosition()).x()) - double(m_blocks.size());
	}

	/// n blocks of 1 kg, a mode of which has the given number of steps of 1/60 s a period, thrown in its shape.
	/// \param mode  1: the slowest
	static Chain* swinging(int n, int mode, double steps, double damping,
						   const btQuaternion& turn = btQuaternion::getIdentity(), bool blockFirst = false)
	{
		Chain* const chain = new Chain(turn);
		const double angle = (2 * mode - 1) * M_PI / (2 * n + 1), root = 2 * M_PI * 60 / steps / (2 * sin(angle / 2));
		for (int i = 0; i < n; ++i)
			chain->add(1, root * root, double(btElasticPlasticCapacity::unlimited()), damping, blockFirst);
		for (int i = 0; i < n; ++i)
			chain->throwBlock(size_t(i), sin((i + 1) * angle));
		return chain;
	}

private:
	btTransform m_turn;
	btRigidBody* m_last;
};

/// Damping ratio, and the period over that of exact integration, by parabolas through turning points.
struct Swing
{
	double m_ratio, m_period;

	Swing(Chain& chain, double steps, int turns)
	{
		double before[2] = {0, 0};
		std::vector<double> times, heights;
		for (int i = 1; int(times.size()) < turns && i < 100000; ++i)
		{
			chain.m_world.step(FRAME);
			const double now = chain.moved();
			if (i > 1 && (before[0] - before[1]) * (now - before[0]) < 0)
			{
				const double slope = (now - before[1]) / 2, bend = now - 2 * before[0] + before[1];
				times.push_back(i - 1 - slope / bend);
				heights.push_back(fabs(before[0] - slope * slope / bend / 2));
			}
			before[1] = before[0];
			before[0] = now;
		}
		// The first half swing begins with joints that have no past.
		const double halves = double(turns - 2), decrement = log(heights[1] / heights.back()) / halves / M_PI;
		m_ratio = decrement / sqrt(1 + decrement * decrement);
		m_period = 2 * (times.back() - times[1]) / halves / steps;
	}
};

TEST(Damping, OfTheSchemeDoesNotDependOnTheNumberOfBlocks)
{
	const struct
	{
		double steps, ratio, period;  ///< of the scheme's roots (Law.DampsWhatTheStepDoesNotResolve)
	} expected[] = {{12, 0.0053, 1.059}, {50, 0.00002, 1.0033}};
	for (const auto& e : expected)
		for (const int blocks : {5, 10, 20, 40, 80})
		{
			const std::unique_ptr<Chain> chain(Chain::swinging(blocks, 1, e.steps, 0));
			const Swing swing(*chain, e.steps, 24);
			// Parabolas through turning points of 12 steps a swing; in float places are rounded, of which swings are a share.
			EXPECT_NEAR(e.ratio, swing.m_ratio, byPrecision(3e-4, 1e-3)) << blocks << " blocks, " << e.steps;
			EXPECT_NEAR(e.period, swing.m_period, 2e-3) << blocks << " blocks, " << e.steps;
		}
}

TEST(Damping, OfTheMaterialIsItsRatioInEachMode)
{
	const btQuaternion askew(btVector3(1, -2, 2).normalized(), btScalar(0.8));
	for (const double ratio : {0.01, 0.03, 0.04})
		for (const int mode : {1, 3})
			for (const double steps : {25., 60., 180.})
				for (const bool blockFirst : {false, true})
				{
					const std::unique_ptr<Chain> chain(Chain::swinging(
						10, mode, steps, ratio, blockFirst ? askew : btQuaternion::getIdentity(), blockFirst));
					const double kinetic = chain->m_world.kineticEnergy();
					const Swing swing(*chain, steps, 12);
					EXPECT_NEAR(ratio, swing.m_ratio, byPrecision(0.05, 0.06) * ratio) << mode << ", " << steps;
					// All that is lost is the material's; its springs hold what has not been lost.
					double damped = 0, numerical = 0, held = 0;
					for (const btElasticPlasticJoint* joint : chain->m_joints)
					{
						damped += joint->getDampingEnergy();
						held += joint->getElasticEnergy();
						numerical += joint->getNumericalEnergy();
					}
					const double lost = kinetic - chain->m_world.kineticEnergy() - held;
					// Kinetic energy is that of half a step before the springs' places.
					EXPECT_NEAR(lost, damped, 0.06 * kinetic);
					EXPECT_NEAR(0, numerical, 0.06 * kinetic);
					EXPECT_GT(damped, 0.3 * kinetic);
				}
}

/// What the scheme stores, by the mean forces of four steps (theory.md).
double stored(const std::array<double, 4>& r, double stiffness)
{
	const double parts[] = {r[0] / 2, r[0] - r[1] / 2, r[1] - r[2] / 2, r[0] - r[2] + r[3] / 2};
	double sum = 0;
	for (const double part : parts)
		sum += part * part;
	return sum / (2 * stiffness);
}

/// Kinetic and stored energy of random chains that yield never rise, from a thousandth of a step a period to a thousand.
TEST(Damping, OfTheSchemeNeverGivesEnergy)
{
	std::mt19937 random(1);
	const auto spread = [&](double from, double to)
	{ return from * pow(to / from, double(random()) / double(std::mt19937::max())); };
	int flowing = 0;
	for (int trial = 0; trial < 1000; ++trial)
	{
		Chain chain;
		const int blocks = 1 + int(random() % 5);
		for (int i = 0; i < blocks; ++i)
		{
			// One after another, for each compiler evaluates arguments in an order of its own.
			const double mass = spread(0.1, 10), yield = spread(1, 1e3) * mass,
						 stiffness = mass * 3600 * spread(1e-2, 1e4), speed = spread(0.01, 1);
			chain.add(mass, stiffness, yield);
			chain.throwBlock(size_t(i), random() % 2 ? speed : -speed);
		}
		std::vector<std::array<double, 4>> applied(size_t(blocks), {0, 0, 0, 0});
		const double start = chain.m_world.kineticEnergy();
		double before = start, most = 0;
		for (int i = 0; i < 60; ++i)
		{
			chain.m_world.step(FRAME);
			double energy = chain.m_world.kineticEnergy();
			for (size_t j = 0; j < applied.size(); ++j)
			{
				std::array<double, 4>& r = applied[j];
				r = {double(chain.m_joints[j]->getAppliedForce(BT_EP_AXIAL)), r[0], r[1], r[2]};
				energy += stored(r, double(chain.m_joints[j]->getCapacity().m_stiffness[BT_EP_AXIAL]));
			}
			most = std::max(most, energy - before);
			before = energy;
		}
		flowing += chain.hasYielded();
		// Linear: nothing. Where flow begins or ends in a row that the step resolves, by its middle, a step may add some parts of a
		// thousand, of which later ones take more. The rounding of places is to stiff springs what float adds.
		EXPECT_LE(most, (chain.hasYielded() ? 2e-2 : byPrecision(1e-9, 1e-3)) * start) << trial;
		EXPECT_LE(before, start) << trial;
	}
	EXPECT_GT(flowing, 200);
}

/// The paper's block, released at rest on its joint, flows by 1.5 mm before it swings: 4 steps of 1/60 s a period.
TEST(Damping, OfTheSchemeLeavesABlowItsFlow)
{
	const struct
	{
		int rate;
		double error;
	} expected[] = {{60, 0.06}, {240, 0.03}, {480, 0.002}};
	for (const auto& e : expected)
		for (const bool blockFirst : {false, true})
		{
			BlockUnderTension::Settings settings;
			settings.method = withoutInnerSteps();
			settings.blockFirst = blockFirst;
			if (blockFirst)
				settings.turn = btQuaternion(btVector3(1, -2, 2).normalized(), btScalar(0.8));
			BlockUnderTension block(settings);
			block.m_joint->setScheme(BT_EP_SCHEME_BY_MODE);
			run(block.m_world, int(0.4 * e.rate), btScalar(1) / btScalar(e.rate));
			const double exact = 1.5e-3;
			EXPECT_NEAR(exact, double(block.m_joint->getPlasticPath(BT_EP_AXIAL)),
						(e.error + byPrecision(0, 1e-3)) * exact)
				<< "1/" << e.rate;
		}
}

TEST(Damping, OfTheMaterialIsSilentDuringFlow)
{
	double path[2];
	for (const double ratio : {0., 0.04})
	{
		Chain chain;
		chain.add(100, 1e6, 1e4, ratio);
		chain.throwBlock(0, 10);
		btElasticPlasticJoint& joint = *chain.m_joints[0];
		double inFlow = 0, least = 1e4, most = 0;
		for (int i = 0; chain.m_blocks[0]->getLinearVelocity().x() > 1; ++i)
		{
			const double before = joint.getDampingEnergy();
			run(chain.m_world, 1, btScalar(1) / 480);
			most = std::max(most, fabs(double(joint.getAppliedForce(BT_EP_AXIAL))));
			// Flow has begun, and what relaxes has relaxed from 20 Hz on.
			if (i <= 20)
				continue;
			inFlow += joint.getDampingEnergy() - before;
			least = std::min(least, double(joint.getAppliedForce(BT_EP_AXIAL)));
		}
		EXPECT_NEAR(1e4, least, 1e-3 * 1e4);
		EXPECT_LE(most, 1e4 * (1 + 8 * double(SIMD_EPSILON)));
		// Of 5 kJ that flow takes.
		EXPECT_LT(inFlow, 5);
		path[ratio > 0] = double(joint.getPlasticPath(BT_EP_AXIAL));
	}
	EXPECT_NEAR(path[0], path[1], 0.005 * path[0]);
}

/// A body at the end of a square bar of 1 m, as heavy against its inertia as makes the bar stretch and bend in the same time, and thrown.
struct BarInSwing
{
	World m_world{Solver::Direct, btVector3(0, 0, 0)};
	btElasticPlasticJoint* m_joint;
	double m_kinetic;

	/// \param isWhole   whether the section yields as a whole
	/// \param fixedEnd  whether the joint stands at the support, where shear and bending are coupled
	BarInSwing(double ratio, double yield, bool isWhole, bool fixedEnd, int dof, double speed)
	{
		const btTransform turn(btQuaternion(btVector3(1, -2, 2).normalized(), btScalar(0.8)));
		const double mass = 1e5, inertia = mass * SIDE * SIDE / 12;
		btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(yield));
		steel.m_dampingRatio = btScalar(ratio);
		steel.m_ultimatePlasticStrain = 10;
		const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
		btCollisionShape* const box = m_world.box(btVector3(1, 1, 1));
		btRigidBody* const support = m_world.body(0, box, turn, false);
		btRigidBody* const body = m_world.body(btScalar(mass), box, turn * at(btScalar(fixedEnd ? 0.5 : 0)), false);
		body->setMassProps(btScalar(mass), btVector3(1, 1, 1) * btScalar(inertia));
		body->updateInertiaTensor();
		m_joint = m_world.joint(
			*support, *body, turn,
			btElasticPlasticCapacity::fromMember(steel, isWhole ? section.withFibres() : section, fixedEnd ? 0 : 1, 1));
		const btVector3 axis = turn.getBasis().getColumn(dof % 3) * btScalar(speed);
		(dof < 3 ? body->setLinearVelocity(axis) : body->setAngularVelocity(axis));
		m_kinetic = m_world.kineticEnergy();
	}

	/// In 60 steps a swing.
	void swing(int swings) { run(m_world, 60 * swings, btScalar(2 * M_PI / std::sqrt(8e7 / 1e5) / 60)); }

	static constexpr double SIDE = 0.02;
};

TEST(Damping, OfTheMaterialIsTheSameInSectionsThatYieldAsAWhole)
{
	for (const double ratio : {0.01, 0.04})
		for (const bool fixedEnd : {false, true})
			for (const int dof : {int(BT_EP_AXIAL), int(BT_EP_SHEAR_Y), int(BT_EP_BENDING_Y), int(BT_EP_BENDING_Z)})
			{
				// Fibres that are coupled with a shear take its scheme.
				if (fixedEnd && dof == BT_EP_AXIAL)
					continue;
				double damped[2], left[2], kinetic = 0;
				for (const bool isWhole : {false, true})
				{
					BarInSwing bar(ratio, 1e12, isWhole, fixedEnd, dof, 0.01);
					bar.swing(3);
					kinetic = bar.m_kinetic;
					damped[isWhole] = bar.m_joint->getDampingEnergy();
					left[isWhole] = bar.m_world.kineticEnergy() + bar.m_joint->getElasticEnergy();
				}
				EXPECT_GT(damped[0], 2e-3 * kinetic);
				// Float rounds what is left after three swings of a turned bar by up to 1.03e-3.
				EXPECT_NEAR(damped[0], damped[1], byPrecision(1e-6, 1e-3) * kinetic) << ratio << fixedEnd << dof;
				EXPECT_NEAR(left[0], left[1], byPrecision(1e-6, 2e-3) * kinetic) << ratio << fixedEnd << dof;
			}
}

TEST(Damping, OfTheMaterialIsSilentWhereASectionFlows)
{
	const struct
	{
		int dof;
		double yield, speed;
	} throws[] = {{BT_EP_AXIAL, 250e6, 1}, {BT_EP_BENDING_Z, 25e6, 2}};
	for (const auto& each : throws)
	{
		double path[2];
		for (const double ratio : {0., 0.04})
		{
			BarInSwing bar(ratio, each.yield, true, false, each.dof, each.speed);
			double damped = 0;
			for (int i = 0; i < 100; ++i)
			{
				run(bar.m_world, 1, btScalar(0.001));
				const btElasticPlasticJoint& joint = *bar.m_joint;
				EXPECT_LE(joint.getUtilisation(each.dof), 1 + 1e-5) << i;
				damped = joint.getDampingEnergy();
			}
			path[ratio > 0] = double(bar.m_joint->getPlasticPath(each.dof));
			EXPECT_LE(damped, 0.02 * bar.m_joint->getPlasticEnergy());
		}
		// Of the turn at which all has yielded, a sixth is elastic, which is stiffer in motion.
		EXPECT_NEAR(path[0], path[1], 0.02 * path[0]) << each.dof;
	}
}

/// A cantilever of the default steel swings less and less, hangs as low as it should, and falls asleep.
TEST(Damping, BringsStructuresToRest)
{
	for (const double ratio : {0.01, 0.})
	{
		Cantilever::Settings settings;
		settings.length = 6;
		settings.member.material.m_dampingRatio = btScalar(ratio);
		Cantilever cantilever(settings);
		for (btElasticPlasticJoint* joint : cantilever.m_member.joints())
			joint->setScheme(BT_EP_SCHEME_BY_MODE);
		cantilever.m_world.allowSleep(btScalar(0.02));
		run(cantilever.m_world, 60 * 45);
		const bool sleeps = !cantilever.m_member.last().isActive();
		EXPECT_EQ(ratio > 0, sleeps);
		if (sleeps)
		{
			EXPECT_NEAR(cantilever.staticSag(), cantilever.sag(), 0.02 * cantilever.staticSag());
		}
	}
}

TEST(Damping, IsOnInMaterialsAndCanBeTurnedOff)
{
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1));
	btElasticPlasticMaterial material = btElasticPlasticMaterial::steel();
	EXPECT_EQ(btScalar(0.01), btElasticPlasticCapacity::fromRod(material, section, 1).m_damping);
	EXPECT_EQ(btScalar(0.03), btElasticPlasticMaterial::reinforcedConcrete(btScalar(0.01)).m_dampingRatio);
	material.m_dampingRatio = 0;
	EXPECT_EQ(0, btElasticPlasticCapacity::fromRod(material, section, 1).m_damping);
	for (const double wrong : {-0.01, 0.11, double(NAN), double(INFINITY)})
	{
		material.m_dampingRatio = btScalar(wrong);
		EXPECT_TRUE(material.fault()) << wrong;
		EXPECT_TRUE(btElasticPlasticCapacity::fromRod(material, section, 1).fault()) << wrong;
		btElasticPlasticCapacity capacity = evenCapacity(1e6);
		capacity.m_damping = btScalar(wrong);
		EXPECT_STREQ("damping ratio", capacity.fault().m_quantity) << wrong;
	}
}

TEST(Damping, OfNextToNothingHasEnergiesThatAreNumbers)
{
	for (const double ratio : {1e-7, 1e-10, 1e-20, 1e-37})
	{
		Pair pair(Solver::Direct);
		btElasticPlasticCapacity capacity = evenCapacity(1e6);
		capacity.m_damping = btScalar(ratio);
		const btElasticPlasticJoint* joint = pair.join(capacity);
		ASSERT_FALSE(joint->fault());
		EXPECT_EQ(0, joint->getElasticEnergy());
		pair.m_b->setLinearVelocity(btVector3(1, 0, 0));
		const double first = pair.m_world.kineticEnergy();
		for (int i = 0; i < 60; ++i)
		{
			pair.m_world.step(FRAME);
			ASSERT_TRUE(btElasticPlasticIsFinite(joint->getElasticEnergy())) << ratio;
			ASSERT_GE(joint->getElasticEnergy(), 0);
			ASSERT_GE(joint->getDampingEnergy(), 0);
			ASSERT_LT(joint->getDampingEnergy(), 1e-4 * first);
		}
	}
}
}  // namespace testDamping
