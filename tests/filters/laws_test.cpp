// What every filter must do, whatever its shape.

#include "tests/support.h"

namespace pbrt {
namespace {

class FilterLaws : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Filter> make(float x, float y) const {
    return test::make<Filter>(GetParam(), {test::number("xwidth", x), test::number("ywidth", y)});
  }
};

INSTANTIATE_TEST_SUITE_P(All, FilterLaws,
                         testing::ValuesIn(test::loader().available(PluginKind::filter)),
                         [](const auto& test) { return test.param; });

const std::vector<Vec2> kRadii = {{0.5F, 0.5F}, {2, 2}, {1.5F, 3.25F}, {4, 0.75F}};

TEST_P(FilterLaws, IsEven) {
  for (const Vec2& r : kRadii) {
    const auto f = make(r.x, r.y);
    EXPECT_EQ(f->radius(), r);
    for (float x = 0; x < 1.2F; x += 0.07F)
      for (float y = 0; y < 1.2F; y += 0.07F) {
        const Vec2 p = Vec2(x, y) * r;
        const float w = f->evaluate(p);
        EXPECT_TRUE(std::isfinite(w));
        EXPECT_EQ(f->evaluate({-p.x, p.y}), w);
        EXPECT_EQ(f->evaluate({p.x, -p.y}), w);
        EXPECT_EQ(f->evaluate(-p), w);
      }
  }
}

TEST_P(FilterLaws, IsZeroBeyondItsRadius) {
  for (const Vec2& r : kRadii) {
    const auto f = make(r.x, r.y);
    const Vec2 beyond(std::nextafter(r.x, 100.F), std::nextafter(r.y, 100.F));
    for (float t = 0; t < 2; t += 0.1F) {
      EXPECT_EQ(f->evaluate({beyond.x, t * r.y}), 0);
      EXPECT_EQ(f->evaluate({t * r.x, -beyond.y}), 0);
      EXPECT_EQ(f->evaluate({(1.001F + t) * r.x, t}), 0);
    }
  }
}

TEST_P(FilterLaws, HasAPositiveIntegralAndItsPeakAtTheCentre) {
  for (const Vec2& r : kRadii) {
    const auto f = make(r.x, r.y);
    const float peak = f->evaluate(Vec2(0));
    double sum = 0;
    for (int i = -100; i < 100; ++i)
      for (int j = -100; j < 100; ++j) {
        const float w = f->evaluate((Vec2(i, j) + 0.5F) * r / 100.F);
        EXPECT_LE(std::abs(w), peak);
        sum += w;
      }
    EXPECT_GT(sum, 0);
  }
}

// All but the box, which has a step.
TEST_P(FilterLaws, IsContinuous) {
  if (GetParam() == "box") GTEST_SKIP() << "has a step";
  for (const Vec2& r : {Vec2(2, 2), Vec2(4, 3)}) {  // the sinc's width is a zero of it
    const auto f = make(r.x, r.y);
    const float peak = f->evaluate(Vec2(0));
    for (int i = -2100; i < 2100; ++i) {
      const float x = static_cast<float>(i) / 2000, next = static_cast<float>(i + 1) / 2000;
      for (const float y : {0.F, 0.3F, 0.7F}) {
        EXPECT_NEAR(f->evaluate(Vec2(x, y) * r), f->evaluate(Vec2(next, y) * r), 0.004F * peak);
        EXPECT_NEAR(f->evaluate(Vec2(y, x) * r), f->evaluate(Vec2(y, next) * r), 0.004F * peak);
      }
    }
  }
}

TEST_P(FilterLaws, WidthsMustBePositive) {
  for (const float bad : {0.F, -1.F, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_THROW(make(bad, 1), Error);
    EXPECT_THROW(make(1, bad), Error);
  }
}

}  // namespace
}  // namespace pbrt
