// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Ropes, strips and bars under high tension: what is taut makes no energy, swings and stretches as it should.

#include <math.h>
#include <stdlib.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepControl.h"
#include "scenes/Member.h"
#include "support/Close.h"
#include "support/DirectSolver.h"
#include "support/Run.h"
#include "world/EnergyAudit.h"

namespace testTaut
{
using namespace ep;

const double GRAVITY = 10;

/// How a rope's joints bend.
enum class Bending
{
	Free,
	Elastic,  ///< weakly
	Yielding  ///< weakly, at 50 N m
};

/// A ball on a straight rope of boxes that hangs askew.
struct Rope
{
	struct Settings
	{
		double ball = 1000;  ///< [kg]
		int links = 16;
		double link = 5;         ///< [kg]
		double length = 8;       ///< of the rope [m]
		double stiffness = 2e7;  ///< of each joint, axial and shear [N/m]
		Bending bending = Bending::Free;
		double angle = 0.6;                     ///< from the plumb line [rad]
		double frame = 0;                       ///< by which the joints' frames are off the rope's direction [rad]
		double halfWidth = 0.04, radius = 0.4;  ///< of the links, of the ball [m]
		btQuaternion turn = btQuaternion::getIdentity();  ///< of all, gravity too
		double nudge = 0;  ///< greatest spin of links about each axis at the start [rad/s]
		Solver solver = Solver::Direct;
	};

	Settings m_settings;
	World m_world;
	btRigidBody* m_ball = nullptr;
	std::vector<btElasticPlasticJoint*> m_joints;

	explicit Rope(const Settings& s)
		: m_settings(s), m_world(s.solver, quatRotate(s.turn, btVector3(0, btScalar(-GRAVITY), 0)))
	{
		btElasticPlasticCapacity capacity;
		for (int i = 0; i < 3; ++i)
			capacity.set(i, btScalar(s.stiffness), btElasticPlasticCapacity::unlimited());
		for (int i = 3; i < BT_EP_DOF_COUNT && s.bending != Bending::Free; ++i)
			capacity.set(i, 2000, s.bending == Bending::Yielding ? 50 : btElasticPlasticCapacity::unlimited());
		const btTransform turn(s.turn * btQuaternion(btVector3(0, 0, 1), btScalar(s.angle) - SIMD_HALF_PI));
		const btTransform askew(btQuaternion(btVector3(0, 0, 1), btScalar(s.frame)));
		const double l = s.length / s.links;
		btCollisionShape* box =
			m_world.box(btVector3(btScalar(l), btScalar(2 * s.halfWidth), btScalar(2 * s.halfWidth)));
		btRigidBody* former = m_world.body(0, m_world.box(btVector3(1, 1, 1)), btTransform::getIdentity(), false);
		std::mt19937 random(1);
		std::uniform_real_distribution<double> nudge(-s.nudge, s.nudge);
		for (int i = 0; i <= s.links; ++i)
		{
			btRigidBody* next;
			btVector3 spin(0, 0, 0);
			if (i < s.links)
			{
				next = m_world.body(btScalar(s.link), box, turn * at(btScalar((i + 0.5) * l)), false);
				for (int axis = 0; axis < 3; ++axis)
					spin[axis] = btScalar(nudge(random));
				next->setAngularVelocity(spin);
			}
			else
				next = m_ball = m_world.body(btScalar(s.ball), m_world.box(btVector3(1, 1, 1) * btScalar(2 * s.radius)),
											 turn * at(btScalar(s.length + s.radius)), false);
			m_joints.push_back(m_world.joint(*former, *next, turn * at(btScalar(i * l)) * askew, capacity));
			former = next;
		}
	}

	/// Kinetic and potential energy, from the support upwards [J]. A step moves places by the velocity at its end: half a step before
	/// that they belong to it.
	double mechanicalEnergy(double dt) const
	{
		double energy = m_world.kineticEnergy();
		for (const auto& body : m_world.bodies())
			if (body->getInvMass() > 0)
			{
				const btVector3 place = body->getCenterOfMassPosition() - body->getLinearVelocity() * btScalar(dt / 2);
				energy -= double(body->getGravity().dot(place)) / double(body->getInvMass());
			}
		return energy;
	}

	/// By how much the ball is farther from the support than unloaded [m].
	double elongation() const
	{
		return double(m_ball->getCenterOfMassPosition().length()) - m_settings.length - m_settings.radius;
	}

	/// The sum over the joints of what hangs on each over its stiffness [m].
	double staticElongation() const
	{
		double sum = 0;
		for (int i = 0; i <= m_settings.links; ++i)
			sum += (m_settings.ball + m_settings.link * (m_settings.links - i)) * GRAVITY / m_settings.stiffness;
		return sum;
	}

	/// Of the slowest small oscillation of rigid links and ball, which hinge freely [s]: the largest eigenvalue of K^-1 M in the
	/// bodies' angles, K being diagonal, by power iteration.
	double period() const
	{
		const int n = m_settings.links + 1;
		const double l = m_settings.length / m_settings.links;
		const auto mass = [&](int i) { return i < n - 1 ? m_settings.link : m_settings.ball; };
		const auto arm = [&](int i) { return i < n - 1 ? l / 2 : m_settings.radius; };
		const auto inertia = [&](int i)
		{
			const double a = i < n - 1 ? l / 2 : m_settings.radius,
						 b = i < n - 1 ? m_settings.halfWidth : m_settings.radius;
			return mass(i) * (a * a + b * b) / 3;
		};
		std::vector<double> angle(n, 1), next(n);
		double eigenvalue = 0;
		for (int k = 0; k < 200; ++k)
		{
			// Momenta m x of the centres, then M angle by summing from the free end.
			double x = 0;
			std::vector<double> momentum(n);
			for (int i = 0; i < n; ++i)
			{
				momentum[i] = mass(i) * (x + arm(i) * angle[i]);
				x += l * angle[i];
			}
			double below = 0, weight = 0, largest = 0;
			for (int i = n - 1; i >= 0; --i)
			{
				const double moment = inertia(i) * angle[i] + arm(i) * momentum[i] + l * below;
				next[i] = moment / (GRAVITY * (arm(i) * mass(i) + l * weight));
				below += momentum[i];
				weight += mass(i);
				largest = std::max(largest, next[i]);
			}
			eigenvalue = largest;
			for (int i = 0; i < n; ++i)
				angle[i] = next[i] / largest;
		}
		return 2 * M_PI * sqrt(eigenvalue);
	}
};

/// A mass at mid-span of a thin straight steel member between two fixed supports: it hangs by the tension of a member that has
/// yielded in bending.
struct Strip
{
	struct Settings
	{
		double length = 4, width = 0.1, height = 0.005;  ///< [m]
		int parts = 8;                                   ///< of each half
		double mass = 800;                               ///< [kg]
		double yieldStress = 250e6;                      ///< [Pa]
	};

	World m_world{Solver::Direct, btVector3(0, btScalar(-GRAVITY), 0)};

	explicit Strip(const Settings& s)
	{
		Member::Settings member;
		member.material = btElasticPlasticMaterial::steel(btScalar(s.yieldStress));
		member.material.m_ultimatePlasticStrain = btScalar(1e9);
		member.width = btScalar(s.width);
		member.height = btScalar(s.height);
		member.parts = s.parts;
		const btElasticPlasticSection section = btElasticPlasticSection::rectangle(member.width, member.height);
		member.capacityOf = [=](btScalar a, btScalar b)
		{ return btElasticPlasticCapacity::fromMember(member.material, section, a, b); };
		btCollisionShape* node = m_world.box(btVector3(member.height, member.height, member.width));
		btRigidBody* left = m_world.body(0, node, at(0), false);
		btRigidBody* middle = m_world.body(btScalar(s.mass), node, at(btScalar(s.length / 2)), false);
		btRigidBody* right = m_world.body(0, node, at(btScalar(s.length)), false);
		Member first(m_world, member, at(0), btScalar(s.length / 2));
		first.joinStart(m_world, *left);
		first.joinEnd(m_world, *middle);
		Member second(m_world, member, at(btScalar(s.length / 2)), btScalar(s.length / 2));
		second.joinStart(m_world, *middle);
		second.joinEnd(m_world, *right);
	}
};

/// How a world is stepped.
struct Stepping
{
	int rate;         ///< steps a second
	bool controlled;  ///< by btElasticPlasticStepControl within a step

	std::string name() const { return "1/" + std::to_string(rate) + (controlled ? " s, controlled" : " s"); }
};

/// What was made from nothing, in shares of the energy at play.
struct Gain
{
	double m_byJoints;  ///< above the energy at the beginning
	double m_byOthers;
	int m_substeps;  ///< and inner steps
	double
		m_later;  ///< the most that a window's greatest energy is above an earlier one's: nothing lost before excuses it
};

/// In which the balance of a swing is compared: more than half a swing, as it sways with the square of the step twice a swing [s].
const double WINDOW = 3;

Gain gainOf(World& world, const Stepping& stepping, double seconds)
{
	EnergyAudit audit(world);
	btElasticPlasticStepControl control;
	const btScalar dt = btScalar(1) / btScalar(stepping.rate);
	const int stepsInWindow = int(WINDOW * stepping.rate), steps = int(seconds * stepping.rate + 0.5);
	int substeps = 0;
	double later = 0, least = 1e300, greatest = -1e300;
	for (int i = 0; i < steps; ++i)
	{
		if (!stepping.controlled)
		{
			audit.step(dt);
			++substeps;
		}
		else
		{
			control.begin(dt);
			while (const btScalar substep = control.next(world.bullet()))
			{
				audit.step(substep);
				++substeps;
				control.observe(world.bullet(), world.action());
			}
		}
		greatest = std::max(greatest, audit.balance());
		if ((i + 1) % stepsInWindow == 0)
		{
			later = std::max(later, greatest - least);
			least = std::min(least, greatest);
			greatest = -1e300;
		}
	}
	substeps += int(statisticsOf(world).m_innerSteps);
	return {audit.createdByJoints(), audit.created(), substeps, later / audit.atPlay()};
}
/// What contacts and Bullet's constraints would make, in shares of the energy at play; without them it is what the matrix is not
/// solved to, and in each substep the rounding of four velocities of each joint, two and two.
double byOthers(int substeps) { return 1e-10 + 4 * double(SIMD_EPSILON) * substeps; }
/// Of the energy at play, in both precisions: what the rounding of places is to springs the audit leaves out.
const double BY_JOINTS = 1e-6;

void expectNothingMade(World& world, const Stepping& stepping, double seconds, const std::string& what)
{
	const Gain gain = gainOf(world, stepping, seconds);
	EXPECT_LE(gain.m_byJoints, BY_JOINTS) << what << ", " << stepping.name();
	EXPECT_LE(gain.m_byOthers, byOthers(gain.m_substeps)) << what << ", " << stepping.name();
	// In float every substep rounds velocities by half of epsilon, to either side: over the substeps of a run that adds up with
	// their square root, to two standard deviations.
	const double rounding = byPrecision(0, 2 * double(SIMD_EPSILON) * sqrt(double(gain.m_substeps)));
	EXPECT_LE(gain.m_later, BY_JOINTS + rounding) << what << ", " << stepping.name();
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks) << what << ", " << stepping.name();
	for (const auto& body : world.bodies())
		EXPECT_TRUE(isFinite(*body)) << what << ", " << stepping.name();
}

const Stepping STEPPINGS[] = {{30, false}, {60, false}, {240, false}, {60, true}};

TEST(Taut, ABallOnARopeMakesNoEnergy)
{
	for (double ball : {10., 1000., 100000.})
		for (int links : {4, 16, 64})
			for (double link : {0.5, 50.})
				for (Bending bending : {Bending::Free, Bending::Elastic, Bending::Yielding})
					for (const Stepping& stepping : STEPPINGS)
					{
						// Of many links only the light ones, in long steps: what they cannot resolve is what makes energy.
						if (links == 64 && (link > 1 || stepping.rate != 60 || stepping.controlled))
							continue;
						Rope::Settings settings;
						settings.ball = ball;
						settings.links = links;
						settings.link = link;
						settings.bending = bending;
						Rope rope(settings);
						expectNothingMade(rope.m_world, stepping, links == 64 ? 6 : 9,
										  "ball of " + std::to_string(ball) + " kg, " + std::to_string(links) +
											  " links of " + std::to_string(link) + " kg, bending " +
											  std::to_string(int(bending)));
					}
}

TEST(Taut, AStripThatWrapsAroundItsMassMakesNoEnergy)
{
	// The hinge at the mass turns through more than half a turn, beyond which the joint's axis points away from the strip that it
	// belongs to. Members bow towards one side of it: where that changed with the pose, the axial force jumped by 78 kN in a step,
	// with 969 J of 2900.
	Strip::Settings settings;
	settings.parts = 4;
	Strip strip(settings);
	EnergyAudit audit(strip.m_world);
	double largest = 0, turn = 0;
	for (int i = 0; i < 3 * 3840; ++i)
	{
		audit.step(btScalar(1) / 3840);
		largest = std::max(largest, audit.gain());
	}
	for (const btElasticPlasticJoint* joint : strip.m_world.joints())
		turn = std::max(turn, std::fabs(double(joint->getPlasticDeformation(BT_EP_BENDING_Z))));
	ASSERT_GT(turn, M_PI);
	// A step moves energy between motion and springs by up to force times half a step's change of speed.
	EXPECT_LT(largest, 1e-3 * audit.atPlay());
}

TEST(Taut, ARopeMakesNoEnergyWhereverItsFramesPoint)
{
	// Ball joints have no direction of their own. Damping about the frames' axes that left out the one nearest to the rope made 1e13 J.
	for (double frame : {0.05, 0.3, 0.7, 1.2})
	{
		Rope::Settings settings;
		settings.ball = 5000;
		settings.links = 3;
		settings.link = 1;
		settings.frame = frame;
		Rope rope(settings);
		expectNothingMade(rope.m_world, {60, false}, 9, "frames off by " + std::to_string(frame));
	}
}

/// Two directions that no axis of the world or of a body is near to.
const btQuaternion TURNS[] = {btQuaternion(btScalar(0.3), btScalar(-0.5), btScalar(0.6), btScalar(0.4)).normalized(),
							  btQuaternion(btScalar(-0.7), btScalar(0.2), btScalar(0.1), btScalar(0.6)).normalized()};

TEST(Taut, LinksDoNotSpinUpOutOfThePlane)
{
	// Slender links with next to no inertia about their own axes. They spun up by 7 times a step: of rounding in a turned scene,
	// within 10 steps, to 250 rad/s, and then made 1e2 to 1e5 times the swing's energy.
	Rope::Settings cases[3];
	cases[0].ball = 10900;
	cases[0].links = 9;
	cases[0].link = 7.85;
	cases[0].length = 1.145;
	cases[0].halfWidth = 0.0127;
	cases[0].radius = 0.67;
	cases[0].stiffness = 8.6e10;
	cases[0].angle = 0.74;
	cases[1].ball = 467;
	cases[1].links = 23;
	cases[1].link = 0.58;
	cases[1].length = 4.6;
	cases[1].halfWidth = 0.02;
	cases[1].radius = 0.23;
	cases[1].stiffness = 2.4e9;
	cases[1].angle = 0.8;
	cases[2].ball = 77400;
	cases[2].links = 39;
	cases[2].link = 1.34;
	cases[2].length = 23;
	cases[2].halfWidth = 0.059;
	cases[2].radius = 1.3;
	cases[2].stiffness = 1.3e11;
	cases[2].angle = 1.3;
	cases[2].bending = Bending::Yielding;
	for (Rope::Settings& settings : cases)
		for (const btQuaternion& turn : TURNS)
			for (double nudge : {0., 0.3})
			{
				settings.turn = turn;
				settings.nudge = nudge;
				Rope rope(settings);
				// Bullet's gyroscopic impulses are not exact: where they have a part, they would be counted.
				for (const auto& body : rope.m_world.bodies())
					if (nudge > 0)
						body->setFlags(0);
				const Gain gain = gainOf(rope.m_world, {30, false}, 9);
				const testing::Message which = testing::Message()
											   << settings.ball << " kg, nudged by " << nudge << " rad/s";
				// Also in the step in which tension comes on, here the first. Its turns lifted the ball by 4e-4.
				EXPECT_LE(gain.m_byJoints, BY_JOINTS + byPrecision(0, double(SIMD_EPSILON) * sqrt(gain.m_substeps)))
					<< which;
				EXPECT_LE(gain.m_later, BY_JOINTS + byPrecision(0, double(SIMD_EPSILON) * sqrt(gain.m_substeps)))
					<< which;
			}
}

/// Any rope of the range that is held to make no energy.
struct RandomRope
{
	Rope::Settings m_settings;
	Stepping m_stepping;

	explicit RandomRope(unsigned seed)
	{
		std::mt19937 random(seed);
		const auto uniform = [&](double low, double high)
		{ return std::uniform_real_distribution<double>(low, high)(random); };
		const auto logarithmic = [&](double low, double high) { return exp(uniform(log(low), log(high))); };
		const auto oneOf = [&](int number) { return int(random() % unsigned(number)); };
		m_settings.ball = logarithmic(10, 1e5);
		m_settings.links = 4 + oneOf(61);
		m_settings.link = logarithmic(0.5, 50);
		m_settings.length = m_settings.links * logarithmic(0.1, 1);
		m_settings.halfWidth = m_settings.length / m_settings.links / uniform(5, 20);
		m_settings.radius = 0.02 * cbrt(m_settings.ball);
		const double weight = GRAVITY * (m_settings.ball + m_settings.links * m_settings.link);
		m_settings.stiffness = weight * m_settings.links / (m_settings.length * logarithmic(1e-4, 1e-2));
		m_settings.bending = Bending(oneOf(3));
		m_settings.angle = uniform(0.05, 1.4);
		m_settings.nudge = uniform(0, 0.3);
		m_settings.turn = btQuaternion(btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1)),
									   btScalar(uniform(0.1, 1)))
							  .normalized();
		const int rates[] = {30, 60, 120, 240};
		m_stepping = {rates[oneOf(4)], oneOf(4) == 0};
	}
};

/// EP_ROPES makes it more.
int numRopes()
{
	const char* const given = getenv("EP_ROPES");
	return given ? atoi(given) : 50;
}

void expectNothingMade(unsigned seed, double innerError = btElasticPlasticSolverSettings().m_innerError)
{
	const RandomRope random(seed);
	Rope rope(random.m_settings);
	btElasticPlasticSolverSettings settings = solverOf(rope.m_world).getSettings();
	settings.m_innerError = innerError;
	ASSERT_TRUE(solverOf(rope.m_world).setSettings(settings));
	for (const auto& body : rope.m_world.bodies())
		body->setFlags(0);
	const Gain gain = gainOf(rope.m_world, random.m_stepping, 2 * WINDOW);
	const testing::Message which = testing::Message()
								   << "seed " << seed << ", " << random.m_settings.links << " links, "
								   << random.m_stepping.name() << ", inner error " << innerError;
	EXPECT_LE(gain.m_byJoints, BY_JOINTS) << which;
	EXPECT_LE(gain.m_later, BY_JOINTS + byPrecision(0, double(SIMD_EPSILON) * sqrt(gain.m_substeps))) << which;
}

TEST(Taut, RandomRopesMakeNoEnergy)
{
	for (int seed = 0; seed < numRopes(); ++seed)
		expectNothingMade(unsigned(seed));
	// Of the first thousand these made up to 60 per cent, in steps in which a slack rope becomes taut, or of which the control changes the length.
	for (const unsigned seed : {215u, 547u, 574u, 659u, 742u, 797u, 824u, 993u})
		for (const double innerError : {btElasticPlasticSolverSettings().m_innerError, 0.})
			expectNothingMade(seed, innerError);
}

TEST(Taut, StripsAndBarsMakeNoEnergy)
{
	Strip::Settings cases[6];
	cases[0].mass = 200;
	cases[2].parts = 4;
	cases[3].parts = 16;
	cases[4].length = 20;
	cases[4].width = 0.05;
	cases[4].height = 0.02;
	cases[4].parts = 10;
	cases[4].mass = 1000;
	cases[4].yieldStress = 355e6;
	cases[5].length = 10;
	cases[5].width = cases[5].height = 0.02;
	cases[5].parts = 10;
	cases[5].mass = 500;
	for (const Strip::Settings& settings : cases)
		for (const Stepping& stepping : STEPPINGS)
		{
			Strip strip(settings);
			expectNothingMade(strip.m_world, stepping, 9,
							  "strip of " + std::to_string(settings.length) + " m, " + std::to_string(settings.parts) +
								  " parts a half, mass of " + std::to_string(settings.mass) + " kg");
		}
}

TEST(Taut, ABallSwingsAsItShould)
{
	for (double ball : {1000., 100000.})
		for (int links : {4, 16})
			for (int rate : {30, 60, 240})
			{
				Rope::Settings settings;
				settings.ball = ball;
				settings.links = links;
				settings.link = 0.5;
				settings.angle = 0.05;
				settings.stiffness = 2e9;  // stretches by 5 mm at most, which makes the period longer by 0.03 %
				Rope rope(settings);
				std::vector<double> zeros;
				btScalar former = rope.m_ball->getCenterOfMassPosition().x();
				for (int i = 1; i < 15 * rate; ++i)
				{
					run(rope.m_world, 1, btScalar(1) / btScalar(rate));
					const btScalar x = rope.m_ball->getCenterOfMassPosition().x();
					if ((x > 0) != (former > 0))
						zeros.push_back((i - 1 + double(former / (former - x))) / rate);
					former = x;
				}
				ASSERT_GE(zeros.size(), 5u);
				// 1 %: the first step's length, and Bullet's rounding of small angles in float.
				expectClose(rope.period(), 2 * (zeros.back() - zeros.front()) / double(zeros.size() - 1), 0.01);
			}
}

TEST(Taut, ABallHangsAsLowAsItShould)
{
	for (double ball : {10., 1000.})
		for (int links : {4, 16})
			for (double link : {0.5, 50.})
				for (int rate : {30, 60, 240})
				{
					Rope::Settings settings;
					settings.ball = ball;
					settings.links = links;
					settings.link = link;
					settings.angle = 0;
					Rope rope(settings);
					run(rope.m_world, 4 * rate, btScalar(1) / btScalar(rate));
					double mean = 0;
					for (int i = 0; i < rate; ++i)
					{
						run(rope.m_world, 1, btScalar(1) / btScalar(rate));
						mean += rope.elongation() / rate;
					}
					// 1 %, and the rounding of places of 8 m.
					EXPECT_NEAR(rope.staticElongation(), mean,
								0.01 * rope.staticElongation() + 16 * double(SIMD_EPSILON))
						<< ball << " kg, " << links << " links of " << link << " kg, rate " << rate;
				}
}

/// A rope that spins end over end without gravity.
struct SpinningRope
{
	World m_world{Solver::Direct, btVector3(0, 0, 0)};

	SpinningRope(int links, Bending bending, double spin)
	{
		btElasticPlasticCapacity capacity;
		for (int i = 0; i < 3; ++i)
			capacity.set(i, btScalar(2e7), btElasticPlasticCapacity::unlimited());
		for (int i = 3; i < BT_EP_DOF_COUNT && bending != Bending::Free; ++i)
			capacity.set(i, 2000, bending == Bending::Yielding ? 50 : btElasticPlasticCapacity::unlimited());
		const double l = 8. / links;
		btCollisionShape* box = m_world.box(btVector3(btScalar(l), btScalar(0.08), btScalar(0.08)));
		for (int i = 0; i < links; ++i)
		{
			const double x = (i + 0.5) * l - 4;
			btRigidBody* body = m_world.body(btScalar(80. / links), box, at(btScalar(x)), false);
			body->setLinearVelocity(btVector3(0, btScalar(spin * x), 0));
			body->setAngularVelocity(btVector3(0, 0, btScalar(spin)));
			if (i > 0)
				m_world.joint(*m_world.bodies()[i - 1], *body, at(btScalar(i * l - 4)), capacity);
		}
	}

	/// About the origin, along z [kg m^2/s].
	double angularMomentum() const
	{
		double sum = 0;
		for (const auto& body : m_world.bodies())
		{
			const btVector3 &x = body->getCenterOfMassPosition(), &v = body->getLinearVelocity();
			sum += (double(x.x()) * double(v.y()) - double(x.y()) * double(v.x())) / double(body->getInvMass()) +
				   double(body->getAngularVelocity().z()) / double(body->getInvInertiaDiagLocal().z());
		}
		return sum;
	}

	/// Kinetic and elastic [J].
	double energy() const
	{
		double sum = m_world.kineticEnergy();
		for (const btElasticPlasticJoint* joint : m_world.joints())
			sum += joint->getElasticEnergy();
		return sum;
	}
};

TEST(Taut, ARopeSpinsOn)
{
	for (int links : {4, 16, 64})
		for (Bending bending : {Bending::Free, Bending::Yielding})
			for (double spin : {1., 6.})
				for (const Stepping& stepping : STEPPINGS)
				{
					SpinningRope rope(links, bending, spin);
					const testing::Message which = testing::Message() << links << " links, bending " << int(bending)
																	  << ", " << spin << " rad/s, " << stepping.name();
					const double energy = rope.energy(), momentum = rope.angularMomentum();
					btElasticPlasticStepControl control;
					const btScalar dt = btScalar(1) / btScalar(stepping.rate);
					double most = 0, afterASecond = 0;
					for (int i = 0; i < 2 * stepping.rate; ++i)
					{
						if (stepping.controlled)
							control.step(rope.m_world.bullet(), rope.m_world.action(), dt);
						else
							rope.m_world.step(dt);
						most = std::max(most, rope.energy());
						if (i == stepping.rate)
							afterASecond = rope.energy();
					}
					// The matrix is solved to some 1e-12; in float, velocities are rounded by 1e-7 in each of up to 480 steps, to
					// either side.
					const double rounding = byPrecision(1e-10, 1e-5);
					EXPECT_NEAR(1, rope.angularMomentum() / momentum, rounding) << which;
					EXPECT_LE(most, energy * (1 + rounding)) << which;
					// At the beginning the rope stretches, by its tension and by what straight motion in a step leaves the circle,
					// (w dt)^2 / 2 of the radius. With the angular momentum kept, energy falls by twice the share in the length.
					double stretch = 0;
					for (const btElasticPlasticJoint* joint : rope.m_world.joints())
						stretch += double(joint->getElasticDeformation(BT_EP_AXIAL));
					const double angle = spin / stepping.rate;
					EXPECT_GE(rope.energy(), energy * (1 - angle * angle - 2 * stretch / 8 - rounding)) << which;
					// Then it spins on, but for what is left of vibrations along it.
					// Kinetic energy alone is read here: what the start has excited goes to and fro with the joints' stretch, 6e-6
					// of it at 6 rad/s and 1/30 s; in float that is also what rounding is.
					EXPECT_NEAR(afterASecond, rope.energy(), energy * 1e-5) << which;
				}
}

/// Iterations that end before the solution cannot hold a taut rope. They may let it stretch, and may not feed it.
TEST(Taut, NoSolverFeedsARope)
{
	// Of the swing's energy of 1.5 m. In float places are rounded by 5e-7 m in each step, and so is the work of impulses: one iteration
	// throws about links that are 20000 times as light as the ball. Which way that goes hangs on the last bits: 1.5e-4 and 6.4e-4 have
	// been seen in that case, and less than 1e-4 in all the others.
	const double tolerance = byPrecision(1e-9, 2e-3);
	for (const Solver solver : {Solver::Iterative, Solver::Stock})
		for (const int iterations : {1, 10, 50})
			for (const double ball : {10., 1e3, 1e5})
				for (const int links : {4, 16})
					for (const Bending bending : {Bending::Free, Bending::Yielding})
						for (const int rate : {30, 60, 240})
						{
							Rope::Settings settings;
							settings.solver = solver;
							settings.ball = ball;
							settings.links = links;
							settings.bending = bending;
							Rope rope(settings);
							rope.m_world.bullet().getSolverInfo().m_numIterations = iterations;
							const double first = rope.mechanicalEnergy(1. / rate);
							const double arm = ball * (settings.length + settings.radius) +
											   links * settings.link * settings.length / 2;
							const double swing = arm * GRAVITY * (1 - cos(settings.angle));
							double most = first;
							for (int i = 0; i < 2 * rate; ++i)
							{
								rope.m_world.step(btScalar(1) / rate);
								most = std::max(most, rope.mechanicalEnergy(1. / rate));
							}
							EXPECT_LE(most - first, tolerance * swing)
								<< "solver " << int(solver) << ", " << iterations << " iterations, ball of " << ball
								<< " kg, " << links << " links, bending " << int(bending) << ", rate " << rate;
						}
}
}  // namespace testTaut
