#pragma once
// A crossing known in double as a hit, which ranks by a float.

#include "core/api/shape.h"

namespace pbrt {

// t is within (tMin, tMax] of the ray, and so is the hit's. What rounding takes from t goes along
// in u: the crossing is at t + u.
inline ShapeHit roundedHit(const ObjectRay& ray, double t, std::uint32_t primitive) {
  auto rounded = static_cast<float>(t);
  if (rounded <= ray.tMin) rounded = std::nextafter(rounded, kInfinity);
  if (rounded > ray.tMax) rounded = std::nextafter(rounded, -kInfinity);
  return {rounded, static_cast<float>(t - rounded), 0, primitive};
}

}  // namespace pbrt
