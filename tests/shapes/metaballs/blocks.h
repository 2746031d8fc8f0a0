#pragma once
// The atoms that a ray may meet, found apart from Cells.

#include <numeric>
#include <span>
#include <vector>

#include "core/base/ray.h"
#include "shapes/metaballs/field.h"

namespace pbrt::metaballs::test {

// The atoms in blocks of neighbours, each with a ball around the supports, so that those near a ray
// are found without looking at all.
class Blocks {
 public:
  explicit Blocks(const Field& field) : field_(field), order_(field.atoms().size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    split(order_);
  }
  const Field& field() const { return field_; }

  // Calls f with every atom whose support the ray's line meets, and with few others.
  template <class F>
  void eachNear(const ObjectRay& ray, F f) const {
    const double dd = lengthSquared(ray.d);
    const auto near = [&](const DPoint3& centre, double radius) {
      const DVec3 v = centre - ray.o, across = v - glm::dot(v, ray.d) / dd * ray.d;
      const double slack = 64 * kEpsilon * (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
      return lengthSquared(across) <= sqr((1 + 64 * kEpsilon) * radius + slack);
    };
    for (const Block& block : blocks_)
      if (near(block.centre, block.radius))
        for (const std::uint32_t j : block.atoms)
          if (const Atom& atom = field_.atoms()[j]; near(DPoint3(atom.centre), atom.radius))
            f(atom);
  }

 private:
  struct Block {
    DPoint3 centre{};
    double radius = 0;
    std::span<const std::uint32_t> atoms;
  };
  void split(std::span<std::uint32_t> atoms) {
    DPoint3 lo(kInfinity), hi(-kInfinity);
    for (const std::uint32_t j : atoms) {
      const DPoint3 c(field_.atoms()[j].centre);
      lo = glm::min(lo, c);
      hi = glm::max(hi, c);
    }
    if (atoms.size() > 12) {
      const DVec3 edge = hi - lo;
      const int axis = edge.x >= edge.y ? (edge.x >= edge.z ? 0 : 2) : (edge.y >= edge.z ? 1 : 2);
      const auto half = static_cast<std::ptrdiff_t>(atoms.size() / 2);
      std::ranges::nth_element(atoms, atoms.begin() + half, {},
                               [&](std::uint32_t j) { return field_.atoms()[j].centre[axis]; });
      split(atoms.first(half));
      split(atoms.subspan(half));
    } else if (!atoms.empty()) {
      Block block{0.5 * lo + 0.5 * hi, 0, atoms};
      for (const std::uint32_t j : atoms) {
        const Atom& atom = field_.atoms()[j];
        block.radius = std::max(
            block.radius,
            (1 + 8 * kEpsilon) * (glm::length(DPoint3(atom.centre) - block.centre) + atom.radius));
      }
      blocks_.push_back(block);
    }
  }

  const Field& field_;
  std::vector<std::uint32_t> order_;
  std::vector<Block> blocks_;
};

}  // namespace pbrt::metaballs::test
