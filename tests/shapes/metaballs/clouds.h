#pragma once
// Sets of atoms, and rays at them, for the tests of metaballs.

#include <limits>

#include "core/base/ray.h"
#include "core/base/rng.h"
#include "core/base/warp.h"
#include "shapes/metaballs/cells.h"

namespace pbrt::metaballs::test {

// `strength` over the threshold, where a lone atom of radius `unit` has its own kernel's peak at 1.
inline Atom atom(Kernel kernel, const Point3& p, float h, double strength, double unit = 1) {
  return {p, h, strength * scale(kernel, h) / scale(kernel, unit)};
}

struct Random : Rng {
  using Rng::Rng;
  double in(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  DVec3 direction() { return DVec3(uniformSphere({uniform(), uniform()})); }
  DVec3 cube() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }
};

// Atoms of radii around `unit` in a cube, about five supports over a point; a part of them carve.
inline Field cloud(int count, Kernel kernel, double carving, double unit, std::uint64_t seed) {
  Random random(seed);
  const double extent = 0.6 * unit * std::cbrt(static_cast<double>(count));
  std::vector<Atom> atoms;
  for (int i = 0; i < count; ++i) {
    const bool carves = i > 0 && random.uniform() < carving;
    atoms.push_back(atom(kernel, Point3((count > 1 ? extent : 0) * random.cube()),
                         static_cast<float>(unit * random.in(0.7, 1.3)),
                         (carves ? -2 : 3) * random.in(0.8, 1.5), unit));
  }
  return {kernel, atoms};
}

// The nearest of the cells' crossings.
template <class FirstCrossing>
std::optional<double> nearest(const Cells& cells, const ObjectRay& ray, FirstCrossing&& crossing) {
  std::optional<double> best;
  for (const Cell& cell : cells.cells())
    if (const auto t = crossing(cell, cells.atoms(cell), ray); t && !(best && *best <= *t))
      best = t;
  return best;
}

}  // namespace pbrt::metaballs::test
