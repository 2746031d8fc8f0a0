#include "shapes/metaballs/cells.h"

#include <numeric>

namespace pbrt::metaballs {
namespace {

// Longest edge of a cell over the smallest support radius that reaches it. Measured for 300 atoms:
// twice as coarse, rays are 1.5 times slower; finer gains nothing.
constexpr double kFineness = 0.35;
// How far a cell reaches over the faces it shares, over its edge.
constexpr double kOverlap = 0x1p-14;

// Those of `parents` that reach the box. A little more than the box, so that a point that moves
// by rounding, or to a surface a hair away, is still served by the list.
std::vector<std::uint32_t> reaching(const Field& field, const Bounds3& box, AtomList parents) {
  const DPoint3 margin = kOverlap * DVec3(box.diagonal());
  const DPoint3 lo = DPoint3(box.lo) - margin, hi = DPoint3(box.hi) + margin;
  std::vector<std::uint32_t> list;
  for (const std::uint32_t j : parents) {
    const Atom& atom = field.atoms()[j];
    const DPoint3 c(atom.centre);
    const DVec3 d = glm::max(DVec3(0), glm::max(lo - c, c - hi)) * atom.inverseRadius;
    if (glm::dot(d, d) < 1 + 16 * kEpsilon) list.push_back(j);
  }
  return list;
}

bool mayMeetSurface(const Field& field, const Bounds3& box, AtomList list) {
  return field.bound(DPoint3(box.lo), DPoint3(box.hi), list).contains(0);
}

// The box on either side of `at` on an axis, reaching over it by the overlap.
Bounds3 below(Bounds3 box, int axis, double at) {
  const double edge = static_cast<double>(box.hi[axis]) - box.lo[axis];
  DPoint3 hi(box.hi);
  hi[axis] = std::min(hi[axis], at + kOverlap * edge);
  return roundOutward(DPoint3(box.lo), hi);
}
Bounds3 above(Bounds3 box, int axis, double at) {
  const double edge = static_cast<double>(box.hi[axis]) - box.lo[axis];
  DPoint3 lo(box.lo);
  lo[axis] = std::max(lo[axis], at - kOverlap * edge);
  return roundOutward(lo, DPoint3(box.hi));
}

// The same question asked of the eight octants: their bounds are tighter. Inside a dense set this
// is what tells that a small cell is all inside.
bool octantsMayMeetSurface(const Field& field, const Bounds3& box, AtomList list) {
  const Point3 middle = box.centre();
  for (int i = 0; i < 8; ++i) {
    Bounds3 octant = box;
    for (int axis = 0; axis < 3; ++axis)
      ((i >> axis & 1) ? octant.lo : octant.hi)[axis] = middle[axis];
    if (mayMeetSurface(field, octant, list)) return true;
  }
  return false;
}

// Cuts slices off the six sides for as long as the surface is provably not in them.
Bounds3 shave(const Field& field, Bounds3 box, AtomList list) {
  for (const double part : {0.5, 0.25, 0.125})
    for (int axis = 0; axis < 3; ++axis) {
      const auto cut = [&](double along) {
        return box.lo[axis] + along * (static_cast<double>(box.hi[axis]) - box.lo[axis]);
      };
      const double low = cut(part);
      if (!mayMeetSurface(field, below(box, axis, low), list)) box = above(box, axis, low);
      const double high = cut(1 - part);
      if (!mayMeetSurface(field, above(box, axis, high), list)) box = below(box, axis, high);
    }
  return box;
}

}  // namespace

Cells::Cells(const Field& field) {
  Bounds3 box;
  for (const Atom& atom : field.atoms())
    if (atom.weight > 0)
      box.add(roundOutward(DPoint3(atom.centre) - static_cast<double>(atom.radius),
                           DPoint3(atom.centre) + static_cast<double>(atom.radius)));
  if (box.empty()) return;
  std::vector<std::uint32_t> all(field.atoms().size());
  std::iota(all.begin(), all.end(), 0U);
  split(field, box, all);
}

void Cells::split(const Field& field, const Bounds3& box, AtomList parents) {
  const std::vector<std::uint32_t> list = reaching(field, box, parents);
  if (!mayMeetSurface(field, box, list)) return;

  float smallest = kInfinity;
  for (const std::uint32_t j : list) smallest = std::min(smallest, field.atoms()[j].radius);
  const DVec3 edge = DVec3(box.hi) - DVec3(box.lo);
  const int axis = edge.x >= edge.y ? (edge.x >= edge.z ? 0 : 2) : (edge.y >= edge.z ? 1 : 2);
  if (edge[axis] > kFineness * smallest) {
    const double middle = 0.5 * (static_cast<double>(box.lo[axis]) + box.hi[axis]);
    const Bounds3 left = below(box, axis, middle), right = above(box, axis, middle);
    // Far from the origin floats may be too coarse to split any further.
    if (left.hi[axis] < box.hi[axis] && right.lo[axis] > box.lo[axis]) {
      split(field, left, list);
      split(field, right, list);
      return;
    }
  }

  if (!octantsMayMeetSurface(field, box, list)) return;
  const Bounds3 tight = shave(field, box, list);
  const std::vector<std::uint32_t> near = reaching(field, tight, list);
  if (!mayMeetSurface(field, tight, near)) return;
  cells_.push_back(
      {tight, static_cast<std::uint32_t>(atoms_.size()), static_cast<std::uint32_t>(near.size())});
  atoms_.insert(atoms_.end(), near.begin(), near.end());
}

}  // namespace pbrt::metaballs
