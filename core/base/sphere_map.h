#pragma once
// The sphere of directions laid out over the unit square, for pictures of surroundings.

#include <cstdint>

#include "core/base/math.h"

namespace pbrt {

// latlong: s is the angle about z from x to y over 2 pi, t the angle to +z over pi. equalarea: the
// octahedral map of Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD": +z in
// the middle of the square, -z in all its corners, equal areas of equal solid angle.
enum class SphereMap : std::uint8_t { latlong, equalarea };

using DVec2 = glm::dvec2;

// The unit direction of a point of [0, 1]^2.
inline DVec3 sphereFromSquare(SphereMap map, DVec2 st) {
  constexpr double pi = std::numbers::pi;
  if (map == SphereMap::latlong) {
    const double theta = pi * st.y, phi = 2 * pi * st.x;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  }
  // The concentric map of Shirley and Chiu 1997, turned by 45 degrees: the circle of radius r in
  // the sense of |u| + |v| becomes the one at height 1 - r^2, which cuts a cap of area 2 pi r^2,
  // pi times the area 2 r^2 of the diamond. Beyond the diamond of radius 1 lies the lower half,
  // folded outward over its four sides.
  const DVec2 p = 2.0 * st - 1.0, a = glm::abs(p);
  const double inside = 1 - (a.x + a.y), r = 1 - std::abs(inside);
  const double phi = r > 0 ? pi / 4 * ((a.y - a.x) / r + 1) : 0;
  const double rho = r * std::sqrt(2 - r * r);  // sin(theta) for cos(theta) = 1 - r^2
  return {std::copysign(rho * std::cos(phi), p.x), std::copysign(rho * std::sin(phi), p.y),
          std::copysign(1 - r * r, inside)};
}

// Its inverse, for a unit direction.
inline DVec2 squareFromSphere(SphereMap map, const DVec3& w) {
  constexpr double pi = std::numbers::pi;
  const double rho2 = w.x * w.x + w.y * w.y;
  if (map == SphereMap::latlong) {
    const double phi = std::atan2(w.y, w.x);
    return {phi / (2 * pi) + (phi < 0 ? 1 : 0), std::atan2(std::sqrt(rho2), w.z) / pi};
  }
  // r^2 = 1 - |cos| = sin^2 / (1 + |cos|), which does not cancel at the poles.
  const DVec2 a = glm::abs(DVec2(w));
  const double r = std::sqrt(rho2 / (1 + std::abs(w.z)));
  const double y = r * (2 / pi) * std::atan2(a.y, a.x), x = r - y;
  const DVec2 p = w.z < 0 ? DVec2(1 - y, 1 - x) : DVec2(x, y);
  return 0.5 * DVec2(std::copysign(p.x, w.x), std::copysign(p.y, w.y)) + 0.5;
}

}  // namespace pbrt
