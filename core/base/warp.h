#pragma once
// Maps from the unit square to the sets one samples, with their densities.

#include "core/base/frame.h"

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

// Directions about +z with 1 - cos(theta) < height, uniform in solid angle. The height of the cap,
// not its cosine, says how wide it is: the cosine of a narrow cone rounds to one.
inline Vec3 uniformCone(Point2 u, float height) {
  const float h = u.x * height;
  const float r = safeSqrt(h * (2 - h));
  return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), 1 - h};
}
inline float uniformConePdf(float height) {
  return 1 / (2 * kPi * height);
}

// The part of the unit sphere between two heights and up to an angle about z, uniform in area:
// slices of equal height have equal area (Archimedes).
inline DVec3 uniformZone(Point2 u, double z0, double z1, double phiMax) {
  const double z = z0 + u.x * (z1 - z0), phi = phiMax * u.y;
  const double rho = std::sqrt(std::max(0.0, 1 - z * z));
  return {rho * std::cos(phi), rho * std::sin(phi), z};
}

// A sphere of radius r about the origin is seen from a point outside within a cone of this height;
// 1 - cos = sin^2 / (1 + cos) does not cancel when the sphere is far.
inline float sphereConeHeight(const DPoint3& from, double r) {
  const double sin2 = r * r / lengthSquared(from);
  return static_cast<float>(sin2 / (1 + std::sqrt(1 - sin2)));
}
// The normal (unit but for rounding) where the sphere is first met from there, in a direction
// uniform in that cone, and the density per solid angle.
struct ConeSample {
  Normal3 n{};
  float pdf = 0;
};
inline ConeSample uniformSphereCone(Point2 u, const DPoint3& from, double r) {
  // The direction is at theta from the axis, the normal at alpha. By the law of sines
  // sin(alpha + theta) = sin(theta) / sin(thetaMax); what is used is sin(alpha) / sin(theta).
  // Only what would cancel near the sphere is worked out in double.
  const double distance2 = lengthSquared(from), inverse = 1 / std::sqrt(distance2);
  const auto sinMax = static_cast<float>(r * inverse);
  const auto cos2Max = static_cast<float>((distance2 - r * r) * inverse * inverse);
  const float height = sqr(sinMax) / (1 + std::sqrt(cos2Max));
  const Vec3 w = uniformCone(u, height);
  const float inverseSinMax = 1 / sinMax, sin2 = w.x * w.x + w.y * w.y;
  const float cosSum = safeSqrt(1 - sin2 * sqr(inverseSinMax));
  const float s = w.z * inverseSinMax - cosSum;
  const Frame frame = Frame::fromZ(from * inverse);
  return {frame.fromLocal({s * w.x, s * w.y, cosSum * w.z + sin2 * inverseSinMax}),
          uniformConePdf(height)};
}

// Barycentric coordinates of a uniform point of a triangle (Turk 1990); the third is the rest.
inline Point2 uniformTriangle(Point2 u) {
  const float s = std::sqrt(u.x);
  return {1 - s, u.y * s};
}

// The density 1 / area over a surface, at its point p with unit normal n, per solid angle at
// `from`. Zero edge-on, where no light arrives.
inline float uniformAreaPdf(const DPoint3& from, const DPoint3& p, const Normal3& n, double area) {
  const DVec3 w = p - from;
  const double cosine = std::abs(glm::dot(w, DVec3(n)));  // times the distance
  const double distance2 = lengthSquared(w);
  return cosine > 0 ? static_cast<float>(distance2 * std::sqrt(distance2) / (cosine * area)) : 0;
}

}  // namespace pbrt
