#include "shapes/metaballs/surfels/atom_hash.h"

#include <algorithm>

namespace pbrt::surfels {

CellFrame AtomHash::frame(const CellKey& cell) const {
  CellFrame f;
  f.side = side_;
  f.centre = side_ * (DVec3(static_cast<double>(cell.x), static_cast<double>(cell.y),
                            static_cast<double>(cell.z)) +
                      0.5);
  // By rounding, a point may be taken for one of the next cell.
  f.slack = 0x1p-20 * side_ +
            0x1p-50 * std::max({std::abs(f.centre.x), std::abs(f.centre.y), std::abs(f.centre.z)});
  return f;
}

void AtomHash::grow() {
  table_.assign(2 * table_.size(), 0);
  for (std::uint32_t i = 0; i < bins_.size(); ++i) table_[slotOf(bins_[i].key)] = i + 1;
}

// A counting sort: each bin's atoms are counted, get a run of their own, and are put there.
void AtomHash::build(std::span<const Atom> atoms, std::span<const std::uint32_t> numbers,
                     double largest) {
  side_ = largest / kCellsToBin;
  bins_.clear();
  table_.assign(std::max<std::size_t>(table_.size(), 64), 0);
  binOf_.resize(numbers.size());
  numbers_.resize(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const CellKey key = keyAt(DPoint3(atoms[numbers[i]].centre), 1 / largest);
    std::size_t slot = slotOf(key);
    if (table_[slot] == 0) {
      bins_.push_back({key});
      if (2 * bins_.size() > table_.size()) {
        grow();
        slot = slotOf(key);
      }
      table_[slot] = static_cast<std::uint32_t>(bins_.size());
    }
    binOf_[i] = table_[slot] - 1;
    ++bins_[binOf_[i]].count;
  }
  std::uint32_t end = 0;
  for (Bin& bin : bins_) bin.first = end += bin.count;
  for (std::size_t i = numbers.size(); i-- > 0;) numbers_[--bins_[binOf_[i]].first] = numbers[i];
}

}  // namespace pbrt::surfels
