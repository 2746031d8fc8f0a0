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
#include "core/plugin/implicit_surface.h"
#include "core/plugin/plugin.h"

namespace pbrt {

// The surface of a formula F (core/plugin/formula.h) which is made from parameters.
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
