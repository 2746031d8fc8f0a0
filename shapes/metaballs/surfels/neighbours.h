#pragma once
// A hash grid over surfels: who is near whom. Any number of surfels to a cell, none is lost.

#include <cstdint>
#include <vector>

#include "shapes/metaballs/surfels/simulation.h"

namespace pbrt::surfels {

// The surfels of one cell: those from `first` on.
struct Cell {
  std::uint64_t key = 0;
  std::uint32_t first = 0, count = 0;
};

// Cells are cubes as wide as the reach. The key of one holds the lowest 21 bits of each of its
// numbers: cells that have the same are two million reaches apart, so that no distance between
// their surfels is mistaken for a short one.
inline constexpr int kKeyBits = 21;
inline constexpr std::uint64_t kKeyMask = (1U << kKeyBits) - 1;

// Eight by eight by eight cells are a block. A block has the same places for its cells wherever it
// lies, so that what is near in space is near in memory; where it lies is by a hash.
inline std::uint32_t bucketOf(std::uint64_t key, unsigned shift) {
  constexpr std::uint64_t low = 7 | 7ULL << kKeyBits | 7ULL << 2 * kKeyBits;
  const std::uint64_t own =
      (key & 7) | (key >> (kKeyBits - 3) & 070) | (key >> (2 * kKeyBits - 6) & 0700);
  const std::uint64_t block = key & ~low;
  return static_cast<std::uint32_t>(
      ((block ^ block >> 32U) * 0x9e3779b97f4a7c15ULL) >> shift << 9U | own);
}

// What the inner loops see of the grid. Arrays of the surfels have eight more numbers to read.
struct GridView {
  const float* place[3] = {};  // of a surfel from the corner of its cell, in reaches
  const float* normal[3] = {};
  const float* crowding = nullptr;
  const std::uint64_t* keys = nullptr;
  const std::uint32_t* starts = nullptr;  // bucket b: the surfels from starts[b] to starts[b + 1]
  unsigned shift = 0;
};

class Neighbours {
 public:
  // `reach` above zero. Returns the order of the cells: number i is to be surfel order[i]; what
  // follows speaks of surfels in that order.
  std::span<const std::uint32_t> sort(std::span<const Surfel> surfels, double reach);
  // The surfels, now in that order, and for each what is to be averaged over those within the
  // reach.
  void store(std::span<const Surfel> surfels, std::span<const float> crowding);

  std::span<const Cell> cells() const { return cells_; }
  GridView view() const;
  // The cell of a point, as a key.
  std::uint64_t keyAt(const DPoint3& p) const;
  // Calls visit(i) for the surfels of the cells about p, which hold all within the reach, until it
  // returns true, and tells whether it did.
  template <class Visit>
  bool any(const DPoint3& p, Visit&& visit) const;

 private:
  double reach_ = 1;
  unsigned shift_ = 0;
  std::vector<std::uint64_t> keys_, unsorted_;
  std::vector<std::uint32_t> starts_, order_;
  std::vector<Cell> cells_;
  std::vector<float> place_[3], normal_[3], crowding_;
};

// The key of the cell (i, j, k) away.
inline std::uint64_t keyBeside(std::uint64_t key, int i, int j, int k) {
  const auto part = [&](int axis, int step) {
    const int at = (2 - axis) * kKeyBits;
    const auto moved = (key >> at) + static_cast<std::uint64_t>(static_cast<std::int64_t>(step));
    return (moved & kKeyMask) << at;
  };
  return part(0, i) | part(1, j) | part(2, k);
}

template <class Visit>
bool Neighbours::any(const DPoint3& p, Visit&& visit) const {
  const std::uint64_t own = keyAt(p);
  for (int c = 0; c < 27; ++c) {
    const std::uint64_t key = keyBeside(own, c / 9 - 1, c / 3 % 3 - 1, c % 3 - 1);
    const std::uint32_t bucket = bucketOf(key, shift_);
    for (std::uint32_t i = starts_[bucket]; i < starts_[bucket + 1]; ++i)
      if (keys_[i] == key && visit(i)) return true;
  }
  return false;
}

}  // namespace pbrt::surfels
