#ifndef EP_PARTS_H
#define EP_PARTS_H

#include "Bridge.h"
#include "Drawing.h"
#include "Vehicle.h"

namespace ep
{
/// Adds a bridge, its roads and its joints, coloured by what they bear and have borne.
void addParts(std::vector<Part>& parts, const Bridge& bridge);

void addParts(std::vector<Part>& parts, const Vehicle& vehicle);

/// Green over yellow to red with utilisation, darker with damage.
Colour jointColour(btScalar utilisation, btScalar damage);
}  // namespace ep

#endif  // EP_PARTS_H
