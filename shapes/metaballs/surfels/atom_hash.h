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

enum class HashKind : std::uint8_t {
  // An atom is in the one cell that holds its centre; a question looks into 27 (Teschner et al.
  // 2003). What is inside a fluid, where nobody asks, costs no more than being counted.
  traditional,
  // An atom is in every cell that its support touches, about 20; a question looks into one (van
  // Kooten et al. 2007).
  inverted
};

// It keeps atoms cell by cell, as the inner loops want them.
class AtomHash {
 public:
  // Of the atoms with these numbers, whose radii are at most `largest`: that is a cell's side, too.
  // Memory is used again.
  void build(std::span<const Atom> atoms, std::span<const std::uint32_t> numbers, double largest,
             HashKind kind = HashKind::traditional);

  // `p` is finite.
  CellKey cellAt(const DPoint3& p) const { return keyAt(p, 1 / side_); }
  // Calls visit(frame, run) until all atoms whose supports touch the cell were in a run, once each,
  // and maybe others that are near, in an order that depends on the cell alone.
  template <class Visit>
  void visit(const CellKey& key, const Visit& visit) const;

 private:
  struct Cell {
    CellKey key;
    std::uint32_t first = 0, count = 0;  // of its atoms
  };

  static CellKey keyAt(const DPoint3& p, double inverseSide) {
    const DVec3 k = glm::clamp(glm::floor(p * inverseSide), -0x1p62, 0x1p62);
    return {static_cast<std::int64_t>(k.x), static_cast<std::int64_t>(k.y),
            static_cast<std::int64_t>(k.z)};
  }
  // Where the cell is in the table, or where it would be.
  std::size_t slotOf(const CellKey& key) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = key.hash() & mask;
    while (table_[slot] > 0 && cells_[table_[slot] - 1].key != key) slot = (slot + 1) & mask;
    return slot;
  }
  CellFrame frame(const CellKey& key) const;
  void enter(std::uint32_t number, const CellKey& key);
  // Calls visit(key) for a cell and the 26 about it.
  template <class Visit>
  static void visitAbout(const CellKey& key, const Visit& visit) {
    for (std::int64_t z = key.z - 1; z <= key.z + 1; ++z)
      for (std::int64_t y = key.y - 1; y <= key.y + 1; ++y)
        for (std::int64_t x = key.x - 1; x <= key.x + 1; ++x) visit(CellKey{x, y, z});
  }

  struct Entry {
    std::uint32_t number, cell;
  };

  HashKind kind_ = HashKind::traditional;
  double side_ = 1;
  std::vector<Cell> cells_;           // that are not empty, in the order of their first atoms
  std::vector<std::uint32_t> table_;  // open addressing: index of a cell + 1, or 0
  std::vector<Entry> entries_;
  // Of the atoms, by their cells, and kLanes more.
  std::vector<std::uint32_t> numbers_;
  std::vector<float> x_, y_, z_, inverse2_, weight_;
};

template <class Visit>
void AtomHash::visit(const CellKey& key, const Visit& visit) const {
  const CellFrame about = frame(key);
  const auto half = static_cast<float>(0.50001 + about.slack / about.side);
  const AtomLoops& loops = atomLoops();
  AtomRun run;
  const auto look = [&](const CellKey& at) {
    const std::uint32_t found = table_[slotOf(at)];
    if (found == 0) return;
    const Cell& cell = cells_[found - 1];
    const Vec3 offset(static_cast<float>(at.x - key.x), static_cast<float>(at.y - key.y),
                      static_cast<float>(at.z - key.z));
    for (std::uint32_t i = cell.first, end = i + cell.count; i < end;) {
      const CellAtoms atoms{&x_[i], &y_[i], &z_[i], &inverse2_[i], &weight_[i], &numbers_[i]};
      i += static_cast<std::uint32_t>(loops.gather(atoms, end - i, offset, half, run));
      if (run.count + kLanes <= AtomRun::kMost) continue;
      visit(about, run);
      run.count = 0;
    }
  };
  if (kind_ == HashKind::traditional)
    visitAbout(key, look);
  else
    look(key);
  if (run.count > 0) visit(about, run);
}

}  // namespace pbrt::surfels
