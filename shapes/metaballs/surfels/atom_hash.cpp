#include "shapes/metaballs/surfels/atom_hash.h"

#include <bit>

namespace pbrt::surfels {

// A counting sort: each bin's atoms are counted, get a run of their own, and are put there.
void AtomHash::build(std::span<const metaballs::Atom> atoms, std::span<const std::uint32_t> numbers,
                     double largest) {
  side_ = largest / kCellsToBin;
  bins_.assign(std::bit_ceil(2 * numbers.size() + 1), {});
  mask_ = bins_.size() - 1;
  slots_.resize(numbers.size());
  numbers_.resize(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const CellKey key = keyAt(DPoint3(atoms[numbers[i]].centre), 1 / largest);
    const auto slot = static_cast<std::uint32_t>(&find(key) - bins_.data());
    bins_[slot].key = key;
    ++bins_[slot].count;
    slots_[i] = slot;
  }
  std::uint32_t end = 0;
  for (Bin& bin : bins_) bin.first = end += bin.count;
  for (std::size_t i = numbers.size(); i-- > 0;) numbers_[--bins_[slots_[i]].first] = numbers[i];
}

}  // namespace pbrt::surfels
