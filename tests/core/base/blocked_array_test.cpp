#include "core/base/blocked_array.h"

#include <gtest/gtest.h>

namespace pbrt {
namespace {

template <int LogBlock>
void expectEveryElementHasItsPlace(int width, int height) {
  BlockedArray<int, LogBlock> array(width, height);
  EXPECT_EQ(array.width(), width);
  EXPECT_EQ(array.height(), height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      EXPECT_EQ(array(x, y), 0);
      array(x, y) = 1 + y * width + x;
    }
  const auto& read = array;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) EXPECT_EQ(read(x, y), 1 + y * width + x);
}

TEST(BlockedArray, EveryElementHasItsPlace) {
  for (const int width : {1, 3, 4, 5, 16, 33})
    for (const int height : {1, 4, 7, 32}) {
      expectEveryElementHasItsPlace<0>(width, height);
      expectEveryElementHasItsPlace<2>(width, height);
      expectEveryElementHasItsPlace<4>(width, height);
    }
}

TEST(BlockedArray, ABlockIsContiguous) {
  BlockedArray<float, 2> array(10, 9);
  constexpr int kBlock = BlockedArray<float, 2>::kBlock;
  for (int by = 0; by + kBlock <= 9; by += kBlock)
    for (int bx = 0; bx + kBlock <= 10; bx += kBlock)
      for (int y = 0; y < kBlock; ++y)
        for (int x = 0; x < kBlock; ++x)
          EXPECT_EQ(&array(bx + x, by + y), &array(bx, by) + y * kBlock + x);
}

TEST(BlockedArray, MayBeEmpty) {
  EXPECT_EQ((BlockedArray<float, 3>().width()), 0);
  EXPECT_EQ((BlockedArray<float, 3>(0, 0).height()), 0);
}

TEST(BlockedArray, MayHoldMoreThanTwoToThe31Elements) {
  // Elements of no interest, 2 GiB of address space that is touched in two places only.
  struct Byte {
    Byte() {}  // NOLINT(modernize-use-equals-default): leaves the memory as it is
    unsigned char value;
  };
  BlockedArray<Byte, 6> array(1 << 16, (1 << 15) + 64);
  array(0, 0).value = 1;
  array((1 << 16) - 1, (1 << 15) + 63).value = 2;
  EXPECT_EQ(array(0, 0).value, 1);
  EXPECT_EQ(&array((1 << 16) - 1, (1 << 15) + 63) - &array(0, 0),
            (std::ptrdiff_t{1} << 16) * ((1 << 15) + 64) - 1);
}

}  // namespace
}  // namespace pbrt
