#pragma once
// Axis-parallel boxes.

#include "core/base/math.h"

namespace pbrt {

// A box in space; empty until a point is added (lo > hi).
struct Bounds3 {
  Point3 lo{kInfinity};
  Point3 hi{-kInfinity};

  bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  Vec3 diagonal() const { return hi - lo; }
  Point3 centre() const { return 0.5F * lo + 0.5F * hi; }

  void add(const Point3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  void add(const Bounds3& b) {
    lo = glm::min(lo, b.lo);
    hi = glm::max(hi, b.hi);
  }
  bool contains(const Point3& p) const {
    return glm::all(glm::lessThanEqual(lo, p)) && glm::all(glm::lessThanEqual(p, hi));
  }
};

// The smallest float box that holds a double box: bounds only ever grow by rounding.
inline Bounds3 roundOutward(const DPoint3& lo, const DPoint3& hi) {
  Bounds3 b;
  for (int i = 0; i < 3; ++i) {
    b.lo[i] = static_cast<float>(lo[i]);
    if (b.lo[i] > lo[i]) b.lo[i] = std::nextafter(b.lo[i], -kInfinity);
    b.hi[i] = static_cast<float>(hi[i]);
    if (b.hi[i] < hi[i]) b.hi[i] = std::nextafter(b.hi[i], kInfinity);
  }
  return b;
}

// A rectangle of pixels: lo inclusive, hi exclusive.
struct Bounds2i {
  Point2i lo{0};
  Point2i hi{0};

  int width() const { return hi.x - lo.x; }
  int height() const { return hi.y - lo.y; }
  bool empty() const { return width() <= 0 || height() <= 0; }
  bool contains(Point2i p) const { return p.x >= lo.x && p.x < hi.x && p.y >= lo.y && p.y < hi.y; }
  friend bool operator==(const Bounds2i&, const Bounds2i&) = default;
};

inline Bounds2i intersect(const Bounds2i& a, const Bounds2i& b) {
  return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

}  // namespace pbrt
