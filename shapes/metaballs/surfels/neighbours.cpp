#include "shapes/metaballs/surfels/neighbours.h"

#include <bit>

#include "core/base/rng.h"
#include "shapes/metaballs/surfels/chunks.h"

namespace pbrt::surfels {
namespace {

// The number of the cell along an axis, whole, and still a number for points that are too far out
// for their cells to be told apart.
double cellOf(double x, double reach) {
  return std::floor(std::clamp(x / reach, -0x1p62, 0x1p62));
}

std::uint64_t keyOf(const DPoint3& p, double reach) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
    key =
        key << kKeyBits |
        (static_cast<std::uint64_t>(static_cast<std::int64_t>(cellOf(p[axis], reach))) & kKeyMask);
  return key;
}

}  // namespace

std::uint64_t Neighbours::keyAt(const DPoint3& p) const {
  return keyOf(p, reach_);
}

// Counting sort by bucket, and by key where cells share one. The sorts keep the order of what is
// equal.
std::span<const std::uint32_t> Neighbours::sort(std::span<const Surfel> surfels, double reach) {
  reach_ = reach;
  const std::size_t n = surfels.size();
  // About one bucket in six is taken, one block in two.
  const unsigned blockBits = std::bit_width(n / 256 + 1);
  shift_ = 64 - blockBits;
  unsorted_.resize(n), keys_.resize(n), order_.resize(n);
  forChunks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) unsorted_[i] = keyOf(surfels[i].p, reach);
  });
  starts_.assign((std::size_t{512} << blockBits) + 1, 0);
  for (const std::uint64_t key : unsorted_) ++starts_[bucketOf(key, shift_)];
  std::uint32_t sum = 0;
  for (std::uint32_t& start : starts_) start = sum += start;
  for (std::size_t i = n; i-- > 0;)
    order_[--starts_[bucketOf(unsorted_[i], shift_)]] = static_cast<std::uint32_t>(i);
  cells_.clear();
  for (std::size_t i = 0; i < n;) {
    const std::uint32_t end = starts_[bucketOf(unsorted_[order_[i]], shift_) + 1];
    const auto less = [&](std::uint32_t a, std::uint32_t b) { return unsorted_[a] < unsorted_[b]; };
    if (!std::is_sorted(&order_[i], &order_[i] + (end - i), less))
      std::stable_sort(&order_[i], &order_[i] + (end - i), less);
    for (; i < end; ++i) {
      keys_[i] = unsorted_[order_[i]];
      if (cells_.empty() || cells_.back().key != keys_[i])
        cells_.push_back({keys_[i], static_cast<std::uint32_t>(i), 0});
      ++cells_.back().count;
    }
  }
  return order_;
}

void Neighbours::store(std::span<const Surfel> surfels, std::span<const float> crowding) {
  for (int axis = 0; axis < 3; ++axis) {
    place_[axis].resize(surfels.size() + 8);
    normal_[axis].resize(surfels.size() + 8);
  }
  crowding_.assign(crowding.begin(), crowding.end());
  crowding_.resize(surfels.size() + 8);
  forChunks(surfels.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      // A hair's breadth, that no two are at quite the same place and stay there.
      const std::uint64_t random = mixBits(i + 1);
      for (int axis = 0; axis < 3; ++axis) {
        const double x = surfels[i].p[axis] / reach_;
        const auto hair = 0x1p-32F * static_cast<float>(random >> 16 * axis & 0xffff);
        place_[axis][i] = static_cast<float>(x - cellOf(surfels[i].p[axis], reach_)) + hair;
        normal_[axis][i] = surfels[i].n[axis];
      }
    }
  });
}

GridView Neighbours::view() const {
  GridView v;
  for (int axis = 0; axis < 3; ++axis)
    v.place[axis] = place_[axis].data(), v.normal[axis] = normal_[axis].data();
  v.crowding = crowding_.data();
  v.keys = keys_.data(), v.starts = starts_.data(), v.shift = shift_;
  return v;
}

}  // namespace pbrt::surfels
