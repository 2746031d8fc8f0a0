// What every filter must do, whatever its shape.

#include "core/base/rng.h"
#include "core/scene/film.h"
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

// The film divides by the sum of weights: so divided, what a filter weighs is one in all. That sum
// is taken over samples, at places that the film rounds to 1/32 of the radius; were it not near the
// integral, the brightness of a detail would depend on where in the pixel it lies.
TEST_P(FilterLaws, FromATenthOfAPixelToTwentyAllWeightsTogetherAreOne) {
  for (const Vec2& r : {Vec2(0.1F), Vec2(0.5F), Vec2(1), Vec2(2), Vec2(4, 0.3F), Vec2(20)}) {
    const auto f = make(r.x, r.y);
    // By the midpoint rule, of 32 and of 256 cells a radius.
    const auto integral = [&](int cells) {
      double sum = 0;
      for (int i = -cells; i < cells; ++i)
        for (int j = -cells; j < cells; ++j)
          sum += f->evaluate((Vec2(i, j) + 0.5F) * r / static_cast<float>(cells));
      return sum * r.x * r.y / (double{1} * cells * cells);
    };
    const double exact = integral(256);
    EXPECT_GT(exact, 0) << r.x;
    EXPECT_NEAR(integral(32) / exact, 1, 0.01) << r.x << ' ' << r.y;
  }
}

TEST_P(FilterLaws, AnEvenlyLitFilmIsEven) {
  for (const Vec2& r : {Vec2(0.1F), Vec2(0.5F), Vec2(1.5F), Vec2(20, 3)}) {
    const auto f = make(r.x, r.y);
    const Point2i size(6, 5);
    Film film(size, {{0, 0}, size}, *f, {});
    Rng rng(7);
    for (int tile = 0; tile < film.tiles(); ++tile) {
      const Bounds2i pixels = film.tilePixels(tile);
      for (int y = pixels.lo.y; y < pixels.hi.y; ++y)
        for (int x = pixels.lo.x; x < pixels.hi.x; ++x)
          for (int i = 0; i < 400; ++i)
            film.add(tile, Point2(x + rng.uniform(), y + rng.uniform()), Spectrum(0.75F), 1);
    }
    const Image image = film.image();
    for (const std::size_t c : {0, 1, 2})
      for (const float v : image.channels[c]) EXPECT_NEAR(v, 0.75, 1e-6) << r.x << ' ' << r.y;
    for (const float alpha : image.channels[3]) EXPECT_NEAR(alpha, 1, 1e-6);
  }
}

// Whatever else a filter is told: an error, or finite weights.
TEST_P(FilterLaws, ExtremeParametersGiveFiniteWeightsOrErrors) {
  for (const char* name : {"alpha", "B", "C", "tau"})
    for (const float v : {1e-30F, 1e-6F, 0.3F, 1.F, 50.F, 1e6F, 1e30F, -1e30F, -2.F, 0.F}) {
      std::unique_ptr<Filter> f;
      try {
        f = test::make<Filter>(GetParam(), {test::number(name, v)});
      } catch (const Error&) {
        continue;
      }
      for (float x = 0; x < 1.1F; x += 0.05F)
        for (float y = 0; y < 1.1F; y += 0.05F)
          EXPECT_TRUE(std::isfinite(f->evaluate(Vec2(x, y) * f->radius()))) << name << ' ' << v;
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
