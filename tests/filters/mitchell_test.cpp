#include "tests/support.h"

namespace pbrt {
namespace {

std::unique_ptr<Filter> mitchell(float radius, float b, float c) {
  return test::make<Filter>("mitchell",
                            {test::number("xwidth", radius), test::number("ywidth", radius),
                             test::number("B", b), test::number("C", c)});
}

// What defines the family: the shifted copies, one per unit, sum to one everywhere.
TEST(MitchellFilter, ShiftedCopiesSumToOne) {
  for (const auto& [b, c] : {std::pair{1 / 3.F, 1 / 3.F}, {1.F, 0.F}, {0.F, 0.5F}, {0.F, 1.F}}) {
    const auto f = mitchell(2, b, c);
    for (float x = 0; x < 1; x += 0.05F)
      for (float y = 0; y < 1; y += 0.1F) {
        float sum = 0;
        for (int i = -3; i <= 3; ++i)
          for (int j = -3; j <= 3; ++j) sum += f->evaluate(Vec2(x, y) + Vec2(i, j));
        EXPECT_NEAR(sum, 1, 1e-5F);
      }
  }
}

// B = 1, C = 0 is the cubic B-spline; B = 0, C = 1/2 interpolates (Catmull and Rom).
TEST(MitchellFilter, HoldsTheKnownCubics) {
  const auto spline = mitchell(2, 1, 0);
  EXPECT_NEAR(spline->evaluate({0, 0}), 4.0 / 9, 1e-6);
  EXPECT_NEAR(spline->evaluate({1, 0}), 1.0 / 9, 1e-6);
  EXPECT_NEAR(spline->evaluate({0, 0.5F}), 2.0 / 3 * 23 / 48, 1e-6);
  EXPECT_NEAR(spline->evaluate({1.5F, 0}), 2.0 / 3 / 48, 1e-6);
  const auto interpolating = mitchell(2, 0, 0.5F);
  EXPECT_NEAR(interpolating->evaluate({0, 0}), 1, 1e-6);
  EXPECT_NEAR(interpolating->evaluate({1, 0}), 0, 1e-6);
  EXPECT_NEAR(interpolating->evaluate({0.5F, 0}), 9.0 / 16, 1e-6);
  EXPECT_NEAR(interpolating->evaluate({1.5F, 0}), -1.0 / 16, 1e-6);
}

TEST(MitchellFilter, SlopeIsContinuous) {
  const auto f = mitchell(2, 1 / 3.F, 1 / 3.F);
  const auto slope = [&](float x) {
    return (f->evaluate({x + 0.01F, 0}) - f->evaluate({x - 0.01F, 0})) / 0.02F;
  };
  for (float x = -2.05F; x < 2.05F; x += 0.01F) EXPECT_NEAR(slope(x), slope(x + 0.01F), 0.04F);
}

TEST(MitchellFilter, WidthScalesTheArgument) {
  const auto narrow = mitchell(1, 0.2F, 0.4F), wide = mitchell(4, 0.2F, 0.4F);
  for (float x = 0; x < 1.1F; x += 0.03F)
    EXPECT_NEAR(narrow->evaluate({x, 0.5F * x}), wide->evaluate({4 * x, 2 * x}), 1e-6F);
  const auto standard = test::make<Filter>("mitchell");
  EXPECT_EQ(standard->radius(), Vec2(2));
  EXPECT_FLOAT_EQ(standard->evaluate({0.3F, 0.6F}),
                  mitchell(2, 1 / 3.F, 1 / 3.F)->evaluate({0.3F, 0.6F}));
}

}  // namespace
}  // namespace pbrt
