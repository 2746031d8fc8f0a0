#include "core/base/blocked_array.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>

namespace pbrt {
namespace {

TEST(BlockedArray, EveryCellOfEveryBlockHasItsOwnPlace) {
  for (const int apron : {0, 2}) {
    BlockedArray<int> array(37, 21, 8, apron);
    EXPECT_EQ(array.blocks(), 5 * 3);
    std::set<const int*> places;
    for (int b = 0; b < array.blocks(); ++b)
      for (int y = 0; y < array.stride(); ++y)
        for (int x = 0; x < array.stride(); ++x) places.insert(array.row(b, y) + x);
    const auto count = static_cast<std::ptrdiff_t>(places.size());
    EXPECT_EQ(count, 15 * sqr(8 + 2 * apron));
    EXPECT_EQ(*places.rbegin() - *places.begin(), count - 1) << "there are gaps";
  }
}

TEST(BlockedArray, ABlockIsContiguous) {
  BlockedArray<float> array(10, 9, 4, 1);
  for (int b = 0; b < array.blocks(); ++b)
    for (int y = 0; y + 1 < array.stride(); ++y)
      EXPECT_EQ(array.row(b, y) + array.stride(), array.row(b, y + 1));
}

TEST(BlockedArray, BlocksCoverTheArrayRowByRow) {
  const BlockedArray<int> array(10, 9, 4);
  EXPECT_EQ(array.corner(0), Point2i(0, 0));
  EXPECT_EQ(array.corner(2), Point2i(8, 0));
  EXPECT_EQ(array.corner(array.across()), Point2i(0, 4));
  EXPECT_EQ(array.corner(array.blocks() - 1), Point2i(8, 8));
}

TEST(BlockedArray, IsZeroAtFirstWhateverWasThere) {
  for (const int size : {5, 2000}) {  // from the heap; from the system
    { std::vector<int> dirt(std::size_t(size) * size, 7); }
    const BlockedArray<int> array(size, size, 8);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) EXPECT_EQ(array.row(array.blocks() - 1, y)[x], 0);
  }
}

// The first ray need not wait until a large film is cleared.
TEST(BlockedArray, TakesNoMemoryBeforeItIsWrittenTo) {
  const auto resident = [] {
    double all = 0, here = 0;
    std::ifstream("/proc/self/statm") >> all >> here;
    return here * static_cast<double>(sysconf(_SC_PAGESIZE));
  };
  const double before = resident(), size = 256 << 20;
  BlockedArray<double> array(1 << 13, 1 << 12, 32);
  EXPECT_LT(resident() - before, size / 4);
  for (int block = 0; block < array.blocks(); ++block)
    for (int y = 0; y < 32; ++y) array.row(block, y)[0] = 1;
  EXPECT_GT(resident() - before, size / 4);
}

TEST(BlockedArray, MayBeEmpty) {
  EXPECT_EQ(BlockedArray<float>().blocks(), 0);
  EXPECT_EQ(BlockedArray<float>(0, 0, 8).blocks(), 0);
}

}  // namespace
}  // namespace pbrt
