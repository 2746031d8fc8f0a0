#pragma once
// Where a ray first meets the surface within a cell, with proof that it does not meet it before.

#include <optional>

#include "core/base/ray.h"
#include "shapes/metaballs/cells.h"

namespace pbrt::metaballs {

// Work done: evaluations of the field over an interval of the ray, and at a point of it.
struct Effort {
  std::uint64_t intervals = 0, points = 0;
};

// The smallest t in (tMin, tMax] at which the ray meets the surface within the cell's box; `list`
// holds the atoms that reach it. The rules where rounding hides the answer:
// - No crossing is missed: an interval is dropped only if the field, rounding included, provably
//   has no zero there.
// - A touch: what is still undecided when it is as short as the rounding of the ray itself (or
//   2^-46 of the piece of the ray in the cell) counts as a crossing. The field differs from the
//   threshold by no more than rounding there; a ray that grazes the surface is such a case.
// - A ray that starts on the surface, to within rounding, does not meet it there unless it grazes.
// A zero or not finite direction meets nothing.
std::optional<double> firstCrossing(const Field& field, const Cell& cell, AtomList list,
                                    const ObjectRay& ray, Effort* effort = nullptr);

// Whether there is any; faster, since a change of sign settles it.
bool crosses(const Field& field, const Cell& cell, AtomList list, const ObjectRay& ray);

}  // namespace pbrt::metaballs
