#pragma once
// Whether two pictures are one.

#include <gtest/gtest.h>

#include "core/base/image.h"

namespace pbrt::test {

// Bit for bit, and in all that they say but how long they took.
inline void expectSamePicture(const Image& a, const Image& b) {
  EXPECT_EQ(a.window, b.window);
  EXPECT_EQ(a.names, b.names);
  EXPECT_TRUE(a.channels == b.channels);
  auto ofA = a.attributes, ofB = b.attributes;
  ofA.erase("renderTimeSeconds"), ofB.erase("renderTimeSeconds");
  EXPECT_TRUE(ofA == ofB);
}

}  // namespace pbrt::test
