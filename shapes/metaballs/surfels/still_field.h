#pragma once
// The surface of any shape that is where a field is zero, at rest.

#include "core/api/implicit.h"
#include "core/base/transform.h"
#include "shapes/metaballs/surfels/moving_field.h"

namespace pbrt::surfels {

// In the space that `toSpace` leads to from the field's own.
class StillField final : public MovingField {
 public:
  // `field` must outlive it. Splits its bounds into a shell of at most `cells` boxes, where seeds
  // come from.
  StillField(const ImplicitField& field, const Transform& toSpace, std::size_t cells = 4096);

  Bounds3 bounds() const override { return bounds_; }
  double grain() const override { return grain_; }
  void at(std::span<const DPoint3> points, std::span<FieldAt> out) const override;
  void shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const override;
  bool seeds(std::uint64_t first, std::span<DPoint3> out) const override;

 private:
  const ImplicitField& field_;
  Transform toSpace_;
  Bounds3 bounds_;
  double grain_ = 1;
  std::vector<Bounds3> shell_;  // in the field's space
};

}  // namespace pbrt::surfels
