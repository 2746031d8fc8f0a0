#pragma once
// A cubic Bezier curve with the width and the normal of the strip about it.

#include <array>

#include "core/base/math.h"

namespace pbrt::curve {

template <class V>
V mix(double u, const V& a, const V& b) {
  return (1 - u) * a + u * b;
}

using Bezier = std::array<DVec3, 4>;

struct CurvePoint {
  DVec3 p{}, tangent{}, bend{}, third{};  // with its derivatives
};

// By de Casteljau's scheme: exact at both ends. Where control points coincide at an end the tangent
// is the direction of its limit.
inline CurvePoint evaluate(const Bezier& b, double u) {
  const DVec3 b01 = mix(u, b[0], b[1]), b12 = mix(u, b[1], b[2]), b23 = mix(u, b[2], b[3]);
  const DVec3 from = mix(u, b01, b12), to = mix(u, b12, b23);
  CurvePoint c{mix(u, from, to), 3.0 * (to - from), 6.0 * ((b23 - b12) - (b12 - b01)),
               6.0 * ((b[3] - b[0]) - 3.0 * (b[2] - b[1]))};
  if (c.tangent == DVec3(0)) c.tangent = u < 0.5 ? c.bend : -c.bend;
  if (c.tangent == DVec3(0)) c.tangent = b[3] - b[0];
  return c;
}

// The control points of the part from u0 to u1, by blossoming.
inline Bezier part(const Bezier& b, double u0, double u1) {
  const auto blossom = [&](double x, double y, double z) {
    const DVec3 b01 = mix(x, b[0], b[1]), b12 = mix(x, b[1], b[2]), b23 = mix(x, b[2], b[3]);
    return mix(z, mix(y, b01, b12), mix(y, b12, b23));
  };
  return {blossom(u0, u0, u0), blossom(u0, u0, u1), blossom(u0, u1, u1), blossom(u1, u1, u1)};
}

struct Segment {
  Bezier points{};
  std::array<double, 2> half{};   // of the width, at both ends
  std::array<DVec3, 2> normal{};  // of a ribbon, at both ends
  double turn = 0;                // the angle between them

  double halfWidth(double u) const { return mix(u, half[0], half[1]); }
};

// The unit normal at u and its derivative: at even speed from one end to the other (Shoemake 1985).
struct Turning {
  DVec3 n{}, derivative{};
};
inline Turning normalAt(const std::array<DVec3, 2>& normal, double turn, double u) {
  if (!(turn > 0)) return {normal[0]};
  const double scale = 1 / std::sin(turn), a = (1 - u) * turn, b = u * turn;
  return {(std::sin(a) * normal[0] + std::sin(b) * normal[1]) * scale,
          (std::cos(b) * normal[1] - std::cos(a) * normal[0]) * (turn * scale)};
}

}  // namespace pbrt::curve
