#pragma once
// Rays in render space (float) and in a shape's object space (double).

#include "core/base/math.h"

namespace pbrt {

// The points o + t d with tMin <= t <= tMax; d need not have unit length.
struct Ray {
  Point3 o{};
  float tMin = 0;
  Vec3 d{};
  float tMax = kInfinity;
  float time = 0;

  Point3 at(float t) const { return o + t * d; }
};

// A ray and its neighbours through the next pixel in x and in y, by which textures filter.
// The neighbours mean something only if `hasDifferentials`.
struct RayDifferential : Ray {
  bool hasDifferentials = false;
  Point3 rxOrigin{}, ryOrigin{};
  Vec3 rxDirection{}, ryDirection{};

  RayDifferential() = default;
  explicit RayDifferential(const Ray& ray) : Ray(ray) {}

  // Brings the neighbours closer, for pixels that take more than one sample.
  void scaleDifferentials(float s) {
    rxOrigin = o + s * (rxOrigin - o);
    ryOrigin = o + s * (ryOrigin - o);
    rxDirection = d + s * (rxDirection - d);
    ryDirection = d + s * (ryDirection - d);
  }
};

// A ray as a shape sees it: object space, double, the same t as the render-space ray it is
// made from (the direction is not normalised again).
struct ObjectRay {
  DPoint3 o{};
  DVec3 d{};
  double tMin = 0;
  double tMax = std::numeric_limits<double>::infinity();

  DPoint3 at(double t) const { return o + t * d; }
};

}  // namespace pbrt
