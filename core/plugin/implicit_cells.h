#pragma once
// Boxes that together hold an implicit surface.

#include <vector>

#include "core/api/implicit.h"

namespace pbrt {

// The boxes share no more than faces, and lie within the bounds of the field. There are at most
// `most`; none, if the range of the field excludes zero everywhere. They are halved as long as
// there are few enough of them, 72 times at most, each time across their longest edge. On all
// threads; the result does not depend on their number. Throws Error if the bounds are empty or not
// finite.
std::vector<Bounds3> shellOf(const ImplicitField& field, std::size_t most);

}  // namespace pbrt
