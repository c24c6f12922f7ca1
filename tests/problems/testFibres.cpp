// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Joints whose sections yield as a whole, against closed forms of rigid-plastic theory.

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticEnergyAudit.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticMaterials.h"
#include "scenes/Member.h"
#include "scenes/StruckBeam.h"
#include "support/Close.h"
#include "support/DirectSolver.h"
#include "support/Run.h"

namespace testFibres
{
using namespace ep;

const double SIDE = 0.02, YIELD = 250e6;                    // of a square bar [m], [Pa]
const double NP = SIDE * SIDE * YIELD, MP = NP * SIDE / 4;  // 100 kN, 500 N m

/// The square bar in strips across its height, two in each: in-plane bending with axial force lies on m = 1 - n^2 where
/// n is a multiple of 2 / strips, and at most 1 / strips^2 inside between.
btElasticPlasticSection strips(int count)
{
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
	for (int i = 0; i < count; ++i)
		for (int side = -1; side <= 1; side += 2)
			section.m_fibres.push_back({btScalar(SIDE * ((i + 0.5) / count - 0.5)), btScalar(side * SIDE / 4),
										btScalar(SIDE * SIDE / count / 2), 0});
	return section;
}

/// Steel that is so stiff that next to nothing is elastic.
btElasticPlasticMaterial stiffSteel(double factor = 100)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(YIELD));
	steel.m_youngsModulus *= btScalar(factor);
	steel.m_ultimatePlasticStrain = btScalar(1e6);
	return steel;
}

/// A body in the middle of its joint with the ground.
struct HeldBody
{
	World m_world;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;
	btVector3 m_along;

	/// \param isReversed  whether the joint's first body is the one that moves
	HeldBody(const btElasticPlasticSection& section, double mass, double inertia,
			 const btQuaternion& turn = btQuaternion(0, 0, 0, 1), bool isReversed = false, double stiffness = 100,
			 Solver solver = Solver::Direct)
		: m_world(solver, btVector3(0, 0, 0))
	{
		const btTransform frame(turn);
		btCollisionShape* const box = m_world.box(btVector3(1, 1, 1));
		btRigidBody* const ground = m_world.body(0, box, frame, false);
		m_body = m_world.body(btScalar(mass), box, frame, false);
		m_body->setMassProps(btScalar(mass), btVector3(btScalar(inertia), btScalar(inertia), btScalar(inertia)));
		m_body->updateInertiaTensor();
		m_along = frame.getBasis().getColumn(0);
		const btElasticPlasticCapacity capacity =
			btElasticPlasticCapacity::fromMember(stiffSteel(stiffness), section, 1, 1);
		// The frame turns with the bodies: with them the other way round, tension is still positive.
		m_joint = isReversed ? m_world.joint(*m_body, *ground, frame, capacity)
							 : m_world.joint(*ground, *m_body, frame, capacity);
	}
};

TEST(Fibres, BearTheMomentThatAnAxialForceLeaves)
{
	struct Way
	{
		bool isReversed;
		Solver solver;
	};
	for (const double n : {0., 0.25, 0.5, 0.75})
		for (const Way way : {Way{false, Solver::Direct}, Way{true, Solver::Direct}, Way{false, Solver::Iterative},
							  Way{true, Solver::Iterative}})
		{
			const bool isReversed = way.isReversed;
			// Turns at 0.5 rad/s whatever the joint does.
			HeldBody held(strips(8), 10, 1e6, btQuaternion(btVector3(1, 2, 3).normalized(), 1), isReversed, 100,
						  way.solver);
			held.m_body->setAngularVelocity(held.m_world.bodies().back()->getWorldTransform().getBasis().getColumn(2) /
											2);
			for (int i = 0; i < 120; ++i)
			{
				held.m_body->applyCentralForce(held.m_along * btScalar(n * NP * (isReversed ? -1 : 1)));
				held.m_world.step(btScalar(1) / 960);
			}
			const double moment = held.m_joint->getAppliedForce(BT_EP_BENDING_Z);
			// The force keeps its direction while the section turns by 0.06 rad, half of it counting: cos gives 0.05 % of N, and as
			// much of M at most; the body's own acceleration is nothing beside that.
			EXPECT_NEAR(MP * (1 - n * n), std::fabs(moment), 2e-3 * MP) << n;
			EXPECT_NEAR(n * NP, std::fabs(held.m_joint->getAppliedForce(BT_EP_AXIAL)), 1e-3 * NP) << n;
		}
}

TEST(Fibres, StopABodyThatFliesAndTurns)
{
	// Np = 20 kN, Mp = 500 N m, |m| + n^2 = 1; by integration of the rigid-plastic equations 10 kg and 0.241667 kg m^2 at 4 m/s and
	// 40 rad/s come to rest after 4.93447 mm and 0.446669 rad. Slower by a factor and heavier by the same, so that the turn is small
	// as in that reference.
	const double slower = 5;
	btElasticPlasticSection section = strips(200);
	const double share = 20e3 / NP, height = 4 * 500 / 20e3 / SIDE;
	for (int i = 0; i < section.m_fibres.size(); ++i)
	{
		section.m_fibres[i].m_area *= btScalar(share);
		section.m_fibres[i].m_y *= btScalar(height);
	}
	section.m_area *= btScalar(share);
	section.m_secondMoment[1] *= btScalar(share * height * height);
	HeldBody held(section, 10 * slower, 0.241667 * slower, btQuaternion(0, 0, 0, 1), false, 3e4);
	held.m_body->setLinearVelocity(btVector3(btScalar(4 / slower), 0, 0));
	held.m_body->setAngularVelocity(btVector3(0, 0, btScalar(40 / slower)));
	const int rate = 61440;
	for (int i = 0; i < rate / 16; ++i)
		held.m_world.step(btScalar(1) / rate);
	EXPECT_NEAR(4.93447e-3, slower * held.m_joint->getPlasticDeformation(BT_EP_AXIAL), 0.01 * 4.93447e-3);
	EXPECT_NEAR(0.446669, slower * held.m_joint->getPlasticDeformation(BT_EP_BENDING_Z), 0.01 * 0.446669);
}

/// A beam of 1 m between two supports that do not give way, of two rigid halves with a body between them.
struct FixedBeam
{
	World m_world;
	btRigidBody* m_middle;
	std::vector<btElasticPlasticJoint*> m_joints;

	FixedBeam(const btElasticPlasticSection& section, double mass, double stiffness)
		: m_world(Solver::Direct, btVector3(0, 0, 0))
	{
		const btElasticPlasticMaterial steel = stiffSteel(stiffness);
		btCollisionShape* const half = m_world.box(btVector3(btScalar(0.5), btScalar(SIDE), btScalar(SIDE)));
		btCollisionShape* const cube = m_world.box(btVector3(btScalar(0.1), btScalar(0.1), btScalar(0.1)));
		btRigidBody* const bodies[] = {
			m_world.body(0, cube, at(0), false), m_world.body(btScalar(0.01), half, at(btScalar(0.25)), false),
			m_world.body(btScalar(mass), cube, at(btScalar(0.5)), false),
			m_world.body(btScalar(0.01), half, at(btScalar(0.75)), false), m_world.body(0, cube, at(1), false)};
		m_middle = bodies[2];
		for (int i = 0; i < 4; ++i)
		{
			const bool isPartFirst = i % 2 == 1;
			m_joints.push_back(
				m_world.joint(*bodies[i], *bodies[i + 1], at(btScalar((i + 1) / 2 * 0.5)),
							  btElasticPlasticCapacity::fromMember(steel, section, btScalar(isPartFirst ? 0.5 : 0),
																   btScalar(isPartFirst ? 0 : 0.5))));
		}
	}

	double sag() const { return -double(m_middle->getCenterOfMassPosition().y()); }
};

TEST(Fibres, HoldABeamThatIsStruckAsACableDoes)
{
	// Haythornthwaite's fixed beam takes up P_c (w + w^3 / 3h^2) to w = h and P_c (4h/3 + (w^2 - h^2) / h) beyond.
	const double exact[][2] = {{25, 6.064e-3}, {100, 19.149e-3}, {400, 43.205e-3}, {900, 66.081e-3}};
	const btElasticPlasticSection square = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
	const struct
	{
		btElasticPlasticSection m_section;
		double m_stiffness;
		int m_rate;
		double m_tolerance;
	} cases[] = {
		{strips(16), 1000, 3840, 0.01},
		// Fibres that bear shear, of which there is a twenty-fifth of what yields. As the bar's halves rock, its ends slip to and fro elastically: where that
		// counted as flow it took a quarter of their moments, and the beam went up to 6 % further. 16 fibres are right within 2.4 %.
		{square.withFibres(), 100, 960, 0.024},
		{square.withFibres(), 100, 3840, 0.024}};
	for (const auto& c : cases)
		for (const auto& blow : exact)
		{
			FixedBeam beam(c.m_section, 500, c.m_stiffness);
			beam.m_middle->setLinearVelocity(btVector3(0, btScalar(-std::sqrt(2 * blow[0] / 500)), 0));
			double most = 0;
			for (int i = 0; i < c.m_rate / 2; ++i)
			{
				beam.m_world.step(btScalar(1) / btScalar(c.m_rate));
				most = std::fmax(most, beam.sag());
			}
			EXPECT_NEAR(blow[1], most, c.m_tolerance * blow[1]) << c.m_rate;
		}
}

/// A beam of square bar, of blocks in a plane between two supports that do not give way, with a heavy body in the middle that strikes it: explicit,
/// each joint in strips that yield by themselves. It shares nothing with the library. (PlanarBlocks' joints know no strips.)
class StruckBeamByStrips
{
public:
	/// \param half  number of blocks of each half
	StruckBeamByStrips(int half, int strips, double mass, double speed) : m_middle(half + 1), m_strips(strips)
	{
		const double l = 0.5 / half, area = SIDE * SIDE, blockMass = 7850 * area * l;
		double x = 0;
		m_blocks.push_back({});
		for (int i = 0; i < 2 * half; ++i, x += l)
		{
			if (i == half)
				m_blocks.push_back({mass, 1e6, {x, 0}, {0, -speed}, 0, 0});
			m_blocks.push_back({blockMass, blockMass * (l * l + area) / 12, {x + l / 2, 0}, {0, 0}, 0, 0});
		}
		m_blocks.push_back({0, 0, {x, 0}, {0, 0}, 0, 0});
		for (size_t i = 0; i + 1 < m_blocks.size(); ++i)
		{
			const bool isRigidA = i == 0 || i == m_middle, isRigidB = i + 1 == m_middle || i + 2 == m_blocks.size();
			const double a = isRigidA ? 0 : l / 2, b = isRigidB ? 0 : l / 2, bending = YOUNGS * area * area / 12;
			Joint joint = {a, b, 0, 0, 0, {}};
			joint.shear = (a + b) / (YOUNGS / 2.6 * area * 5 / 6) + (a * a * a + b * b * b) / (3 * bending);
			joint.coupling = -(b - a) / 2 * (a + b) / bending;
			joint.plastic.assign(size_t(strips), 0.);
			m_joints.push_back(joint);
		}
	}

	/// \return the sag at which it comes to rest
	double strike(double dt)
	{
		while (m_blocks[m_middle].velocity[1] < 0)
			step(dt);
		return -m_blocks[m_middle].place[1];
	}

private:
	static constexpr double YOUNGS = 200e9;
	struct Block
	{
		double mass, inertia, place[2], velocity[2], angle, spin;
		double force[2] = {0, 0}, torque = 0;
		Block(double m = 0, double i = 0, std::array<double, 2> x = {}, std::array<double, 2> v = {}, double a = 0,
			  double w = 0)
			: mass(m), inertia(i), place{x[0], x[1]}, velocity{v[0], v[1]}, angle(a), spin(w)
		{
		}
	};
	struct Joint
	{
		double a, b;             ///< to the middles of its blocks
		double shear, coupling;  ///< compliance of shear, and between it and bending
		double slip;
		std::vector<double> plastic;  ///< by strip
	};

	double heightOf(size_t strip) const { return SIDE * ((double(strip) + 0.5) / m_strips - 0.5); }

	/// What strips bear, and their flow. \return axial force and moment
	std::array<double, 2> stretch(Joint& joint, double axial, double turn, bool flows) const
	{
		const double area = SIDE * SIDE / m_strips, stiffness = YOUNGS * area / (joint.a + joint.b);
		double force = 0, moment = 0;
		for (size_t i = 0; i < joint.plastic.size(); ++i)
		{
			const double trial = stiffness * (axial - heightOf(i) * turn - joint.plastic[i]),
						 f = std::fmax(-area * YIELD, std::fmin(area * YIELD, trial));
			if (flows)
				joint.plastic[i] += (trial - f) / stiffness;
			force += f;
			moment -= heightOf(i) * f;
		}
		return {force, moment};
	}

	void pull(Block& A, Block& B, Joint& joint)
	{
		const double armA[] = {joint.a * std::cos(A.angle), joint.a * std::sin(A.angle)},
					 armB[] = {-joint.b * std::cos(B.angle), -joint.b * std::sin(B.angle)};
		const double gap[] = {B.place[0] + armB[0] - A.place[0] - armA[0], B.place[1] + armB[1] - A.place[1] - armA[1]};
		const double c = std::cos((A.angle + B.angle) / 2), s = std::sin((A.angle + B.angle) / 2),
					 e[] = {c * gap[0] + s * gap[1], c * gap[1] - s * gap[0], B.angle - A.angle};
		// The member bows with its elastic turn.
		double plasticTurn = 0, squares = 0;
		for (size_t i = 0; i < joint.plastic.size(); ++i)
		{
			plasticTurn -= heightOf(i) * joint.plastic[i];
			squares += heightOf(i) * heightOf(i);
		}
		const double length = joint.a + joint.b, elastic = e[2] - plasticTurn / squares,
					 axial = e[0] - length * elastic * elastic / 12, mostShear = SIDE * SIDE * YIELD / 2;
		// The shear force that belongs to the slip, as it turns the strips.
		const double slip = e[1] - joint.slip;
		double V = std::fmax(-mostShear, std::fmin(mostShear, slip / joint.shear));
		if (joint.coupling != 0)
		{
			double low = -mostShear, high = mostShear;
			for (int k = 0; k < 30; ++k)
			{
				V = (low + high) / 2;
				const double moment = stretch(joint, axial, e[2] - joint.coupling * V, false)[1];
				(joint.shear * V + joint.coupling * moment > slip ? high : low) = V;
			}
		}
		const std::array<double, 2> NM = stretch(joint, axial, e[2] - joint.coupling * V, true);
		if (std::fabs(V) > (1 - 1e-9) * mostShear)
			joint.slip = e[1] - joint.shear * V - joint.coupling * NM[1];
		const double N = NM[0], M = NM[1] - N * length * elastic / 6, force[] = {c * N - s * V, s * N + c * V},
					 turn = (N * e[1] - V * e[0]) / 2;
		for (int k = 0; k < 2; ++k)
		{
			A.force[k] += force[k];
			B.force[k] -= force[k];
		}
		A.torque += armA[0] * force[1] - armA[1] * force[0] - turn + M;
		B.torque -= armB[0] * force[1] - armB[1] * force[0] + turn + M;
	}

	void step(double dt)
	{
		for (Block& b : m_blocks)
			b.force[0] = b.force[1] = b.torque = 0;
		for (size_t i = 0; i < m_joints.size(); ++i)
			pull(m_blocks[i], m_blocks[i + 1], m_joints[i]);
		for (size_t i = 1; i + 1 < m_blocks.size(); ++i)
		{
			Block& b = m_blocks[i];
			for (int k = 0; k < 2; ++k)
				b.place[k] += dt * (b.velocity[k] += dt * b.force[k] / b.mass);
			b.angle += dt * (b.spin += dt * b.torque / b.inertia);
		}
	}

	size_t m_middle;
	int m_strips;
	std::vector<Block> m_blocks;
	std::vector<Joint> m_joints;
};

TEST(Fibres, HoldABeamOfRealSteelThatIsStruck)
{
	// The same with mass and elasticity of its own, in 20 parts, struck in the middle by 50 kg. Moments and tension each by itself stop the last one at
	// 39 mm. The other program is right within 1e-4: 10.00, 23.37, 46.84 mm.
	const int rate = 122880;
	for (const double speed : {1., 2., 4.})
	{
		const StruckBeam::Settings settings = StruckBeam::ofSteel(Solver::Direct, strips(24), speed);
		StruckBeam beam(settings);
		while (beam.sagRate() > 0)
			beam.m_world.step(btScalar(1) / rate);
		// It is 0.7, 0.6 and 0.3 % less. With a quarter of the step that is 1.4, 1.2 and 0.7, with an eighth more 0.1, 0.0 and 0.0 %: axial waves of blocks of
		// 50 mm take 0.03 ms.
		const double exact = StruckBeamByStrips(settings.halfParts, 24, settings.mass, speed).strike(4e-6);
		EXPECT_NEAR(exact, beam.sag(), 0.01 * exact) << speed;
	}
}

/// The concrete in eight strips.
btElasticPlasticSection stripsOfConcrete()
{
	const double width = 0.3, height = 0.5;
	const int count = 8;
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(width), btScalar(height));
	for (int i = 0; i < count; ++i)
		for (const double z : {-width / 4, width / 4})
			section.m_fibres.push_back(
				{btScalar(height * ((i + 0.5) / count - 0.5)), btScalar(z), btScalar(width * height / count / 2), 0});
	return section;
}

/// Largest sag of the middle [m] and pressure at the support [N] in the first quarter of a second.
void strikeConcrete(bool isHeld, double tensileShare, double& sag, double& pressure)
{
	StruckBeam beam(StruckBeam::ofConcrete(Solver::Direct, stripsOfConcrete(), isHeld, tensileShare));
	sag = pressure = 0;
	for (int i = 0; i < 960; ++i)
	{
		beam.m_world.step(btScalar(1) / 3840);
		sag = std::fmax(sag, beam.sag());
		pressure = std::fmax(pressure, -double(beam.m_atSupport->getAppliedForce(BT_EP_AXIAL)));
	}
}

TEST(Fibres, HoldABeamOfConcreteThatIsStruckByItsArch)
{
	// By another program of planar beams at the same step, in which concrete is next to nothing in tension, and bears as soon as it is pressed again: 203.8 mm
	// where an end may move, and 71.2 mm with 2156 kN at the support where it may not. A peak of a force is of the waves that a step leaves.
	double sag = 0, pressure = 0;
	strikeConcrete(false, 1e-6, sag, pressure);
	EXPECT_NEAR(0.2038, sag, 0.01 * 0.2038);
	strikeConcrete(true, 1e-6, sag, pressure);
	EXPECT_NEAR(0.0712, sag, 0.01 * 0.0712);
	EXPECT_NEAR(2156e3, pressure, 0.02 * 2156e3);
	// A crack that has to close first leaves less of the arch.
	double sagOfCracks = 0, pressureOfCracks = 0;
	strikeConcrete(true, 0, sagOfCracks, pressureOfCracks);
	EXPECT_GT(sagOfCracks, sag);
	EXPECT_LT(pressureOfCracks, 0.9 * pressure);
}

/// A cantilever of blocks along x of a frame, from a support that does not move.
struct FibreCantilever
{
	World m_world;
	Member m_member;
	std::vector<btElasticPlasticJoint*> m_joints;

	static Member::Settings settings(const btElasticPlasticMaterial& material, const btElasticPlasticSection& section,
									 int parts, double length)
	{
		Member::Settings settings;
		settings.material = material;
		// Cubes: Bullet turns a body without regard to what its inertia does in other directions, which would show in the balance.
		settings.width = settings.height = btScalar(length / parts);
		settings.partMass = btScalar(7800 * SIDE * SIDE * length / parts);
		settings.parts = parts;
		settings.capacityOf = [=](btScalar a, btScalar b)
		{ return btElasticPlasticCapacity::fromMember(material, section, a, b); };
		return settings;
	}

	FibreCantilever(const btElasticPlasticMaterial& material, const btElasticPlasticSection& section, int parts,
					double length, const btVector3& gravity, const btQuaternion& turn = btQuaternion(0, 0, 0, 1))
		: m_world(Solver::Direct, gravity),
		  m_member(m_world, settings(material, section, parts, length), btTransform(turn), btScalar(length))
	{
		m_member.joinStart(m_world, *m_world.body(0, m_world.box(btVector3(1, 1, 1)), btTransform(turn), false));
		m_joints = m_member.joints();
	}

	btVector3 tip() const { return m_member.last().getCenterOfMassPosition(); }
};

TEST(Fibres, AreAsStiffAsIndependentDegreesOfFreedom)
{
	// At rest below yield: with one block, where shear and bending are coupled, and with four; bent about both axes, and pulled.
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(1e10));
	const btElasticPlasticSection shape = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
	for (const int parts : {1, 4})
	{
		btVector3 tips[2];
		for (const bool isWhole : {false, true})
		{
			FibreCantilever beam(steel, isWhole ? shape.withFibres() : shape, parts, 1, btVector3(0, 0, 0));
			for (int i = 0; i < 240; ++i)
			{
				beam.m_member.last().applyCentralForce(btVector3(1000, 10, 20));
				beam.m_world.step(FRAME);
			}
			tips[isWhole] = beam.tip();
		}
		// In float places of half a metre are rounded by 3e-8 m, a ten thousandth of the sag.
		const double sag = std::fabs(double(tips[0].z()));
		EXPECT_GT(sag, 1e-4);
		for (int k = 1; k < 3; ++k)
			EXPECT_NEAR(tips[0][k], tips[1][k], byPrecision(1e-6, 1e-3) * sag) << parts << " parts, axis " << k;
	}
}

TEST(Fibres, LeaveInItsPlaneWhatStandsInOne)
{
	// A bar that sags, and one that flows, in the direction of its width and of its height, with joints between halves and at an end. What fibres have on both sides
	// of the plane cancels: of rounding that is left products are no normal numbers in float, and take processors several times as long.
	const btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(2 * SIDE)).withFibres(8);
	for (const double yield : {1e10, YIELD})
		for (const int across : {1, 2})
		{
			FibreCantilever beam(btElasticPlasticMaterial::steel(btScalar(yield)), section, 6, 1, btVector3(0, 0, 0));
			btVector3 load(100, 0, 0);
			load[across] = -2000;
			for (int i = 0; i < 60; ++i)
			{
				beam.m_member.last().applyCentralForce(load);
				beam.m_world.step(FRAME);
			}
			double flow = 0;
			for (const btElasticPlasticJoint* joint : beam.m_joints)
				flow += joint->getPlasticEnergy();
			const bool flows = flow > 0, yields = yield < 1e10;
			EXPECT_EQ(yields, flows);
			for (const auto& body : beam.m_world.bodies())
			{
				const btVector3 &velocity = body->getLinearVelocity(), &spin = body->getAngularVelocity();
				for (const btScalar beside : {velocity[3 - across], spin.x(), spin[across]})
					EXPECT_EQ(0, beside) << yield << " Pa along axis " << across;
			}
		}
}

TEST(Fibres, OfOneSidedBarsBendAboutTheirElasticCentroid)
{
	// A cantilever of concrete that does not crack, with 4000 mm^2 of bars in its lower face, under a load at its tip.
	const double length = 4, width = 0.3, height = 0.5, youngs = 30e9, ratio = 200. / 30, bars = 4000e-6, place = -0.21,
				 load = 1e5;
	btElasticPlasticMaterial concrete;
	concrete.m_youngsModulus = btScalar(youngs);
	concrete.m_yieldStress = btScalar(1e10);
	concrete.m_dampingRatio = btScalar(0.1);
	const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(1e10));
	btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(width), btScalar(height)).withFibres(36);
	for (const double z : {-0.1, 0.1})
		section.addBar(btScalar(place), btScalar(z), btScalar(bars / 2), steel);
	const double area = width * height + ratio * bars, centroid = ratio * bars * place / area,
				 second = width * height * (height * height / 12 + centroid * centroid) +
						  ratio * bars * (place - centroid) * (place - centroid),
				 exact = load * (length * length * length / (3 * youngs * second) +
								 length / (double(concrete.shearModulus()) * double(section.m_shearArea[0])));
	for (const int parts : {2, 4, 8})
	{
		FibreCantilever beam(concrete, section, parts, length, btVector3(0, 0, 0));
		const btVector3 end(btScalar(length / parts / 2), 0, 0);
		btRigidBody& last = beam.m_member.last();
		for (int i = 0; i < 8 * 240; ++i)
		{
			last.applyForce(btVector3(0, btScalar(-load), 0), last.getCenterOfMassTransform().getBasis() * end);
			beam.m_world.step(btScalar(1) / 240);
		}
		const double sag = -double((last.getCenterOfMassTransform() * end).y());
		// What shear turns a part of the length l by at its end goes by l^2; the material's damping leaves some ten-thousandths. About the
		// concrete's own middle the sag would be 4 % less.
		EXPECT_NEAR(exact, sag, (0.06 / (parts * parts) + byPrecision(5e-4, 1e-3)) * exact) << parts;
	}
}

TEST(Fibres, KeepTheBalanceOfEnergy)
{
	// A bar that falls, flows and tears fibre by fibre, in the direction of its width and of its height, in frames of any orientation.
	for (const double ductility : {1e6, 0.002})
		for (const int rate : {60, 480})
			for (const btQuaternion& turn :
				 {btQuaternion(0, 0, 0, 1), btQuaternion(btVector3(3, 1, 2).normalized(), 2)})
			{
				btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(YIELD));
				steel.m_ultimatePlasticStrain = btScalar(ductility);
				const btVector3 gravity = quatRotate(turn, btVector3(0, -300, -200));
				FibreCantilever bar(steel,
									btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE)).withFibres(), 4,
									1, gravity, turn);
				btElasticPlasticEnergyAudit audit(bar.m_world.bullet(), bar.m_world.action());
				for (int i = 0; i < rate; ++i)
				{
					audit.begin();
					bar.m_world.step(btScalar(1) / rate);
				}
				bool hasRuptured = false, hasYielded = false;
				for (const btElasticPlasticJoint* joint : bar.m_joints)
				{
					for (int f = 0; f < joint->getState().m_fibres.size(); ++f)
						hasRuptured |= joint->getState().m_fibres[f].isRuptured();
					hasYielded |= joint->hasYielded();
				}
				EXPECT_EQ(ductility < 1, hasRuptured);
				EXPECT_TRUE(hasYielded);
				// As of independent degrees of freedom, Energy.IsAudited.
				EXPECT_NEAR(0, audit.getBalance().m_rest, byPrecision(1e-9, 1e-5) * audit.getBalance().m_turnover);
				EXPECT_GT(audit.getBalance().m_gravity, 0);
			}
}

TEST(Fibres, OfConcreteOpenWithoutAForceAndBearWhenTheyHaveClosed)
{
	// A block that stands on the joint, heavy enough to be pressed, is tilted by a push and comes back: nothing tears, and it stands
	// as before.
	btElasticPlasticMaterial concrete;
	concrete.m_youngsModulus = btScalar(30e9);
	concrete.m_yieldStress = btScalar(30e6);
	concrete.m_tensileShare = 0;
	const btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(0.3), btScalar(0.3)).withFibres(36);
	World world(Solver::Direct, btVector3(-10, 0, 0));
	btCollisionShape* const box = world.box(btVector3(1, btScalar(0.3), btScalar(0.3)));
	btRigidBody* const ground = world.body(0, box, at(btScalar(-0.5)), false);
	btRigidBody* const block = world.body(1000, box, at(btScalar(0.5)), false);
	btElasticPlasticJoint* const joint =
		world.joint(*ground, *block, at(0), btElasticPlasticCapacity::fromMember(concrete, section, 1, 1));
	run(world, 60);
	const btVector3 before = block->getCenterOfMassPosition();
	// Weight times half the width is all the moment that resists: 1500 N m. With 10 J it turns by 7 mrad.
	block->setAngularVelocity(btVector3(0, 0, btScalar(0.25)));
	block->setLinearVelocity(btVector3(0, btScalar(0.125), 0));
	double most = 0;
	for (int i = 0; i < 4 * 480; ++i)
	{
		world.step(btScalar(1) / 480);
		most = std::fmax(most, block->getCenterOfMassPosition().y());
		EXPECT_LE(joint->getForce(BT_EP_AXIAL), byPrecision(1e-6, 1));
	}
	EXPECT_GT(most, 1e-3);
	EXPECT_FALSE(joint->hasYielded());
	EXPECT_EQ(0, joint->getDamage());
	EXPECT_EQ(0, joint->getPlasticEnergy());
	EXPECT_NEAR(0, double((block->getCenterOfMassPosition() - before).length()), 1e-3);
}

TEST(Fibres, RuptureOneAfterAnother)
{
	// Four bars that are pulled alike, two of which are the more brittle steel.
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
	for (int i = 0; i < 4; ++i)
		section.m_fibres.push_back({btScalar(i % 2 ? SIDE : -SIDE), btScalar(i < 2 ? SIDE : -SIDE), btScalar(1e-4), 0});
	btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(stiffSteel(1), section, 1, 1);
	for (int i = 0; i < 4; ++i)
		capacity.m_fibres[i].m_stretchLimit = btScalar(i == 0 || i == 3 ? 0.01 : 0.02);
	World world(Solver::Direct, btVector3(0, 0, 0));
	btCollisionShape* const box = world.box(btVector3(1, 1, 1));
	btElasticPlasticJoint* const joint =
		world.joint(*world.body(0, box, at(0), false), *world.body(1e5, box, at(0), false), at(0), capacity);
	btRigidBody& body = joint->getConstraint().getRigidBodyB();
	double forces[5] = {};
	for (int i = 0; i < 240; ++i)
	{
		body.setLinearVelocity(btVector3(btScalar(0.1), 0, 0));
		world.step(btScalar(1) / 480);
		const btElasticPlasticState& state = joint->getState();
		if (joint->isBroken())
			break;
		int left = 0;
		for (int k = 0; k < 4; ++k)
			left += !state.m_fibres[k].isRuptured();
		forces[left] = joint->getForce(BT_EP_AXIAL);
	}
	// Each bears 25 kN, two over 10 and two over 20 mm. In the step of a rupture the force is what the others still bear.
	EXPECT_NEAR(100e3, forces[4], 1);
	EXPECT_NEAR(50e3, forces[2], 1);
	EXPECT_EQ(0, forces[3] + forces[1]);
	EXPECT_TRUE(joint->isBroken());
	EXPECT_EQ(1, joint->getDamage());
	// No more than the ductility allows: what a step deforms beyond that is not plastic.
	expectClose(50e3 * 0.03, joint->getPlasticEnergy(), byPrecision(1e-9, 1e-5));
}

/// A body that a force nobody resists moves along the joint with the ground.
struct PulledBody
{
	World m_world;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;

	PulledBody(const btElasticPlasticCapacity& capacity, Solver solver = Solver::Direct)
		: m_world(solver, btVector3(0, 0, 0))
	{
		btCollisionShape* const box = m_world.box(btVector3(1, 1, 1));
		btRigidBody* const ground = m_world.body(0, box, at(btScalar(-0.5)), false);
		m_body = m_world.body(btScalar(1e6), box, at(btScalar(0.5)), false);
		m_joint = m_world.joint(*ground, *m_body, at(0), capacity);
	}

	/// Moves on, in steps of 1/480 s. \param speed  [m/s]
	void pull(double speed, int steps)
	{
		for (int i = 0; i < steps && !m_joint->isBroken(); ++i)
		{
			m_body->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
			m_world.step(btScalar(1) / 480);
		}
	}
};

TEST(Fibres, BreakUnderSolversThatDoNotKnowThem)
{
	// A rod that is pulled beyond its ductility of 5 cm, by Miner's sum as without fibres.
	btElasticPlasticMaterial steel = stiffSteel(1);
	steel.m_ultimatePlasticStrain = btScalar(0.05);
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock, Solver::Mlcp})
	{
		PulledBody pulled(btElasticPlasticCapacity::fromMember(steel, section.withFibres(), 1, 1), solver);
		pulled.pull(0.1, 230);
		EXPECT_FALSE(pulled.m_joint->isBroken());
		EXPECT_GT(pulled.m_joint->getDamage(), 0.9);
		pulled.pull(0.1, 30);
		EXPECT_TRUE(pulled.m_joint->isBroken());
		expectClose(NP * 0.05, pulled.m_joint->getPlasticEnergy(), byPrecision(1e-9, 1e-4));
	}
}

TEST(Fibres, ThatAreLeftInALineAreAHinge)
{
	// All but two fibres at one place of the height are torn: the body turns about them many times, and nobody pays for it.
	for (const int left : {1, 2, 4})
	{
		btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
			stiffSteel(1), btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE)).withFibres(), 1, 1);
		capacity.m_length = 0;
		World world(Solver::Direct, btVector3(0, 0, 0));
		btCollisionShape* const box = world.box(btVector3(1, btScalar(0.1), btScalar(0.1)));
		btElasticPlasticJoint* const joint =
			world.joint(*world.body(0, box, at(btScalar(-0.5)), false), *world.body(100, box, at(btScalar(0.5)), false),
						at(0), capacity);
		btRigidBody& body = joint->getConstraint().getRigidBodyB();
		btElasticPlasticState state = joint->getState();
		for (int i = left; i < state.m_fibres.size(); ++i)
			state.m_fibres[i].m_damage = 1;
		ASSERT_TRUE(joint->setState(state));
		body.setAngularVelocity(btVector3(0, 0, 10));
		body.setLinearVelocity(btVector3(0, 5, 0));
		const double before = world.kineticEnergy();
		for (int i = 0; i < 4 * 480; ++i)
		{
			world.step(btScalar(1) / 480);
			ASSERT_LT(world.kineticEnergy(), 1.001 * before) << left;
		}
		// Flow counts by a step's last velocity, work by its mean one.
		EXPECT_LT(joint->getPlasticEnergy() + joint->getElasticEnergy(), joint->getWork() + 0.05 * before) << left;
		EXPECT_FALSE(joint->isBroken());
		for (const btScalar strain : joint->getState().m_fibreStrain)
			EXPECT_LT(btFabs(strain), 1);
	}
}

/// Brick: bears 1 MPa in compression, and a tenth of it in tension until it cracks at 1 mm.
btElasticPlasticCapacity brick(double tensileShare)
{
	btElasticPlasticMaterial brick;
	brick.m_youngsModulus = btScalar(5e9);
	brick.m_yieldStress = btScalar(1e6);
	brick.m_tensileShare = btScalar(tensileShare);
	brick.m_ultimatePlasticStrain = btScalar(1e-3);
	brick.m_crushingStrain = btScalar(0.1);
	return btElasticPlasticCapacity::fromMember(
		brick, btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(), 1, 1);
}

TEST(Fibres, ThatCrackBearWhenTheyHaveClosed)
{
	// Pulled by 1 mm, of which fibres bear 1 kN, 0.05 mm more, and back: all of it is the crack's width, and they close where they were whole.
	btElasticPlasticCapacity capacity = brick(0.1);
	PulledBody pulled(capacity);
	const auto force = [&] { return double(pulled.m_joint->getForce(BT_EP_AXIAL)); };
	pulled.pull(0.01, 24);
	EXPECT_NEAR(1e3, force(), 1);
	for (int i = 0; i < 16; ++i)
		EXPECT_FALSE(pulled.m_joint->getState().m_fibres[i].m_isCracked);
	pulled.pull(0.01, 26);
	EXPECT_TRUE(pulled.m_joint->getState().m_fibres[0].m_isCracked);
	EXPECT_EQ(0, force());
	// But for rounding, nothing has been crushed.
	EXPECT_NEAR(0, double(pulled.m_joint->getDamage()), byPrecision(1e-15, 1e-6));
	// Told when bodies have given it; of what they still owe when all fibres crack in one step, half in each step.
	pulled.pull(0, 40);
	expectClose(1e3 * 1e-3, pulled.m_joint->getPlasticEnergy(), byPrecision(1e-9, 1e-4));
	pulled.pull(-0.01, 26);
	EXPECT_EQ(0, force());
	pulled.pull(-0.01, 48);
	EXPECT_NEAR(-10e3, force(), 10);
	EXPECT_FALSE(pulled.m_joint->isBroken());
	// Pulled again they bear nothing as soon as they are open.
	pulled.pull(0.01, 24);
	EXPECT_EQ(0, force());
}

TEST(Fibres, ThatCrackCloseWhereTheyHaveBeenCrushedTo)
{
	// Pressed by half a millimetre, of which 0.2 mm are elastic, and torn then: whatever share of the ductility the pressing has spent.
	for (const double crushLimit : {0.1, 1e-3, 7e-4})
	{
		btElasticPlasticCapacity capacity = brick(0.1);
		for (int i = 0; i < capacity.m_fibres.size(); ++i)
			capacity.m_fibres[i].m_crushLimit = btScalar(crushLimit);
		PulledBody pulled(capacity);
		const auto elongation = [&] { return double(pulled.m_body->getCenterOfMassPosition().x()) - 0.5; };
		pulled.pull(-0.01, 24);
		while (!pulled.m_joint->getState().m_fibres[0].m_isCracked && !pulled.m_joint->isBroken())
			pulled.pull(0.01, 1);
		ASSERT_FALSE(pulled.m_joint->isBroken()) << crushLimit;
		EXPECT_EQ(0, pulled.m_joint->getForce(BT_EP_AXIAL));
		while (!(pulled.m_joint->getForce(BT_EP_AXIAL) < 0) && elongation() > -2e-3)
			pulled.pull(-0.01, 1);
		// To a step.
		EXPECT_NEAR(-0.3e-3, elongation(), 0.01 / 480 + 1e-6) << crushLimit;
	}
}

TEST(Fibres, OfASectionThatGapesThroughoutBreakTheJoint)
{
	// Nothing has ever flowed: the section is apart by more than the 1 mm that its fibres stretch.
	PulledBody pulled(brick(0));
	pulled.pull(0.01, 46);
	EXPECT_FALSE(pulled.m_joint->isBroken());
	pulled.pull(0.01, 4);
	EXPECT_TRUE(pulled.m_joint->isBroken());
	EXPECT_EQ(0, pulled.m_joint->getPlasticEnergy());
	EXPECT_EQ(1, pulled.m_joint->getDamage());
}

TEST(Fibres, ThatGapeOnOneSideTurnFarWithoutEnergyFromNothing)
{
	// A block that stands on its edge turns over it by more than a half turn, elastic and open, without a bound on the gap.
	btElasticPlasticCapacity capacity = brick(0);
	for (int i = 0; i < capacity.m_fibres.size(); ++i)
		capacity.m_fibres[i].m_stretchLimit = btElasticPlasticCapacity::unlimited();
	World world(Solver::Direct, btVector3(0, 0, 0));
	btCollisionShape* const box = world.box(btVector3(1, btScalar(0.1), btScalar(0.1)));
	btElasticPlasticJoint* const joint = world.joint(*world.body(0, box, at(btScalar(-0.5)), false),
													 *world.body(100, box, at(btScalar(0.5)), false), at(0), capacity);
	btRigidBody& body = joint->getConstraint().getRigidBodyB();
	body.setAngularVelocity(btVector3(0, 0, 20));
	body.setLinearVelocity(btVector3(0, 10, 0));
	const double before = world.kineticEnergy();
	double turn = 0;
	for (int i = 0; i < 2 * 480; ++i)
	{
		world.step(btScalar(1) / 480);
		turn += double(body.getAngularVelocity().z()) / 480;
		ASSERT_LT(world.kineticEnergy(), 1.001 * before) << i;
	}
	EXPECT_GT(turn, 3);
	EXPECT_LT(joint->getPlasticEnergy(), 0.01 * before);
}

TEST(Fibres, ThatCrackBesideABarSetNothingInMotion)
{
	// Two parts that turn against each other, of a material that hardly bears tension, with a bar near one face, by which they are pulled. What cracks or is crushed
	// bows less, and where the bar was stretched by that the parts gained ten times their energy, at steps however fine.
	struct Case
	{
		const char* m_material;
		double m_height, m_length, m_bar, m_spin;
	};
	for (const Case& c : {Case{"C24 across", 0.3, 1.8, 0.05, 3}, Case{"clay brick", 0.3, 3, 0.03, 2},
						  Case{"clay brick", 0.1, 2, 0.03, 6}, Case{"C20/25", 0.1, 2, 0.03, 6}})
		for (const int rate : {60, 1000})
		{
			World world(Solver::Direct, btVector3(0, 0, 0));
			const btScalar height = btScalar(c.m_height), length = btScalar(c.m_length);
			const btElasticPlasticMaterial material = btElasticPlasticReadyMaterial::find(c.m_material);
			btElasticPlasticSection section = btElasticPlasticSection::rectangle(height, height).withFibres();
			section.addBar(btScalar(0.4) * height, 0, btScalar(c.m_bar) * height * height,
						   btElasticPlasticReadyMaterial::find("B500B"));
			btCollisionShape* const part = world.box(btVector3(length, height, height));
			btRigidBody* bodies[2];
			for (int i = 0; i < 2; ++i)
			{
				bodies[i] = world.body(material.m_density * height * height * length, part,
									   at((btScalar(i) - btScalar(0.5)) * length), false);
				bodies[i]->setAngularVelocity(btVector3(0, 0, btScalar(i == 0 ? c.m_spin : -c.m_spin)));
				bodies[i]->setLinearVelocity(btVector3(0, btScalar(c.m_spin) * length / 2, 0));
			}
			world.joint(*bodies[0], *bodies[1], at(0),
						btElasticPlasticCapacity::fromMember(material, section, length, length));
			const double start = world.kineticEnergy();
			for (int i = 0; i < rate / 2; ++i)
			{
				world.step(btScalar(1) / btScalar(rate));
				ASSERT_LT(world.kineticEnergy(), 1.001 * start) << c.m_material << " at " << rate << ", step " << i;
			}
		}
}

TEST(Fibres, OfASectionMuchLargerThanItsBodiesHold)
{
	// Cubes of 1 cm and 0.1 g on a section of 1 m: its edge is ten thousand times as mobile by their turns as by their motion along it.
	const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
		btElasticPlasticMaterial::steel(), btElasticPlasticSection::rectangle(1, 1).withFibres(16), btScalar(0.1),
		btScalar(0.1));
	for (unsigned seed = 0; seed < 20; ++seed)
	{
		std::mt19937 engine(seed);
		const auto any = [&](double most)
		{
			const auto draw = [&] { return btScalar(most * (2 * double(engine()) / 4294967296. - 1)); };
			const btScalar x = draw(), y = draw();
			return btVector3(x, y, draw());
		};
		World world(Solver::Direct, btVector3(0, 0, 0));
		btCollisionShape* const cube = world.box(btVector3(btScalar(0.01), btScalar(0.01), btScalar(0.01)));
		btRigidBody* bodies[2];
		for (int i = 0; i < 2; ++i)
			bodies[i] = world.body(btScalar(1e-4), cube, at(btScalar(0.01 * i)), false);
		world.joint(*bodies[0], *bodies[1], at(btScalar(0.005)), capacity);
		bodies[0]->setLinearVelocity(any(0.1));
		bodies[1]->setAngularVelocity(any(10));
		const double start = world.kineticEnergy();
		for (int i = 0; i < 60; ++i)
		{
			world.step(btScalar(1) / 60);
			ASSERT_LT(world.kineticEnergy(), start * (1 + byPrecision(1e-6, 1e-3))) << seed << " at step " << i;
		}
	}
}

TEST(Fibres, WakeBodiesWhenTheyChange)
{
	PulledBody pulled(brick(1));
	btElasticPlasticCapacity capacity = pulled.m_joint->getCapacity();
	pulled.m_body->forceActivationState(ISLAND_SLEEPING);
	ASSERT_TRUE(pulled.m_joint->setCapacity(capacity));
	EXPECT_FALSE(pulled.m_body->isActive());
	capacity.m_fibres[5].m_tension /= 2;
	EXPECT_FALSE(capacity.isSameAs(pulled.m_joint->getCapacity()));
	ASSERT_TRUE(pulled.m_joint->setCapacity(capacity));
	EXPECT_TRUE(pulled.m_body->isActive());
}

TEST(Fibres, AreLeftOutBySolversThatDoNotKnowThem)
{
	// Bullet's own sees independent yield values: the whole bending moment beside half of the axial force.
	HeldBody held(strips(8), 10, 1e6);
	btDiscreteDynamicsWorld& bullet = held.m_world.bullet();
	btConstraintSolver* const own = bullet.getConstraintSolver();
	btSequentialImpulseConstraintSolver stock;
	const auto turn = [&](int steps)
	{
		for (int i = 0; i < steps; ++i)
		{
			held.m_body->setAngularVelocity(btVector3(0, 0, btScalar(0.5)));
			held.m_body->applyCentralForce(btVector3(btScalar(0.5 * NP), 0, 0));
			held.m_world.step(btScalar(1) / 960);
		}
		return std::fabs(double(held.m_joint->getForce(BT_EP_BENDING_Z)));
	};
	bullet.setConstraintSolver(&stock);
	EXPECT_NEAR(MP, turn(60), 1e-3 * MP);
	// Ours takes over from there, and the section yields as a whole.
	bullet.setConstraintSolver(own);
	EXPECT_NEAR(0.75 * MP, turn(60), 5e-3 * MP);
	ASSERT_TRUE(solverOf(held.m_world).setForm(BT_EP_ITERATIVE));
	EXPECT_NEAR(0.75 * MP, turn(10), 5e-3 * MP);
	bullet.setConstraintSolver(own);
}

/// A cantilever of two blocks of a meter each.
struct PulledCantilever
{
	World m_world;
	btElasticPlasticJoint* m_root;
	btRigidBody* m_end;

	PulledCantilever(Solver solver, int iterations, const btQuaternion& turn) : m_world(solver, btVector3(0, 0, 0))
	{
		const double height = 0.1;
		btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(250e6));
		steel.m_ultimatePlasticStrain = 10;
		const btElasticPlasticSection section =
			btElasticPlasticSection::rectangle(btScalar(height), btScalar(height)).withFibres();
		const btElasticPlasticCapacity capacity =
			btElasticPlasticCapacity::fromMember(steel, section, btScalar(0.5), btScalar(0.5));
		m_world.bullet().getSolverInfo().m_numIterations = iterations;
		// The iterative form knows no inner steps.
		btElasticPlasticSolverSettings settings = solverOf(m_world).getSettings();
		settings.m_innerError = 0;
		EXPECT_TRUE(solverOf(m_world).setSettings(settings));
		btCollisionShape* const block = m_world.box(btVector3(1, btScalar(height), btScalar(height)));
		const btTransform pose(turn);
		btRigidBody* last = m_world.body(0, block, pose, false);
		btElasticPlasticJoint* joints[2];
		for (int i = 0; i < 2; ++i)
		{
			btRigidBody* const next = m_world.body(btScalar(78.5), block, pose * at(btScalar(i + 1)), false);
			joints[i] = m_world.joint(*last, *next, pose * at(btScalar(i + 0.5)), capacity);
			last = next;
		}
		m_root = joints[0];
		m_end = last;
		// Half of what the section bears, and with it a load across that grows to 1.5 times what the root bears then.
		const double axial = 0.5 * height * height * 250e6, across = 1.5 * 0.75 * axial * 2 * height / 4 / 1.5;
		for (int i = 0; i < 120; ++i)
		{
			m_end->applyCentralForce(pose.getBasis() * btVector3(btScalar(axial), btScalar(across * i / 120), 0));
			m_world.step(btScalar(1) / 60);
		}
	}
};

TEST(Fibres, InTheIterativeFormAreAsGoodAsItsIterations)
{
	const btQuaternion turn(btVector3(1, 2, 3).normalized(), 1);
	PulledCantilever exact(Solver::Direct, 1, turn), many(Solver::Iterative, 300, turn),
		some(Solver::Iterative, 50, turn);
	const auto error = [&](const PulledCantilever& other)
	{ return std::fabs(double(other.m_root->getPlasticEnergy() / exact.m_root->getPlasticEnergy() - 1)); };
	EXPECT_GT(exact.m_root->getPlasticEnergy(), 100);
	// Tension damping is the direct form's alone.
	EXPECT_LT(error(many), 1e-3);
	EXPECT_GT(error(some), 10 * error(many));
}

TEST(Fibres, InTheIterativeFormMakeNoEnergy)
{
	// Random chains that fly, of materials as weak in tension as you like, at steps that change, with few iterations.
	int numFlowed = 0;
	for (unsigned seed = 0; seed < 150; ++seed)
	{
		std::mt19937 engine(seed);
		const auto draw = [&](double from, double to) { return from + (to - from) * double(engine()) / 4294967296.; };
		World world(Solver::Iterative, btVector3(0, 0, 0));
		world.bullet().getSolverInfo().m_numIterations = int(draw(1, 60));
		btElasticPlasticMaterial material;
		material.m_youngsModulus = btScalar(std::pow(10, draw(7, 11.3)));
		material.m_yieldStress = material.m_youngsModulus * btScalar(std::pow(10, draw(-4.5, -1.5)));
		material.m_tensileShare = btScalar(draw(0, 1) < 0.5 ? draw(0, 1) : 1);
		material.m_ultimatePlasticStrain = btScalar(std::pow(10, draw(-3, 0)));
		const double height = draw(0.02, 0.3), length = height * draw(0.7, 6);
		const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
			material,
			btElasticPlasticSection::rectangle(btScalar(height), btScalar(height * draw(0.4, 1))).withFibres(),
			btScalar(length / 2), btScalar(length / 2));
		btCollisionShape* const block = world.box(btVector3(btScalar(length), btScalar(height), btScalar(height)));
		std::vector<btElasticPlasticJoint*> joints;
		const double speed = std::pow(10, draw(-2, 1));
		for (int i = 0, n = int(draw(2, 8)); i < n; ++i)
		{
			btRigidBody* const body =
				world.body(btScalar(2000 * length * height * height), block, at(btScalar(length * i)), false);
			const auto any = [&](double most)
			{ return btVector3(btScalar(draw(-1, 1)), btScalar(draw(-1, 1)), btScalar(draw(-1, 1))) * btScalar(most); };
			body->setLinearVelocity(any(speed));
			body->setAngularVelocity(any(speed / length));
			body->setFlags(0);
			if (i > 0)
				joints.push_back(
					world.joint(*world.bodies()[size_t(i - 1)], *body, at(btScalar(length * (i - 0.5))), capacity));
		}
		const double start = world.kineticEnergy();
		double plastic = 0;
		for (int i = 0; i < 100; ++i)
		{
			world.step(btScalar(std::pow(2, draw(-3, 1)) / 60));
			double told = 0;
			plastic = 0;
			for (const btElasticPlasticJoint* joint : joints)
			{
				plastic += joint->getPlasticEnergy();
				told += joint->getElasticEnergy();
			}
			// Rounding alone: no step gains.
			ASSERT_LE(world.kineticEnergy(), start * (1 + byPrecision(1e-9, 1e-5))) << seed << " at step " << i;
			ASSERT_LE(world.kineticEnergy() + told + plastic, start * (1 + byPrecision(1e-9, 1e-5)))
				<< seed << " at step " << i;
		}
		numFlowed += plastic > 0.01 * start;
	}
	EXPECT_GT(numFlowed, 15);
}

TEST(Fibres, AreSavedAndPutBackWithTheState)
{
	HeldBody held(strips(8), 10, 1, btQuaternion(0, 0, 0, 1), false, 1);
	const auto blow = [&](double speed)
	{
		held.m_body->setAngularVelocity(btVector3(0, 0, btScalar(speed)));
		run(held.m_world, 20, btScalar(1) / 960);
	};
	blow(20);
	const btElasticPlasticState state = held.m_joint->getState();
	const btTransform pose = held.m_body->getWorldTransform();
	EXPECT_EQ(16, state.m_fibres.size());
	EXPECT_NE(0, state.m_fibres[0].m_offset);
	btScalar forces[2];
	for (btScalar& force : forces)
	{
		held.m_body->setWorldTransform(pose);
		held.m_body->setInterpolationWorldTransform(pose);
		held.m_body->setLinearVelocity(btVector3(0, 0, 0));
		EXPECT_TRUE(held.m_joint->setState(state));
		blow(-5);
		force = held.m_joint->getForce(BT_EP_BENDING_Z);
	}
	// The same bits but for the first guess of the bounds, which decides on the last digits of the search.
	expectClose(forces[0], forces[1], byPrecision(1e-9, 1e-4));
	btElasticPlasticState wrong = state;
	wrong.m_fibres.pop_back();
	EXPECT_FALSE(held.m_joint->setState(wrong));
	wrong = state;
	wrong.m_fibres[3].m_force = btScalar(65 * NP);
	EXPECT_FALSE(held.m_joint->setState(wrong));
	wrong = state;
	wrong.m_fibres[3].m_offset = btScalar(NAN);
	EXPECT_FALSE(held.m_joint->setState(wrong));
}
}  // namespace testFibres
