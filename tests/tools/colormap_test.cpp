#include "tools/compare/colormap.h"

#include <gtest/gtest.h>

#include <array>

#include "core/base/error.h"

namespace pbrt {
namespace {

// The code values that a PNG has.
std::array<float, 3> codes(const Image& image, std::size_t i) {
  std::array<float, 3> code{};
  for (int c = 0; c < 3; ++c) {
    const float x = image.channels[c][i];
    code[c] = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
  }
  return code;
}

TEST(HeatMap, IsMagma) {
  // Colours of matplotlib's map (CC0) by index, 0 to 255.
  const std::pair<int, std::array<float, 3>> expected[] = {
      {0, {0.001462F, 0.000466F, 0.013866F}},   {8, {0.013708F, 0.011771F, 0.068667F}},
      {22, {0.065330F, 0.047318F, 0.184892F}},  {37, {0.140858F, 0.068654F, 0.324538F}},
      {52, {0.238826F, 0.059517F, 0.443256F}},  {67, {0.335308F, 0.078236F, 0.491024F}},
      {97, {0.519045F, 0.150383F, 0.507443F}},  {112, {0.613617F, 0.181811F, 0.498536F}},
      {127, {0.709962F, 0.212797F, 0.477201F}}, {142, {0.804752F, 0.249911F, 0.442102F}},
      {157, {0.889731F, 0.305079F, 0.397002F}}, {172, {0.950210F, 0.390820F, 0.362468F}},
      {187, {0.981000F, 0.498428F, 0.369734F}}, {202, {0.993834F, 0.609644F, 0.418613F}},
      {217, {0.997351F, 0.719089F, 0.493755F}}, {232, {0.995131F, 0.827052F, 0.585701F}},
      {247, {0.989815F, 0.934329F, 0.690198F}}, {255, {0.987053F, 0.991438F, 0.749504F}}};
  for (const auto& [index, colour] : expected) {
    const Image image = heatMap({static_cast<float>(index) / 255}, 1, 1);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(codes(image, 0)[c], colour[c], 0.012) << index;
  }
}

TEST(HeatMap, GrowsBrighterWithTheErrorAndStopsAtTheEnds) {
  std::vector<float> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(static_cast<float>(i) / 1000);
  const Image image = heatMap(values, 1001, 1);
  const auto luminance = [&](std::size_t i) {
    return 0.2126F * image.channels[0][i] + 0.7152F * image.channels[1][i] +
           0.0722F * image.channels[2][i];
  };
  for (std::size_t i = 1; i < values.size(); ++i) ASSERT_GT(luminance(i), luminance(i - 1)) << i;

  const Image ends = heatMap({-1, 2, kInfinity, std::nanf("")}, 2, 2);
  EXPECT_EQ(ends.window, (Bounds2i{{0, 0}, {2, 2}}));
  EXPECT_EQ(codes(ends, 0), codes(image, 0));
  for (const std::size_t i : {1, 2, 3}) EXPECT_EQ(codes(ends, i), codes(image, 1000));
}

TEST(HeatMap, RefusesOtherThanOneValuePerPixel) {
  EXPECT_THROW(heatMap({}, 0, 0), Error);
  EXPECT_THROW(heatMap({1, 1, 1}, 2, 2), Error);
  EXPECT_THROW(heatMap({1, 1}, -1, -2), Error);
}

}  // namespace
}  // namespace pbrt
