#include "tests/support.h"

namespace pbrt {
namespace {

long double sinc(long double x) {
  const long double y = std::numbers::pi_v<long double> * x;
  return y == 0 ? 1 : std::sin(y) / y;
}

TEST(SincFilter, IsTheWindowedSinc) {
  for (const float tau : {0.5F, 3.F, 4.F, 100.F}) {
    const auto f = test::make<Filter>(
        "sinc", {test::number("xwidth", 4), test::number("ywidth", 2), test::number("tau", tau)});
    for (float x = -4; x <= 4; x += 0.125F)
      for (float y = -2; y <= 2; y += 0.0625F)
        EXPECT_NEAR(f->evaluate({x, y}), sinc(x) * sinc(x / tau) * sinc(y) * sinc(y / tau), 1e-6L);
    for (const float x : {1e-7F, 1e-5F, 0.99e-4F, 1.01e-4F, 1e-3F})
      EXPECT_NEAR(f->evaluate({x, 0}), sinc(x) * sinc(x / tau), 2e-7L);
  }
  EXPECT_EQ(test::make<Filter>("sinc")->radius(), Vec2(4));
}

TEST(SincFilter, WindowMustHaveAWidth) {
  EXPECT_THROW(test::make<Filter>("sinc", {test::number("tau", 0)}), Error);
}

}  // namespace
}  // namespace pbrt
