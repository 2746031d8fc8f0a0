#pragma once
// Pieces of rays, for those who look for roots along them. Every number is relative to the middle
// of the piece, so that none is larger than the place in question.

#include "core/base/ray.h"

namespace pbrt {

// A piece of a ray: the points o + s u, s in [-half, half].
struct Segment {
  DPoint3 o{};
  DVec3 u{};            // of unit length
  double half = -1;     // negative: nothing
  double error = 0;     // bound on the distance of o + s u from the ray's true point
  double middle = 0;    // t where s = 0
  double speed = 1;     // |d|
  bool starts = false;  // the ray starts where s = -half

  double t(double s) const { return middle + std::clamp(s, -half, half) / speed; }
};

// The piece of the ray within the box. Rounding may lose a sliver at a face. Nothing, too, for a
// direction that is zero or not finite.
Segment clip(const ObjectRay& ray, const DPoint3& lo, const DPoint3& hi);

}  // namespace pbrt
