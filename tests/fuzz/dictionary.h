#pragma once
// The words of the scene format, for whoever makes scenes up.

#include <string>
#include <vector>

namespace pbrt::fuzz {

// Statements, the names of all plug-ins of this build and of other generations, their parameters
// with each type they may have, and numbers at the edges. Each ends with a blank where one has to
// follow.
std::vector<std::string> dictionary();

}  // namespace pbrt::fuzz
