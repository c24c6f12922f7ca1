// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The interface in C: what it does with what is wrong. That it works is shown by its sample (tests/consumers/c).

#include <math.h>
#include <string.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticC.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticFault.h"
#include "LinearMath/btScalar.h"

namespace testC
{
const double GRAVITY[3] = {0, -10, 0}, ORIGIN[3] = {0, 0, 0}, UPRIGHT[4] = {0, 0, 0, 1};

struct CInterface : testing::Test
{
	btep_world* m_world = nullptr;
	int m_wall = 0, m_block = 0;
	btep_body_description m_cube = {sizeof m_cube, BTEP_BOX, {1, 1, 1}, 0, {0, 0, 0}, {0, 0, 0, 1}, 0.5};
	btep_capacity m_capacity = {sizeof m_capacity, {}, {}, {}, {}, 0, 0, 0, 0};

	CInterface()
	{
		EXPECT_EQ(BTEP_OK, btep_world_create(BTEP_VERSION, GRAVITY, &m_world));
		EXPECT_EQ(BTEP_OK, btep_body_create(m_world, &m_cube, &m_wall));
		m_cube.m_mass = 10;
		m_cube.m_position[1] = -1;
		EXPECT_EQ(BTEP_OK, btep_body_create(m_world, &m_cube, &m_block));
		for (int i = 0; i < 6; ++i)
		{
			m_capacity.m_stiffness[i] = 1e6;
			m_capacity.m_yield[i] = 1e4;
			m_capacity.m_ductility[i] = 1e30;
		}
	}
	~CInterface() override { btep_world_destroy(m_world); }

	void expectMessage(const char* part) const
	{
		EXPECT_TRUE(strstr(btep_world_message(m_world), part)) << btep_world_message(m_world);
	}
};

TEST_F(CInterface, RefusesVersionsAndNull)
{
	btep_world* other = m_world;
	for (const int wrong : {BTEP_VERSION - 1, BTEP_VERSION + 1})
		EXPECT_EQ(BTEP_BAD_VERSION, btep_world_create(wrong, GRAVITY, &other));
	EXPECT_EQ(nullptr, other);
	EXPECT_EQ(BTEP_BAD_POINTER, btep_world_create(BTEP_VERSION, nullptr, &other));
	EXPECT_EQ(BTEP_BAD_POINTER, btep_world_step(nullptr, 0.1));
	EXPECT_EQ(BTEP_BAD_POINTER, btep_body_create(m_world, nullptr, &m_wall));
	EXPECT_TRUE(btep_world_message(nullptr));
	m_cube.m_size -= 1;
	EXPECT_EQ(BTEP_BAD_VERSION, btep_body_create(m_world, &m_cube, &m_wall));
	expectMessage("m_size");
	btep_world_destroy(nullptr);
}

TEST_F(CInterface, RefusesWhatIsOutOfRange)
{
	for (double bad : {0., -1., double(NAN), double(INFINITY)})
		EXPECT_EQ(BTEP_BAD_VALUE, btep_world_step(m_world, bad));
	expectMessage("length of a step");
	btep_body_description body = m_cube;
	int made = 0;
	body.m_extent[1] = 0;
	EXPECT_EQ(BTEP_BAD_VALUE, btep_body_create(m_world, &body, &made));
	body = m_cube;
	body.m_mass = -1;
	EXPECT_EQ(BTEP_BAD_VALUE, btep_body_create(m_world, &body, &made));
	body = m_cube;
	body.m_rotation[3] = 0;
	EXPECT_EQ(BTEP_BAD_VALUE, btep_body_create(m_world, &body, &made));
	body = m_cube;
	body.m_shape = 7;
	EXPECT_EQ(BTEP_BAD_VALUE, btep_body_create(m_world, &body, &made));
	EXPECT_EQ(0, made);
	EXPECT_EQ(BTEP_BAD_HANDLE, btep_joint_create(m_world, m_wall, 99, ORIGIN, UPRIGHT, &m_capacity, &made));
	expectMessage("99 is no body");
	m_capacity.m_stiffness[0] = -1;
	EXPECT_EQ(BTEP_BAD_VALUE, btep_joint_create(m_world, m_wall, m_block, ORIGIN, UPRIGHT, &m_capacity, &made));
	expectMessage("stiffness");
	btep_material steel = {sizeof steel, 200e9, 0.3, 0, 0.2, 0, 1, 0, 0, 0, 0};
	EXPECT_EQ(BTEP_BAD_VALUE, btep_capacity_of_member(m_world, &steel, 0.1, 0.1, 1, 1, &m_capacity));
	expectMessage("yield stress");
	// The world goes on.
	EXPECT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 60));
}

TEST_F(CInterface, RefusesWhatSinglePrecisionDoesNotBear)
{
	btep_world* other = nullptr;
	int made = 0;
	// Of each range, what is beyond its ends: a little, and by far.
	struct Case
	{
		double btep_body_description::*m_field;
		std::vector<double> m_good, m_bad;
		const char* m_message;
	};
	const Case cases[] = {{&btep_body_description::m_mass,
						   {0, 1e-12, 1e9},
						   {1e-310, 9e-13, 1.1e12, 1e30, 1e200, -1, NAN},
						   "mass of a body"},
						  {&btep_body_description::m_friction, {0, 100}, {-0.1, 101, 1e38, NAN}, "friction of a body"}};
	for (const Case& each : cases)
		for (const bool isGood : {true, false})
			for (const double value : isGood ? each.m_good : each.m_bad)
			{
				btep_body_description body = m_cube;
				body.*each.m_field = value;
				EXPECT_EQ(isGood ? BTEP_OK : BTEP_BAD_VALUE, btep_body_create(m_world, &body, &made)) << value;
				if (!isGood)
					expectMessage(each.m_message);
			}
	for (const double bad : {9e-7, 1.1e7, 1e30, 1e200, -1., double(NAN)})
	{
		btep_body_description body = m_cube;
		body.m_extent[2] = bad;
		EXPECT_EQ(BTEP_BAD_VALUE, btep_body_create(m_world, &body, &made)) << bad;
		expectMessage("extent of a body");
	}
	for (const double bad : {1.1e9, -1e30, 1e300, double(INFINITY), double(NAN)})
	{
		const double three[3] = {0, bad, 0};
		btep_body_description body = m_cube;
		body.m_position[1] = bad;
		EXPECT_EQ(BTEP_BAD_VALUE, btep_body_create(m_world, &body, &made)) << bad;
		expectMessage("coordinate of a body");
		expectMessage("from -1e+09 to 1e+09");
		EXPECT_EQ(BTEP_BAD_VALUE, btep_joint_create(m_world, m_wall, m_block, three, UPRIGHT, &m_capacity, &made));
		expectMessage("coordinate of a joint");
		EXPECT_EQ(BTEP_BAD_VALUE, btep_body_set_velocity(m_world, m_block, three, ORIGIN)) << bad;
		expectMessage("velocity of a body");
		EXPECT_EQ(BTEP_BAD_VALUE, btep_body_set_velocity(m_world, m_block, ORIGIN, three)) << bad;
		expectMessage("angular velocity of a body");
		EXPECT_EQ(BTEP_BAD_VALUE, btep_world_create(BTEP_VERSION, three, &other)) << bad;
	}
	EXPECT_EQ(nullptr, other);
	for (const double bad : {1.1e18, 1.1e13, -1e30, double(NAN)})
	{
		const double force[3] = {0, 0, bad};
		EXPECT_EQ(BTEP_BAD_VALUE, btep_body_apply_force(m_world, m_block, force)) << bad;
		expectMessage("force on a body");
	}
	for (const double bad : {9e-10, 1.1e3, 1e30})
		EXPECT_EQ(BTEP_BAD_VALUE, btep_world_step(m_world, bad)) << bad;
}

TEST_F(CInterface, TellsThatABodyIsNotFinite)
{
	// Of single precision an inertia that cannot be reckoned with is refused.
	m_cube.m_mass = 1e12;
	m_cube.m_extent[0] = 1e4;
	int made = 0;
	const bool isSingle = sizeof(btScalar) == sizeof(float);
	ASSERT_EQ(isSingle ? BTEP_BAD_VALUE : BTEP_OK, btep_body_create(m_world, &m_cube, &made));
	if (isSingle)
		expectMessage("mass and extents of a body");
	// What is extreme together can still become no number. It is told of as long as it is there, and the others go on without it.
	std::vector<int> bodies;
	const double masses[3] = {1e12, 1e-12, 1e-12};
	for (int i = 0; i < 3; ++i)
	{
		btep_body_description body = {sizeof body,  i > 0, {0.8, 0.025, 0.8}, masses[i], {0.78 * i - 4, 0, 0},
									  {0, 0, 0, 1}, 100};
		const double velocity[3] = {i < 2 ? 0 : -2e5, i > 0 ? 0 : 4e4, 0},
					 spin[3] = {i > 0 ? 0 : -60., i > 0 ? 0 : -1e4, 0};
		ASSERT_EQ(BTEP_OK, btep_body_create(m_world, &body, &made)) << btep_world_message(m_world);
		ASSERT_EQ(BTEP_OK, btep_body_set_velocity(m_world, made, velocity, spin));
		bodies.push_back(made);
	}
	for (int i = 0; i < 10; ++i)
	{
		const int result = btep_world_step(m_world, 1. / 60);
		bool areFinite = true;
		for (const int body : bodies)
		{
			double linear[3], angular[3];
			ASSERT_EQ(BTEP_OK, btep_body_get_velocity(m_world, body, linear, angular));
			areFinite &=
				btElasticPlasticIsFinite(linear[0] + linear[1] + linear[2] + angular[0] + angular[1] + angular[2]);
		}
		EXPECT_EQ(areFinite ? BTEP_OK : BTEP_NOT_FINITE, result) << i;
		if (isSingle && i == 9)
		{
			EXPECT_FALSE(areFinite);
			expectMessage("is not finite any more");
		}
	}
	for (const int body : bodies)
		ASSERT_EQ(BTEP_OK, btep_body_destroy(m_world, body));
	EXPECT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 60));
}

TEST_F(CInterface, TakesRotationsOfAnyLength)
{
	for (const double length : {1e-300, 1e-20, 1., 1e20, 1e300})
	{
		btep_body_description body = m_cube;
		body.m_position[0] = 5;
		body.m_rotation[0] = body.m_rotation[3] = length;
		int made = 0;
		ASSERT_EQ(BTEP_OK, btep_body_create(m_world, &body, &made)) << length;
		double place[3], turn[4];
		ASSERT_EQ(BTEP_OK, btep_body_get_pose(m_world, made, place, turn));
		EXPECT_NEAR(sqrt(0.5), turn[0], 1e-6) << length;
		EXPECT_NEAR(sqrt(0.5), turn[3], 1e-6) << length;
		ASSERT_EQ(BTEP_OK, btep_body_destroy(m_world, made));
	}
}

TEST_F(CInterface, UnreadEventsStayBounded)
{
	const double middle[3] = {0, -0.5, 0};
	int joint = 0;
	ASSERT_EQ(BTEP_OK, btep_joint_create(m_world, m_wall, m_block, middle, UPRIGHT, &m_capacity, &joint));
	ASSERT_EQ(BTEP_OK, btep_joint_set_level(m_world, joint, 0.1));
	int read = 0;
	btep_event event = {sizeof event, 0, 0, 0, 0, 0, {}, {}, {}, 0, 0};
	for (int i = 0; i < 200; ++i)
	{
		// To and fro, each until the ringing is below the level again.
		for (int k = 0; k < 20; ++k)
		{
			const double force[3] = {i % 2 ? 5e3 : 0, 0, 0};
			ASSERT_EQ(BTEP_OK, btep_body_apply_force(m_world, m_block, force));
			ASSERT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 10));
		}
		// Read one by one they are all told.
		if (i < 100)
			read += btep_event_next(m_world, &event) == BTEP_OK;
	}
	EXPECT_GT(read, 20);
	int unread = 0;
	while (btep_event_next(m_world, &event) == BTEP_OK)
		++unread;
	EXPECT_EQ(1, unread);
	EXPECT_EQ(BTEP_LEVEL, event.m_type);
	EXPECT_EQ(joint, event.m_joint);
}

TEST_F(CInterface, TheSameCapacityHasOneNumber)
{
	const btep_material steel = {sizeof steel, 200e9, 0.3, 200e6, 0.2, 0.01, 1, 0, 0, 0, 0};
	int number = 0;
	for (int i = 0; i < 3; ++i)
	{
		int section = 0;
		ASSERT_EQ(BTEP_OK, btep_section_create(m_world, &steel, 0.1, 0.2, 8, &section));
		ASSERT_EQ(BTEP_OK, btep_capacity_of_section(m_world, section, 0.5, 0.5, 0, &m_capacity));
		EXPECT_TRUE(i == 0 || number == m_capacity.m_fibres);
		number = m_capacity.m_fibres;
		ASSERT_EQ(BTEP_OK, btep_capacity_of_section(m_world, section, 0.5, 0.6, 0, &m_capacity));
		EXPECT_NE(number, m_capacity.m_fibres);
		ASSERT_EQ(BTEP_OK, btep_section_destroy(m_world, section));
	}
}

TEST_F(CInterface, HoldsAndFrees)
{
	const double middle[3] = {0, -0.5, 0};
	int joint = 0, second = 0;
	ASSERT_EQ(BTEP_OK, btep_joint_create(m_world, m_wall, m_block, middle, UPRIGHT, &m_capacity, &joint));
	ASSERT_EQ(BTEP_OK, btep_joint_create(m_world, m_wall, m_block, middle, UPRIGHT, &m_capacity, &second));
	for (int i = 0; i < 60; ++i)
		ASSERT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 60));
	btep_joint_state state = {sizeof state, {}, {}, 0, 0, 0, 0, 0, 0};
	ASSERT_EQ(BTEP_OK, btep_joint_get_state(m_world, joint, &state));
	// 100 N by two joints, along the joint's y axis; the sign is that of what acts on A.
	EXPECT_NEAR(50, fabs(state.m_force[1]), 0.5);
	EXPECT_FALSE(state.m_is_broken);
	ASSERT_EQ(BTEP_OK, btep_joint_destroy(m_world, joint));
	EXPECT_EQ(BTEP_BAD_HANDLE, btep_joint_destroy(m_world, joint));
	ASSERT_EQ(BTEP_OK, btep_joint_destroy(m_world, second));
	for (int i = 0; i < 30; ++i)
		ASSERT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 60));
	double linear[3], angular[3];
	ASSERT_EQ(BTEP_OK, btep_body_get_velocity(m_world, m_block, linear, angular));
	EXPECT_NEAR(-5, linear[1], 0.01);
	ASSERT_EQ(BTEP_OK, btep_body_destroy(m_world, m_block));
	EXPECT_EQ(BTEP_BAD_HANDLE, btep_body_get_velocity(m_world, m_block, linear, angular));
}

TEST_F(CInterface, EventsOfWhatIsDestroyedAreNotTold)
{
	const double middle[3] = {0, -0.5, 0}, force[3] = {1e6, 0, 0};
	int joint = 0;
	for (double& each : m_capacity.m_ductility)
		each = 1e-3;
	ASSERT_EQ(BTEP_OK, btep_joint_create(m_world, m_wall, m_block, middle, UPRIGHT, &m_capacity, &joint));
	btep_event event = {sizeof event, 0, 0, 0, 0, 0, {}, {}, {}, 0, 0};
	EXPECT_EQ(BTEP_NO_EVENT, btep_event_next(m_world, &event));
	ASSERT_EQ(BTEP_OK, btep_body_apply_force(m_world, m_block, force));
	ASSERT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 60));
	EXPECT_EQ(BTEP_OK, btep_event_next(m_world, &event));
	EXPECT_EQ(BTEP_YIELD, event.m_type);
	EXPECT_EQ(joint, event.m_joint);
	ASSERT_EQ(BTEP_OK, btep_body_destroy(m_world, m_block));
	EXPECT_EQ(BTEP_NO_EVENT, btep_event_next(m_world, &event));
}

TEST_F(CInterface, TellsWhatCracksAndRuptures)
{
	// 30 x 30 cm of concrete with two bars is pulled at 0.1 m/s: it cracks throughout, then the bars rupture.
	const btep_material concrete = {sizeof concrete, 30e9, 0.2, 30e6, 1e-5, 0.03, 0.1, 0.0035, 0, 0, 0},
						bar = {sizeof bar, 200e9, 0.3, 500e6, 0.01, 0.01, 1, 0, 0, 0, 0};
	int section = 0, joint = 0, count = 0, heavy = 0;
	m_cube.m_mass = 1e6;
	ASSERT_EQ(BTEP_OK, btep_body_create(m_world, &m_cube, &heavy));
	ASSERT_EQ(BTEP_OK, btep_section_create(m_world, &concrete, 0.3, 0.3, 16, &section));
	for (const double z : {-0.1, 0.1})
		ASSERT_EQ(BTEP_OK, btep_section_add_bar(m_world, section, -0.1, z, 3e-4, &bar));
	ASSERT_EQ(BTEP_OK, btep_capacity_of_section(m_world, section, 1, 1, 0.5, &m_capacity));
	ASSERT_EQ(BTEP_OK, btep_section_destroy(m_world, section));
	const double middle[3] = {0, -0.5, 0}, down[4] = {0, 0, -sqrt(0.5), sqrt(0.5)}, still[3] = {0, 0, 0},
				 pull[3] = {0, -0.1, 0};
	ASSERT_EQ(BTEP_OK, btep_joint_create(m_world, m_wall, heavy, middle, down, &m_capacity, &joint));
	ASSERT_EQ(BTEP_OK, btep_joint_get_num_fibres(m_world, joint, &count));
	ASSERT_EQ(18, count);
	int cracks = 0, ruptures = 0;
	bool isBroken = false;
	for (int i = 0; i < 480 && !isBroken; ++i)
	{
		ASSERT_EQ(BTEP_OK, btep_body_set_velocity(m_world, heavy, pull, still));
		ASSERT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 480));
		btep_event event = {sizeof event, 0, 0, 0, 0, 0, {}, {}, {}, 0, 0};
		while (btep_event_next(m_world, &event) == BTEP_OK)
		{
			EXPECT_EQ(joint, event.m_joint);
			isBroken |= event.m_type == BTEP_BREAK;
			if (event.m_type != BTEP_CRACK && event.m_type != BTEP_RUPTURE)
			{
				EXPECT_EQ(-1, event.m_fibre);
				EXPECT_EQ(-1, event.m_part);
				continue;
			}
			btep_fibre fibre = {sizeof fibre, 0, 0, 0, 0, 0, 0, 0};
			ASSERT_EQ(BTEP_OK, btep_joint_get_fibre(m_world, joint, event.m_fibre, &fibre));
			EXPECT_EQ(event.m_part, fibre.m_part);
			EXPECT_EQ(0, fibre.m_force);
			// All of the section has cracked before a bar goes.
			if (event.m_type == BTEP_CRACK)
			{
				EXPECT_EQ(0, event.m_part);
				EXPECT_TRUE(fibre.m_is_cracked);
				EXPECT_EQ(0, ruptures);
				++cracks;
			}
			else if (event.m_part > 0)
			{
				EXPECT_EQ(1, fibre.m_damage);
				++ruptures;
			}
		}
	}
	EXPECT_EQ(16, cracks);
	EXPECT_EQ(2, ruptures);
	EXPECT_TRUE(isBroken);
}

TEST_F(CInterface, RefusesSectionsThatAreNone)
{
	btep_material steel = {sizeof steel, 200e9, 0.3, 2e8, 0.2, 0, 1, 0, 0, 0, 0};
	int section = 0, joint = 0;
	EXPECT_EQ(BTEP_BAD_VALUE, btep_section_create(m_world, &steel, 0.3, 0.3, 1000, &section));
	expectMessage("fibres");
	EXPECT_EQ(BTEP_BAD_VALUE, btep_section_create(m_world, &steel, 0.3, -1, 0, &section));
	expectMessage("height");
	ASSERT_EQ(BTEP_OK, btep_section_create(m_world, &steel, 0.3, 0.3, 0, &section));
	EXPECT_EQ(BTEP_BAD_VALUE, btep_section_add_bar(m_world, section, 0, 0, 0, &steel));
	EXPECT_EQ(BTEP_BAD_VALUE, btep_capacity_of_section(m_world, section, 0, 0, 0, &m_capacity));
	steel.m_yield_stress = -1;
	EXPECT_EQ(BTEP_BAD_VALUE, btep_section_add_bar(m_world, section, 0, 0, 1e-4, &steel));
	ASSERT_EQ(BTEP_OK, btep_capacity_of_section(m_world, section, 1, 1, 0, &m_capacity));
	const double middle[3] = {0, -0.5, 0};
	ASSERT_EQ(BTEP_OK, btep_joint_create(m_world, m_wall, m_block, middle, UPRIGHT, &m_capacity, &joint));
	btep_fibre fibre = {sizeof fibre, 0, 0, 0, 0, 0, 0, 0};
	EXPECT_EQ(BTEP_BAD_VALUE, btep_joint_get_fibre(m_world, joint, -1, &fibre));
	EXPECT_EQ(BTEP_BAD_VALUE, btep_joint_get_fibre(m_world, joint, 16, &fibre));
	EXPECT_EQ(BTEP_OK, btep_section_destroy(m_world, section));
	EXPECT_EQ(BTEP_BAD_HANDLE, btep_section_destroy(m_world, section));
	EXPECT_EQ(BTEP_BAD_HANDLE, btep_capacity_of_section(m_world, section, 1, 1, 0, &m_capacity));
	m_capacity.m_fibres = 99;
	EXPECT_EQ(BTEP_BAD_HANDLE, btep_joint_create(m_world, m_wall, m_block, middle, UPRIGHT, &m_capacity, &joint));
	expectMessage("m_fibres");
}
}  // namespace testC
