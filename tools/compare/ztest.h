#pragma once
// Whether two noisy pictures may be of the same scene: their difference, block by block, against
// what the noise that they state allows.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace pbrt {

// A block of pixels whose mean in one channel is z standard deviations above the reference's.
struct BlockZ {
  Point2i corner{0};  // the block's upper left pixel
  int channel = 0;    // of ZTest::channels
  float z = 0;        // infinite if it cannot be worked out: not a number, a variance below 0
};

// All blocks of one size, each in every channel. Those at the right and lower border are cut off.
struct ZScale {
  int size = 0;                  // of a side, in pixels; 0: one block, the whole picture
  std::size_t n = 0;             // blocks x channels; 0: pixels need 16 samples to be judged
  double beyond3 = 0;            // share of |z| > 3; normal noise alone gives 0.0027
  BlockZ worst;                  // the largest |z|
  std::vector<BlockZ> failures;  // more than noise explains; the worst first
};

struct ZTest {
  std::vector<std::string> channels;                   // those tested, as in the reference
  bool referenceIsExact = false, testIsExact = false;  // it states no variance of these
  std::array<ZScale, 4> scales;  // blocks of 1, 8 and 32 pixels a side, and the whole picture

  // Whether noise explains all differences.
  bool agree() const;
};

// Tests every channel X that states its variance in "Variance.X", in one of the pictures at least;
// a picture states none if its attribute "samplesPerPixel" is below 2 or missing. A picture without
// a variance is taken as exact: right for a computed one, while a rendered one then makes alarms of
// its own noise. `alpha` bounds the chance that noise alone makes any block of any scale fail.
// Empty if no channel states its variance. Throws Error, Failure::usage, if the
// windows differ or `alpha` is not within (0, 1).
std::optional<ZTest> zTest(const Image& reference, const Image& test, double alpha = 1e-3);

}  // namespace pbrt
