#pragma once
// Cones, cylinders, paraboloids and hyperboloids, and an oracle that intersects them in 113 bits.

#include <array>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt::test {

__extension__ using Quad = __float128;

inline Quad squareRoot(Quad x) {
  Quad y = std::sqrt(static_cast<double>(x));
  for (int i = 0; i < 3 && y > 0; ++i) y = (y + x / y) / 2;
  return y;
}
inline Quad magnitude(Quad x) {
  return x < 0 ? -x : x;
}

// A whole turn of a surface x^2 + y^2 = square z^2 + linear z + constant between two heights.
struct Revolved {
  std::string shape;
  ParamList params;
  Quad square = 0, linear = 0, constant = 0;
  double lo = 0, hi = 0;
  double size = 0;  // no point is farther from the middle of its axis

  DPoint3 centre() const { return {0, 0, (lo + hi) / 2}; }
  Quad radius2(Quad z) const { return (square * z + linear) * z + constant; }
  std::unique_ptr<Shape> make() const { return test::make<Shape>(shape, params); }

  // Half the gradient of x^2 + y^2 - radius2(z).
  DVec3 gradient(const DPoint3& p) const {
    return {p.x, p.y, static_cast<double>(-square * p.z - linear / 2)};
  }
  // How far p is from the surface, to first order.
  double height(const DPoint3& p) const {
    const Quad x = p.x, y = p.y, value = x * x + y * y - radius2(p.z);
    return value == 0 ? 0 : static_cast<double>(magnitude(value)) / (2 * glm::length(gradient(p)));
  }
};

// The shapes of the four plug-ins, every length times `scale`.
inline std::vector<Revolved> revolved(float scale) {
  const auto length = [&](const char* name, float x) { return number(name, x * scale); };
  const auto q = [&](float x) { return Quad(x * scale); };
  const auto done = [](Revolved r) {
    const double radius2 = static_cast<double>(std::max(r.radius2(r.lo), r.radius2(r.hi)));
    r.size = std::sqrt(radius2 + sqr((r.hi - r.lo) / 2));
    return r;
  };
  const auto at = [&](float z) { return static_cast<double>(z * scale); };
  const auto hyperboloid = [&](std::array<float, 3> a, std::array<float, 3> b) {
    // The squared distance from the axis, |a + s d|^2, with s = (z - a.z) / d.z.
    std::vector<float> p1, p2;
    for (const float x : a) p1.push_back(x * scale);
    for (const float x : b) p2.push_back(x * scale);
    const Quad dx = Quad(p2[0]) - p1[0], dy = Quad(p2[1]) - p1[1], dz = Quad(p2[2]) - p1[2];
    const Quad s2 = (dx * dx + dy * dy) / (dz * dz), s1 = (p1[0] * dx + p1[1] * dy) / dz * 2;
    const Quad s0 = Quad(p1[0]) * p1[0] + Quad(p1[1]) * p1[1], z = p1[2];
    return done({"hyperboloid",
                 {points("p1", p1), points("p2", p2)},
                 s2,
                 s1 - 2 * s2 * z,
                 s0 - s1 * z + s2 * z * z,
                 std::min(p1[2], p2[2]),
                 std::max(p1[2], p2[2])});
  };
  const Quad slant = q(2) / q(3);
  return {
      done({"cylinder",
            {length("radius", 0.7F), length("zmin", -1), length("zmax", 2)},
            0,
            0,
            q(0.7F) * q(0.7F),
            at(-1),
            at(2)}),
      done({"cylinder",
            {length("radius", 1e-3F), length("zmin", 0), length("zmax", 100)},
            0,
            0,
            q(1e-3F) * q(1e-3F),
            0,
            at(100)}),
      done({"cone",
            {length("radius", 2), length("height", 3)},
            slant * slant,
            -2 * slant * q(2),
            q(2) * q(2),
            0,
            at(3)}),
      done({"paraboloid",
            {length("radius", 2), length("zmax", 3)},
            0,
            q(2) * q(2) / q(3),
            0,
            0,
            at(3)}),
      hyperboloid({1, 0, -1}, {0.3F, 1, 1.5F}),
      hyperboloid({1, 2, 2}, {-0.5F, 1, 1}),
      hyperboloid({1, 0, -1}, {-1, 0, 1}),
  };
}

// The nearest crossing with t > tMin. `certain`: neither the count of crossings nor which of them
// lies between the two heights hangs on rounding of the ray by `rounding` in place.
struct Crossing {
  bool hit = false, certain = true;
  Quad t = 0;
  double cosine = 0;  // of the ray with the normal
};
inline Crossing nearestCrossing(const Revolved& r, const ObjectRay& ray, double rounding) {
  const Quad ox = ray.o.x, oy = ray.o.y, oz = ray.o.z, dx = ray.d.x, dy = ray.d.y, dz = ray.d.z;
  const Quad a = dx * dx + dy * dy - r.square * dz * dz;
  const Quad b = ox * dx + oy * dy - r.square * oz * dz - r.linear * dz / 2;
  const Quad c = ox * ox + oy * oy - r.radius2(oz);
  Crossing found;
  const Quad discriminant = b * b - a * c;
  std::array<Quad, 2> roots{};
  int count = 0;
  if (a == 0) {
    if (b != 0) roots[count++] = -c / (2 * b);
  } else if (discriminant >= 0) {
    const Quad root = squareRoot(discriminant);
    roots[count++] = (-b - (a > 0 ? root : -root)) / a;
    roots[count++] = (-b + (a > 0 ? root : -root)) / a;
  }
  const double length = glm::length(ray.d);
  // Within rounding of a tangent there may be a crossing or none: the line's least distance to the
  // surface is about value / (2 |gradient|) at the vertex.
  if (a != 0) {
    const DPoint3 vertex = ray.at(static_cast<double>(-b / a));
    if (r.height(vertex) < 30 * rounding) found.certain = false;
  }
  for (int i = 0; i < count && !found.hit; ++i) {
    const double t = static_cast<double>(roots[i]);
    if (!(t * length > ray.tMin * length)) continue;
    const double z = static_cast<double>(oz + roots[i] * dz);
    const DVec3 g = r.gradient(ray.at(t));
    const double cosine = std::abs(glm::dot(ray.d, g)) / (length * glm::length(g));
    const double slack = 30 * rounding / std::max(cosine, 1e-12);
    if (std::abs(z - r.lo) < slack || std::abs(z - r.hi) < slack) found.certain = false;
    if (z < r.lo || z > r.hi) continue;
    found.hit = true;
    found.t = roots[i];
    found.cosine = cosine;
  }
  return found;
}

}  // namespace pbrt::test
