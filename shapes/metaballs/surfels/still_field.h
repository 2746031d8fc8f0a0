#pragma once
// The surface of any shape that is where a field is zero, at rest.

#include <optional>
#include <vector>

#include "core/api/implicit.h"
#include "core/base/transform.h"
#include "shapes/metaballs/surfels/moving_field.h"

namespace pbrt::surfels {

// In the space that `toSpace` leads to from the field's own. The field's unit is its own: here it
// is scaled so that the length of the gradient is about 2 / grain on the surface. Where it has no
// value, or beyond its bounds by more than an eighth of the grain, is outside.
class StillField final : public MovingField {
 public:
  // `field` must outlive it. Splits its bounds into a shell of at most `cells` boxes, where seeds
  // come from. Throws Error if the bounds are empty or not finite.
  StillField(const ImplicitField& field, const Transform& toSpace, std::size_t cells = 4096);

  Bounds3 bounds() const override { return bounds_; }
  double grain() const override { return grain_; }
  void at(std::span<const DPoint3> points, std::span<FieldAt> out) const override;
  void shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const override;
  bool seeds(std::uint64_t first, std::span<DPoint3> out) const override;

  // Of the surface; an estimate, off by a hundredth or so.
  double area() const { return patches_.empty() ? 0 : patches_.back().areaSoFar; }
  // Whether a point of the surface is of the shape: an open surface ends at the field's bounds,
  // where its surfels need neighbours beyond.
  bool holds(const DPoint3& p) const { return distanceBeyond(toField_.point(p)) <= slack_ / 128; }

 private:
  // A small part of the surface about one of its points, in the field's space. Along an axis it is
  // a rectangle.
  struct Patch {
    DPoint3 p{};
    int axis = 0;
    float width = 0, height = 0;  // of the rectangle, along axis + 1 and axis + 2
    double areaSoFar = 0;         // in space; of all patches up to and including this one
  };

  // What comes of some boxes.
  struct Part {
    std::vector<Patch> patches;
    std::vector<Bounds3> halves;
  };

  bool addPatches(const Bounds3& box, bool whatever, std::vector<Patch>& patches) const;
  void measure();
  std::optional<DPoint3> between(DPoint3 from, DPoint3 to) const;
  std::optional<DPoint3> onSurface(DPoint3 p, double within) const;
  // How far a point of the field's space is beyond the field's bounds, along an axis.
  double distanceBeyond(const DPoint3& p) const;
  ShapeAt shapeAt(const DPoint3& p) const;  // the field's own, unscaled, in space

  const ImplicitField& field_;
  Transform toSpace_, toField_;
  Bounds3 bounds_;
  std::vector<Patch> patches_;
  double grain_ = 1;
  double scale_ = 1;  // from the field's unit to this one's
  double slack_ = 0;  // how far beyond its bounds the field is looked at, in its space
};

}  // namespace pbrt::surfels
