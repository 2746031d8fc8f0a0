#pragma once
// Where a ray meets an implicit surface: by ranges, which prove that it does not meet it before.

#include <optional>

#include "core/api/implicit.h"
#include "core/base/segment.h"

namespace pbrt {

// The first s of the piece at which f = 0; with `any`, some s at which it is. No allocation.
// The rules where ranges do not settle the question:
// - No crossing is missed: a part of the ray is dropped only if the range of f excludes zero there,
//   or that of its slope proves it.
// - A touch: what is still undecided when it is as short as the rounding of the ray itself (or
//   2^-46 of the piece), or when the ranges are those of rounding, counts as a crossing, if f is
//   bounded there. A ray that grazes the surface is such a case; a pole is not.
// - A ray that starts on the surface, to within rounding, does not meet it there.
// - The work is bounded: after kMostLooks ranges, parts still undecided are settled by the signs of
//   f at their ends, without proof: an even number of crossings in one of them is missed. Fields
//   with good ranges take a few.
// A crossing that is found is off by 2^-48 of the piece and the rounding of the ray, if f is
// continuous; a touch by as much as it is short.
inline constexpr int kMostLooks = 2000;
std::optional<double> firstZero(const ImplicitField& field, const Segment& piece, bool any);

}  // namespace pbrt
