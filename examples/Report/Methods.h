#ifndef EP_REPORT_METHODS_H
#define EP_REPORT_METHODS_H

#include <string>
#include <vector>

#include "World.h"

namespace ep
{
/// As reports call them.
const char* nameOf(Solver solver);
const char* nameOf(Joints joints);
const char* nameOf(JointClass jointClass);

/// What the report compares. \param quick  one of each kind only
std::vector<Method> methodsToCompare(bool quick);
}  // namespace ep

#endif  // EP_REPORT_METHODS_H
