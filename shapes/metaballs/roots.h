#pragma once
// Where a ray first meets the surface within a cell, with proof that it does not meet it before.

#include <optional>

#include "core/base/ray.h"
#include "shapes/metaballs/cells.h"
#include "shapes/metaballs/loops.h"

namespace pbrt::metaballs {

// The smallest t in (tMin, tMax] at which the ray meets the surface within the cell's box (and a
// hair around it, see Cells); `list` holds the atoms that reach it. t is off by no more than
// `tolerance` times the smallest radius of the list, or, if that is less, by the rounding of
// double. The rules where rounding hides the answer:
// - No crossing is missed: a piece of the ray is dropped only if the field, rounding included,
//   provably has no zero there.
// - A touch: what is still undecided when it is as short as the rounding of the ray itself (or
//   2^-46 of the piece of the ray in the cell) counts as a crossing. The field differs from the
//   threshold by no more than rounding there; a ray that grazes the surface is such a case.
// - A ray that starts on the surface, to within rounding, does not meet it there.
// A zero or not finite direction meets nothing.
std::optional<double> firstCrossing(const Field& field, const Cell& cell, AtomList list,
                                    const ObjectRay& ray, Effort* effort = nullptr,
                                    double tolerance = 0);

// Whether there is any; faster, since a change of sign settles it.
bool crosses(const Field& field, const Cell& cell, AtomList list, const ObjectRay& ray);

}  // namespace pbrt::metaballs
