#include "tests/support.h"

namespace pbrt {
namespace {

TEST(TriangleFilter, FallsLinearlyOnBothAxes) {
  const auto f =
      test::make<Filter>("triangle", {test::number("xwidth", 3), test::number("ywidth", 1.5F)});
  for (float x = -4; x <= 4; x += 0.25F)
    for (float y = -2; y <= 2; y += 0.25F)
      EXPECT_FLOAT_EQ(f->evaluate({x, y}),
                      std::max(0.F, 3 - std::abs(x)) * std::max(0.F, 1.5F - std::abs(y)));
  EXPECT_EQ(test::make<Filter>("triangle")->radius(), Vec2(2));
}

}  // namespace
}  // namespace pbrt
