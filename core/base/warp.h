#pragma once
// Maps from the unit square to the sets one samples, with their densities.

#include "core/base/math.h"

namespace pbrt {

// Unit disk, area-preserving (Shirley and Chiu 1997).
inline Point2 concentricDisk(Point2 u) {
  const Point2 p = 2.F * u - 1.F;
  if (p.x == 0 && p.y == 0) return Point2(0);
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float r = wide ? p.x : p.y;
  const float phi = wide ? kPi / 4 * (p.y / p.x) : kPi / 2 - kPi / 4 * (p.x / p.y);
  return r * Point2(std::cos(phi), std::sin(phi));
}

// Hemisphere about +z with density cosHemispherePdf.
inline Vec3 cosHemisphere(Point2 u) {
  const Point2 d = concentricDisk(u);
  return {d.x, d.y, safeSqrt(1 - d.x * d.x - d.y * d.y)};
}
inline float cosHemispherePdf(float cosTheta) {
  return cosTheta * kInvPi;
}

// Whole sphere, density 1 / (4 pi).
inline Vec3 uniformSphere(Point2 u) {
  const float z = 1 - 2 * u.x;
  const float r = safeSqrt(1 - z * z);
  return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
}

// Barycentric coordinates of a uniform point of a triangle (Turk 1990); the third is the rest.
inline Point2 uniformTriangle(Point2 u) {
  const float s = std::sqrt(u.x);
  return {1 - s, u.y * s};
}

}  // namespace pbrt
