#pragma once
// The nearest crossing of a ray with a strip about a curve.
//
// At u a strip is the straight piece c(u) + a e(u), |a| <= w(u) / 2, where e is the unit vector
// along N x c'. N is the ray's direction for strips that face every ray, and given for ribbons.
// Seen along the ray, both c and e being projected to the plane across it, the strip meets the ray
// at the zeros of
//   F(u) = c x (N x c') along the ray = N_z (c . c') - c'_z (c . N),
// with x, y (and the products) across the ray and z along it. Pieces of the curve whose boxes the
// ray passes are left out, the others halved until F is simple on them (the culling is that of
// Nakamaru and Ohno 2002, "Ray Tracing for Curves Primitive").

#include <optional>

#include "core/api/shape.h"
#include "shapes/curve/segment.h"

namespace pbrt::curve {

// The search for the nearest crossing of a ray with a part of a segment.
class Search {
 public:
  Search(const Segment& s, const ObjectRay& ray, bool facing)
      : segment_(s), length_(glm::length(ray.d)), tMin_(ray.tMin), t_(ray.tMax) {
    const DVec3 z = ray.d / length_;
    const int small = std::abs(z.x) < std::abs(z.y) ? 0 : 1;
    DVec3 aside(0);
    aside[small] = 1;
    const DVec3 x = glm::normalize(glm::cross(aside, z)), y = glm::cross(z, x);
    const auto seen = [&](const DVec3& v) {
      return DVec3(glm::dot(x, v), glm::dot(y, v), glm::dot(z, v));
    };
    for (int i = 0; i < 4; ++i) curve_[i] = seen(s.points[i] - ray.o);
    if (facing) {
      normal_ = {DVec3(0, 0, 1), DVec3(0, 0, 1)};
    } else {
      normal_ = {seen(s.normal[0]), seen(s.normal[1])};
      turn_ = s.turn;
    }
  }

  std::optional<ShapeHit> nearest(double u0, double u1, std::uint32_t primitive) {
    const Bezier b = part(curve_, u0, u1);
    visit(b, u0, u1, halvings(b, u0, u1));
    if (std::isnan(u_)) return {};
    return ShapeHit{float(t_), float(u_), float(u_ - float(u_)), primitive};
  }

 private:
  // How often to halve until the curve is straight, against its width, but for a small part, and
  // the normal hardly turns: a cubic departs from its chord by no more than 6 / 8 of its second
  // differences, a fourth of it in each half (Wang 1984).
  int halvings(const Bezier& b, double u0, double u1) const {
    const double bent = std::max(glm::length(glm::dvec2(b[0] - 2.0 * b[1] + b[2])),
                                 glm::length(glm::dvec2(b[1] - 2.0 * b[2] + b[3])));
    const double straight = 0.25 * std::max(segment_.halfWidth(u0), segment_.halfWidth(u1));
    int n = 0;
    for (double off = 0.75 * bent, angle = turn_ * (u1 - u0);
         n < 10 && (off > straight || angle > 0.25); off /= 4, angle /= 2)
      ++n;
    return n;
  }

  void visit(const Bezier& b, double u0, double u1, int halvings) {
    const DVec3 lo = glm::min(glm::min(b[0], b[1]), glm::min(b[2], b[3]));
    const DVec3 hi = glm::max(glm::max(b[0], b[1]), glm::max(b[2], b[3]));
    const double h = std::max(segment_.halfWidth(u0), segment_.halfWidth(u1));
    if (lo.x > h || hi.x < -h || lo.y > h || hi.y < -h) return;
    if (lo.z - h > t_ * length_ || hi.z + h < tMin_ * length_) return;
    const double u = 0.5 * (u0 + u1);
    if (halvings == 0) return simple(u0, u1);
    visit(part(b, 0, 0.5), u0, u, halvings - 1);
    visit(part(b, 0.5, 1), u, u1, halvings - 1);
  }

  double value(double u) const {
    const CurvePoint c = evaluate(curve_, u);
    const DVec3 n = normalAt(normal_, turn_, u).n;
    return n.z * (c.p.x * c.tangent.x + c.p.y * c.tangent.y) -
           c.tangent.z * (c.p.x * n.x + c.p.y * n.y);
  }

  // Where F has at most two zeros. Its ends are worked out alike by both neighbours, so that no
  // zero gets lost between them.
  void simple(double u0, double u1) {
    const double f0 = value(u0), f1 = value(u1);
    if ((f0 < 0) != (f1 < 0)) return root(u0, f0, u1, f1);
    // Two or none: the extremum of the parabola through a third point tells.
    const double fm = value(0.5 * (u0 + u1));
    const double s = 0.25 * (3 * f0 - 4 * fm + f1) / (f0 - 2 * fm + f1);
    if (!(s > 0 && s < 1)) return;
    const double u = mix(s, u0, u1), f = value(u);
    if ((f < 0) == (f0 < 0)) return;
    root(u0, f0, u, f);
    root(u, f, u1, f1);
  }

  // The zero between two values of unlike sign, by regula falsi as Illinois has it (Dowell and
  // Jarratt 1971).
  void root(double a, double fa, double b, double fb) {
    for (int i = 0; i < 60 && std::abs(b - a) > 1e-15 && fb != 0; ++i) {
      const double u = b - fb * (b - a) / (fb - fa), f = value(u);
      if ((f < 0) == (fb < 0))
        fa *= 0.5;
      else
        a = b, fa = fb;
      if (u == b) break;
      b = u, fb = f;
    }
    accept(b);
  }

  void accept(double u) {
    const CurvePoint c = evaluate(curve_, u);
    const DVec3 across = glm::cross(normalAt(normal_, turn_, u).n, c.tangent);
    // Along N, above all along the ray, a curve has no strip.
    if (!(lengthSquared(across) > 1e-20 * lengthSquared(c.tangent))) return;
    const glm::dvec2 flat(across);
    const double a = -glm::dot(glm::dvec2(c.p), flat) / lengthSquared(flat);  // times |across|
    if (!(a * a * lengthSquared(across) <= sqr(segment_.halfWidth(u)))) return;
    const double t = (c.p.z + a * across.z) / length_;
    if (t > tMin_ && t <= t_) t_ = t, u_ = u;
  }

  const Segment& segment_;
  Bezier curve_{};  // as the ray sees it: from its origin, z along it
  std::array<DVec3, 2> normal_{};
  double turn_ = 0;
  double length_, tMin_;
  double t_;  // of the nearest crossing so far
  double u_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace pbrt::curve
