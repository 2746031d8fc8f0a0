#pragma once
// Which atoms reach a place: a hash grid over the atoms of about one radius.

#include <vector>

#include "core/base/rng.h"
#include "shapes/metaballs/field.h"

namespace pbrt::surfels {

// A cell of a grid, counted from the origin of space. Keys are compared in full: places that share
// a hash share nothing else.
struct CellKey {
  std::int64_t x = 0, y = 0, z = 0;

  friend bool operator==(const CellKey&, const CellKey&) = default;
  std::uint64_t hash() const {
    return mixBits(static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL +
                   static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL +
                   static_cast<std::uint64_t>(z) * 0x165667b19e3779f9ULL);
  }
};

// The traditional spatial hash (Teschner et al. 2003): an atom is in the one bin that holds its
// centre, and a question looks into the bins about it. It keeps numbers of atoms alone; those of
// the inside, for which nobody asks, cost no more than being counted.
class AtomHash {
 public:
  // Of the atoms with these numbers, whose radii are at most `largest`. Memory is used again.
  void build(std::span<const metaballs::Atom> atoms, std::span<const std::uint32_t> numbers,
             double largest);

  double cellSide() const { return side_; }
  // `p` is finite.
  CellKey cellAt(const DPoint3& p) const { return keyAt(p, 1 / side_); }
  DPoint3 centre(const CellKey& cell) const {
    return side_ * (DVec3(static_cast<double>(cell.x), static_cast<double>(cell.y),
                          static_cast<double>(cell.z)) +
                    0.5);
  }
  // Calls visit(number) for every atom whose support touches the cell, in an order that depends on
  // the cell alone.
  template <class Visit>
  void visit(std::span<const metaballs::Atom> atoms, const CellKey& cell, const Visit& visit) const;

 private:
  // Cells along a bin's side, which is the largest radius: the supports that touch a cell have
  // their centres in its bin or the 26 about it.
  static constexpr int kCellsToBin = 2;

  struct Bin {
    CellKey key;
    std::uint32_t first = 0, count = 0;  // in numbers_; none: no bin
  };

  static CellKey keyAt(const DPoint3& p, double inverseSide) {
    const DVec3 k = glm::clamp(glm::floor(p * inverseSide), -0x1p62, 0x1p62);
    return {static_cast<std::int64_t>(k.x), static_cast<std::int64_t>(k.y),
            static_cast<std::int64_t>(k.z)};
  }
  // That of the key, or the empty one where it would be.
  const Bin& find(const CellKey& key) const {
    std::size_t slot = key.hash() & mask_;
    while (bins_[slot].count > 0 && bins_[slot].key != key) slot = (slot + 1) & mask_;
    return bins_[slot];
  }

  double side_ = 1;
  std::size_t mask_ = 0;
  std::vector<Bin> bins_;  // open addressing, linear probing
  std::vector<std::uint32_t> slots_, numbers_;
};

template <class Visit>
void AtomHash::visit(std::span<const metaballs::Atom> atoms, const CellKey& cell,
                     const Visit& visit) const {
  const DPoint3 c = centre(cell);
  // Half a cell, and what its place and that of a point in it may be off by.
  const double half =
      side_ * (0.5 + 0x1p-20) + 0x1p-50 * std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  const CellKey bin = keyAt(c, 1 / (kCellsToBin * side_));
  for (std::int64_t z = bin.z - 1; z <= bin.z + 1; ++z)
    for (std::int64_t y = bin.y - 1; y <= bin.y + 1; ++y)
      for (std::int64_t x = bin.x - 1; x <= bin.x + 1; ++x) {
        const Bin& found = find({x, y, z});
        for (std::uint32_t i = found.first; i < found.first + found.count; ++i) {
          const metaballs::Atom& atom = atoms[numbers_[i]];
          const DVec3 off = glm::max(glm::abs(DPoint3(atom.centre) - c) - half, DVec3(0));
          const double radius = atom.radius;
          if (lengthSquared(off) <= radius * radius) visit(numbers_[i]);
        }
      }
}

}  // namespace pbrt::surfels
