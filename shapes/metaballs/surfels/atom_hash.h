#pragma once
// Which atoms reach a place: a hash grid over the atoms of about one radius.

#include <array>
#include <vector>

#include "core/base/rng.h"
#include "shapes/metaballs/surfels/atom_loops.h"

namespace pbrt::surfels {

// A cell of a grid, counted from the origin of space. Keys are compared in full: places that share
// a hash share nothing else.
struct CellKey {
  std::int64_t x, y, z;

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
  void build(std::span<const Atom> atoms, std::span<const std::uint32_t> numbers, double largest);

  // `p` is finite.
  CellKey cellAt(const DPoint3& p) const { return keyAt(p, 1 / side_); }
  CellFrame frame(const CellKey& cell) const;
  // Calls visit(run) until all atoms whose supports touch the cell were in a run, in an order that
  // depends on the cell alone.
  template <class Visit>
  void visit(std::span<const Atom> atoms, const CellFrame& cell, const Visit& visit) const;

 private:
  // Cells along a bin's side, which is the largest radius: the supports that touch a cell have
  // their centres in its bin or the 26 about it.
  static constexpr int kCellsToBin = 1;

  struct Bin {
    CellKey key;
    std::uint32_t first = 0, count = 0;  // in numbers_
  };

  static CellKey keyAt(const DPoint3& p, double inverseSide) {
    const DVec3 k = glm::clamp(glm::floor(p * inverseSide), -0x1p62, 0x1p62);
    return {static_cast<std::int64_t>(k.x), static_cast<std::int64_t>(k.y),
            static_cast<std::int64_t>(k.z)};
  }
  // Where the bin is in the table, or where it would be.
  std::size_t slotOf(const CellKey& key) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = key.hash() & mask;
    while (table_[slot] > 0 && bins_[table_[slot] - 1].key != key) slot = (slot + 1) & mask;
    return slot;
  }
  void grow();

  double side_ = 1;
  std::vector<Bin> bins_;             // in the order of their first atoms
  std::vector<std::uint32_t> table_;  // open addressing: number of a bin + 1, or 0
  std::vector<std::uint32_t> binOf_;  // of each atom
  std::vector<std::uint32_t> numbers_;
};

template <class Visit>
void AtomHash::visit(std::span<const Atom> atoms, const CellFrame& cell, const Visit& visit) const {
  const AtomLoops& loops = atomLoops();
  AtomRun run;
  std::array<std::uint32_t, 512> candidates;
  std::size_t count = 0;
  const auto flush = [&] {
    for (std::size_t i = 0; i < count;) {
      i += loops.gather(atoms, AtomList(candidates.data() + i, count - i), cell, run);
      if (run.count + kLanes <= AtomRun::kMost) continue;
      visit(run);
      run.count = 0;
    }
    count = 0;
  };
  const CellKey bin = keyAt(cell.centre, 1 / (kCellsToBin * side_));
  for (std::int64_t z = bin.z - 1; z <= bin.z + 1; ++z)
    for (std::int64_t y = bin.y - 1; y <= bin.y + 1; ++y)
      for (std::int64_t x = bin.x - 1; x <= bin.x + 1; ++x) {
        const std::uint32_t found = table_[slotOf({x, y, z})];
        if (found == 0) continue;
        const Bin& b = bins_[found - 1];
        for (std::uint32_t i = b.first; i < b.first + b.count; ++i) {
          if (count == candidates.size()) flush();
          candidates[count++] = numbers_[i];
        }
      }
  flush();
  if (run.count > 0) visit(run);
}

}  // namespace pbrt::surfels
