// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/destruction/Props.h"

namespace ep
{
namespace
{
const double BASE_MASS = 60;  // [kg]
const double BASE_TOP = 0.1;  // [m]
const double POST = 1;        // height of a post [m]

/// Builds props, one by one.
class Yard
{
public:
	explicit Yard(Stage& stage) : m_stage(stage)
	{
		World& world = stage.world();
		m_base = world.box(vector(0.6, BASE_TOP, 0.6));
		m_post = world.box(vector(0.08, POST, 0.08));
		m_sign = world.box(vector(0.6, 0.6, 0.03));
		m_rail = world.box(vector(1.8, 0.1, 0.04));
		// Steel and wood of the stage's strength.
		btElasticPlasticMaterial steel = stage.concrete(235e6, 0.2), wood = stage.concrete(20e6, 0.02);
		steel.m_youngsModulus = btElasticPlasticMaterial::steel().m_youngsModulus;
		wood.m_youngsModulus = btScalar(10e9);
		m_pole = btElasticPlasticCapacity::fromMember(steel, btElasticPlasticSection::circle(btScalar(0.02)), 1, 1);
		m_plank = stage.rectangularMember(wood, 0.04, 0.1, 1, 1);
		m_foot = stage.rectangularMember(wood, 0.08, 0.08, 1, 1);
	}

	void addSign(const btVector3& place)
	{
		btRigidBody &base = m_stage.body(BASE_MASS, m_base, place + vector(0, BASE_TOP / 2, 0)),
					&pole = m_stage.body(6, m_post, place + vector(0, BASE_TOP + POST / 2, 0)),
					&sign = m_stage.body(5, m_sign, place + vector(0, BASE_TOP + POST + 0.3, 0));
		m_stage.join(base, pole, place + vector(0, BASE_TOP, 0), Stage::Along::Y, m_pole);
		m_stage.join(pole, sign, place + vector(0, BASE_TOP + POST, 0), Stage::Along::Y, m_pole);
	}

	void addFence(const btVector3& place)
	{
		const double aside[2] = {-0.8, 0.8};
		btRigidBody* posts[2];
		for (int i = 0; i < 2; ++i)
		{
			const btVector3 foot = place + vector(aside[i], 0, 0);
			btRigidBody& base = m_stage.body(BASE_MASS, m_base, foot + vector(0, BASE_TOP / 2, 0));
			posts[i] = &m_stage.body(5, m_post, foot + vector(0, BASE_TOP + POST / 2, 0));
			m_stage.join(base, *posts[i], foot + vector(0, BASE_TOP, 0), Stage::Along::Y, m_foot);
		}
		for (int rail = 0; rail < 3; ++rail)
		{
			const double height = 0.4 + 0.3 * rail;
			btRigidBody& body = m_stage.body(4, m_rail, place + vector(0, height, 0.065));
			for (int i = 0; i < 2; ++i)
				m_stage.join(*posts[i], body, place + vector(aside[i], height, 0.04), Stage::Along::X, m_plank);
		}
	}

private:
	Stage& m_stage;
	btCollisionShape *m_base, *m_post, *m_sign, *m_rail;
	btElasticPlasticCapacity m_pole, m_plank, m_foot;
};
}  // namespace

void Props::build(Stage& stage) const
{
	Yard yard(stage);
	const int inRow = 20;
	for (int i = 0; i < count; ++i)
	{
		const btVector3 place = vector(i % inRow * 3 - 30, 0, i / inRow * 3 - 15);
		i % 2 ? yard.addSign(place) : yard.addFence(place);
	}
	const double radius = 0.7;
	for (int i = 0; i < 4; ++i)
		stage.throwBall(120 + 20 * i, {btScalar(radius), 3000, vector(-38, radius, -13 + 6 * i), vector(20, 0, 1)});
}
}  // namespace ep
