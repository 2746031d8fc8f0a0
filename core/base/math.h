#pragma once
// Vectors, points and the few scalar helpers everything else is written in.
//
// Points, vectors and normals are the same GLM type; the alias says which transformation rule
// applies. float is the type of stored and shaded quantities (render space, see docs/
// architecture.md); double (the D- aliases) is the type in which shapes find their roots.

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace pbrt {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Point2 = glm::vec2;
using Point3 = glm::vec3;
using Normal3 = glm::vec3;
using Point2i = glm::ivec2;
using DVec3 = glm::dvec3;
using DPoint3 = glm::dvec3;

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;
// The largest float below one: samples in [0, 1) stay below it after rounding.
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1F;

template <class T>
constexpr T sqr(T x) {
  return x * x;
}

constexpr float lerp(float t, float a, float b) {
  return (1 - t) * a + t * b;
}

inline float safeSqrt(float x) {
  return std::sqrt(std::max(0.F, x));
}

constexpr float radians(float degrees) {
  return degrees * (kPi / 180);
}

template <class V>
auto lengthSquared(const V& v) {
  return glm::dot(v, v);
}

// n turned so that it lies in the hemisphere of v.
inline Normal3 faceForward(const Normal3& n, const Vec3& v) {
  return glm::dot(n, v) < 0 ? -n : n;
}

inline bool isFinite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Bound on the relative error of n chained float roundings (Higham 2002, lemma 3.1).
constexpr float gammaBound(int n) {
  constexpr float unit = std::numeric_limits<float>::epsilon() * 0.5F;
  return static_cast<float>(n) * unit / (1 - static_cast<float>(n) * unit);
}

}  // namespace pbrt
