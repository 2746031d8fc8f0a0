#pragma once
// A surface for lights to shine from.

#include "core/api/shape.h"
#include "core/base/warp.h"

namespace pbrt::laws {

// A disk about the origin that faces +z, sampled uniformly over its area.
class DiskSampler final : public AreaSampler {
 public:
  explicit DiskSampler(double radius) : radius_(radius) {}

  double area() const override { return std::numbers::pi * radius_ * radius_; }
  AreaSample sample(const DPoint3& from, Point2 u) const override {
    AreaSample s;
    s.p = DPoint3(radius_ * DVec3(concentricDisk(u), 0));
    s.n = {0, 0, 1};
    s.pdf = pdf(from, s.p, s.n);
    return s;
  }
  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override {
    return uniformAreaPdf(from, p, n, area());
  }
  bool mayHit(const DPoint3& from, const DVec3& w) const override {
    const double t = -from.z / w.z;
    return t > 0 && glm::length(from + t * w) <= radius_;
  }
  DirectionCone normals() const override { return {{0, 0, 1}, 1}; }

 private:
  double radius_;
};

}  // namespace pbrt::laws
