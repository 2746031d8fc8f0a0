#include "tests/support.h"

namespace pbrt {
namespace {

long double axis(long double x, long double r, long double alpha) {
  return std::max(0.0L, std::exp(-alpha * x * x) - std::exp(-alpha * r * r));
}

TEST(GaussianFilter, IsAGaussianLoweredToZeroAtItsWidth) {
  for (const float alpha : {1e-5F, 0.5F, 2.F, 30.F}) {
    const auto f = test::make<Filter>(
        "gaussian",
        {test::number("xwidth", 3), test::number("ywidth", 1.5F), test::number("alpha", alpha)});
    for (float x = -3; x <= 3; x += 0.1F)
      for (float y = -1.5F; y <= 1.5F; y += 0.1F) {
        const long double exact = axis(x, 3, alpha) * axis(y, 1.5L, alpha);
        EXPECT_NEAR(f->evaluate({x, y}), exact, 1e-6L * exact + 1e-30L) << x << ' ' << y;
      }
  }
  EXPECT_EQ(test::make<Filter>("gaussian")->radius(), Vec2(2));
}

TEST(GaussianFilter, WouldRatherFailThanBeZeroEverywhere) {
  for (const float alpha : {0.F, -1.F, 1e-30F})
    EXPECT_THROW(test::make<Filter>("gaussian", {test::number("alpha", alpha)}), Error);
}

}  // namespace
}  // namespace pbrt
