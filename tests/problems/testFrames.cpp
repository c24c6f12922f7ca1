// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Space frames of few blocks against matrix stiffness: displacements, and forces at the members' ends. Frames of few blocks at
// their limit loads.

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "scenes/LoadedBeam.h"
#include "scenes/PortalFrame.h"
#include "support/FrameStiffness.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/Place.h"

namespace testFrames
{
using namespace ep;
typedef FrameStiffness::Six Six;

/// Share of the loads. In double a small one, as matrix stiffness is linear: what is left is of second order, the turns' share of a
/// moment. In float a large one, as displacements are to be far above the rounding of places.
const double LOAD = inPrecision(0.02, 1), TOLERANCE = inPrecision(2e-4, 6e-3);

FrameStiffness::Vector vectorOf(const btVector3& v) { return {double(v.x()), double(v.y()), double(v.z())}; }

/// A frame in a world, turned as a whole, and the same by matrix stiffness.
class Frame
{
public:
	explicit Frame(const btTransform& turn = btTransform::getIdentity(), JointClass jointClass = JointClass::Spring2)
		: m_world(Solver::Direct, btVector3(0, 0, 0)), m_turn(turn), m_jointClass(jointClass)
	{
		// No yield: the question is stiffness.
		m_material.m_yieldStress = btScalar(1e15);
	}

	int addNode(const btVector3& place, bool isFixed)
	{
		m_places.push_back(place);
		m_nodes.push_back(body(isFixed ? 0 : btScalar(20), btVector3(1, 1, 1) * btScalar(0.2), at(0), place));
		m_loads.push_back({});
		return m_reference.addNode(vectorOf(place), isFixed);
	}

	/// A member of blocks of the given lengths, as shares of the whole; bodies of every other joint are swapped.
	/// \param eccentricity  of both ends from their nodes: what is between is rigid
	void addMember(int i, int k, const btElasticPlasticSection& section, const std::vector<double>& shares,
				   const btVector3& eccentricity = btVector3(0, 0, 0))
	{
		const btVector3 start = m_places[size_t(i)] + eccentricity, end = m_places[size_t(k)] + eccentricity;
		const btVector3 x = (end - start).normalized(),
						side = btFabs(x.y()) > btScalar(0.9) ? btVector3(0, 0, 1) : btVector3(0, 1, 0);
		const btVector3 y = (side - x * x.dot(side)).normalized(), z = x.cross(y);
		const btMatrix3x3 axes(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z());
		btRigidBody* before = m_nodes[size_t(i)];
		btScalar lengthBefore = 0, place = 0;
		Member member = {};
		for (size_t b = 0; b <= shares.size(); ++b)
		{
			const bool isEnd = b == shares.size();
			const btScalar length = isEnd ? btScalar(0) : btScalar(shares[b]) * (end - start).length();
			const btTransform frame(axes, start + x * place);
			btRigidBody* next = isEnd ? m_nodes[size_t(k)]
									  : body(m_material.m_density * section.m_area * length,
											 btVector3(length, btScalar(0.1), btScalar(0.1)), frame, x * (length / 2));
			const btElasticPlasticCapacity capacity =
				btElasticPlasticCapacity::fromMember(m_material, section, lengthBefore, length);
			const bool isSwapped = b % 2 == 1;
			btElasticPlasticJoint* joint = isSwapped
											   ? m_world.joint(*next, *before, m_turn * frame, capacity, m_jointClass)
											   : m_world.joint(*before, *next, m_turn * frame, capacity, m_jointClass);
			if (b == 0 || isEnd)
				member.end[isEnd] = {joint, isSwapped ? -1. : 1.};
			before = next;
			lengthBefore = length;
			place += length;
		}
		m_members.push_back(member);
		const double E = m_material.m_youngsModulus, G = m_material.shearModulus();
		m_reference.addMember(i, k, vectorOf(start), vectorOf(end), vectorOf(y),
							  {E * section.m_area,
							   {G * section.m_shearArea[0], G * section.m_shearArea[1]},
							   G * section.m_torsionConstant,
							   {E * section.m_secondMoment[0], E * section.m_secondMoment[1]}});
	}

	void load(int node, const btVector3& force, const btVector3& torque = btVector3(0, 0, 0))
	{
		for (int i = 0; i < 3; ++i)
		{
			m_loads[size_t(node)][size_t(i)] += LOAD * double(force[i]);
			m_loads[size_t(node)][size_t(3 + i)] += LOAD * double(torque[i]);
		}
	}

	/// Lets the loads grow for a second, which a frame follows almost at rest, and come to rest.
	void settle()
	{
		m_reference.solve(m_loads);
		for (auto& body : m_world.bodies())
			body->setDamping(btScalar(0.9), btScalar(0.9));
		for (int i = 0; i < 600; ++i)
		{
			for (size_t n = 0; n < m_nodes.size(); ++n)
			{
				const double share = std::min(1., (i + 1) / 60.);
				m_nodes[n]->applyCentralForce(m_turn.getBasis() * part(m_loads[n], 0, share));
				m_nodes[n]->applyTorque(m_turn.getBasis() * part(m_loads[n], 3, share));
			}
			m_world.step(FRAME);
		}
	}

	/// Largest difference of a node's displacement, over the largest displacement.
	double displacementError() const
	{
		double most = 0, error = 0;
		for (size_t n = 0; n < m_nodes.size(); ++n)
		{
			const btVector3 exact = part(m_reference.displacement(int(n)), 0, 1);
			const btVector3 moved = m_turn.invXform(m_nodes[n]->getCenterOfMassPosition()) - m_places[n];
			most = std::max(most, double(exact.length()));
			error = std::max(error, double((moved - exact).length()));
		}
		return error / most;
	}

	/// Largest difference of a section force at a member's end, forces over the largest force, moments over the largest moment.
	double forceError() const
	{
		double most[2] = {0, 0}, error[2] = {0, 0};
		for (size_t m = 0; m < m_members.size(); ++m)
			for (int end = 0; end < 2; ++end)
			{
				const Six exact = m_reference.sectionForce(int(m), end);
				for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
				{
					const End& e = m_members[m].end[end];
					const double found = e.sign * double(e.joint->getForce(dof));
					most[dof / 3] = std::max(most[dof / 3], std::fabs(exact[size_t(dof)]));
					error[dof / 3] = std::max(error[dof / 3], std::fabs(found - exact[size_t(dof)]));
				}
			}
		return std::max(error[0] / most[0], error[1] / most[1]);
	}

	/// What rounding a place by half an epsilon of 8 m, on both sides of the stiffest joint, makes of the largest force.
	double rounding() const
	{
		double stiffest = 0, most = 0;
		for (const btElasticPlasticJoint* joint : m_world.joints())
			stiffest = std::max(stiffest, double(joint->getCapacity().m_stiffness[BT_EP_AXIAL]));
		for (size_t m = 0; m < m_members.size(); ++m)
			for (int dof = 0; dof < 3; ++dof)
				most = std::max(most, std::fabs(m_reference.sectionForce(int(m), 0)[size_t(dof)]));
		return 8 * double(SIMD_EPSILON) * stiffest / most;
	}

	World m_world;
	btElasticPlasticMaterial m_material;

private:
	struct End
	{
		btElasticPlasticJoint* joint;
		double sign;  ///< of its forces, -1 where its bodies are swapped
	};
	struct Member
	{
		End end[2];
	};

	static btVector3 part(const Six& six, int first, double factor)
	{
		return btVector3(btScalar(factor * six[size_t(first)]), btScalar(factor * six[size_t(first) + 1]),
						 btScalar(factor * six[size_t(first) + 2]));
	}

	btRigidBody* body(btScalar mass, const btVector3& size, const btTransform& frame, const btVector3& along)
	{
		const btTransform pose(frame.getBasis(), frame.getOrigin() + along);
		return m_world.body(mass, m_world.box(size), m_turn * pose, false);
	}

	btTransform m_turn;
	JointClass m_jointClass;
	FrameStiffness m_reference;
	std::vector<btVector3> m_places;
	std::vector<btRigidBody*> m_nodes;
	std::vector<Six> m_loads;
	std::vector<Member> m_members;
};

std::vector<double> evenly(int blocks) { return std::vector<double>(size_t(blocks), 1. / blocks); }

/// Three storeys on four columns with a brace in each of four bays: 28 members, pushed from above and the side, and twisted.
void build(Frame& frame, int blocks)
{
	const btElasticPlasticSection column = btElasticPlasticSection::hollowRectangle(btScalar(0.15), btScalar(0.2),
																					btScalar(0.008)),
								  beam = btElasticPlasticSection::iSection(btScalar(0.15), btScalar(0.3),
																		   btScalar(0.008), btScalar(0.012)),
								  brace = btElasticPlasticSection::circle(btScalar(0.03));
	const btScalar x[] = {0, 5, 5, 0}, z[] = {0, 0, 4, 4}, height = 3;
	for (int level = 0; level < 4; ++level)
		for (int c = 0; c < 4; ++c)
			frame.addNode(btVector3(x[c], height * btScalar(level), z[c]), level == 0);
	for (int level = 0; level < 3; ++level)
		for (int c = 0; c < 4; ++c)
		{
			frame.addMember(4 * level + c, 4 * level + 4 + c, column, evenly(blocks));
			frame.addMember(4 * level + 4 + c, 4 * level + 4 + (c + 1) % 4, beam, evenly(blocks));
		}
	for (int level = 0; level < 2; ++level)
		for (int c = 0; c < 4; c += 2)
			frame.addMember(4 * level + c, 4 * level + 4 + c + 1, brace, evenly(blocks));
	for (int c = 0; c < 4; ++c)
		frame.load(12 + c, btVector3(2000, -5000, 3000));
	frame.load(6, btVector3(0, 0, 4000), btVector3(0, 3000, 1000));
}

TEST(Frames, OfFewBlocksAreAsStiffAsByMatrixAnalysis)
{
	const btTransform turned(btQuaternion(btVector3(1, 2, -1).normalized(), btScalar(0.7)), btVector3(3, -2, 1));
	for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
		for (int blocks : {1, 2, 4})
		{
			Frame frame(jointClass == JointClass::Spring ? turned : btTransform::getIdentity(), jointClass);
			build(frame, blocks);
			frame.settle();
			EXPECT_LT(frame.displacementError(), TOLERANCE) << blocks << " blocks a member";
			EXPECT_LT(frame.forceError(), TOLERANCE) << blocks << " blocks a member";
		}
}

/// Members between random places in blocks of random lengths, with random sections, which begin and end beside their nodes.
TEST(Frames, OfAnyMixtureAreAsStiffAsByMatrixAnalysis)
{
	std::mt19937 random(7);
	const auto between = [&random](double a, double b)
	{ return a + (b - a) * double(random()) / double(std::mt19937::max()); };
	// One after another, for each compiler evaluates arguments in an order of its own.
	const auto vector = [&](double most)
	{
		const double z = between(-most, most), y = between(-most, most), x = between(-most, most);
		return btVector3(btScalar(x), btScalar(y), btScalar(z));
	};
	for (int trial = 0; trial < 10; ++trial)
	{
		const btVector3 place = vector(3);
		const double angle = between(-3, 3);
		const btVector3 axis = vector(1).normalized();
		Frame frame(btTransform(btQuaternion(axis, btScalar(angle)), place));
		for (int n = 0; n < 6; ++n)
			frame.addNode(btVector3(btScalar(n % 3), btScalar(n / 3), btScalar(n % 2)) * 2 + vector(0.5), n < 3);
		for (int i = 0; i < 6; ++i)
			for (int k = std::max(3, i + 1); k < 6; ++k)
			{
				std::vector<double> shares;
				double sum = 0;
				for (int blocks = int(between(1, 4)); blocks > 0; --blocks)
				{
					shares.push_back(between(0.3, 1));
					sum += shares.back();
				}
				for (double& share : shares)
					share /= sum;
				const btScalar width = btScalar(between(0.05, 0.15)), height = btScalar(between(0.05, 0.3));
				frame.addMember(i, k,
								i % 2 == 0 ? btElasticPlasticSection::rectangle(width, height)
										   : btElasticPlasticSection::hollowRectangle(width, height, btScalar(0.005)),
								shares, vector(0.3));
			}
		for (int n = 3; n < 6; ++n)
		{
			const btVector3 moment = vector(10000), force = vector(30000);
			frame.load(n, force, moment);
		}
		frame.settle();
		// At the full load these frames have half a per cent of second order, as double shows, and rounding makes as much.
		EXPECT_LT(frame.displacementError(), inPrecision(TOLERANCE, 0.01)) << "trial " << trial;
		EXPECT_LT(frame.forceError(), TOLERANCE + frame.rounding()) << "trial " << trial;
	}
}

// ---- limit loads with joints by fromMember: the problems' joints are the textbook's, without coupling

/// Whether it has given way by less than a limit after a load has grown for a second and rested for another.
template <class Structure, class Load, class Give>
bool stands(Structure& structure, double limit, const Load& load, const Give& give)
{
	for (int i = 0; i < 120; ++i)
	{
		load(std::min(1., (i + 1) / 60.));
		structure.m_world.step(FRAME);
		if (!(std::fabs(double(give())) < limit))
			return false;
	}
	return true;
}

Member::CapacityOf fromMember(const Member::Settings& s)
{
	return [=](btScalar a, btScalar b)
	{
		btElasticPlasticMaterial material = s.material;
		material.m_ultimatePlasticStrain = btScalar(1e6);
		return btElasticPlasticCapacity::fromMember(material, btElasticPlasticSection::rectangle(s.width, s.height), a,
													b);
	};
}

TEST(Frames, BeamsOfFewBlocksCollapseAtTheirLimitLoad)
{
	for (const auto supports :
		 {LoadedBeam::Supports::Fixed, LoadedBeam::Supports::Propped, LoadedBeam::Supports::Simple})
		for (int parts : {2, 4, 10})
			for (double factor : {0.99, 1.01})
			{
				LoadedBeam::Settings settings;
				settings.supports = supports;
				settings.member.parts = parts;
				settings.member.capacityOf = fromMember(settings.member);
				LoadedBeam beam(settings);
				// What stands sags by less than 0.02 of the length.
				EXPECT_EQ(factor < 1, stands(
										  beam, 0.05 * double(settings.length),
										  [&](double share) { beam.load(factor * share * beam.collapseLoad()); },
										  [&] { return beam.sag(); }))
					<< "supports " << int(supports) << ", parts " << parts << ", factor " << factor;
			}
}

TEST(Frames, PortalsOfFewBlocksCollapseAtTheirLimitLoad)
{
	const double loads[][2] = {{8, 0}, {0, 4}, {6, 3}};  // in Mp/L and Mp/h: beam, sway, both
	for (const auto& load : loads)
		for (int parts : {2, 6})
			for (double factor : {0.985, 1.015})
			{
				PortalFrame::Settings settings;
				settings.member.parts = parts;
				settings.member.capacityOf = fromMember(settings.member);
				PortalFrame frame(settings);
				const double v = load[0] * frame.plasticMoment() / double(settings.span),
							 h = load[1] * frame.plasticMoment() / double(settings.height),
							 exact = factor * frame.collapseFactor(v, h);
				EXPECT_EQ(factor < 1,
						  stands(
							  frame, 0.05, [&](double share) { frame.load(share * exact * v, share * exact * h); },
							  [&] { return frame.sag() + frame.sway(); }))
					<< "loads " << load[0] << ", " << load[1] << ", parts " << parts << ", factor " << factor;
			}
}
}  // namespace testFrames
