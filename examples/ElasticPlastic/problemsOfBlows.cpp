#include "problemsOfBlows.h"

#include <cmath>

#include "BeamOnSupports.h"
#include "ParkesCantilever.h"

namespace ep
{
namespace
{
/// A body that turns about a hinge: all of its energy but what the hinge stores becomes plastic work.
Outcome hingeStopsBody(const Method& method, const Stepping& stepping)
{
	const double mass = 600, side = 1, stiffness = 4e5, yield = 4e3, spin = 10;
	World world(method, btVector3(0, 0, 0));
	btCollisionShape* cube = world.box(btVector3(btScalar(side), btScalar(side), btScalar(side)));
	btRigidBody* support = world.body(0, cube, btTransform::getIdentity(), false);
	btRigidBody* body = world.body(btScalar(mass), cube, btTransform::getIdentity(), false);
	btElasticPlasticCapacity capacity;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		capacity.set(i, btScalar(i < 3 ? 1e8 : stiffness),
					 i == BT_EP_BENDING_Z ? btScalar(yield) : capacity.unlimited());
	btElasticPlasticJoint* joint = world.joint(*support, *body, btTransform::getIdentity(), capacity);
	body->setAngularVelocity(btVector3(0, 0, btScalar(spin)));
	Outcome outcome;
	Run run(world, stepping, outcome);
	while (run.stepsUntil(1) > 0)
		run.step();
	const double energy = mass * side * side / 6 * spin * spin / 2;
	outcome.quantities = {{"plastic angle [rad]", double(joint->getPlasticDeformation(BT_EP_BENDING_Z)),
						   energy / yield - yield / (2 * stiffness)}};
	return outcome;
}

/// The cantilever struck at its tip: mean over the last third of the time, in which it swings about where it stays.
Outcome parkes(const Method& method, const Stepping& stepping, btScalar tipMass, btScalar velocity, double time,
			   double tip)
{
	ParkesCantilever::Settings settings;
	settings.method = method;
	settings.tipMass = tipMass;
	settings.velocity = velocity;
	ParkesCantilever cantilever(settings);
	Outcome outcome;
	Run run(cantilever.m_world, stepping, outcome);
	double sum = 0;
	int count = 0;
	while (run.stepsUntil(time) > 0)
	{
		run.step();
		if (run.time() < time * 2 / 3)
			continue;
		sum += cantilever.tip();
		++count;
	}
	outcome.quantities = {{"displacement of the tip that stays [m]", count > 0 ? sum / count : cantilever.tip(), tip}};
	return outcome;
}

// References: this solver in double with steps of 1 us (0.6367 and 0.2866 m; with 2 us 0.6374 and 0.2865 m). Parkes' own
// formula, for small deflections and without elasticity, gives 0.582 m for the heavy mass.
Outcome parkesHeavy(const Method& method, const Stepping& stepping)
{
	return parkes(method, stepping, btScalar(1.5), 25, 0.12, 0.6367);
}
Outcome parkesLight(const Method& method, const Stepping& stepping)
{
	return parkes(method, stepping, btScalar(0.3), 50, 0.12, 0.2866);
}

// Reference: an independent program in double with steps of 0.13 ms; with 0.065 and 0.033 ms this solver gives 0.3266 and
// 0.3286 m.
Outcome droppedMass(const Method& method, const Stepping& stepping)
{
	BeamOnSupports::Settings settings;
	settings.method = method;
	BeamOnSupports beam(settings);
	Outcome outcome;
	Run run(beam.m_world, stepping, outcome);
	while (run.stepsUntil(1) > 0)
		run.step();
	outcome.quantities = {{"sag that stays [m]", double(beam.sag()), 0.3255}};
	return outcome;
}
}  // namespace

std::vector<Problem> problemsOfBlows()
{
	return {
		{"hinge-stops-body", "a turning body that a hinge brings to rest", "conservation of energy", hingeStopsBody},
		{"parkes-heavy", "a cantilever struck at its tip, mass ratio 0.96", "own solution at 1 us", parkesHeavy},
		{"parkes-light", "a cantilever struck at its tip, mass ratio 0.19", "own solution at 1 us", parkesLight},
		{"dropped-mass", "2 t dropped on a beam that lies on supports", "solution at 0.13 ms", droppedMass},
	};
}
}  // namespace ep
