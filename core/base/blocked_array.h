#pragma once
// A two-dimensional array stored block by block, so that neighbours in both directions share
// cache lines, and a block is one contiguous piece of memory.

#include <vector>

#include "core/base/math.h"

namespace pbrt {

template <class T, int LogBlock>
class BlockedArray {
 public:
  static constexpr int kBlock = 1 << LogBlock;

  BlockedArray() = default;
  BlockedArray(int width, int height)
      : width_(width),
        height_(height),
        blocksX_((width + kBlock - 1) >> LogBlock),
        data_(static_cast<std::size_t>(blocksX_) * ((height + kBlock - 1) >> LogBlock) * kBlock *
              kBlock) {}

  int width() const { return width_; }
  int height() const { return height_; }

  T& operator()(int x, int y) { return data_[index(x, y)]; }
  const T& operator()(int x, int y) const { return data_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    const auto block = static_cast<std::size_t>(y >> LogBlock) * blocksX_ + (x >> LogBlock);
    return (block << (2 * LogBlock)) + ((y & (kBlock - 1)) << LogBlock) + (x & (kBlock - 1));
  }

  int width_ = 0, height_ = 0, blocksX_ = 0;
  std::vector<T> data_;
};

}  // namespace pbrt
