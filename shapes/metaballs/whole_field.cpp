#include "shapes/metaballs/whole_field.h"

#include <array>
#include <numeric>

namespace pbrt::metaballs {
namespace {

constexpr std::size_t kLeaf = 8;

Bounds3 supportOf(const Atom& atom) {
  const auto h = static_cast<double>(atom.radius);
  return roundOutward(DPoint3(atom.centre) - h, DPoint3(atom.centre) + h);
}

// Nodes of a tree over `count` atoms, whose nodes are halved until a leaf is small enough.
std::size_t nodesOver(std::size_t count) {
  return count <= kLeaf ? 1 : 1 + 2 * nodesOver((count + 1) / 2);
}

}  // namespace

WholeField::WholeField(const Field& field, const Cells& cells)
    : field_(field), order_(field.atoms().size()), tree_(nodesOver(order_.size())) {
  for (const Cell& cell : cells.cells()) bounds_.add(cell.box);
  std::iota(order_.begin(), order_.end(), 0U);
  sort(0, 0, order_.size());
}

void WholeField::sort(std::size_t node, std::size_t first, std::size_t last) {
  const auto begin = order_.begin();
  const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
  Bounds3 centres;
  for (std::size_t i = first; i < last; ++i) {
    const Atom& atom = field_.atoms()[order_[i]];
    centres.add(atom.centre);
    tree_[node].add(supportOf(atom));
  }
  if (last - first <= kLeaf) return;
  const Vec3 extent = centres.diagonal();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t middle = first + (last - first + 1) / 2;
  std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
    return field_.atoms()[a].centre[axis] < field_.atoms()[b].centre[axis];
  });
  sort(2 * node + 1, first, middle);
  sort(2 * node + 2, middle, last);
}

// Leaves are handed over many at a time, for the lanes of the loops.
template <class Visit>
void WholeField::visitReaching(const DPoint3& lo, const DPoint3& hi, const Visit& visit) const {
  std::array<std::uint32_t, 32 * kLeaf> some;
  std::size_t count = 0;
  const auto descend = [&](const auto& self, std::size_t node, std::size_t first,
                           std::size_t last) -> void {
    const Bounds3& box = tree_[node];
    for (int i = 0; i < 3; ++i)
      if (hi[i] < box.lo[i] || lo[i] > box.hi[i]) return;
    if (last - first > kLeaf) {
      const std::size_t middle = first + (last - first + 1) / 2;
      self(self, 2 * node + 1, first, middle);
      self(self, 2 * node + 2, middle, last);
      return;
    }
    if (count + kLeaf > some.size()) {
      visit(AtomList(some.data(), count));
      count = 0;
    }
    for (std::size_t i = first; i < last; ++i) some[count++] = order_[i];
  };
  descend(descend, 0, 0, order_.size());
  visit(AtomList(some.data(), count));
}

// Every part of the sum has the -1 of the whole.
FieldPoint WholeField::at(const DPoint3& p) const {
  FieldPoint sum{-1};
  visitReaching(p, p, [&](AtomList list) {
    const FieldSample part = field_.sample(p, list);
    sum.value += part.value + 1;
    sum.gradient += part.gradient;
  });
  return sum;
}

FieldRange WholeField::over(const DPoint3& lo, const DPoint3& hi) const {
  FieldRange sum{-1};
  visitReaching(lo, hi, [&](AtomList list) {
    const FieldRange part = field_.range(lo, hi, list);
    sum.value += part.value + 1;
    for (int i = 0; i < 3; ++i) sum.gradient[i] += part.gradient[i];
  });
  return sum;
}

glm::dmat3 WholeField::hessian(const DPoint3& p) const {
  glm::dmat3 sum(0);
  visitReaching(p, p, [&](AtomList list) { sum += field_.sample(p, list).hessian; });
  return sum;
}

}  // namespace pbrt::metaballs
