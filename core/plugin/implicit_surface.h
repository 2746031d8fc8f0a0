#pragma once
// The base class of shapes that are implicit surfaces. One that is given by a formula needs no more
// than core/plugin/implicit_shape.h.

#include <memory>

#include "core/api/shape.h"

namespace pbrt {

// The surface of any field.
//
// The box of the field is split into a shell of small boxes, the primitives, and those are dropped
// whose range excludes zero. intersect() is a certified search within a box: see
// core/plugin/implicit_roots.h for what it promises.
//
// Parametrisation: u and v are the place within the field's bounds, from 0 to 1, along the two axes
// that the normal n is least along: y and z, z and x, or x and y. u is mirrored where n points down
// its axis, so that pictures are not, seen from outside. It jumps where another component of n
// becomes the greatest; the surface and its normal do not.
class ImplicitShape : public Shape {
 public:
  // Splits the bounds into at most `cells` boxes (core/plugin/implicit_cells.h); 0: there is no
  // surface. Throws Error for bounds that are empty or not finite.
  ImplicitShape(std::unique_ptr<const ImplicitField> field, std::size_t cells);
  ~ImplicitShape() override;

  std::uint32_t primitives() const final;
  Bounds3 bounds(std::uint32_t primitive) const final;
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t primitive) const final;
  bool occluded(const ObjectRay& ray, std::uint32_t primitive) const final;
  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const final;
  const ImplicitField* implicit() const final { return field_.get(); }

 protected:
  // Whether the range of the field excludes zero everywhere.
  bool empty() const { return cells_.empty(); }

 private:
  double errorBound(const DPoint3& p, const DVec3& n, double steep, double size) const;

  std::unique_ptr<const ImplicitField> field_;
  std::vector<Bounds3> cells_;
};

}  // namespace pbrt
