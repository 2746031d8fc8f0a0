#pragma once
// A two-dimensional array stored block by block: neighbours in both directions share cache lines,
// and one thread can own a block without touching the lines of another.

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <vector>

#include "core/base/math.h"

namespace pbrt {

// Memory that is zero when it comes: the system brings a page when a thread first writes there.
template <class T>
struct ZeroedAllocator {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(std::max_align_t));
  using value_type = T;

  ZeroedAllocator() = default;
  template <class U>
  explicit ZeroedAllocator(const ZeroedAllocator<U>&) {}

  T* allocate(std::size_t n) {
    if (void* p = std::calloc(n, sizeof(T))) return static_cast<T*>(p);
    throw std::bad_alloc();
  }
  void deallocate(T* p, std::size_t) { std::free(p); }
  void construct(T*) {}  // it is zero already
  bool operator==(const ZeroedAllocator&) const { return true; }
};

// Cells are zero at first, byte by byte. Blocks are squares of `size` cells, numbered row by row;
// those at the right and lower edge may stand out of the array. With an apron each block also
// stores that many cells beyond its edges, its own and not its neighbours'.
template <class T>
class BlockedArray {
 public:
  BlockedArray() = default;
  // Throws std::bad_alloc or std::length_error.
  BlockedArray(int width, int height, int size, int apron = 0)
      : size_(size),
        apron_(apron),
        across_((width + size - 1) / size),
        down_((height + size - 1) / size),
        stride_(size + 2 * apron),
        cells_(std::size_t(across_) * down_ * stride_ * stride_) {}

  // What such an array takes of memory.
  static double bytes(int width, int height, int size, int apron = 0) {
    const double stride = size + 2 * apron;
    return std::ceil(double(width) / size) * std::ceil(double(height) / size) * stride * stride *
           sizeof(T);
  }

  int size() const { return size_; }
  int apron() const { return apron_; }
  int stride() const { return stride_; }  // cells in a row of a block with its apron
  int across() const { return across_; }
  int down() const { return down_; }
  int blocks() const { return across_ * down_; }
  // The cell of the whole array at the upper left corner of a block, within its apron.
  Point2i corner(int block) const { return Point2i(block % across_, block / across_) * size_; }

  // Row y of a block, from 0 to stride() - 1, from the upper left corner of its apron.
  T* row(int block, int y) { return &cells_[index(block, y)]; }
  const T* row(int block, int y) const { return &cells_[index(block, y)]; }

 private:
  std::size_t index(int block, int y) const { return (std::size_t(block) * stride_ + y) * stride_; }

  int size_ = 1, apron_ = 0, across_ = 0, down_ = 0, stride_ = 1;
  std::vector<T, ZeroedAllocator<T>> cells_;
};

}  // namespace pbrt
