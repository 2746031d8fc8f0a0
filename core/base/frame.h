#pragma once
// Orthonormal frames: BSDFs work in one whose z axis is the shading normal.

#include "core/base/math.h"

namespace pbrt {

struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec3 toLocal(const Vec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
  Vec3 fromLocal(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }

  // Any frame about the unit vector z, without a branch on its direction
  // (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
  static Frame fromZ(const Vec3& z) {
    const float sign = std::copysign(1.F, z.z);
    const float a = -1 / (sign + z.z);
    const float b = z.x * z.y * a;
    return {{1 + sign * sqr(z.x) * a, sign * b, -sign * z.x}, {b, sign + sqr(z.y) * a, -z.y}, z};
  }

  // The frame about the unit vector z whose x axis lies as near to the tangent as it can;
  // any frame if the tangent is zero, not finite or within half a degree of z, where rounding
  // would skew the frame.
  static Frame fromZX(const Vec3& z, const Vec3& tangent) {
    const Vec3 t = tangent - glm::dot(tangent, z) * z;
    const float l2 = lengthSquared(t);
    if (!(l2 > 1e-4F * lengthSquared(tangent)) || !std::isfinite(l2)) return fromZ(z);
    const Vec3 x = t / std::sqrt(l2);
    return {x, glm::cross(z, x), z};
  }
};

// Trigonometry of a unit direction in a local frame.
inline float cosTheta(const Vec3& w) {
  return w.z;
}
inline float absCosTheta(const Vec3& w) {
  return std::abs(w.z);
}
inline float cos2Theta(const Vec3& w) {
  return w.z * w.z;
}
inline float sin2Theta(const Vec3& w) {
  return std::max(0.F, 1 - w.z * w.z);
}
inline bool sameHemisphere(const Vec3& a, const Vec3& b) {
  return a.z * b.z > 0;
}

}  // namespace pbrt
