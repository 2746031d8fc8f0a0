#pragma once
// Which particle of one frame is which of another, when only their places are known.

#include <optional>
#include <vector>

#include "core/base/math.h"

namespace pbrt::motion {

// How each particle of `from` has moved, as far as can be told. If there are as many in both, or
// `to` is the later frame and the longer (what is new comes last), they are taken to be in the same
// order, unless they would then have moved about as far apart as places in the set are. Those that
// would have moved further than `furthest`, and all if the order does not hold, are matched with
// what is nearest in `to`, if that is nearer than `near`.
std::vector<std::optional<Vec3>> shifts(const std::vector<Point3>& from,
                                        const std::vector<Point3>& to, bool toIsLater,
                                        float furthest, float near);

}  // namespace pbrt::motion
