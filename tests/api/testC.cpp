// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The interface in C: what it does with what is wrong. That it works is shown by its sample (tests/consumers/c).

#include <math.h>
#include <string.h>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticC.h"

namespace
{
const double GRAVITY[3] = {0, -10, 0}, ORIGIN[3] = {0, 0, 0}, UPRIGHT[4] = {0, 0, 0, 1};

struct CInterface : testing::Test
{
	btep_world* m_world = nullptr;
	int m_wall = 0, m_block = 0;
	btep_body_description m_cube = {sizeof m_cube, BTEP_BOX, {1, 1, 1}, 0, {0, 0, 0}, {0, 0, 0, 1}, 0.5};
	btep_capacity m_capacity = {sizeof m_capacity, {}, {}, {}, {}, 0, 0};

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
	btep_material steel = {sizeof steel, 200e9, 0.3, 0, 0.2, 0};
	EXPECT_EQ(BTEP_BAD_VALUE, btep_capacity_of_member(m_world, &steel, 0.1, 0.1, 1, 1, &m_capacity));
	expectMessage("yield stress");
	// The world goes on.
	EXPECT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 60));
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
	btep_event event = {sizeof event, 0, 0, 0, 0, 0, {}, {}, {}};
	EXPECT_EQ(BTEP_NO_EVENT, btep_event_next(m_world, &event));
	ASSERT_EQ(BTEP_OK, btep_body_apply_force(m_world, m_block, force));
	ASSERT_EQ(BTEP_OK, btep_world_step(m_world, 1. / 60));
	EXPECT_EQ(BTEP_OK, btep_event_next(m_world, &event));
	EXPECT_EQ(BTEP_YIELD, event.m_type);
	EXPECT_EQ(joint, event.m_joint);
	ASSERT_EQ(BTEP_OK, btep_body_destroy(m_world, m_block));
	EXPECT_EQ(BTEP_NO_EVENT, btep_event_next(m_world, &event));
}
}  // namespace
