// Parts of a box: cut at random, and missing or there twice.

#include "tools/merge/sample_box.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/rng.h"

namespace pbrt {
namespace {

using Boxes = std::vector<SampleBox>;

// Cuts one of the boxes in two, where there is room.
void cutOne(Boxes& boxes, Rng& rng) {
  SampleBox& box = boxes[rng.uniform(static_cast<std::uint32_t>(boxes.size()))];
  const int axis = static_cast<int>(rng.uniform(3));
  const auto length = static_cast<std::uint32_t>(box.hi[axis] - box.lo[axis]);
  if (length < 2) return;
  SampleBox behind = box;
  behind.lo[axis] = box.hi[axis] = box.lo[axis] + 1 + rng.uniform(length - 1);
  boxes.push_back(behind);
}

Boxes parts(const SampleBox& whole, int cuts, Rng& rng) {
  Boxes boxes{whole};
  for (int i = 0; i < cuts; ++i) cutOne(boxes, rng);
  for (std::size_t i = boxes.size(); i > 1; --i)
    std::swap(boxes[i - 1], boxes[rng.uniform(static_cast<std::uint32_t>(i))]);
  return boxes;
}

const SampleBox kWhole({{3, 5}, {10, 11}}, 2, 12);

// How many of the boxes hold each sample of the whole, which is small.
std::vector<int> counts(const Boxes& boxes) {
  std::vector<int> result;
  for (auto z = kWhole.lo.z; z < kWhole.hi.z; ++z)
    for (auto y = kWhole.lo.y; y < kWhole.hi.y; ++y)
      for (auto x = kWhole.lo.x; x < kWhole.hi.x; ++x)
        result.push_back(static_cast<int>(std::ranges::count_if(boxes, [&](const SampleBox& b) {
          const SampleBox::Corner p(x, y, z);
          return glm::all(glm::lessThanEqual(b.lo, p)) && glm::all(glm::lessThan(p, b.hi));
        })));
  return result;
}

TEST(SampleBoxes, ThatTileLeaveNothingOut) {
  Rng rng(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Boxes boxes = parts(kWhole, trial % 40, rng);
    EXPECT_FALSE(overlapping(boxes));
    EXPECT_EQ(hull(boxes), kWhole);
    EXPECT_EQ(missing(kWhole, boxes), Boxes());
  }
}

TEST(SampleBoxes, TellWhatIsMissing) {
  Rng rng(2);
  for (int trial = 0; trial < 500; ++trial) {
    Boxes boxes = parts(kWhole, 1 + trial % 40, rng);
    const SampleBox one = boxes.back();
    boxes.pop_back();
    EXPECT_EQ(missing(kWhole, boxes), Boxes{one}) << "one part is named in one piece";
    boxes.resize(rng.uniform(static_cast<std::uint32_t>(boxes.size() + 1)));
    Boxes all = missing(kWhole, boxes);
    all.insert(all.end(), boxes.begin(), boxes.end());
    EXPECT_EQ(counts(all), std::vector<int>(counts(all).size(), 1)) << "each sample once";
  }
}

TEST(SampleBoxes, TellWhatIsThereTwice) {
  Rng rng(3);
  for (int trial = 0; trial < 500; ++trial) {
    Boxes boxes = parts(kWhole, trial % 40, rng);
    const std::size_t n = boxes.size();
    SampleBox more = boxes[rng.uniform(static_cast<std::uint32_t>(n))];
    if (trial % 2)
      for (int axis = 0; axis < 3; ++axis)
        more.lo[axis] += rng.uniform(static_cast<std::uint32_t>(more.hi[axis] - more.lo[axis]));
    boxes.push_back(more);
    const auto both = overlapping(boxes);
    ASSERT_TRUE(both);
    EXPECT_EQ(both->second, n);
    EXPECT_EQ(common(boxes[both->first], more), more);
  }
}

TEST(SampleBoxes, ThatTouchDoNotOverlap) {
  const SampleBox a({{0, 0}, {4, 4}}, 0, 8);
  EXPECT_TRUE(overlap(a, a));
  EXPECT_TRUE(overlap(a, SampleBox({{3, 3}, {5, 5}}, 7, 9)));
  EXPECT_FALSE(overlap(a, SampleBox({{4, 0}, {8, 4}}, 0, 8)));
  EXPECT_FALSE(overlap(a, SampleBox({{0, 4}, {4, 8}}, 0, 8)));
  EXPECT_FALSE(overlap(a, SampleBox({{0, 0}, {4, 4}}, 8, 9)));
}

TEST(SampleBoxes, CallThemselvesByTheOptionsThatRenderThem) {
  EXPECT_EQ(describe({{{0, 0}, {640, 480}}, 0, 16}, {640, 480}), "--samples 0..16");
  EXPECT_EQ(describe({{{0, 32}, {64, 480}}, 2000000000, 2147483647}, {640, 480}),
            "--samples 2000000000..2147483647 --pixelbounds 0,64,32,480");
}

}  // namespace
}  // namespace pbrt
