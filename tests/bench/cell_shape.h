#pragma once
// The part of the metaballs plug-in that rays see.

#include "core/api/shape.h"
#include "shapes/metaballs/roots.h"

namespace pbrt::metaballs::bench {

class CellShape final : public Shape {
 public:
  // `effort`, if given, counts the work of intersect(), for one thread.
  explicit CellShape(const Field& field, Effort* effort = nullptr)
      : field_(field), cells_(field), effort_(effort) {}
  std::uint32_t primitives() const override {
    return static_cast<std::uint32_t>(cells_.cells().size());
  }
  Bounds3 bounds(std::uint32_t i) const override { return Cells::bounds(cells_.cells()[i]); }
  // `tolerance` as in firstCrossing.
  std::optional<double> crossing(const ObjectRay& ray, std::uint32_t i,
                                 double tolerance = 0) const {
    const Cell& cell = cells_.cells()[i];
    return firstCrossing(field_, cell, cells_.atoms(cell), ray, effort_, tolerance);
  }
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t i) const override {
    const auto t = crossing(ray, i);
    if (!t || static_cast<float>(*t) > ray.tMax) return {};
    return ShapeHit{static_cast<float>(*t), 0, 0, i};
  }
  bool occluded(const ObjectRay& ray, std::uint32_t i) const override {
    const Cell& cell = cells_.cells()[i];
    return crosses(field_, cell, cells_.atoms(cell), ray);
  }
  SurfacePoint surface(const ObjectRay&, const ShapeHit&) const override { return {}; }

  const Cells& cells() const { return cells_; }
  double atomsPerCell() const {
    double sum = 0;
    for (const Cell& cell : cells_.cells()) sum += cell.count;
    return sum / static_cast<double>(cells_.cells().size());
  }

 private:
  const Field& field_;
  Cells cells_;
  Effort* effort_;
};

}  // namespace pbrt::metaballs::bench
