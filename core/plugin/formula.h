#pragma once
// A whole implicit field from its formula, written once.

#include "core/api/implicit.h"
#include "core/base/dual.h"

namespace pbrt {

// The field of a formula F, which has
//   template <class T> T operator()(const T& x, const T& y, const T& z) const
//     f at a point, in + - * / and sqr sqrt pow (whole powers) abs min max exp log sin cos, called
//     without std::. T may be mixed with plain numbers. sqr(x) has a better range than x * x, and
//     every mention of x that is saved makes ranges better. There are no branches on a T: min and
//     max unite and intersect solids.
//   Bounds3 bounds() const
//     where the surface is looked for.
template <class F>
class Formula final : public ImplicitField {
 public:
  explicit Formula(const F& f) : f_(f) {}

  Bounds3 bounds() const override { return f_.bounds(); }

  FieldPoint at(const DPoint3& p) const override {
    const auto [x, y, z] = variables(p);
    const Dual<double> f = f_(x, y, z);
    return {f.v, {f.d[0], f.d[1], f.d[2]}};
  }

  FieldRange over(const DPoint3& lo, const DPoint3& hi) const override {
    using T = Dual<Range>;
    const T f =
        f_(T({lo.x, hi.x}, {1, 0, 0}), T({lo.y, hi.y}, {0, 1, 0}), T({lo.z, hi.z}, {0, 0, 1}));
    return {f.v, {f.d[0], f.d[1], f.d[2]}};
  }

  LineRange along(const DPoint3& o, const DVec3& u, const Range& s, double error) const override {
    using T = Dual<Range, 1>;
    const auto coordinate = [&](int i) {
      return T(o[i] + s * u[i] + Range(-error, error), {u[i]});
    };
    const T f = f_(coordinate(0), coordinate(1), coordinate(2));
    return {f.v, f.d[0]};
  }

  glm::dmat3 hessian(const DPoint3& p) const override {
    using T = Dual<Dual<double>>;
    const auto [x, y, z] = variables(p);
    const T f = f_(T(x, {1, 0, 0}), T(y, {0, 1, 0}), T(z, {0, 0, 1}));
    glm::dmat3 h;
    for (int i = 0; i < 3; ++i) h[i] = {f.d[i].d[0], f.d[i].d[1], f.d[i].d[2]};
    return h;
  }

 private:
  static std::array<Dual<double>, 3> variables(const DPoint3& p) {
    return {{{p.x, {1, 0, 0}}, {p.y, {0, 1, 0}}, {p.z, {0, 0, 1}}}};
  }

  F f_;
};

}  // namespace pbrt
