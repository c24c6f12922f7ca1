// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/generators/Assembly.h"

namespace ep
{
namespace
{
/// A beam or a chain: from a point to another, in parts.
void lineStructure(Fields& f, SceneBuilder& builder, bool isRope)
{
	Assembly assembly(f, builder);
	Assembly::Line line;
	line.isRope = isRope;
	btVector3 from(0, 0, 0), to(1, 0, 0);
	int parts = isRope ? 10 : 8;
	double sag = 0;
	std::string bodies[2] = {"world", "world"};
	sectionField(f, "section", builder, line.section, Need::Required);
	f.vector("from", from, "m", "its beginning", Need::Required);
	f.vector("to", to, "m", "its end", Need::Required);
	f.whole("parts", parts, 1, 1000, "rigid bodies that it is made of");
	f.number("sag", sag, {-1e5, 1e5}, "m", "of its middle against up, as a parabola");
	f.direction("up", line.up, "direction of the section's height, as near as can be");
	f.named("start", line.ends[0], supports(), "what holds its beginning");
	f.text("start_body", bodies[0], "to which its beginning is joined, else the world");
	f.named("end", line.ends[1], supports(), "what holds its end");
	f.text("end_body", bodies[1], "to which its end is joined, else the world");
	for (int i = 0; i < 2; ++i)
		line.bodies[i] = builder.body(f, i == 0 ? "start_body" : "end_body", bodies[i]);
	if (!((to - from).length() > btScalar(1e-3)))
		f.refuse("to", "is where it begins");
	if (f.hasFailed() || !builder.hasRoom(f, parts))
		return;
	for (int i = 0; i <= parts; ++i)
	{
		const btScalar t = btScalar(i) / btScalar(parts);
		line.nodes.push_back(from.lerp(to, t) - line.up * (btScalar(4 * sag) * t * (1 - t)));
	}
	assembly.line(line);
}
}  // namespace

void beamStructure(Fields& f, SceneBuilder& builder) { lineStructure(f, builder, false); }

void chainStructure(Fields& f, SceneBuilder& builder) { lineStructure(f, builder, true); }
}  // namespace ep
