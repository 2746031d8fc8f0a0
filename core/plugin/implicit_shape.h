#pragma once
// Shapes that are implicit surfaces. A plug-in is a formula with a reader of its parameters:
//
//   struct Ball {
//     explicit Ball(pbrt::Params& p) : r(p.positive("radius", 1, "radius", "scene units")) {}
//     template <class T>
//     T operator()(const T& x, const T& y, const T& z) const {
//       return r * r - (sqr(x) + sqr(y) + sqr(z));
//     }
//     pbrt::Bounds3 bounds() const { return {pbrt::Point3(-r), pbrt::Point3(r)}; }
//     float r;
//   };
//   PBRT_PLUGIN(Shape, pbrt::FormulaShape<Ball>, "ball", "a ball by its formula")

#include "core/plugin/formula.h"
#include "core/plugin/plugin.h"

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

// That of a formula F (core/plugin/formula.h) which is made from parameters.
template <class F>
class FormulaShape final : public ImplicitShape {
 public:
  explicit FormulaShape(Params& p) : FormulaShape(p, F(p)) {}

 private:
  FormulaShape(Params& p, const F& f) : ImplicitShape(std::make_unique<Formula<F>>(f), cells(p)) {
    if (empty() && !p.describing()) p.warn("", "there is no surface: the formula is never zero");
  }
  static std::size_t cells(Params& p) {
    const int most = p.integer("cells", 8192, 1, 1 << 24, "boxes it is split into, at most");
    return p.describing() ? 0 : static_cast<std::size_t>(most);
  }
};

}  // namespace pbrt
