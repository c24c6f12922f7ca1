// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Second order: columns at their buckling load, frames that sway under their load, strings that ring; all at 1/60 s.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/Member.h"
#include "support/Precision.h"
#include "support/Run.h"

namespace testStability
{
using namespace ep;

const double LENGTH = 4, SIDE = 0.05;  // of members, square [m]

struct Parts
{
	btElasticPlasticMaterial m_material = btElasticPlasticMaterial::steel(btScalar(1e15));
	btElasticPlasticSection m_section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));

	double bending() const { return double(m_material.m_youngsModulus * m_section.m_secondMoment[0]); }

	Member::Settings member(int blocks) const
	{
		Member::Settings settings;
		settings.material = m_material;
		settings.width = settings.height = btScalar(SIDE);
		settings.parts = blocks;
		const btElasticPlasticMaterial material = m_material;
		const btElasticPlasticSection section = m_section;
		settings.capacityOf = [=](btScalar a, btScalar b)
		{ return btElasticPlasticCapacity::fromMember(material, section, a, b); };
		return settings;
	}
};

/// Euler's cases: a column along x between a support and a head that is pressed.
struct EulerColumn
{
	enum Case
	{
		FREE_HEAD,    ///< clamped below
		HINGED,       ///< at both ends
		HINGED_HEAD,  ///< clamped below
		CLAMPED,      ///< at both ends
	};

	World m_world;
	Parts m_parts;
	btRigidBody* m_head;
	std::vector<btRigidBody*> m_blocks;
	btVector3 m_x;

	/// \param isSwapped  whether every other joint has its bodies the other way round
	EulerColumn(Case which, int blocks, const btQuaternion& turn, bool isSwapped)
		: m_world(Solver::Direct, btVector3(0, 0, 0)),
		  m_head(m_world.body(1, m_world.box(btVector3(1, 1, 1) * btScalar(0.02)),
							  btTransform(turn) * at(btScalar(LENGTH)), false)),
		  m_x(quatRotate(turn, btVector3(1, 0, 0)))
	{
		btRigidBody* before =
			m_world.body(0, m_world.box(btVector3(1, 1, 1)), btTransform(turn) * at(btScalar(-0.5)), false);
		const Member::Settings settings = m_parts.member(blocks);
		const btScalar l = btScalar(LENGTH / blocks), width = settings.width;
		btElasticPlasticJoint *start = nullptr, *end = nullptr;
		for (int i = 0; i <= blocks; ++i)
		{
			btRigidBody* next = m_head;
			if (i < blocks)
			{
				next = m_world.body(m_parts.m_material.m_density * l * width * width,
									m_world.box(btVector3(l, width, width)),
									btTransform(turn) * at(l * (btScalar(i) + btScalar(0.5))), false);
				m_blocks.push_back(next);
			}
			const btElasticPlasticCapacity capacity =
				settings.capacityOf(i > 0 ? l : btScalar(0), i < blocks ? l : btScalar(0));
			const bool swaps = isSwapped && i % 2 == 0;
			end = m_world.joint(swaps ? *next : *before, swaps ? *before : *next,
								btTransform(turn) * at(l * btScalar(i)), capacity);
			start = start ? start : end;
			before = next;
		}
		if (which == HINGED)
			release(start);
		if (which == HINGED || which == HINGED_HEAD)
			release(end);
		if (which == FREE_HEAD)
			return;
		guide(turn);
	}

	/// Lets a force grow for a second, disturbs the column a second later, and looks for 20 s.
	/// \return the largest distance from the axis in the first four seconds after that, and in the last four
	void press(double force, double& before, double& after)
	{
		before = after = 0;
		for (int i = 0; i < 22 * 60; ++i)
		{
			for (size_t part = 0; i == 120 && part < m_blocks.size(); ++part)
				m_blocks[part]->setLinearVelocity(across() * btScalar(DISTURBANCE * double(1 + part % 3)));
			m_head->applyCentralForce(m_x * btScalar(-force * std::min(1., (i + 1) / 60.)));
			m_world.step(FRAME);
			double& most = i < 6 * 60 ? before : after;
			for (const btRigidBody* part : m_blocks)
			{
				const btVector3 place = part->getCenterOfMassPosition();
				if (i < 6 * 60 || i >= 18 * 60)
					most = std::max(most, double((place - m_x * place.dot(m_x)).length()));
			}
		}
	}

	/// [m/s]
	static constexpr double DISTURBANCE = sizeof(btScalar) == sizeof(double) ? 1e-6 : 1e-3;

private:
	btVector3 across() const
	{
		btVector3 y, z;
		btPlaneSpace1(m_x, y, z);
		return y;
	}

	void release(btElasticPlasticJoint* joint)
	{
		for (int dof : {BT_EP_BENDING_Y, BT_EP_BENDING_Z})
			m_world.release(*joint, dof);
	}

	/// Lets the head go along x only, by a joint to the ground without an axial row. (Bullet's factors know the world's axes only.)
	void guide(const btQuaternion& turn)
	{
		btRigidBody* ground =
			m_world.body(0, m_world.box(btVector3(1, 1, 1)), btTransform(turn) * at(btScalar(LENGTH + 1)), false);
		btElasticPlasticCapacity slides;
		for (int dof = BT_EP_SHEAR_Y; dof < BT_EP_DOF_COUNT; ++dof)
			slides.set(dof, btScalar(1e10), btElasticPlasticCapacity::unlimited());
		btElasticPlasticJoint* joint =
			m_world.joint(*m_head, *ground, btTransform(turn) * at(btScalar(LENGTH)), slides);
		m_world.release(*joint, BT_EP_AXIAL);
	}
};

double eulerLoad(EulerColumn::Case which, double bending)
{
	// K of the clamped and hinged column: pi over the first root of tan x = x.
	const double K[] = {2, 1, M_PI / 4.493409457909064, 0.5};
	return M_PI * M_PI * bending / (K[which] * K[which] * LENGTH * LENGTH);
}

/// At 0.98 of Euler's load a disturbance does not grow, at 1.02 it does. With 16 blocks the critical load is Euler's within 0.001,
/// with 8 within 0.003; what grows at 1.02 of it is slow, sqrt(0.02) of the frequency without load.
TEST(Stability, ColumnsBuckleAtEulersLoad)
{
	const btQuaternion turned(btVector3(1, -2, 2).normalized(), btScalar(0.8));
	for (const int blocks : {8, 16})
		for (const auto which :
			 {EulerColumn::FREE_HEAD, EulerColumn::HINGED, EulerColumn::HINGED_HEAD, EulerColumn::CLAMPED})
			for (const btQuaternion& turn : {btQuaternion::getIdentity(), turned})
				for (const double factor : {0.98, 1.02})
				{
					EulerColumn column(which, blocks, turn, turn.w() < 1);
					double before, after;
					column.press(factor * eulerLoad(which, column.m_parts.bending()), before, after);
					SCOPED_TRACE(testing::Message()
								 << "case " << which << ", blocks " << blocks << ", factor " << factor);
					if (factor < 1)
						EXPECT_LE(after, before);
					else  // Grows, or has grown until the turned head bears less.
						EXPECT_TRUE(after > 2 * before || after > 0.01) << before << " to " << after;
				}
}
/// A portal, clamped below, with a load on each corner and half of the sway force each.
struct LoadedPortal
{
	World m_world{Solver::Direct, btVector3(0, 0, 0)};
	Parts m_parts;
	std::vector<btRigidBody*> m_corners;

	explicit LoadedPortal(int blocks)
	{
		const btScalar l = btScalar(LENGTH);
		btRigidBody* ground = m_world.body(0, m_world.box(btVector3(1, 1, 1)), at(0, btScalar(-0.5)), false);
		const btQuaternion up(btVector3(0, 0, 1), SIMD_HALF_PI);
		btCollisionShape* node = m_world.box(btVector3(1, 1, 1) * btScalar(0.1));
		for (int side = 0; side < 2; ++side)
		{
			const btScalar x = l * btScalar(side);
			m_corners.push_back(m_world.body(5, node, at(x, l), false));
			Member column(m_world, m_parts.member(blocks), btTransform(up, btVector3(x, 0, 0)), l);
			column.joinStart(m_world, *ground);
			column.joinEnd(m_world, *m_corners.back());
		}
		Member beam(m_world, m_parts.member(blocks), at(0, l), l);
		beam.joinStart(m_world, *m_corners[0]);
		beam.joinEnd(m_world, *m_corners[1]);
	}

	/// At rest. \param load  on each corner
	double sway(double load, double force)
	{
		for (auto& body : m_world.bodies())
			body->setDamping(btScalar(0.95), btScalar(0.95));
		for (int i = 0; i < 900; ++i)
		{
			const double share = std::min(1., (i + 1) / 120.);
			for (btRigidBody* corner : m_corners)
				corner->applyCentralForce(btVector3(btScalar(share * force / 2), btScalar(-share * load), 0));
			m_world.step(FRAME);
		}
		return (double(m_corners[0]->getCenterOfMassPosition().x()) +
				double(m_corners[1]->getCenterOfMassPosition().x()) - LENGTH) /
			   2;
	}
};

/// By stability functions (Livesley and Chandler): column and beam of one length and section, corners turn alike.
/// \return sway over force
double exactSway(double bending, double load)
{
	const double u = LENGTH * std::sqrt(load / bending), k = bending / LENGTH;
	const double s = u * (std::sin(u) - u * std::cos(u)) / (2 - 2 * std::cos(u) - u * std::sin(u)),
				 sc = u * (u - std::sin(u)) / (2 - 2 * std::cos(u) - u * std::sin(u));
	// Corner: k s turn - k (s + sc) sway/L + 6 k turn = 0. Storey: 2 k (s + sc) sway/L - k (s + sc) turn - P sway = H L / 2.
	const double turn = (s + sc) / (s + 6);
	return LENGTH * LENGTH / 2 / (2 * k * (s + sc) - k * (s + sc) * turn - load * LENGTH);
}

TEST(Stability, APortalSwaysAsBySecondOrderTheory)
{
	// Tolerance: what lumping leaves where a load lowers the sway's stiffness to two thirds and to one third, measured to fall
	// with the square of the number of blocks.
	for (const int blocks : {1, 2, 4, 8})
	{
		const double bending = LoadedPortal(blocks).m_parts.bending(), euler = M_PI * M_PI * bending / LENGTH / LENGTH;
		for (const double share : {0.1, 0.3, 0.5})
		{
			// So that it sways by a hundredth of the height: small to the theory, large to float.
			const double exact = exactSway(bending, share * euler), force = 0.01 * LENGTH / exact;
			LoadedPortal portal(blocks);
			const double sway = portal.sway(share * euler, force) / force;
			EXPECT_NEAR(exact, sway,
						(blocks < 4 && share > 0.4 ? 0.06
						 : blocks < 4              ? 0.02
												   : 0.005) *
							exact)
				<< "blocks " << blocks << ", load " << share << " of Euler's";
		}
	}
}

/// A string of blocks between a support and a heavy head, which a force pulls.
struct TautString
{
	World m_world{Solver::Direct, btVector3(0, 0, 0)};
	btRigidBody* m_head;
	std::vector<btRigidBody*> m_parts;
	double m_pull;
	btVector3 m_across;
	static constexpr double MASS = 10;

	/// \param period  of the first mode by theory, 2 L sqrt(mu / N)
	TautString(int blocks, double period)
		: m_pull(4 * MASS * LENGTH / (period * period)), m_across(quatRotate(turn(), btVector3(0, 1, 0)))
	{
		const btTransform scene(turn());
		// Springs along and across, stiff enough for the string to keep its length; bending is free.
		btElasticPlasticCapacity link;
		for (int dof = 0; dof < 4; ++dof)
			link.set(dof, btScalar(1e4 * m_pull * blocks), btElasticPlasticCapacity::unlimited());
		const btScalar l = btScalar(LENGTH / blocks);
		btCollisionShape* box = m_world.box(btVector3(l, l / 10, l / 10));
		btRigidBody* before = m_world.body(0, box, scene * at(-l / 2), false);
		for (int i = 0; i < blocks; ++i)
		{
			m_parts.push_back(
				m_world.body(btScalar(MASS / blocks), box, scene * at(l * (btScalar(i) + btScalar(0.5))), false));
			join(*before, *m_parts.back(), scene * at(l * btScalar(i)), link);
			before = m_parts.back();
		}
		m_head = m_world.body(1000, m_world.box(btVector3(1, 1, 1)), scene * at(btScalar(LENGTH + 0.5)), false);
		join(*before, *m_head, scene * at(btScalar(LENGTH)), link);
		btElasticPlasticCapacity slides;
		for (int dof = BT_EP_SHEAR_Y; dof < BT_EP_DOF_COUNT; ++dof)
			slides.set(dof, btScalar(1e10), btElasticPlasticCapacity::unlimited());
		btRigidBody* ground = m_world.body(0, box, scene * at(btScalar(LENGTH + 2)), false);
		m_world.release(*m_world.joint(*m_head, *ground, scene * at(btScalar(LENGTH + 0.5)), slides), BT_EP_AXIAL);
	}

	void step()
	{
		m_head->applyCentralForce(quatRotate(turn(), btVector3(btScalar(m_pull), 0, 0)));
		m_world.step(FRAME);
	}

	/// The first mode's share.
	double deflection() const
	{
		double sum = 0;
		for (size_t i = 0; i < m_parts.size(); ++i)
			sum += shape(i) * double(m_parts[i]->getCenterOfMassPosition().dot(m_across));
		return sum;
	}
	double shape(size_t i) const { return std::sin(M_PI * (double(i) + 0.5) / double(m_parts.size())); }

private:
	static btQuaternion turn() { return btQuaternion(btVector3(1, 2, 1).normalized(), btScalar(0.5)); }

	void join(btRigidBody& a, btRigidBody& b, const btTransform& frame, const btElasticPlasticCapacity& link)
	{
		btElasticPlasticJoint* joint = m_world.joint(a, b, frame, link);
		for (int dof : {BT_EP_BENDING_Y, BT_EP_BENDING_Z})
			m_world.release(*joint, dof);
	}
};

/// With 12 to 60 steps a period, where the stiffness by tension goes from explicit to damped.
TEST(Stability, AStringRingsAtItsFrequency)
{
	for (const int blocks : {16, 32})
		for (const double period : {0.2, 0.5, 1.})
		{
			TautString string(blocks, period);
			for (auto& body : string.m_world.bodies())
				body->setDamping(btScalar(0.9), btScalar(0.9));
			for (int i = 0; i < 240; ++i)
				string.step();
			for (auto& body : string.m_world.bodies())
				body->setDamping(0, 0);
			// A swing of a thousandth of the length, with the turns that belong to it.
			const double speed = 2 * M_PI / period * LENGTH / 1000;
			const btVector3 along =
				quatRotate(btQuaternion(btVector3(1, 2, 1).normalized(), btScalar(0.5)), btVector3(1, 0, 0));
			for (size_t i = 0; i < string.m_parts.size(); ++i)
			{
				const double slope = std::cos(M_PI * (double(i) + 0.5) / double(string.m_parts.size())) * M_PI / LENGTH;
				string.m_parts[i]->setLinearVelocity(string.m_across * btScalar(speed * string.shape(i)));
				string.m_parts[i]->setAngularVelocity(along.cross(string.m_across) * btScalar(speed * slope));
			}
			std::vector<double> crossings;
			double last = 0, time = 0;
			while (crossings.size() < 21 && time < 20 * period)
			{
				string.step();
				const double now = string.deflection();
				if (time > 0 && now * last <= 0)
					crossings.push_back(time + double(FRAME) * last / (last - now));
				last = now;
				time += double(FRAME);
			}
			ASSERT_EQ(21u, crossings.size());
			const double found = (crossings.back() - crossings.front()) / 10;
			// Of the period: an explicit stiffness takes (2 pi / 12)^2 / 24 = 1.1 % of it at 12 steps, blocks (pi / 16)^2 / 24 at most,
			// elongation 0.01 %.
			EXPECT_NEAR(period, found, 0.012 * period) << blocks << " blocks, period " << period;
		}
}
}  // namespace testStability
