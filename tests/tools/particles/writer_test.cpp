#include "tools/particles/writer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace pbrt {
namespace {

TEST(Writer, DoesItsWorkInOrder) {
  std::vector<int> done;
  Writer writer;
  for (int i = 0; i < 1000; ++i) writer.put([&done, i] { done.push_back(i); });
  writer.finish();
  ASSERT_EQ(done.size(), 1000U);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
  writer.finish();
}

TEST(Writer, ThreeAreUnderWayAtMost) {
  std::atomic<int> done = 0;
  Writer writer;
  for (int i = 0; i < 100; ++i) {
    writer.put([&] { ++done; });
    EXPECT_GE(done, i + 1 - 3);
  }
}

TEST(Writer, TellsOfWhatFailedAndStops) {
  int later = 0;
  Writer writer;
  EXPECT_THROW(
      {
        writer.put([] { throw std::runtime_error("full"); });
        for (int i = 0; i < 10; ++i) writer.put([&] { ++later; });
      },
      std::runtime_error);
  EXPECT_THROW(writer.finish(), std::runtime_error);
  EXPECT_THROW(writer.put([&] { ++later; }), std::runtime_error);
  EXPECT_EQ(later, 0);
}

TEST(Writer, DoesWhatWaitsBeforeItGoes) {
  for (int run = 0; run < 100; ++run) {
    int done = 0;
    {
      Writer writer;
      writer.put([&] { ++done; });
      writer.put([&] { ++done; });
    }
    EXPECT_EQ(done, 2);
  }
}

}  // namespace
}  // namespace pbrt
