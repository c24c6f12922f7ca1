// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/SceneBuilder.h"

namespace ep
{
namespace
{
enum class VehicleKind
{
	DumpTruck,
	Car
};

const std::vector<Named<VehicleKind>>& vehicleKinds()
{
	static const std::vector<Named<VehicleKind>> all = {
		{"dump-truck", VehicleKind::DumpTruck, "the demolisher's, of 50 t"}, {"car", VehicleKind::Car, "of 1.4 t"}};
	return all;
}

void chassisFields(Fields& f, VehicleSettings& s)
{
	const Range length = {.01, 100}, notNegative = Range::notNegative();
	// In a file x is forward.
	btVector3 size(s.size.z(), s.size.y(), s.size.x());
	f.scalar("mass", s.mass, {1, 1e9}, "kg", "of all of it");
	f.vector("size", size, "m", "length, height and width of its body, a box", Need::Optional, length);
	s.size.setValue(size.z(), size.y(), size.x());
	f.scalar("wheel_radius", s.wheelRadius, length, "m", "of its four wheels");
	f.scalar("wheel_base", s.wheelBase, length, "m", "between its axles");
	f.scalar("track", s.track, length, "m", "between the wheels of an axle");
	f.scalar("axle_height", s.axleHeight, {-100, 100}, "m", "of the unloaded wheels, above the middle of the body");
	f.scalar("suspension_length", s.suspensionLength, length, "m", "unloaded");
	f.scalar("suspension_stiffness", s.suspensionStiffness, {.1, 1e5}, "1/s^2", "of a wheel, over the mass");
	f.scalar("suspension_damping", s.suspensionDamping, {0, 1e4}, "1/s", "of a wheel, over the mass");
	f.scalar("grip", s.grip, {0, 10}, "", "friction of the tyres");
	f.scalar("drive_force", s.driveForce, notNegative, "N", "of all wheels at low speed");
	f.scalar("power", s.power, notNegative, "W", "of the engine");
	f.scalar("brake_force", s.brakeForce, notNegative, "N", "of all wheels");
	f.scalar("top_speed", s.topSpeed, {0, 1e3}, "m/s", "from which on the engine does not push");
	f.scalar("rolling_resistance", s.rollingResistance, notNegative, "N", "of all wheels");
	f.scalar("air_drag", s.airDrag, notNegative, "N s^2/m^2", "force over the square of the speed");
	double steering = double(btDegrees(s.maxSteer));
	if (f.number("steering", steering, {0, 60}, "degrees", "of the front wheels; the rear ones turn against them"))
		s.maxSteer = btRadians(btScalar(steering));
}

void legFields(Fields& f, Route& route, btVector3& place)
{
	Leg leg;
	std::vector<double> to;
	leg.drives =
		f.numbers("to", to, 2, 2, Range::place(), "m", "x and z of a place; straight on, behind it in reverse");
	f.scalar("speed", leg.speed, {.1, 1e3}, "m/s", "on the way");
	f.flag("stop", leg.stops, "there; else it drives on to the next place");
	const bool hasWait = f.scalar("wait", leg.wait, {0, 1e5}, "s", "before it drives on; without a place only this");
	if (!leg.drives && !hasWait)
		return f.refuse("", "must have to, to drive, or wait");
	if (hasWait && leg.drives && !leg.stops)
		return f.refuse("wait", "is for a place where it stops");
	if (to.size() == 2)
	{
		leg.to.setValue(btScalar(to[0]), place.y(), btScalar(to[1]));
		const btVector3 way = leg.to - place;
		const btScalar length = way.length();
		if (length < btScalar(.01))
			return f.refuse("to", "is where it is already");
		leg.along.setValue(way.x() / length, 0, way.z() / length);
		place = leg.to;
	}
	route.push_back(leg);
}
}  // namespace

void vehicleFields(Fields& f, SceneBuilder& builder)
{
	SceneDescription::Vehicle v;
	SceneDescription::Body b;
	b.friction = .4;
	b.colour.setValue(btScalar(.78), btScalar(.36), btScalar(.02));
	VehicleKind kind = VehicleKind::DumpTruck;
	double speed = 0;
	f.text("name", b.name, "of its body, by which it is found", Need::Required);
	f.named("kind", kind, vehicleKinds(), "whose sizes and forces it has where it has none of its own");
	if (kind == VehicleKind::Car)
		v.settings = VehicleSettings::car();
	// Of the ground below it.
	poseFields(f, b.pose);
	btVector3 place = b.pose.getOrigin();
	f.number("velocity", speed, {-1e3, 1e3}, "m/s", "forwards, at the beginning");
	f.number("friction", b.friction, {0, 100}, "", "of its body, is multiplied with that of what it touches");
	f.vector("colour", b.colour, "", "red, green and blue, linear", Need::Optional, {0, 1});
	chassisFields(f, v.settings);
	f.list("route", 1000, "places to drive to, one after the other; then it brakes. Without one it rolls",
		   [&](Fields& in) { legFields(in, v.route, place); });
	const btVector3& size = v.settings.size;
	b.shape.size.setValue(size.z(), size.y(), size.x());
	b.mass = double(v.settings.mass);
	b.velocity = b.pose.getBasis().getColumn(0) * btScalar(speed);
	b.pose.setOrigin(b.pose * btVector3(0, v.settings.chassisHeight(), 0));
	v.body = builder.add(f, b);
	if (v.body != SceneDescription::WORLD)
		builder.scene().vehicles.push_back(v);
}
}  // namespace ep
