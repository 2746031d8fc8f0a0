#include "core/base/colorspace.h"

#include <gtest/gtest.h>

namespace pbrt {
namespace {

// `expected`: row by row, as matrices are printed.
void expectMatrix(const glm::dmat3& m, const double (&expected)[9], double tolerance) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      EXPECT_NEAR(m[column][row], expected[3 * row + column], tolerance) << row << ' ' << column;
}

TEST(ColorSpace, IsFoundByTheNamesOfPbrt4) {
  EXPECT_EQ(findColorSpace("srgb"), ColorSpace::srgb);
  EXPECT_EQ(findColorSpace("rec2020"), ColorSpace::rec2020);
  EXPECT_EQ(findColorSpace("aces2065-1"), ColorSpace::aces2065_1);
  EXPECT_EQ(findColorSpace("dci-p3"), ColorSpace::dci_p3);
  EXPECT_FALSE(findColorSpace("sRGB"));
  EXPECT_FALSE(findColorSpace(""));
  for (const std::string& name : colorSpaceNames()) EXPECT_TRUE(findColorSpace(name)) << name;
}

TEST(ColorSpace, WhiteStaysWhite) {
  for (const std::string& name : colorSpaceNames()) {
    const DVec3 white = toRec709(*findColorSpace(name)) * DVec3(1);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1, 1e-12) << name;
  }
}

TEST(ColorSpace, MatricesArePublishedOnes) {
  expectMatrix(toRec709(ColorSpace::srgb), {1, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-12);
  // ITU-R BT.2407.
  expectMatrix(toRec709(ColorSpace::rec2020),
               {1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083, -0.0182, -0.1006, 1.1187},
               3e-4);
  expectMatrix(toRec709(ColorSpace::dci_p3),
               {1.2249, -0.2249, 0, -0.0420, 1.0420, 0, -0.0196, -0.0786, 1.0983}, 3e-4);
  // The academy's own, with the Bradford matrix.
  expectMatrix(toRec709(ColorSpace::aces2065_1),
               {2.5217, -1.1341, -0.3876, -0.2765, 1.3727, -0.0962, -0.0154, -0.1530, 1.1683},
               6e-4);
}

TEST(ColorSpace, LuminanceIsThatOfRec709) {
  const glm::dmat3 xyzFromRec709 = glm::inverse(rec709FromXyz());
  for (const Spectrum c : {Spectrum(1, 0, 0), Spectrum(0, 1, 0), Spectrum(0, 0, 1)})
    EXPECT_NEAR((xyzFromRec709 * DVec3(c)).y, luminance(c), 1e-4);
}

}  // namespace
}  // namespace pbrt
