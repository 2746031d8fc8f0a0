#pragma once
// The field and its derivatives at a point.

#include "shapes/metaballs/atom_lanes.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {

template <class K>
FieldSample sample(std::span<const Atom> atoms, const DPoint3& p, AtomList list) {
  using V = Doubles;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  V value{}, magnitude{}, slopes{}, gx{}, gy{}, gz{}, bend{}, jump{};
  V identity{}, xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
  V most = V{} - 1, strongest{};
  for (std::size_t i = 0; i < list.size(); i += kLanes) {
    const AtomLanes<V> a(atoms, list, i, p);
    const V inverse2 = a.inverse * a.inverse;
    const V q = (a.x * a.x + a.y * a.y + a.z * a.z) * inverse2;
    const V own = a.weight * K::value(q);
    value += own;
    magnitude += abs(own);
    // grad K(q) = K' 2 r / h^2 with r = p - centre; its Jacobian is K' 2 / h^2 I +
    // K'' 4 r r^T / h^4. The lanes hold -r.
    const V slope = a.weight * K::slope(q);
    slopes += abs(slope);
    const V k1 = -2 * inverse2 * slope;
    const V k2 = 4 * inverse2 * inverse2 * a.weight * K::curvature(q);
    gx += k1 * a.x, gy += k1 * a.y, gz += k1 * a.z;
    identity -= k1;
    const V x = k2 * a.x, y = k2 * a.y;
    xx += x * a.x, xy += x * a.y, xz += x * a.z, yy += y * a.y, yz += y * a.z;
    zz += k2 * a.z * a.z;
    const V size = abs(a.weight) * inverse2;
    bend += q < 1.01 ? size : V{};
    if constexpr (K::kJump > 0) jump += abs(q - 1) < 0x1p-12 ? size / a.inverse : V{};
    const auto more = own > most;
    most = more ? own : most;
    strongest = more ? V{} + static_cast<double>(i) : strongest;
  }
  const V u = sums(value, gx, gy, gz, identity, bend, slopes, magnitude);
  const V v = sums(xx, yy, zz, xy, xz, yz, jump, V{});
  FieldSample s;
  s.value = u[0] - 1;
  s.gradient = {u[1], u[2], u[3]};
  s.hessian = {u[4] + v[0], v[3], v[4], v[3], u[4] + v[1], v[5], v[4], v[5], u[4] + v[2]};
  s.bend = K::kBend * u[5];
  s.jump = K::kJump * v[6];
  // q is off by less than 16 epsilon: differences of coordinates are rounded once, relative to
  // themselves. The rest is the rounding of K (the gaussian's, of K + exp(-b)) and of the sum.
  const auto terms = static_cast<double>(list.size() + 16 + K::kRounding);
  s.error = epsilon * ((16 + K::kRounding) * u[6] + terms * (1 + u[7]));
  int lane = 0;
  for (int k = 1; k < kLanes; ++k)
    if (most[k] > most[lane]) lane = k;
  if (!list.empty())
    s.strongest = list[std::min(list.size() - 1, static_cast<std::size_t>(strongest[lane]) + lane)];
  return s;
}

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
