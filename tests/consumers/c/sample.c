/* SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors */
/* SPDX-License-Identifier: Zlib */

/* A box of 3 t hangs on a steel rod, which yields and tears: by the C interface. */
#include <stdio.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticC.h"

static btep_world* world;

static int check(int result)
{
	if (result < 0)
		printf("error %d: %s\n", result, btep_world_message(world));
	return result;
}

static int add_box(double mass, double height)
{
	struct btep_body_description box = {
		sizeof box, BTEP_BOX, {1, 1, 1}, mass, {0, height, 0}, {0, 0, 0, 1}, 0.5};
	int body = 0;
	check(btep_body_create(world, &box, &body));
	return body;
}

int main(void)
{
	const double gravity[3] = {0, -10, 0}, middle[3] = {0, -1, 0};
	const double down[4] = {0, 0, -0.70710678118654752, 0.70710678118654752}; /* x points from A to B */
	const struct btep_material steel = {sizeof steel, 200e9, 0.3, 200e6, 0.2, 0.01, 1, 0, 0, 0, 0};
	struct btep_capacity rod = {sizeof rod, {0}, {0}, {0}, {0}, 0, 0, 0, 0};
	struct btep_joint_state state = {sizeof state, {0}, {0}, 0, 0, 0, 0, 0, 0};
	struct btep_event event = {sizeof event, 0, 0, 0, 0, 0, {0}, {0}, {0}, 0, 0};
	int support, load, joint = 0, i, breaks = 0;

	if (check(btep_world_create(BTEP_VERSION, gravity, &world)))
		return 1;
	support = add_box(0, 0);
	load = add_box(3000, -2);
	if (check(btep_capacity_of_member(world, &steel, 0.01, 0.01, 1, 1, &rod)) ||
		check(btep_joint_create(world, support, load, middle, down, &rod, &joint)) ||
		check(btep_joint_set_level(world, joint, 0.5)))
		return 1;
	for (i = 0; i < 240 && !state.m_is_broken; ++i)
	{
		if (check(btep_world_step(world, 1. / 240)))
			return 1;
		while (btep_event_next(world, &event) == BTEP_OK)
		{
			printf("%.3f s: event %d of joint %d, %.0f J\n", event.m_time, event.m_type, event.m_joint, event.m_energy);
			breaks += event.m_type == BTEP_BREAK;
		}
		check(btep_joint_get_state(world, joint, &state));
	}
	/* 20 kN along 20 % of a metre, and what the rod has stored. */
	if (breaks != 1 || state.m_plastic_energy < 4000 || state.m_plastic_energy > 4100)
		return 1;
	if (btep_joint_get_state(world, joint + 1, &state) != BTEP_BAD_HANDLE)
		return 1;
	btep_world_destroy(world);
	return 0;
}
