#include "core/base/segment.h"

namespace pbrt {

Segment clip(const ObjectRay& ray, const DPoint3& lo, const DPoint3& hi) {
  Segment piece;
  double t0 = ray.tMin, t1 = ray.tMax;
  for (int i = 0; i < 3; ++i) {
    const double below = lo[i] - ray.o[i], above = hi[i] - ray.o[i];
    if (ray.d[i] == 0) {
      if (below > 0 || above < 0) return piece;
      continue;
    }
    const double inverse = 1 / ray.d[i];
    const double a = below * inverse, b = above * inverse;
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  piece.speed = glm::length(ray.d);
  if (!(t0 <= t1) || !(piece.speed > 0 && piece.speed < kInfinity)) return piece;
  piece.middle = 0.5 * t0 + 0.5 * t1;
  piece.o = ray.at(piece.middle);
  piece.u = ray.d / piece.speed;
  piece.half = 0.5 * (t1 - t0) * piece.speed;
  piece.starts = t0 == ray.tMin;
  // In each coordinate t d and its sum with o are rounded, by half an epsilon of the result; a
  // factor of two to spare.
  const DVec3 rounded = std::abs(piece.middle) * glm::abs(ray.d) + glm::abs(piece.o);
  piece.error = std::numeric_limits<double>::epsilon() * (rounded.x + rounded.y + rounded.z);
  if (!(piece.error < kInfinity)) piece.half = -1;
  return piece;
}

}  // namespace pbrt
